// Merging near walls and corners (numerics 16): nothing leaks through a wall thinner than the
// radius, and what discs that a wall cuts are short of is a strip as wide as the radius.
//
// Photons merge only where their surface faces the same way as the eye's and lies on its side
// (MERGE_COS_MIN, transport/merge.h): two dot products for each photon.
#include <fmt/format.h>

#include <cmath>

#include "stability/measurements.h"
#include "stability/renderer.h"

namespace pellucid::stability {
namespace {

constexpr double pi = 3.14159265358979323846;

Build fixed_radius(const char* method, double radius, int size, uint light_paths) {
  Build build{method, size, size};
  build.radius = radius, build.radius_alpha = 1;
  build.light_paths = light_paths;
  return build;
}

/// A plate a tenth of the radius thick, one without any thickness, and two sheets that face the
/// same way, lit from the side that the camera does not see.
void measure_leaks(const Lab& lab, Findings& findings) {
  Scene two = lab.open_scene("thin-wall"), sheet = two, alike = two, lit = two;
  sheet.shapes.erase(sheet.shapes.begin() + 1);
  for (glm::uvec3& t : std::get<Mesh>(alike.shapes.at(1).geometry).triangles) std::swap(t.y, t.z);
  lit.camera.origin.z *= -1, lit.camera.forward.z *= -1, lit.camera.right.x *= -1;
  for (const char* method : {"sppm", "bpm", "vcm"}) {
    const Build build = fixed_radius(method, 0.1, 16, uint(lab.count(1 << 10)));
    const auto render = [&](const Scene& scene) {
      return Renderer(lab, scene, build).render({16, 1, {}, MIS_BALANCE});
    };
    std::uint64_t leaks = 0;
    for (const Scene* dark : {&two, &sheet, &alike})
      for (const auto& pixel : render(*dark).pixels) leaks += pixel[0].mean != 0;
    findings.none(fmt::format("lit pixels behind a thin wall, {}", method), leaks);
    findings.require(fmt::format("its other side is lit, {}", method),
                     render(lit).image(0).mean > 0.01);
  }
}

/// CF7: over distances from 0 to r of a mirror wall, discs are short of 2 r / (3 pi) of the floor.
void measure_strip(const Lab& lab, Findings& findings) {
  constexpr double floor = 1, width = 0.5, plates = 1 / (1 - 0.6 * 0.7);
  const Scene scene = lab.open_scene("mirror-strip");
  double missing[2], error[2];
  for (int i : {0, 1}) {
    const double r = i ? 0.2 : 0.1;
    Renderer renderer(lab, scene, fixed_radius("sppm", r, 16, 1 << 10));
    const Estimate e = renderer.measure({lab.count(768), 1, long_enough, MIS_BALANCE}).image[0];
    const double per_light = width / (plates - floor);
    missing[i] = (plates - e.mean) * per_light, error[i] = e.error() * per_light;
    findings.at_most(fmt::format("dark strip at a wall, radius {}: off, in widths", r),
                     std::abs(missing[i] / (2 * r / (3 * pi)) - 1),
                     4.5 * error[i] / (2 * r / (3 * pi)));
    findings.at_most(fmt::format("dark strip at a wall, radius {}: resolved to", r),
                     4.5 * error[i] / (2 * r / (3 * pi)), 0.5 / std::sqrt(lab.effort));
  }
}

}  // namespace

void merging_stays_on_its_side(const Lab& lab, Findings& findings) {
  measure_leaks(lab, findings);
  measure_strip(lab, findings);
}

}  // namespace pellucid::stability
