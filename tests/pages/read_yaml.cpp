// Usage: read_yaml SCENE.yaml FILE.yaml...
// Reads each file by its format. What has none are keys of a scene: they take the place of SCENE's. Exit 2, with one line
// for each file that cannot be read.

#include <filesystem>
#include <fstream>
#include <iostream>

#include <yaml-cpp/yaml.h>

#include "scenes/scene.hpp"
#include <seam/error.hpp>
#include <seam/primitive_file.hpp>
#include <seam/sequence_file.hpp>

namespace {

// Beside the file, so that its paths hold.
std::string scene_with(const std::string& base, const std::string& file) {
  YAML::Node scene = YAML::LoadFile(base);
  for (const auto& entry : YAML::LoadFile(file))
    scene[entry.first.as<std::string>()] = entry.second;
  const std::string path = file + ".scene";
  std::ofstream(path) << scene << '\n';
  return path;
}

void read(const std::string& base, const std::string& file) {
  const YAML::Node format = YAML::LoadFile(file)["format"];
  const std::string kind = format ? format.as<std::string>() : "";
  if (kind.rfind("seam-primitive", 0) == 0)
    seam::read_primitive(file);
  else if (kind.rfind("seam-sequence", 0) == 0)
    seam::read_sequence(file);
  else
    seam::Scene::read(format ? file : scene_with(base, file));
}

}  // namespace

int main(int argc, char** argv) {
  int status = 0;
  for (int i = 2; i < argc; ++i) try {
      read(argv[1], argv[i]);
    } catch (const std::exception& error) {
      std::cerr << argv[i] << ": " << error.what() << '\n';
      status = 2;
    }
  return status;
}
