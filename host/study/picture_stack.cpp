// Means, variances and squared bias of pictures, all in double.
#include "study/picture_stack.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/statistics.h"
#include "study/fit.h"

namespace pellucid {

std::vector<double> relmse_weights(const Picture& reference) {
  constexpr double floor_share = 0.01;
  const double mean = energy_of(reference) / double(reference.size());
  std::vector<double> weights;
  for (float v : reference) {
    const double square = double(v) * double(v) + std::pow(floor_share * mean, 2);
    weights.push_back(square > 0 ? 1 / square : 0);
  }
  return weights;
}

double weighted_distance(const Picture& a, const Picture& b, const std::vector<double>& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = double(a[i]) - double(b[i]);
    sum += weights[i] * d * d;
  }
  return sum / double(a.size());
}

double energy_of(const Picture& picture) {
  double sum = 0;
  for (float v : picture) sum += double(v);
  return sum;
}

bool all_finite(const Picture& picture) {
  return std::all_of(picture.begin(), picture.end(), [](float v) { return std::isfinite(v); });
}

Picture PictureStack::mean(int leave) const {
  const double n = double(size()) - (leave >= 0 ? 1 : 0);
  std::vector<double> sum(pictures_.at(0).size());
  for (int k = 0; k < size(); ++k) {
    if (k == leave) continue;
    const Picture& picture = pictures_[std::size_t(k)];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double(picture[i]);
  }
  Picture mean(sum.size());
  for (std::size_t i = 0; i < sum.size(); ++i) mean[i] = float(sum[i] / n);
  return mean;
}

double PictureStack::variance(const std::vector<double>& weights, int leave) const {
  const Picture middle = mean(leave);
  const double n = double(size()) - (leave >= 0 ? 1 : 0);
  PELLUCID_CHECK(n >= 2, "a variance needs two pictures");
  double sum = 0;
  for (int k = 0; k < size(); ++k)
    if (k != leave) sum += weighted_distance(pictures_[std::size_t(k)], middle, weights);
  return sum / (n - 1);
}

double PictureStack::bias2(const Picture& reference, const std::vector<double>& weights,
                           double reference_relmse, int leave) const {
  const double n = double(size()) - (leave >= 0 ? 1 : 0);
  return weighted_distance(mean(leave), reference, weights) - variance(weights, leave) / n -
         reference_relmse;
}

Split PictureStack::split(const Picture& reference, const std::vector<double>& weights,
                          double reference_relmse) const {
  constexpr double upper = 0.9;  // one-sided
  Split split;
  split.variance = variance(weights);
  const auto bias = jackknife(size(), [&](int leave) -> std::optional<double> {
    return bias2(reference, weights, reference_relmse, leave);
  });
  split.bias2 = bias->value;
  split.bias2_upper90 = bias->value + student_quantile(upper, double(size() - 1)) * bias->error;
  return split;
}

}  // namespace pellucid
