// Your own demonstration: from a CSV file (`time` and one column per coordinate) to a primitive in a YAML file, with as
// few kernels as reproduce it to a precision.
//     own_demonstration demonstration.csv primitive.yaml [precision in m or rad]

#include <cstdlib>
#include <iostream>

#include <seam/primitive_file.hpp>
#include <seam/seam.hpp>

int main(int argc, char** argv) try {
  if (argc < 3)
    throw seam::Error("usage", "own_demonstration demonstration.csv primitive.yaml [precision]");
  seam::DerivativeSettings smoothing;
  smoothing.cutoff = 6.0;  // [Hz] faster than a hand moves on purpose, slower than it trembles
  const auto shown = seam::Demonstration::read(argv[1], smoothing);

  seam::LearnSettings settings;
  settings.precision = argc > 3 ? std::atof(argv[3]) : 1e-3;
  const seam::Primitive primitive = seam::learn(shown, settings);
  seam::write_primitive(argv[2], primitive);

  const seam::LearnReport report = seam::assess(shown, primitive);
  std::cout << shown.samples() << " samples, " << primitive.kernels.count() << " kernels, within "
            << report.error_max << " m or rad\n";
} catch (const seam::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
