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

/// At least two runs. Throws InputError if sizes or colour channels differ.
RunSplit split_error(const std::vector<const Image*>& runs, const Image& reference);

}  // namespace pellucid
