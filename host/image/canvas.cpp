// Drawing letters.
#include "image/canvas.h"

#include <algorithm>

#include "base/error.h"
#include "image/font.h"

namespace pellucid {
namespace {

constexpr float background = 0.12f, ink = 0.85f;  // display values
static_assert(letter_pitch > glyph_width && line_height > glyph_height, "letters keep apart");

const Glyph* glyph_of(char letter) {
  for (const Glyph& glyph : glyphs)
    if (glyph.letter == letter) return &glyph;
  return nullptr;
}

}  // namespace

Canvas::Canvas(int width, int height) {
  image_.width = width;
  image_.height = height;
  image_.channels = {"R", "G", "B"};
  image_.data.assign(std::size_t(width) * std::size_t(height) * 3, background);
}

void Canvas::text(int x, int y, const std::string& text) {
  for (const char letter : text) {
    const Glyph* glyph = glyph_of(letter);
    PELLUCID_CHECK(glyph, "the font has the letter");
    for (int row = 0; row < glyph_height; ++row)
      for (int dot = 0; dot < glyph_width; ++dot)
        if (glyph->rows[std::size_t(row)] >> (glyph_width - 1 - dot) & 1)
          std::fill_n(pixel(x + dot, y + row), 3, ink);
    x += letter_pitch;
  }
}

bool can_draw(const std::string& text) {
  return std::all_of(text.begin(), text.end(), glyph_of);
}

}  // namespace pellucid
