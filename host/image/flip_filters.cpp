// Kernels by their formulas, and separable filtering.
#include "image/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pellucid::flip {
namespace {

const double PI = std::acos(-1.0);

/// f at -radius ... radius.
template <typename F>
Kernel sampled(int radius, const F& f) {
  Kernel k;
  for (int x = -radius; x <= radius; ++x) k.push_back(f(double(x)));
  return k;
}

double sum(const Kernel& k) {
  return std::accumulate(k.begin(), k.end(), 0.0);
}

Kernel scaled(Kernel k, double by) {
  for (double& w : k) w *= by;
  return k;
}

/// Positive weights sum to 1, negative ones to -1.
Kernel balanced(Kernel k) {
  double above = 0, below = 0;
  for (const double w : k) (w > 0 ? above : below) += std::abs(w);
  for (double& w : k) w /= w > 0 ? above : below;
  return k;
}

/// All rows, those of the rim too.
std::vector<double> along_rows(const Band& band, const Kernel& kernel) {
  const auto width = std::size_t(band.width), radius = kernel.size() / 2;
  std::vector<double> out(band.values.size()), padded(width + 2 * radius);
  for (std::size_t first = 0; first < out.size(); first += width) {
    const double* row = &band.values[first];
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + std::ptrdiff_t(radius));
    std::fill_n(padded.end() - std::ptrdiff_t(radius), radius, row[width - 1]);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      for (std::size_t x = 0; x < width; ++x) out[first + x] += kernel[k] * padded[x + k];
  }
  return out;
}

}  // namespace

std::vector<double> filtered(const Band& band, const Kernel& along_x, const Kernel& along_y) {
  const std::vector<double> rows = along_rows(band, along_x);
  const auto width = std::size_t(band.width);
  const std::size_t above = std::size_t(band.rim) - along_y.size() / 2;  // rows not needed
  std::vector<double> out(width * std::size_t(band.rows));
  for (std::size_t y = 0; y < std::size_t(band.rows); ++y)
    for (std::size_t k = 0; k < along_y.size(); ++k) {
      const double weight = along_y[k], *from = &rows[(y + above + k) * width];
      double* to = &out[y * width];
      for (std::size_t x = 0; x < width; ++x) to[x] += weight * from[x];
    }
  return out;
}

SpatialFilter::SpatialFilter(double ppd) {
  // Gaussians a sqrt(pi/b) exp(-pi^2 r^2 / b) of r in degrees; table 1 of the paper.
  struct Gaussian {
    double a, b;
  };
  const std::vector<Gaussian> channels[3] = {
      {{1, 0.0047}}, {{1, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}};
  const double widest = 0.04;
  radius_ = int(std::ceil(3 * std::sqrt(widest / (2 * PI * PI)) * ppd));
  for (std::size_t c = 0; c < 3; ++c) {
    double total = 0;
    for (const Gaussian& g : channels[c]) {
      const Kernel k = sampled(
          radius_, [&](double x) { return std::exp(-PI * PI * (x / ppd) * (x / ppd) / g.b); });
      const double weight = g.a * std::sqrt(PI / g.b) * sum(k) * sum(k);
      terms_[c].push_back({weight, scaled(k, 1 / sum(k))});
      total += weight;
    }
    for (Term& term : terms_[c]) term.weight /= total;
  }
}

std::vector<double> SpatialFilter::apply(const Band& band, std::size_t channel) const {
  std::vector<double> out(std::size_t(band.width) * std::size_t(band.rows));
  for (const Term& term : terms_[channel]) {
    const std::vector<double> part = filtered(band, term.kernel, term.kernel);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += term.weight * part[i];
  }
  return out;
}

double SpatialFilter::at(std::size_t channel, int x, int y) const {
  double value = 0;
  for (const Term& term : terms_[channel])
    value +=
        term.weight * term.kernel[std::size_t(x + radius_)] * term.kernel[std::size_t(y + radius_)];
  return value;
}

FeatureFilter::FeatureFilter(double ppd) {
  constexpr double peak_to_trough = 0.082;  // degrees, of the eye's edge detector
  const double sigma = 0.5 * peak_to_trough * ppd;
  radius_ = int(std::ceil(3 * sigma));
  const auto gaussian = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  smooth_ = sampled(radius_, gaussian);
  smooth_ = scaled(smooth_, 1 / sum(smooth_));
  edge_ = balanced(sampled(radius_, [&](double x) { return -x * gaussian(x); }));
  point_ = balanced(
      sampled(radius_, [&](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); }));
}

std::vector<double> FeatureFilter::magnitude(const Band& band, const Kernel& derivative) const {
  std::vector<double> x = filtered(band, derivative, smooth_);
  const std::vector<double> y = filtered(band, smooth_, derivative);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
  return x;
}

std::vector<double> FeatureFilter::edges(const Band& luminance) const {
  return magnitude(luminance, edge_);
}

std::vector<double> FeatureFilter::points(const Band& luminance) const {
  return magnitude(luminance, point_);
}

}  // namespace pellucid::flip
