// Display pictures to draw labels and pixels on.
#pragma once

#include <string>

#include "image/image.h"

namespace pellucid {

constexpr int letter_pitch = 6, line_height = 11;  ///< pixels

class Canvas {
 public:
  /// Dark grey.
  Canvas(int width, int height);
  /// Its three display values.
  float* pixel(int x, int y) {
    return &image_.data[(std::size_t(y) * std::size_t(image_.width) + std::size_t(x)) * 3];
  }
  /// A text from (x, y) to the right, of letters that the built-in font has.
  void text(int x, int y, const std::string& text);
  Image take() { return std::move(image_); }

 private:
  Image image_;
};

/// Whether the built-in font has every letter of a text.
bool can_draw(const std::string& text);

}  // namespace pellucid
