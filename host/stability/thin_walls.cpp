// Merging near walls and corners (numerics 16): nothing leaks through a wall thinner than the
// radius, what discs that a wall cuts are short of is a strip that is as wide as the radius, and
// what they smooth away vanishes with their area, pass by pass.
//
// Photons merge only where their surface faces the same way as the eye's and lies on its side
// (MERGE_COS_MIN, transport/merge.h): two dot products for each photon.
#include <fmt/format.h>

#include <cmath>

#include "scene/mesh_tools.h"
#include "stability/estimates.h"
#include "stability/measurements.h"
#include "stability/renderer.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double sigmas = 4.5;

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

/// Pixels share photons, so the spread of runs tells the error.
Estimate mean_of_runs(Renderer& renderer, Sampling run) {
  constexpr int runs = 16;
  double sum = 0, square = 0;
  for (int k = 0; k < runs; ++k, ++run.seed) {
    const double mean = renderer.render(run).image(0).mean;
    sum += mean, square += mean * mean;
  }
  const double mean = sum / runs;
  return {mean, (square / runs - mean * mean) / (runs - 1)};
}

/// CF7: over distances from 0 to r of a mirror wall, discs are short of 2 r / (3 pi) of the floor.
/// So wide is it by `sppm`, which merges on the floor alone. By `bpm` and `vcm` deeper vertices are
/// short of light, too, at all four walls, and weights share it: there the strip has no closed
/// form.
void measure_strip(const Lab& lab, Findings& findings, const char* method) {
  constexpr double floor = 1, width = 0.5, plates = 1 / (1 - 0.6 * 0.7);
  const Scene scene = lab.open_scene("mirror-strip");
  double missing[2], error[2];  // of the strip's own width
  for (int i : {0, 1}) {
    const double r = i ? 0.25 : 0.125, strip = 2 * r / (3 * pi);
    Renderer renderer(lab, scene, fixed_radius(method, r, 8, 1 << 12));
    const Estimate e = mean_of_runs(renderer, {lab.count(16), 1, long_enough, MIS_BALANCE});
    const double per_light = width / (plates - floor) / strip;
    missing[i] = (plates - e.mean) * per_light, error[i] = sigmas * e.error() * per_light;
    const std::string what = fmt::format("dark strip at a wall, {}, radius {}: ", method, r);
    if (method == std::string("sppm"))
      findings.at_most(what + "off, in widths", std::abs(missing[i] - 1), error[i]);
    findings.at_most(what + "resolved to", error[i], 0.15 / std::sqrt(lab.effort));
  }
  // Twice the radius, twice the width: a strip that stayed as it is would be off by half.
  const double noise = std::hypot(error[0] / missing[0], error[1] / missing[1]);
  findings.at_most(
      fmt::format("width of the strip over the radius, {}, off between radii 1 : 2", method),
      std::abs(missing[1] / missing[0] - 1), noise);
}

/// Irradiance from a point h above the floor, in the mean over a disc of radius r below it, over
/// that of its middle.
double mean_over_disc(double r, double h) {
  return 2 * h * h / (r * r) * (1 - h / std::hypot(h, r));
}

/// A floor, and a spot that shines upwards into a mirror: its image stands 1 above the floor.
/// (Light that came straight from a lamp would not be merged by `sppm`.)
Scene under_mirror() {
  Scene scene = empty_scene(0.5);
  add_shape(scene, baked(make_rectangle({-2, 0, -2}, {0, 0, 4}, {4, 0, 0})));
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].kind = MaterialKind::mirror, scene.materials[1].reflectance = Rgb(1.0);
  add_shape(scene, baked(make_rectangle({-2, 0.625, -2}, {4, 0, 0}, {0, 0, 4}))).material = 1;
  SpotLight spot;
  spot.position = {0, 0.25, 0}, spot.direction = {0, 1, 0};
  spot.inner = 0.65, spot.outer = 0.66;  // beyond the widest disc
  scene.lights.push_back(spot);
  Camera& c = scene.camera;
  c.origin = {0, 0.125, 0}, c.forward = {0, -1, 0}, c.right = {1, 0, 0}, c.up = {0, 0, -1};
  c.fov = 0.1;
  return scene;
}

/// What discs smooth away below a lamp goes as their area: over N passes its mean falls as
/// N^-(1 - alpha), and is known by the last digit for every N. (So few passes of discs so wide keep
/// the slope 0.07 to 0.11 flatter than that.)
void measure_shrinking(const Lab& lab, Findings& findings, const char* method) {
  constexpr double h = 1, r0 = 0.7, middle = 0.5 / (pi * h * h);  // rho I / (pi h^2)
  constexpr std::uint64_t passes[2] = {4, 128};
  const Scene scene = under_mirror();
  for (double alpha : {0.6, 0.75}) {
    Build build = fixed_radius(method, r0, 2, uint(lab.count(1 << 10)));
    build.radius_alpha = alpha;
    Renderer renderer(lab, scene, build);
    double bias[2];
    for (int k : {0, 1}) {
      double expected = 0;
      for (std::uint64_t i = 1; i <= passes[k]; ++i)
        expected +=
            mean_over_disc(r0 * std::pow(double(i), 0.5 * (alpha - 1)), h) / double(passes[k]);
      Estimate e = mean_of_runs(renderer, {passes[k], 1, 3, MIS_BALANCE});
      e.mean /= middle, e.variance /= middle * middle;
      bias[k] = 1 - e.mean;
      compare(lab, findings,
              fmt::format("below a lamp, {}, alpha {}, {} passes", method, alpha, passes[k]), e,
              expected, 1e-4, 2 * usual_resolution);
    }
    const double slope = std::log(bias[1] / bias[0]) / std::log(double(passes[1] / passes[0]));
    findings.at_most(
        fmt::format("bias over passes, {}, alpha {}: slope beside alpha - 1", method, alpha),
        std::abs(slope - (alpha - 1)), 0.15);
  }
}

}  // namespace

void merging_stays_on_its_side(const Lab& lab, Findings& findings) {
  measure_leaks(lab, findings);
  for (const char* method : {"sppm", "bpm", "vcm"}) {
    measure_strip(lab, findings, method);
    measure_shrinking(lab, findings, method);
  }
}

}  // namespace pellucid::stability
