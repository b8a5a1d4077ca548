// Film: blocks, merging, and statistics in double.
#include "render/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/phase_clock.h"
#include "base/relmse.h"
#include "shared/film_sums.h"

namespace pellucid {
namespace {

double to_double(const uint* words, int count, int exponent) {
  double value = 0;
  for (int i = count - 1; i >= 0; --i) value = value * 4294967296.0 + words[i];
  return std::ldexp(value, exponent);
}

struct PixelStats {
  std::array<double, 3> mean{}, variance_of_mean{};
};

/// Means and variances of pixels; what is the same for all of them is worked out once.
class Statistics {
 public:
  explicit Statistics(const Film& film)
      : film_(film),
        passes_(double(film.passes.count())),
        blocks_(double(film.complete_blocks())) {}

  PixelStats operator()(std::size_t i) const {
    PixelStats s;
    if (passes_ == 0) return s;
    const FilmPixel& p = film_.pixels[i];
    for (int c = 0; c < 3; ++c) {
      BlockSum total;
      std::copy_n(p.sum[c], FILM_SUM_WORDS, total[std::size_t(c)].begin());
      uint* words = total[std::size_t(c)].data();
      wide_add_words(words, p.block[c], FILM_SUM_WORDS);
      for (const auto& [block, sums] : film_.open)
        wide_add_words(words, sums[i][std::size_t(c)].data(), FILM_SUM_WORDS);
      s.mean[std::size_t(c)] = to_double(words, FILM_SUM_WORDS, film_.lsb) / passes_;
      s.variance_of_mean[std::size_t(c)] = variance(p, c);
    }
    return s;
  }

 private:
  /// Var(mean) = Var(total of a block) / (block size * passes).
  double variance(const FilmPixel& p, int c) const {
    if (blocks_ < 2) return std::numeric_limits<double>::quiet_NaN();
    const double sum = to_double(p.sum[c], FILM_SUM_WORDS, film_.lsb);
    const double square =
        to_double(p.square[c], FILM_SQUARE_WORDS, 2 * film_.lsb + FILM_SQUARE_DROP);
    // Blocks' totals were cut to 32 bits before squaring: below that noise the variance is 0.
    const double spread = std::max(0.0, square - sum * sum / blocks_) / (blocks_ - 1);
    return spread / (double(film_.block_size) * passes_);
  }

  const Film& film_;
  double passes_, blocks_;
};

}  // namespace

Film::Film(int w, int h, const Window& of, int step, std::uint64_t size)
    : width(w), height(h), window(of), lsb(step), block_size(size), pixels(of.pixels()) {}

void Film::select_block(std::uint64_t block) {
  if (current == block) return;
  set_aside();
  current = block;
  const auto found = open.find(block);
  if (found == open.end()) return;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      std::copy(found->second[i][c].begin(), found->second[i][c].end(), pixels[i].block[c]);
  open.erase(found);
}

void Film::set_aside() {
  if (!current) return;
  std::vector<BlockSum>& sums = open[*current];
  sums.resize(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      std::copy_n(pixels[i].block[c], FILM_SUM_WORDS, sums[i][c].begin());
      std::fill_n(pixels[i].block[c], FILM_SUM_WORDS, 0u);
    }
  current.reset();
}

std::uint64_t Film::complete_blocks() const {
  std::uint64_t in_blocks = passes.count();
  if (current) in_blocks -= passes.count(block_range(*current));
  for (const auto& [block, sums] : open) in_blocks -= passes.count(block_range(block));
  return in_blocks / block_size;
}

void Film::merge(const Film& other) {
  PELLUCID_CHECK(width == other.width && height == other.height && window == other.window &&
                     lsb == other.lsb && block_size == other.block_size,
                 "films of the same picture");
  Film theirs = other;
  theirs.set_aside();
  set_aside();
  for (const PassRange& range : theirs.passes.ranges()) passes.add(range);
  layers.merge(theirs.layers);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    FilmPixel& p = pixels[i];
    const FilmPixel& q = theirs.pixels[i];
    for (int c = 0; c < 3; ++c) {
      wide_add_words(p.sum[c], q.sum[c], FILM_SUM_WORDS);
      wide_add_words(p.square[c], q.square[c], FILM_SQUARE_WORDS);
    }
    film_keep_peak(&p, q.peak, q.peak_pass);
    p.count[0] += q.count[0];
    wide_add_words(p.count + 1, q.count + 1, 2);
  }
  for (auto& [block, sums] : theirs.open) {
    select_block(block);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        wide_add_words(pixels[i].block[c], sums[i][c].data(), FILM_SUM_WORDS);
    if (!passes.contains(block_range(block))) continue;
    for (FilmPixel& p : pixels) film_end_block(&p);
    current.reset();
  }
  set_aside();
}

Film::Sums Film::sums(std::size_t pixel) const {
  const PixelStats s = Statistics(*this)(pixel);
  Sums out;
  for (std::size_t c = 0; c < 3; ++c) {
    out.sum[c] = s.mean[c] * double(passes.count());
    out.square[c] =
        to_double(pixels[pixel].square[c], FILM_SQUARE_WORDS, 2 * lsb + FILM_SQUARE_DROP);
  }
  return out;
}

FilmSummary summarise(const Film& film) {
  const PhaseScope phase(Phase::film);
  FilmSummary out;
  out.iterations = film.passes.count();
  const Statistics statistics(film);
  double sum = 0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    out.rays += (std::uint64_t{film.pixels[i].count[2]} << 32) + film.pixels[i].count[1];
    for (double m : statistics(i).mean) sum += m;
  }
  const double values = 3.0 * double(film.pixels.size());
  out.mean = sum / values;
  if (film.complete_blocks() < 2) {
    out.relmse = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  const double e = RELMSE_EPSILON * out.mean;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const PixelStats s = statistics(i);
    for (std::size_t c = 0; c < 3; ++c) {
      const double below = s.mean[c] * s.mean[c] + e * e;
      out.relmse += below > 0 ? s.variance_of_mean[c] / below / values : 0;
    }
  }
  return out;
}

Image film_image(const Film& film, bool variance, bool samples) {
  Image image;
  image.width = film.window.width;
  image.height = film.window.height;
  image.x0 = film.window.x0;
  image.y0 = film.window.y0;
  image.full_width = film.width;
  image.full_height = film.height;
  image.channels = {"R", "G", "B"};
  if (variance)
    image.channels.insert(image.channels.end(), {"variance.R", "variance.G", "variance.B"});
  if (samples) image.channels.push_back("samples");
  image.data.reserve(film.pixels.size() * image.channels.size());
  const Statistics statistics(film);
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const PixelStats s = statistics(i);
    for (double m : s.mean) image.data.push_back(float(m));
    if (variance)
      for (double v : s.variance_of_mean) image.data.push_back(float(v));
    if (samples) image.data.push_back(float(film.pixels[i].count[0]));
  }
  add_channels(image, layer_images(film.layers, film.passes.count()));
  return image;
}

Image film_atlas(const Film& film) {
  return strategy_atlas(film.layers, film.window.width, film.window.height, film.passes.count());
}

Image film_grid(const Film& film) {
  return grid_picture(film.layers, film.window.width, film.window.height, film.passes.count());
}

}  // namespace pellucid
