// Spheres from afar (numerics 29): which rays hit, and where the device puts the surface point.
//
// b^2 - 4 a c cancels as the square of distance over radius. Here the ray's origin first moves to
// the point nearest the centre, and the distance from the centre to the ray decides
// (geom/quadric.h): a handful of operations more. Points are not taken from the ray, whose t has
// roundoffs of the distance, but pulled onto the sphere (geom/surface.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "stability/measurements.h"
#include "stability/renderer.h"

namespace pellucid::stability {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double roundoff = 0x1p-24;

/// Parallel rays across a square of 3 x 3, of which pi / 9 hit a ball of radius 1; the raster lies
/// anywhere within a cell, so that what cells on the border add is chance.
std::vector<TraceRay> raster(Random& random, double distance, int n) {
  const glm::dvec3 d(glm::vec3(random.direction()));
  const glm::dvec3 s = glm::normalize(glm::cross(d, {0.3, 1, 0.2})), t = glm::cross(d, s);
  const double u = random.uniform(), v = random.uniform();
  std::vector<TraceRay> rays;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      rays.push_back(
          ray_along((3 * (i + u) / n - 1.5) * s + (3 * (k + v) / n - 1.5) * t - distance * d, d));
  return rays;
}

/// How near the line of a ray, as its floats have it, comes to the origin.
double passes_at(const TraceRay& ray) {
  const glm::dvec3 o = origin_of(ray), d = direction_of(ray);
  return glm::length(glm::cross(o, d)) / glm::length(d);
}

/// Rays that hit though they pass outside, or miss though inside, may pass this near the outline of
/// a ball of radius 1: the foot of the perpendicular, o - b d, has rounded products (one roundoff
/// of the distance, sideways) and a rounded b (three of its sum, two of |d|, one of a product:
/// along the ray, which lengthens it in second order), and its square has roundoffs of 1.
double outline_error(double distance) {
  const double along = 6 * roundoff * distance;
  return roundoff * distance + 0.5 * along * along + 4 * roundoff;
}

void measure_silhouette(const Lab& lab, Findings& findings) {
  constexpr int bundles = 8;
  Scene scene = empty_scene();
  add_shape(scene, Sphere{});
  TracedScene traced(lab, scene);
  Random random(2);
  const auto n = int(350 * std::sqrt(lab.effort));
  for (double distance : {2.0, 1e2, 1e4, 1e6}) {
    double hits = 0, inside = 0, all = 0, misjudged = 0;
    for (int bundle = 0; bundle < bundles; ++bundle) {
      const std::vector<TraceRay> rays = raster(random, distance, n);
      const std::vector<TraceHit> found = traced.closest(rays);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const double nearest = passes_at(rays[i]);
        const bool hit = found[i].prim != NONE;
        ++all, hits += hit, inside += nearest < 1;
        if (hit != (nearest < 1)) misjudged = std::max(misjudged, std::abs(nearest - 1));
      }
    }
    const std::string from = fmt::format("from {:g} radii", distance);
    findings.at_most("silhouette " + from + ": area beside that of the same rays in double",
                     std::abs(hits / inside - 1), 1e-3);
    findings.at_most("silhouette " + from + ": area beside pi", std::abs(9 * hits / all / pi - 1),
                     1e-3);
    findings.at_most("outline " + from + ": off, in radii", misjudged, outline_error(distance));
  }
}

/// Where a camera that has the ball in four fifths of its picture sees it, by pixels; nothing where
/// rays pass by.
std::vector<std::optional<glm::dvec3>> seen_points(const Lab& lab, const Scene& scene) {
  constexpr int size = 128;
  std::map<std::string, std::vector<float>> aov = first_surfaces(lab, scene, {"P", "Z"}, size);
  std::vector<std::optional<glm::dvec3>> points(std::size_t(size) * size);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(aov.at("Z")[i]))
      points[i] = glm::dvec3(aov.at("P.X")[i], aov.at("P.Y")[i], aov.at("P.Z")[i]);
  return points;
}

/// The points themselves, as renders have them.
void measure_points(const Lab& lab, Findings& findings) {
  constexpr double share = 0.8;  // of the picture's width
  Random random(3);
  for (double distance : {2.0, 1e2, 1e4, 1e6}) {
    Scene scene = empty_scene();
    Sphere ball;
    ball.center = {0.25, -0.5, 0.125};  // whole floats, so that |p - c| is the device's own
    add_shape(scene, ball);
    const glm::dvec3 d = random.direction();
    scene.camera.forward = d;
    scene.camera.right = glm::normalize(glm::cross(d, {0.3, 1, 0.2}));
    scene.camera.up = glm::cross(scene.camera.right, d);
    scene.camera.origin = ball.center - distance * d;
    const double outline = 1 / std::sqrt(distance * distance - 1);  // tangent of its angle
    scene.camera.fov = 2 * std::atan(outline / share) * 180 / pi;
    const auto points = seen_points(lab, scene);
    double off = 0, hits = 0;
    std::uint64_t behind = 0;
    for (const auto& p : points) {
      if (!p) continue;
      const glm::dvec3 n = *p - ball.center;
      ++hits;
      off = std::max(off, std::abs(glm::length(n) - 1));
      behind += glm::dot(n, d) > roundoff * distance;  // beyond the outline: the far side
    }
    const std::string from = fmt::format("from {:g} radii", distance);
    findings.at_most("points " + from + ": | |p - c| / R - 1 |", off, 1e-5);
    findings.none("points " + from + ": on the far side", behind);
    // Of 322 pixels on the border some; directions have steps that move the outline by a roundoff
    // of the distance.
    findings.at_most("picture " + from + ": share that the ball covers, relative error",
                     std::abs(hits / double(points.size()) / (0.25 * pi * share * share) - 1),
                     0.005 + 2 * roundoff * distance);
  }
}

}  // namespace

void spheres_stay_round(const Lab& lab, Findings& findings) {
  measure_silhouette(lab, findings);
  measure_points(lab, findings);
}

}  // namespace pellucid::stability
