#include "tests/fuzz/input.hpp"
#include <seam/demonstration.hpp>
#include <seam/learn.hpp>
#include <seam/orientation.hpp>
#include <seam/recording.hpp>
#include <seam/table.hpp>

using namespace seam;

// Demonstrations are learned, too: a sequence does it with whatever its CSV file holds.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Inputs inputs("input.csv");
  const std::string& path = inputs.put(data, size);
  fuzz::read_or_refuse([&] { Table::read(path); });
  fuzz::read_or_refuse([&] { Recording::read(path); });
  fuzz::read_or_refuse([&] {
    Demonstration demo = Demonstration::read(path);
    if (has_orientation(demo)) demo = with_rotation_vector(demo, first_orientation(demo));
    LearnSettings settings;
    settings.kernels = 3;
    learn(demo, settings);
    settings.kind = Kind::rhythmic;
    learn(demo, settings);
  });
  return 0;
}
