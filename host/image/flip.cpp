// LDR-FLIP as in [Andersson20], numbers of sections and equations are the paper's; HDR-FLIP takes
// the worst of it over exposures [Andersson21]. All filters are sums of products of one-dimensional
// ones. Pictures are done in bands of rows, so memory stays small and all cores work.
#include "image/flip.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "base/statistics.h"
#include "image/flip_filters.h"
#include "image/image_pair.h"

namespace pellucid {
namespace {

using flip::Kernel;
using Colour = std::array<double, 3>;

/// Linear Rec.709 to CIE XYZ, from the standard's primaries and its white D65 (0.3127, 0.3290).
constexpr double TO_XYZ[3][3] = {
    {10135552 / 24577794.0, 8788810 / 24577794.0, 4435075 / 24577794.0},
    {2613072 / 12288897.0, 8788810 / 12288897.0, 887015 / 12288897.0},
    {1425312 / 73733382.0, 8788810 / 73733382.0, 70074185 / 73733382.0}};

/// XYZ over that of white, as the opponent values Y, X - Y, Y - Z: YCxCz (section 4.1) but for its
/// affine scales, which filters with sum 1 do not see.
Colour opponent(const Colour& rgb) {
  Colour xyz{};
  for (std::size_t i = 0; i < 3; ++i) {
    double white = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      xyz[i] += TO_XYZ[i][j] * rgb[j];
      white += TO_XYZ[i][j];
    }
    xyz[i] /= white;
  }
  return {xyz[1], xyz[0] - xyz[1], xyz[1] - xyz[2]};
}

/// The inverse of opponent(): rows of colours that its matrix maps to the axes, by Cramer's rule.
struct FromOpponent {
  double m[3][3];
  FromOpponent() {
    const Colour r = opponent({1, 0, 0}), g = opponent({0, 1, 0}), b = opponent({0, 0, 1});
    const double a[3][3] = {{r[0], g[0], b[0]}, {r[1], g[1], b[1]}, {r[2], g[2], b[2]}};
    const auto minor = [&](int i, int j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      return a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
    };
    const double det = a[0][0] * minor(0, 0) + a[0][1] * minor(0, 1) + a[0][2] * minor(0, 2);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[j][i] = minor(i, j) / det;
  }
  Colour operator()(const Colour& v) const {
    Colour rgb{};
    for (std::size_t i = 0; i < 3; ++i) rgb[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return rgb;
  }
};

/// CIELAB of a linear colour with Hunt's adjustment: less chroma in the dark (section 4.1.2).
Colour hunt_lab(const Colour& rgb) {
  constexpr double delta = 6.0 / 29;
  const Colour v = opponent(rgb);
  const auto f = [](double t) {
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const double x = f(v[0] + v[1]), y = f(v[0]), z = f(v[0] - v[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

constexpr double COLOUR_EXPONENT = 0.7;  // q_c

/// HyAB distance to the power q_c (section 4.1.3).
double colour_distance(const Colour& a, const Colour& b) {
  return std::pow(std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), COLOUR_EXPONENT);
}

/// To [0,1]: small differences get most of the range (section 4.1.4).
double redistributed(double distance) {
  constexpr double part = 0.4, range = 0.95;  // p_c, p_t
  static const double most = colour_distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
  const double knee = part * most;
  return distance < knee ? range / knee * distance
                         : range + (distance - knee) / (most - knee) * (1 - range);
}

/// Narkowicz's fit of ACES with its pre-exposure of 0.6 undone, as HDR-FLIP has it.
double aces(double x) {
  constexpr double far = 1e8;  // long since white, and squares stay finite
  if (x > far) return 1.0;
  x *= 0.6;
  return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

/// How linear values are shown.
struct Shot {
  bool tone_mapped = false;
  double scale = 1;
  double operator()(double v) const {
    if (!tone_mapped) return std::clamp(v, 0.0, 1.0);
    return aces(std::max(0.0, v) * scale);
  }
};

/// Rows of one of the two images as its observer takes them in.
struct Seen {
  std::vector<Colour> colours;        ///< filtered, Hunt-adjusted CIELAB
  std::vector<double> edges, points;  ///< magnitudes of the features (section 4.2)
};

class Flip {
 public:
  Flip(const Image& a, const Image& reference, double ppd)
      : pair_(a, reference), spatial_(ppd), features_(ppd) {}

  /// The worst of all shots, pixel by pixel.
  Image map(const std::vector<Shot>& shots) const {
    constexpr std::size_t band = 32;  // rows
    Image out;
    out.width = pair_.width();
    out.height = pair_.height();
    out.channels = {"error"};
    out.data.assign(pair_.pixels(), 0.0f);
    const auto height = std::size_t(out.height);
    parallel_tasks((height + band - 1) / band, [&](std::size_t i) {
      const int y0 = int(i * band), y1 = int(std::min(height, (i + 1) * band));
      for (const Shot& shot : shots) add_band(y0, y1, shot, out);
      for (std::size_t p = pair_.pixel(0, y0); p < pair_.pixel(0, y1); ++p)
        if (!pair_.finite(p)) out.data[p] = std::numeric_limits<float>::quiet_NaN();
    });
    return out;
  }

 private:
  void add_band(int y0, int y1, const Shot& shot, Image& out) const {
    const Seen a = seen(y0, y1, shot, true), b = seen(y0, y1, shot, false);
    const std::size_t first = pair_.pixel(0, y0);
    for (std::size_t i = 0; i < a.colours.size(); ++i) {
      const double colour = redistributed(colour_distance(a.colours[i], b.colours[i]));
      const double feature = std::max(std::abs(a.edges[i] - b.edges[i]),  // q_f = 1/2
                                      std::abs(a.points[i] - b.points[i]));
      const double error = std::pow(colour, 1 - std::sqrt(feature / std::sqrt(2.0)));
      out.data[first + i] = std::max(out.data[first + i], float(error));
    }
  }

  Seen seen(int y0, int y1, const Shot& shot, bool of_a) const {
    static const FromOpponent from_opponent;
    const int rim = std::max(spatial_.radius(), features_.radius());
    std::array<flip::Band, 3> planes;
    for (flip::Band& plane : planes) plane = {pair_.width(), y1 - y0, rim, {}};
    for (int y = y0 - rim; y < y1 + rim; ++y)
      for (int x = 0; x < pair_.width(); ++x) {
        const Colour v =
            opponent(shown(pair_.pixel(x, std::clamp(y, 0, pair_.height() - 1)), shot, of_a));
        for (std::size_t c = 0; c < 3; ++c) planes[c].values.push_back(v[c]);
      }
    Seen result;
    result.edges = features_.edges(planes[0]);
    result.points = features_.points(planes[0]);
    std::array<std::vector<double>, 3> filtered;
    for (std::size_t c = 0; c < 3; ++c) filtered[c] = spatial_.apply(planes[c], c);
    for (std::size_t i = 0; i < filtered[0].size(); ++i) {
      Colour rgb = from_opponent({filtered[0][i], filtered[1][i], filtered[2][i]});
      for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
      result.colours.push_back(hunt_lab(rgb));
    }
    return result;
  }

  Colour shown(std::size_t pixel, const Shot& shot, bool of_a) const {
    Colour rgb{};
    if (!pair_.finite(pixel)) return rgb;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t from = std::min(c, pair_.colours() - 1);
      rgb[c] = shot(of_a ? pair_.a(pixel, from) : pair_.b(pixel, from));
    }
    return rgb;
  }

  ImagePair pair_;
  flip::SpatialFilter spatial_;
  flip::FeatureFilter features_;
};

/// The x with aces(x) = y, by the quadratic's positive root.
double aces_inverse(double y) {
  const double a = 2.51 - 2.43 * y, b = 0.03 - 0.59 * y, c = -0.14 * y;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a) / 0.6;
}

}  // namespace

ExposureRange flip_exposures(const Image& reference) {
  constexpr double bright = 0.85;
  constexpr double luminance[] = {0.2126, 0.7152, 0.0722};
  const ImagePair pair(reference, reference);
  std::vector<double> all;
  for (std::size_t p = 0; p < pair.pixels(); ++p) {
    if (!pair.finite(p)) continue;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c)
      sum += luminance[c] * std::max(0.0, pair.a(p, std::min(c, pair.colours() - 1)));
    all.push_back(sum);
  }
  const double most = all.empty() ? 0 : *std::max_element(all.begin(), all.end());
  if (!(most > 0)) return {};
  double middle = median_of(all);
  if (!(middle > 0)) {
    all.erase(std::remove(all.begin(), all.end(), 0.0), all.end());
    middle = median_of(all);
  }
  ExposureRange range;
  range.start = std::log2(aces_inverse(bright) / most);
  range.stop = std::log2(aces_inverse(bright) / middle);
  range.count = std::max(2, int(std::ceil(range.stop - range.start)));
  return range;
}

Image flip_map(const Image& a, const Image& reference, double ppd) {
  return Flip(a, reference, ppd).map({Shot{}});
}

Image hdr_flip_map(const Image& a, const Image& reference, double ppd) {
  const ExposureRange range = flip_exposures(reference);
  std::vector<Shot> shots;
  for (int i = 0; i < range.count; ++i) shots.push_back({true, std::exp2(range.at(i))});
  return Flip(a, reference, ppd).map(shots);
}

double mean_of_map(const Image& map) {
  return std::accumulate(map.data.begin(), map.data.end(), 0.0) / double(map.data.size());
}

}  // namespace pellucid
