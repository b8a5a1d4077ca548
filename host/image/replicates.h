// Error of one method split into noise and bias, from several runs that are independent of each
// other.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace pellucid {

/// On one scale: squares of radiance, or these over ref^2 + e^2 as in relMSE (image/metrics.h).
struct ErrorSplit {
  double variance = 0;  ///< of one run, which needs no reference
  double variance_low90 = 0, variance_high90 = 0;
  double bias2 = 0;          ///< squared bias, mean over pixels; unbiased, so it may be negative
  double bias2_upper90 = 0;  ///< above it with 10 % probability at most
  double mse() const { return variance + bias2; }  ///< of one run against the truth
};

struct RunSplit {
  std::uint64_t nonfinite = 0;  ///< pixels with a NaN or Inf in any image; if > 0 the rest is NaN
  /// Whether the reference tells its own variance (channels variance.*), which then is no bias.
  bool reference_variance = false;
  /// Its variance over the MSE of one run, as in relMSE; above a tenth or so relative bias is
  /// doubtful, since the reference's noise is in what errors are divided by, too.
  double reference_share = 0;
  ErrorSplit absolute, relative;
};

/// products[k][l]: mean of (x_k - ref)(x_l - ref) over pixels and channels, weighed or not.
using RunProducts = std::vector<std::vector<double>>;

struct VarianceAndBias {
  double variance = 0, bias2 = 0;
};

/// Of runs that count so often each, two at least in all. With d_k = x_k - ref: the mean over runs
/// of d is sum(n_k d_k) / N, s^2 = (sum(n_k d_k^2) - N mean(d)^2) / (N - 1), and
/// bias^2 = mean(d)^2 - s^2 / N: the noise that is left in the mean is no bias. The reference's
/// variance is still in bias^2.
VarianceAndBias split_products(const RunProducts& products, const std::vector<int>& counts);

/// At least two runs. Throws InputError if sizes or colour channels differ.
RunSplit split_error(const std::vector<const Image*>& runs, const Image& reference);

}  // namespace pellucid
