// Balls against all balls of nearly their place and size: nothing else can be near them but in
// spots.
//
// Meshes within meshes, and balls that a mesh or a disk follows closely, are not looked at: those
// are for the user to keep apart.
#include "scene/thin_shells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/thin_glass.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

/// Balls that touch are too near each other in a spot, too. This share of the smaller one's surface
/// is let pass: of the 4 % of light that glass sends back, it is less than samples can tell.
constexpr double spot = 0.01;
/// Least radius of the smaller ball over that of the other. Balls less alike can be near on more
/// than a spot only where rounding is a hundredth of their size (distance_warning).
constexpr double alike = 0.5;

/// As kernels see it: in floats.
struct Ball {
  glm::dvec3 center;
  double radius = 0;
  double needed = 0;  ///< how far off other surfaces must be
  double key = 0;     ///< what balls are sorted by
  bool clear = false;
  const Shape* shape = nullptr;
};

/// Twice what rays start off it by at most (sphere_point in geom/surface.h), for a start is off its
/// surface by as much again when all errors add up.
double least_gap(const glm::dvec3& center, double radius) {
  const double bound = glm::length(center) + radius * (1 + std::sqrt(3.0));
  return 2 * double(POINT_ERROR_ULPS) * double(UNIT_ROUNDOFF) * bound;
}

Ball ball_of(const Shape& shape, const Sphere& sphere, bool clear) {
  Ball b;
  b.center = glm::vec3(sphere.center), b.radius = float(sphere.radius);
  b.needed = least_gap(b.center, b.radius);
  b.clear = clear, b.shape = &shape;
  // A direction that no row of balls is likely to follow, of length 1 in space and radius.
  const glm::dvec3 across(0.614, 0.523, 0.437);
  constexpr double along_radius = 0.396;
  b.key = glm::dot(across, b.center) + along_radius * b.radius;
  return b;
}

/// The share of the smaller ball's surface that is nearer than `needed` to the other ball's:
/// distances to a point squared are uniform over spheres.
double near_share(const Ball& a, const Ball& b, double needed) {
  const auto [small, large] = std::minmax(a.radius, b.radius);
  const double d = glm::distance(a.center, b.center);
  if (d == 0) return large - small < needed ? 1 : 0;
  const auto cosine = [&, small = small](double distance) {
    return std::clamp((distance * distance - small * small - d * d) / (2 * small * d), -1.0, 1.0);
  };
  return 0.5 * (cosine(large + needed) - cosine(large - needed));
}

std::string warning_of(const Ball& a, const Ball& b, double needed) {
  const double gap =
      std::abs(a.radius - b.radius) - glm::distance(a.center, b.center);  // < 0: they intersect
  return fmt::format(
      "the balls {} and {} are {:.2g} apart, which rays that enter between them may miss; keep "
      "them {:.2g} apart, or make one ball of \"thin-dielectric\"",
      a.shape->name, b.shape->name, std::max(gap, 0.0), needed);
}

std::vector<Ball> sorted_balls(const Scene& scene) {
  std::vector<Ball> balls;
  for (const Shape& shape : scene.shapes)
    if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry))
      balls.push_back(
          ball_of(shape, *sphere, lets_rays_in(scene.materials[std::size_t(shape.material)])));
  std::sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.key < b.key; });
  return balls;
}

}  // namespace

std::string thin_shell_warning(const Scene& scene) {
  const std::vector<Ball> balls = sorted_balls(scene);
  if (std::none_of(balls.begin(), balls.end(), [](const Ball& b) { return b.clear; })) return "";
  for (const Ball& a : balls) {
    // Of a ball whose center is d off, needed / (alike * d) is near at most. So d is below this
    // where that is more than a spot, and the difference of the radii, too, or they do not meet.
    const double most = (1 / (alike * spot) + 1) * a.needed, reach = std::sqrt(2.0) * most;
    const auto too_near = [&](const Ball& b) {
      return b.needed <= a.needed && (a.clear || b.clear) && &a != &b &&
             std::abs(a.radius - b.radius) <= most &&
             std::min(a.radius, b.radius) >= alike * std::max(a.radius, b.radius) &&
             near_share(a, b, a.needed) > spot;
    };
    // From the first ball whose key is within reach.
    const auto from = std::lower_bound(balls.begin(), balls.end(), a.key - reach,
                                       [](const Ball& b, double key) { return b.key < key; });
    for (auto b = from; b != balls.end() && b->key <= a.key + reach; ++b)
      if (too_near(*b)) return warning_of(a, *b, a.needed);
  }
  return "";
}

}  // namespace pellucid
