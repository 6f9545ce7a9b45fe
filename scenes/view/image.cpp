#include "scenes/view/image.hpp"

#include <cmath>
#include <cstring>

#include <png.h>

#include <seam/error.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

png_image header() {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.format = PNG_FORMAT_RGB;
  return png;
}

}  // namespace

Image::Image(int columns, int rows, std::uint8_t grey)
    : width(columns), height(rows), rgb(3UL * columns * rows, grey) {}

Image::Colour Image::at(int x, int y) const {
  const std::uint8_t* pixel = &rgb[3UL * (static_cast<std::size_t>(y) * width + x)];
  return {pixel[0], pixel[1], pixel[2]};
}

void Image::blend(int x, int y, const Colour& colour, double opacity) {
  if (x < 0 || y < 0 || x >= width || y >= height) return;
  std::uint8_t* pixel = &rgb[3UL * (static_cast<std::size_t>(y) * width + x)];
  for (std::size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<std::uint8_t>(std::lround(pixel[i] + opacity * (colour[i] - pixel[i])));
}

void Image::paste(const Image& other, int x, int y) {
  for (int row = 0; row < other.height; ++row)
    for (int column = 0; column < other.width; ++column)
      blend(x + column, y + row, other.at(column, row), 1.0);
}

void Image::fill(int x, int y, int columns, int rows, const Colour& colour, double opacity) {
  for (int row = y; row < y + rows; ++row)
    for (int column = x; column < x + columns; ++column) blend(column, row, colour, opacity);
}

void Image::write_png(const std::string& path) const {
  png_image png = header();
  png.width = static_cast<png_uint_32>(width);
  png.height = static_cast<png_uint_32>(height);
  png_alloc_size_t size = 0;
  std::string bytes;
  const auto pack = [&](char* to) {
    return png_image_write_to_memory(&png, to, &size, 0, rgb.data(), 0, nullptr);
  };
  if (pack(nullptr)) bytes.resize(size);
  if (bytes.empty() || !pack(bytes.data())) throw Error(path, png.message);
  bytes.resize(size);
  write_whole(path, bytes);
}

Image Image::read_png(const std::string& path) {
  png_image png = header();
  if (!png_image_begin_read_from_file(&png, path.c_str())) throw Error(path, png.message);
  png.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (!png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr))
    throw Error(path, png.message);
  return image;
}

}  // namespace seam
