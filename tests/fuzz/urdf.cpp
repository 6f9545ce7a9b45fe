#include "tests/fuzz/input.hpp"
#include <seam/robot_model.hpp>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const seam::fuzz::Inputs inputs("input.urdf");
  const std::string& path = inputs.put(data, size);
  seam::fuzz::read_or_refuse([&] { seam::RobotModel::read(path); });
  return 0;
}
