#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace seam {

/// Makes every option of the commands that takes a number refuse what is none, and NaN and infinity, before anything else
/// looks at it. To be called when all options are there.
void require_numbers(CLI::App& app);

/// Options that several commands have.
int all_cores();  // the default of `--jobs`
void add_jobs_option(CLI::App& command, int& jobs);
void add_set_option(CLI::App& command, std::vector<std::string>& overrides);
void add_allow_option(CLI::App& command, std::vector<std::string>& folders);

}  // namespace seam
