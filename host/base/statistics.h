// Distributions that intervals and tests need.
#pragma once

#include <vector>

namespace pellucid {

/// P(Z <= z) of the standard normal distribution, to full precision in both tails.
double normal_cdf(double z);
/// Its inverse, for 0 < p < 1.
double normal_quantile(double p);

/// P(T <= t) of Student's distribution with `dof` > 0 degrees of freedom, which need not be whole.
double student_cdf(double t, double dof);
/// Its inverse, for 0 < p < 1.
double student_quantile(double p, double dof);

/// Of at least one value.
double median_of(std::vector<double> values);

}  // namespace pellucid
