#include "scenes/view/font.hpp"

#include <functional>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <seam/error.hpp>

namespace seam {

namespace {

// Code points of a text; what is no UTF-8 is left out.
void each_letter(const std::string& utf8, const std::function<void(FT_ULong)>& use) {
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i++]);
    const int more = first < 0x80 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    FT_ULong letter = more == 0 ? first : first & (0x3FU >> static_cast<unsigned>(more));
    for (int k = 0; k < more && i < utf8.size(); ++k)
      letter = letter << 6U | (static_cast<unsigned char>(utf8[i++]) & 0x3FU);
    use(letter);
  }
}

}  // namespace

struct Font::Parts {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  ~Parts() {
    FT_Done_Face(face);
    FT_Done_FreeType(library);
  }
};

Font::Font(int pixels) : parts_(std::make_unique<Parts>()) {
  if (FT_Init_FreeType(&parts_->library) != 0 ||
      FT_New_Face(parts_->library, SEAM_FONT, 0, &parts_->face) != 0)
    throw Error(SEAM_FONT, "cannot be read, it is needed for labels (Debian: fonts-dejavu-core)");
  FT_Set_Pixel_Sizes(parts_->face, 0, static_cast<FT_UInt>(pixels));
}

Font::~Font() = default;

int Font::width(const std::string& utf8) const {
  long sum = 0;
  each_letter(utf8, [&](FT_ULong letter) {
    if (FT_Load_Char(parts_->face, letter, FT_LOAD_DEFAULT) == 0)
      sum += parts_->face->glyph->advance.x;
  });
  return static_cast<int>(sum / 64);
}

void Font::draw(Image& image, int x, int y, const std::string& utf8,
                const Image::Colour& colour) const {
  each_letter(utf8, [&](FT_ULong letter) {
    if (FT_Load_Char(parts_->face, letter, FT_LOAD_RENDER) != 0) return;
    const FT_GlyphSlotRec& glyph = *parts_->face->glyph;
    for (unsigned row = 0; row < glyph.bitmap.rows; ++row)
      for (unsigned column = 0; column < glyph.bitmap.width; ++column) {
        const unsigned char ink =
            glyph.bitmap.buffer[row * static_cast<unsigned>(glyph.bitmap.pitch) + column];
        image.blend(x + glyph.bitmap_left + static_cast<int>(column),
                    y - glyph.bitmap_top + static_cast<int>(row), colour, ink / 255.0);
      }
    x += static_cast<int>(glyph.advance.x / 64);
  });
}

}  // namespace seam
