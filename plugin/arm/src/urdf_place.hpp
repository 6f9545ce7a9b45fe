#pragma once

#include <string>
#include <utility>
#include <vector>

#include <seam/error.hpp>

namespace seam {

/// An element of a URDF, as messages name it, and where warnings about it go.
class UrdfPlace {
 public:
  UrdfPlace(std::string urdf, std::string element, std::vector<std::string>& warnings)
      : urdf_(std::move(urdf)), element_(std::move(element)), warnings_(warnings) {}

  /// A part of the element.
  UrdfPlace part(const std::string& name) const {
    return {urdf_, element_ + ": " + name, warnings_};
  }
  std::string text() const { return urdf_ + ": " + element_; }

  /// @throws Error  with file, element and this
  [[noreturn]] void refuse(const std::string& what) const { throw Error(text(), what); }
  /// Says what is odd about the element and what was done about it, in one line without the file.
  void warn(const std::string& what) const { warnings_.emplace_back(Error(element_, what).what()); }

 private:
  std::string urdf_;
  std::string element_;
  std::vector<std::string>& warnings_;
};

}  // namespace seam
