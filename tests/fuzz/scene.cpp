#include "scenes/scene.hpp"

#include "tests/fuzz/input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const seam::fuzz::Inputs inputs("input.yaml");
  const std::string& path = inputs.put(data, size);
  seam::fuzz::read_or_refuse([&] { seam::Scene::read(path); });
  return 0;
}
