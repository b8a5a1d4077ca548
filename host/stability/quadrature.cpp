// Adaptive quadrature.
#include "stability/quadrature.h"

#include <cmath>

namespace pellucid::stability {
namespace {

constexpr int max_depth = 8;

/// Gauss-Legendre with 4 x 4 points.
double gauss(const Integrand& f, double x0, double x1, double y0, double y1) {
  static const double node[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                 0.8611363115940526};
  static const double weight[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                   0.3478548451374538};
  const double hx = 0.5 * (x1 - x0), hy = 0.5 * (y1 - y0);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      sum += weight[i] * weight[j] * f(x0 + hx * (1 + node[i]), y0 + hy * (1 + node[j]));
  return sum * hx * hy;
}

/// `depth` bounds the work along a jump of f; what is left there is 2^-depth of a cell.
double refine(const Integrand& f, double x0, double x1, double y0, double y1, double coarse,
              double tolerance, int depth) {
  const double xm = 0.5 * (x0 + x1), ym = 0.5 * (y0 + y1);
  const double part[4] = {gauss(f, x0, xm, y0, ym), gauss(f, xm, x1, y0, ym),
                          gauss(f, x0, xm, ym, y1), gauss(f, xm, x1, ym, y1)};
  const double fine = part[0] + part[1] + part[2] + part[3];
  // The first level is always refined: coarse points may all miss a narrow feature.
  if (depth == 0 || (depth < max_depth && std::abs(fine - coarse) <= tolerance)) return fine;
  const double t = 0.5 * tolerance;
  return refine(f, x0, xm, y0, ym, part[0], t, depth - 1) +
         refine(f, xm, x1, y0, ym, part[1], t, depth - 1) +
         refine(f, x0, xm, ym, y1, part[2], t, depth - 1) +
         refine(f, xm, x1, ym, y1, part[3], t, depth - 1);
}

}  // namespace

double integrate(const Integrand& f, double x0, double x1, double y0, double y1, double tolerance) {
  constexpr int depth = max_depth;
  return refine(f, x0, x1, y0, y1, gauss(f, x0, x1, y0, y1), tolerance, depth);
}

}  // namespace pellucid::stability
