// Shapes are checked once, here; everything else is arithmetic in double.
#include "image/image_pair.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/relmse.h"
#include "base/text.h"

namespace pellucid {

std::vector<std::size_t> colour_channels(const Image& image) {
  const int r = image.channel("R"), g = image.channel("G"), b = image.channel("B");
  if (r >= 0 && g >= 0 && b >= 0) return {std::size_t(r), std::size_t(g), std::size_t(b)};
  const int y = image.channel("Y");
  if (y >= 0) return {std::size_t(y)};
  if (image.channels.size() == 1) return {0};
  throw InputError(
      fmt::format("an image to be compared needs channels R, G, B or a single one; it has {}",
                  join(image.channels)));
}

std::vector<Tile> tiles_of(int width, int height) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += TILE)
    for (int x = 0; x < width; x += TILE)
      tiles.push_back({x, y, std::min(x + TILE, width), std::min(y + TILE, height)});
  return tiles;
}

ImagePair::ImagePair(const Image& a, const Image& reference)
    : a_(a),
      b_(reference),
      a_channels_(colour_channels(a)),
      b_channels_(colour_channels(reference)) {
  if (a_.width != b_.width || a_.height != b_.height)
    throw InputError(
        fmt::format("sizes differ: {}x{} against {}x{}", a_.width, a_.height, b_.width, b_.height));
  if (a_channels_.size() != b_channels_.size())
    throw InputError(fmt::format("colour channels differ: {} against {}", a_channels_.size(),
                                 b_channels_.size()));
}

std::uint64_t ImagePair::count_nonfinite() const {
  std::uint64_t count = 0;
  for (std::size_t p = 0; p < pixels(); ++p) count += finite(p) ? 0 : 1;
  return count;
}

double ImagePair::epsilon() const {
  double sum = 0, count = 0;
  for (std::size_t p = 0; p < pixels(); ++p) {
    if (!finite(p)) continue;
    for (std::size_t c = 0; c < colours(); ++c) sum += b(p, c);
    count += static_cast<double>(colours());
  }
  return quotient(RELMSE_EPSILON * std::abs(sum), count);
}

double ImagePair::relmse(std::size_t pixel, double e) const {
  double sum = 0;
  for (std::size_t c = 0; c < colours(); ++c) {
    const double difference = a(pixel, c) - b(pixel, c), reference = b(pixel, c);
    sum += quotient(difference * difference, reference * reference + e * e);
  }
  return sum / static_cast<double>(colours());
}

double ImagePair::signed_error(std::size_t pixel, double e) const {
  double sum = 0;
  for (std::size_t c = 0; c < colours(); ++c)
    sum += quotient(a(pixel, c) - b(pixel, c), std::hypot(b(pixel, c), e));
  return sum / static_cast<double>(colours());
}

}  // namespace pellucid
