#include "tests/fuzz/input.hpp"
#include <seam/primitive_file.hpp>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const seam::fuzz::Inputs inputs("input.yaml");
  const std::string& path = inputs.put(data, size);
  seam::fuzz::read_or_refuse([&] { seam::read_primitive(path); });
  return 0;
}
