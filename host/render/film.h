// The film on the host: exact sums of a set of passes over a window of the picture, what can be
// said from them, and how two films become one.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "image/image.h"
#include "render/layers.h"
#include "render/pass_set.h"
#include "shared/layout.h"

namespace pellucid {

/// Pixels x0 <= x < x0 + width of the picture, and rows alike.
struct Window {
  int x0 = 0, y0 = 0, width = 0, height = 0;
  std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
  bool operator==(const Window& o) const {
    return x0 == o.x0 && y0 == o.y0 && width == o.width && height == o.height;
  }
};

/// Sums of a block of passes of which some are missing [channel][word].
using BlockSum = std::array<std::array<uint, FILM_SUM_WORDS>, 3>;

class Film {
 public:
  /// Black, without passes. `lsb`: exponent of a step; `block_size`: passes per block, of which
  /// variances are made.
  Film(int width, int height, const Window& window, int lsb, std::uint64_t block_size);

  int width, height;  ///< of the whole picture
  Window window;      ///< what the film holds of it
  int lsb;
  std::uint64_t block_size;
  PassSet passes;
  std::vector<FilmPixel> pixels;  ///< of the window, row by row
  /// Block whose sums are in pixels[].block, as passes are added to it.
  std::optional<std::uint64_t> current;
  /// Other blocks begun and not complete: their ends lie in another range of passes.
  std::map<std::uint64_t, std::vector<BlockSum>> open;
  Layers layers;  ///< of the window, where they are asked for

  PassRange block_range(std::uint64_t block) const {
    return {block * block_size, (block + 1) * block_size};
  }
  /// Makes `block` the current one, together with what it already has.
  void select_block(std::uint64_t block);
  /// Puts the current block, if any, among the open ones.
  void set_aside();
  /// Number of blocks in sum and square.
  std::uint64_t complete_blocks() const;

  /// Adds all passes of a film of the same picture, disjoint from ours (else InternalError). The
  /// result does not depend on order or grouping, bit for bit.
  void merge(const Film& other);

  /// Sum of all samples and of the squares of complete blocks, per channel.
  struct Sums {
    std::array<double, 3> sum{}, square{};
  };
  Sums sums(std::size_t pixel) const;
};

struct FilmSummary {
  std::uint64_t iterations = 0;  ///< of each pixel
  std::uint64_t rays = 0;        ///< of all pixels
  double mean = 0;               ///< of pixels and channels
  double relmse = 0;  ///< estimated from the variances: mean of var/(mean^2 + e^2), e = 1 % of the
                      ///< mean; NaN below 2 complete blocks
};

FilmSummary summarise(const Film& film);

/// R G B means; with `variance` also variance.R/G/B, the variance of those means (unbiased, NaN
/// below 2 complete blocks of passes); with `samples` also the number of passes; then the channels
/// of its layers. A crop knows its place in the picture.
Image film_image(const Film& film, bool variance, bool samples);

/// The pyramid of strategies; the film has layers of them.
Image film_atlas(const Film& film);

/// The photon grid; the film has the layers that show it.
Image film_grid(const Film& film);

}  // namespace pellucid
