// Means, variances and squared bias of pictures, all in double.
#include "study/picture_stack.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/relmse.h"
#include "base/statistics.h"
#include "image/replicates.h"
#include "study/fit.h"

namespace pellucid {

std::vector<double> relmse_weights(const Picture& reference) {
  const double e = RELMSE_EPSILON * energy_of(reference) / double(reference.size());
  std::vector<double> weights;
  for (float v : reference) weights.push_back(relmse_weight(double(v), e));
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

Picture PictureStack::mean() const {
  std::vector<double> sum(pictures_.at(0).size());
  for (const Picture& picture : pictures_)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double(picture[i]);
  Picture mean(sum.size());
  for (std::size_t i = 0; i < sum.size(); ++i) mean[i] = float(sum[i] / double(size()));
  return mean;
}

double PictureStack::variance(const std::vector<double>& weights) const {
  PELLUCID_CHECK(size() >= 2, "a variance needs two pictures");
  const Picture middle = mean();
  double sum = 0;
  for (const Picture& picture : pictures_) sum += weighted_distance(picture, middle, weights);
  return sum / double(size() - 1);
}

Split PictureStack::split(const Picture& reference, const std::vector<double>& weights,
                          double reference_relmse) const {
  constexpr double upper = 0.9;  // one-sided
  const std::size_t runs = pictures_.size(), values = reference.size();
  RunProducts products(runs, std::vector<double>(runs));
  for (std::size_t k = 0; k < runs; ++k)
    for (std::size_t l = 0; l <= k; ++l) {
      const Picture &a = pictures_[k], &b = pictures_[l];
      double sum = 0;
      for (std::size_t i = 0; i < values; ++i)
        sum += weights[i] * (double(a[i]) - double(reference[i])) *
               (double(b[i]) - double(reference[i]));
      products[k][l] = products[l][k] = sum / double(values);
    }
  Split split;
  split.variance = split_products(products, std::vector<int>(runs, 1)).variance;
  const auto bias = jackknife(size(), [&](int leave) -> std::optional<double> {
    std::vector<int> counts(runs, 1);
    if (leave >= 0) counts[std::size_t(leave)] = 0;
    return split_products(products, counts).bias2 - reference_relmse;
  });
  split.bias2 = bias->value;
  split.bias2_upper90 = bias->value + student_quantile(upper, double(size() - 1)) * bias->error;
  return split;
}

}  // namespace pellucid
