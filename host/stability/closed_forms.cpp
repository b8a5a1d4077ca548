// Closed forms and quadratures. Directions are in the frame of the surface, z along its normal.
#include "stability/closed_forms.h"

#include <cmath>
#include <complex>

#include "stability/quadrature.h"

namespace pellucid::stability {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double quadrature_tolerance = 1e-6;  // a thousandth of what the tests resolve

glm::dvec3 direction(double cos_t, double phi) {
  const double sin_t = std::sqrt(std::max(0.0, 1 - cos_t * cos_t));
  return {sin_t * std::cos(phi), sin_t * std::sin(phi), cos_t};
}

double ggx_distribution(const glm::dvec3& h, double alpha) {
  if (h.z <= 0) return 0;
  const double a2 = alpha * alpha, k = h.x * h.x / a2 + h.y * h.y / a2 + h.z * h.z;
  return 1 / (pi * a2 * k * k);
}

double smith_lambda(const glm::dvec3& w, double alpha) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);
}

}  // namespace

double polygon_form_factor(const glm::dvec3& p, const glm::dvec3& n,
                           const std::vector<glm::dvec3>& corners) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::normalize(corners[i] - p);
    const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - p);
    const glm::dvec3 c = glm::cross(a, b);
    sum += c * (std::atan2(glm::length(c), glm::dot(a, b)) / glm::length(c));
  }
  return std::abs(glm::dot(sum, n)) / (2 * pi);
}

double fresnel(double cos_i, double from, double eta, double k) {
  using Complex = std::complex<double>;
  const Complex n1 = from, n2(eta, -k);
  const Complex sin_t = n1 / n2 * std::sqrt(1 - cos_i * cos_i);
  const Complex cos_t = std::sqrt(1.0 - sin_t * sin_t);
  const Complex s = (n1 * cos_i - n2 * cos_t) / (n1 * cos_i + n2 * cos_t);
  const Complex p = (n2 * cos_i - n1 * cos_t) / (n2 * cos_i + n1 * cos_t);
  return 0.5 * (std::norm(s) + std::norm(p));
}

double pane_transmission(double degrees, double n) {
  const double r = fresnel(std::cos(degrees * pi / 180), 1, n, 0);
  return (1 - r) / (1 + r);
}

double lands_below_pane(double sine, double D, double t, double n) {
  return (D - t) * sine / std::sqrt(1 - sine * sine) + t * sine / std::sqrt(n * n - sine * sine);
}

double irradiance_below_pane(double r, double D, double t, double n) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (low + high);
    (lands_below_pane(mid, D, t, n) < r ? low : high) = mid;
  }
  const double cosine = std::sqrt(1 - low * low), inner = n * n - low * low;
  const double per_angle =  // dr / da
      cosine * ((D - t) / (cosine * cosine * cosine) + t * n * n / (inner * std::sqrt(inner)));
  // sin a / r tends to the inverse of dr / d sin a on the axis.
  const double sine_over_r = r > 1e-9 ? low / r : 1 / ((D - t) + t / n);
  const double passed = 1 - fresnel(cosine, 1, n, 0);
  return passed * passed * sine_over_r / per_angle;
}

double ggx_reflected(double cos_o, double alpha, double near, double far, double k) {
  const glm::dvec3 o = direction(cos_o, 0);
  const auto integrand = [&](double cos_i, double phi) {
    const glm::dvec3 i = direction(cos_i, phi), h = glm::normalize(i + o);
    const double g = 1 / (1 + smith_lambda(i, alpha) + smith_lambda(o, alpha));
    return fresnel(glm::dot(o, h), near, far, k) * ggx_distribution(h, alpha) * g / (4 * o.z);
  };
  return integrate(integrand, 0, 1, 0, 2 * pi, quadrature_tolerance);
}

double ggx_transmitted(double cos_o, double alpha, double near, double far) {
  const glm::dvec3 o = direction(cos_o, 0);
  const auto integrand = [&](double cos_i, double phi) {
    const glm::dvec3 i = direction(-cos_i, phi);
    glm::dvec3 h = glm::normalize(near * o + far * i);
    if (h.z < 0) h = -h;
    const double ih = glm::dot(i, h), oh = glm::dot(o, h);
    if (oh <= 0 || ih >= 0) return 0.0;
    const double g = 1 / (1 + smith_lambda(i, alpha) + smith_lambda(o, alpha));
    const double root = far * ih + near * oh;
    const double passed = 1 - fresnel(oh, near, far, 0);
    return std::abs(ih * oh) / o.z * near * near * passed * g * ggx_distribution(h, alpha) /
           (root * root);
  };
  return integrate(integrand, 0, 1, 0, 2 * pi, quadrature_tolerance);
}

double oren_nayar_albedo(double cos_o, double rho, double r) {
  const double a = 1 / (1 + (0.5 - 2 / (3 * pi)) * r);
  const double theta = std::acos(cos_o), s = std::sin(theta);
  const double g = s * (theta - s * cos_o) + 2.0 / 3 * (s / cos_o * (1 - s * s * s) - s);
  const double single = a * (1 + r * g / pi);
  const double mean = a * (1 + (2.0 / 3 - 28 / (15 * pi)) * r);
  return rho * single + rho * rho * mean / (1 - rho * (1 - mean)) * (1 - single);
}

double plastic_base(double rho, double n) {
  const auto reflected = [&](double c, double) { return 2 * c * fresnel(c, n, 1, 0); };
  const double critical = std::sqrt(1 - 1 / (n * n));  // beyond it all is reflected
  const double f =
      critical * critical + integrate(reflected, critical, 1, 0, 1, quadrature_tolerance);
  return rho * (1 - f) / (1 - rho * f);
}

double phong_albedo(double cos_o, double exponent) {
  const glm::dvec3 mirror = direction(cos_o, pi);
  const auto integrand = [&](double cos_i, double phi) {
    const double c = std::max(0.0, glm::dot(direction(cos_i, phi), mirror));
    return (exponent + 2) / (2 * pi) * std::pow(c, exponent) * cos_i;
  };
  return integrate(integrand, 0, 1, 0, 2 * pi, quadrature_tolerance);
}

}  // namespace pellucid::stability
