#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace seam {

/// An opaque picture in sRGB, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // 3·width·height

  Image() = default;
  Image(int columns, int rows, std::uint8_t grey = 255);

  using Colour = std::array<std::uint8_t, 3>;
  Colour at(int x, int y) const;
  /// Lays a colour over a pixel. Nothing happens outside of the picture.
  void blend(int x, int y, const Colour& colour, double opacity);
  /// Lays another picture over this one with its corner at (x, y).
  void paste(const Image& other, int x, int y);
  void fill(int x, int y, int columns, int rows, const Colour& colour, double opacity = 1.0);

  /// @throws Error  cannot be written
  void write_png(const std::string& path) const;
  /// @throws Error  cannot be read, or is no PNG
  static Image read_png(const std::string& path);
};

}  // namespace seam
