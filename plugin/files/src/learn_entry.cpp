#include "learn_entry.hpp"

#include <seam/learn.hpp>
#include <seam/orientation.hpp>

namespace seam {

namespace {

constexpr int most_kernels = 1000;
constexpr double most_work = 1e10;  // samples × kernels², some seconds

Gains read_gains(const YamlEntry& entry) {
  entry.only({"K", "D", "H"});
  Gains gains = Gains::critical(entry.at("K").positive());
  if (const auto D = entry.find("D")) gains.D = D->positive();
  if (const auto H = entry.find("H")) gains.H = H->positive();
  return gains;
}

LearnMethod read_method(const YamlEntry& entry) {
  constexpr LearnMethod methods[] = {LearnMethod::least_squares, LearnMethod::recursive,
                                     LearnMethod::locally_weighted};
  return methods[entry.choice({"least_squares", "recursive", "locally_weighted"})];
}

LearnSettings read_settings(const YamlEntry& entry) {
  LearnSettings settings;
  if (const auto kind = entry.find("kind"))
    settings.kind = kind->choice({"discrete", "rhythmic"}) == 0 ? Kind::discrete : Kind::rhythmic;
  if (const auto period = entry.find("period")) settings.period = period->positive();
  if (const auto method = entry.find("method")) settings.method = read_method(*method);
  if (const auto precision = entry.find("precision")) settings.precision = precision->positive();
  if (const auto kernels = entry.find("kernels"))
    settings.kernels = kernels->count(2, most_kernels);
  if (const auto width = entry.find("width")) settings.width = width->positive();
  if (const auto alpha = entry.find("alpha")) settings.alpha = alpha->positive();
  if (const auto gains = entry.find("gains")) settings.gains = read_gains(*gains);
  return settings;
}

Demonstration read_demonstration(const std::string& path, const DerivativeSettings& derivatives,
                                 const std::optional<Eigen::Quaterniond>& reference) {
  const Demonstration demo = Demonstration::read(path, derivatives);
  if (!has_orientation(demo)) return demo;
  return with_rotation_vector(demo, reference ? *reference : first_orientation(demo), derivatives);
}

// With a precision, every number of kernels up to theirs is tried with four widths.
void require_bounded(const Demonstration& demo, const LearnSettings& settings) {
  const bool tries = settings.precision > 0.0;
  const int kernels = settings.kernels > 0 ? settings.kernels : tries ? 100 : 20;
  const double work =
      1.0 * demo.samples() * kernels * kernels * (tries ? 4.0 / 3.0 * kernels : 1.0);
  if (work > most_work)
    throw Error(demo.source, std::to_string(demo.samples()) + " samples with up to " +
                                 std::to_string(kernels) +
                                 " kernels are too much work, must be fewer");
}

}  // namespace

Primitive learn_primitive(const YamlEntry& entry,
                          const std::optional<Eigen::Quaterniond>& reference) {
  entry.only({"demonstration", "kind", "period", "kernels", "width", "precision", "method", "alpha",
              "gains", "cutoff", "speed"});
  const LearnSettings settings = read_settings(entry);
  DerivativeSettings derivatives;
  if (const auto cutoff = entry.find("cutoff")) derivatives.cutoff = cutoff->positive();
  const auto faster = entry.find("speed");
  const double speed = faster ? faster->positive() : 1.0;
  const YamlEntry file = entry.at("demonstration");
  const std::string path = file.path();
  return at_key(file, [&] {
    const Demonstration demo = read_demonstration(path, derivatives, reference);
    require_bounded(demo, settings);
    return learn(demo, settings).at_speed(speed);
  });
}

}  // namespace seam
