// Everything follows from the means over pixels of products of two runs' errors, so the images are
// looked at once, however often runs are drawn again.
#include "image/replicates.h"

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include "image/image_pair.h"
#include "image/variances.h"

namespace pellucid {

VarianceAndBias split_products(const RunProducts& products, const std::vector<int>& counts) {
  double squares = 0, of_sum = 0, n = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    n += counts[k];
    squares += counts[k] * products[k][k];
    for (std::size_t l = 0; l < counts.size(); ++l)
      of_sum += counts[k] * counts[l] * products[k][l];
  }
  const double of_mean = of_sum / (n * n);
  const double variance = std::max(0.0, (squares - n * of_mean) / (n - 1));
  return {variance, of_mean - variance / n};
}

namespace {

/// The value below which a share of the sorted list lies.
double quantile(const std::vector<double>& sorted, double share) {
  return sorted[std::size_t(share * double(sorted.size() - 1))];
}

/// The basic bootstrap over runs, never over pixels: what draws of as many of the runs differ from
/// the runs is what these differ from the truth. Draws spread the variance of the runs as it is,
/// (K-1)/K of the unbiased one, and are centred on what the runs have in common with the
/// reference, noise included, which leaves bounds on bias wide where there is none.
ErrorSplit with_intervals(const RunProducts& products, double reference_variance) {
  constexpr int draws = 1000;
  const std::size_t runs = products.size();
  const VarianceAndBias found = split_products(products, std::vector<int>(runs, 1));
  std::mt19937_64 random(runs);  // the same runs always give the same intervals
  std::vector<double> variances, biases;
  double mean_bias = 0;
  for (int i = 0; i < draws; ++i) {
    std::vector<int> counts(runs);
    for (std::size_t k = 0; k < runs; ++k) ++counts[random() % runs];
    const VarianceAndBias drawn = split_products(products, counts);
    variances.push_back(drawn.variance * double(runs) / double(runs - 1));
    biases.push_back(drawn.bias2);
    mean_bias += drawn.bias2 / draws;
  }
  std::sort(variances.begin(), variances.end());
  std::sort(biases.begin(), biases.end());
  ErrorSplit result;
  result.variance = found.variance;
  result.variance_low90 = std::max(0.0, 2 * found.variance - quantile(variances, 0.95));
  result.variance_high90 = 2 * found.variance - quantile(variances, 0.05);
  result.bias2 = found.bias2 - reference_variance;
  result.bias2_upper90 = result.bias2 + mean_bias - quantile(biases, 0.1);
  return result;
}

ErrorSplit unknown() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {nan, nan, nan, nan, nan};
}

struct Sums {
  RunProducts absolute, relative;
  double reference_variance = 0, relative_variance = 0;
};

/// Means over pixels and channels.
Sums look_at(const std::vector<ImagePair>& pairs, const Variances* variances) {
  const ImagePair& first = pairs.front();
  const std::size_t runs = pairs.size();
  Sums sums{RunProducts(runs, std::vector<double>(runs)),
            RunProducts(runs, std::vector<double>(runs))};
  const double e = first.epsilon(), values = double(first.pixels() * first.colours());
  std::vector<double> d(runs);
  for (std::size_t p = 0; p < first.pixels(); ++p)
    for (std::size_t c = 0; c < first.colours(); ++c) {
      const double reference = first.b(p, c);
      const double scale = (reference * reference + e * e) * values;
      for (std::size_t k = 0; k < runs; ++k) d[k] = pairs[k].a(p, c) - reference;
      for (std::size_t k = 0; k < runs; ++k)
        for (std::size_t l = 0; l <= k; ++l) {
          sums.absolute[k][l] = sums.absolute[l][k] += d[k] * d[l] / values;
          sums.relative[k][l] = sums.relative[l][k] += quotient(d[k] * d[l], scale);
        }
      if (!variances) continue;
      sums.reference_variance += (*variances)(p, c) / values;
      sums.relative_variance += quotient((*variances)(p, c), scale);
    }
  return sums;
}

}  // namespace

RunSplit split_error(const std::vector<const Image*>& runs, const Image& reference) {
  std::vector<ImagePair> pairs;
  for (const Image* run : runs) pairs.emplace_back(*run, reference);
  RunSplit result;
  for (std::size_t p = 0; p < pairs.front().pixels(); ++p)
    result.nonfinite += std::all_of(pairs.begin(), pairs.end(),
                                    [&](const ImagePair& pair) { return pair.finite(p); })
                            ? 0
                            : 1;
  const Variances variances(reference);
  result.reference_variance = variances.known();
  result.absolute = result.relative = unknown();
  if (result.nonfinite > 0) return result;
  const Sums sums = look_at(pairs, variances.known() ? &variances : nullptr);
  result.absolute = with_intervals(sums.absolute, sums.reference_variance);
  result.relative = with_intervals(sums.relative, sums.relative_variance);
  result.reference_share = quotient(
      sums.relative_variance, result.relative.variance + std::max(0.0, result.relative.bias2));
  return result;
}

}  // namespace pellucid
