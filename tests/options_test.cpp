#include <CLI/CLI.hpp>
#include <gmock/gmock.h>

#include "bench/commands.hpp"

namespace seam {
namespace {

// What the program says to `command name value`, the value as often as the option takes it.
std::string refusal(const std::string& command, const CLI::Option& option,
                    const std::string& value) {
  CLI::App app;
  add_commands(app);
  const auto count = static_cast<std::size_t>(option.get_expected_min());
  std::vector<std::string> arguments(count, value);  // from the last to the first
  arguments.push_back(option.get_name());
  arguments.push_back(command);
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "none";
}

struct Number {
  std::string command;
  const CLI::Option* option;
  bool whole;
};

std::vector<Number> number_options(CLI::App& app) {
  std::vector<Number> all;
  for (const CLI::App* command : app.get_subcommands({}))
    for (const CLI::Option* option : command->get_options()) {
      const std::string type = option->get_type_name().substr(0, option->get_type_name().find(':'));
      if (type == "FLOAT" || type == "INT" || type == "UINT")
        all.push_back({command->get_name(), option, type != "FLOAT"});
    }
  return all;
}

TEST(Options, TakeNoNumberThatIsNotFiniteWhateverTheCommand) {
  CLI::App app;
  add_commands(app);
  const std::vector<Number> numbers = number_options(app);
  ASSERT_GE(numbers.size(), 30U);
  for (const auto& [command, option, whole] : numbers)
    for (const char* value : {"nan", "-nan", "inf", "-inf", "infinity", "1e400", "one", "1s", ""})
      EXPECT_EQ(refusal(command, *option, value),
                option->get_name() + ": " + value +
                    (whole ? ", must be a whole number" : ", must be a finite number"))
          << command;
}

}  // namespace
}  // namespace seam
