// Adaptive quadrature over rectangles.
#pragma once

#include <functional>

namespace pellucid::stability {

using Integrand = std::function<double(double, double)>;

/// Integral over [x0,x1] x [y0,y1], adaptive Gauss-Legendre, absolute tolerance.
double integrate(const Integrand& f, double x0, double x1, double y0, double y1, double tolerance);

}  // namespace pellucid::stability
