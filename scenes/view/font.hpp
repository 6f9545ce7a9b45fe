#pragma once

#include <memory>
#include <string>

#include "scenes/view/image.hpp"

namespace seam {

/// DejaVu Sans at a size.
class Font {
 public:
  /// @param pixels  height of a line's capital and tail together
  /// @throws Error  the font is not there (says what to install)
  explicit Font(int pixels);
  ~Font();

  int width(const std::string& utf8) const;  // [pixels]
  /// @param y  of the line that letters stand on
  void draw(Image& image, int x, int y, const std::string& utf8, const Image::Colour& colour) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seam
