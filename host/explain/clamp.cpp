// Bright values cut: those of samples, or those of the finished picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "explain/causes.h"

namespace pellucid::explain {
namespace {

/// Pixels around one that may show the same light: what filters mix in, and a light's own width, so
/// that one of them shows it alone.
constexpr int REACH = 4;

/// What is cut, and by what.
struct Kind {
  const char* id;
  const char* words;
  bool samples;       ///< before the pixel filter; else the finished picture
  bool keeps_colour;  ///< all channels by the same factor, of the brightest
};
constexpr Kind KINDS[] = {
    {"samples", "values of samples above about {level:.3g}, by channel, are cut", true, false},
    {"samples-colour",
     "samples brighter than about {level:.3g} in any channel are scaled down to it", true, true},
    {"picture", "values of the picture above {level:.3g} are cut", false, false},
};

/// Per pixel and channel: values that are cut, and how bright they were before the filter.
struct Bright {
  std::vector<float> value, level;
};

/// The largest of the neighbours within REACH along one axis.
std::vector<float> widened(const std::vector<float>& in, int width, int height, int dx, int dy) {
  std::vector<float> out(in.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t c = 0; c < COLOURS; ++c) {
        float most = 0;
        for (int i = -REACH; i <= REACH; ++i) {
          const int nx = std::clamp(x + i * dx, 0, width - 1),
                    ny = std::clamp(y + i * dy, 0, height - 1);
          most = std::max(most, in[std::size_t(ny * width + nx) * COLOURS + c]);
        }
        out[std::size_t(y * width + x) * COLOURS + c] = most;
      }
  return out;
}

/// A sample that sees a light shows what it emits: as bright as the brightest pixel around. What is
/// seen of lit surfaces is a mean of many samples of which the picture does not tell.
Bright bright_values(const Case& c, const Kind& kind) {
  Bright b;
  for (std::size_t p = 0; p < c.known.pixels(); ++p)
    for (std::size_t ch = 0; ch < COLOURS; ++ch)
      b.value.push_back(float(kind.samples ? c.known.at(0, p, ch) : c.known.all(p, ch)));
  b.level = b.value;
  if (!kind.samples) return b;
  b.level = widened(b.level, c.known.width(), c.known.height(), 1, 0);
  b.level = widened(b.level, c.known.width(), c.known.height(), 0, 1);
  for (std::size_t p = 0; p < c.known.pixels() && kind.keeps_colour; ++p) {
    float* level = &b.level[p * COLOURS];
    std::fill(level, level + COLOURS, *std::max_element(level, level + COLOURS));
  }
  return b;
}

/// The known layers with the first one cut; of a finished picture, what is cut of all goes off it.
Layers clamped(const Evidence& e, const Bright& b, double level) {
  Layers layers = e.known;
  for (int y = 0; y < e.grid.height; ++y)
    for (int x = 0; x < e.grid.width; ++x)
      for (std::size_t c = 0; c < COLOURS; ++c) {
        const std::size_t j = std::size_t(y * e.grid.width + x) * COLOURS + c;
        if (!(b.level[j] > level)) continue;
        layers.front()[c * e.grid.cells() + e.cell(0, x, y)] -=
            double(b.value[j]) * (1 - level / double(b.level[j]));
      }
  return layers;
}

/// The best level: a scan over all brightness of the upper half of pixels, then ever finer ones.
double best_level(const Evidence& e, const Bright& b) {
  std::vector<float> levels = b.level;
  const auto middle = levels.begin() + std::ptrdiff_t(levels.size() / 2);
  std::nth_element(levels.begin(), middle, levels.end());
  const double most = double(*std::max_element(levels.begin(), levels.end()));
  double low = std::max(double(*middle), most * 1e-4), high = most, best = most;
  constexpr int rounds = 4, steps = 24;
  for (int round = 0; round < rounds; ++round) {
    double least = e.misfit(clamped(e, b, best));
    const double ratio = std::pow(high / low, 1.0 / steps);
    for (int i = 0; i < steps; ++i) {
      const double level = low * std::pow(ratio, i), misfit = e.misfit(clamped(e, b, level));
      if (misfit < least) least = misfit, best = level;
    }
    low = best / ratio, high = best * ratio;
  }
  return best;
}

}  // namespace

void try_clamp(const Case& c, Causes& causes) {
  const Evidence& e = c.evidence;
  Cause best;
  for (const Kind& kind : KINDS) {
    // Layers of a picture that was cut when it was finished do not add up to it.
    if (!kind.samples && e.by_length()) continue;
    const Bright bright = bright_values(c, kind);
    if (!(*std::max_element(bright.level.begin(), bright.level.end()) > 0)) continue;
    const double level = best_level(e, bright);
    Layers predicted = clamped(e, bright, level);
    const double misfit = e.misfit(predicted);
    if (!best.id.empty() && misfit >= best.misfit) continue;
    best.id = "clamp";
    best.words =
        fmt::format("{} differs from {} where it is bright, and only there: ", c.names.other,
                    c.names.known) +
        fmt::format(kind.words, fmt::arg("level", level)) + " in " + c.names.other;
    best.advice = fmt::format("switch clamping off in the program that made {} (pellucid has none)",
                              c.names.other);
    best.figures = {{"clamp", level},
                    {"of_samples", double(kind.samples)},
                    {"keeps_colour", double(kind.keeps_colour)}};
    best.predicted = std::move(predicted);
    best.misfit = misfit;
    best.parameters = 1;
  }
  if (!best.id.empty()) causes.push_back(std::move(best));
}

}  // namespace pellucid::explain
