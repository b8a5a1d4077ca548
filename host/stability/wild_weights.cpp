// Weights of densities whose squares leave the range of floats (numerics 7): lamps so small that a
// density is 1e12, the power heuristic, and both in scenes of 2^-33 and 2^33 of their size.
//
// Densities are compared as ratios, and partial sums are kept with an exponent of their own
// (transport/partials.h): two words more per vertex and sub-path. The chains of 128 vertices and
// ratios of 10^+-6 of the catalogue are the twin's (tests/unit/audit_partials_test.cpp).
#include <fmt/format.h>

#include <cmath>

#include "stability/estimates.h"
#include "stability/exact.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {

void weights_stay_in_range(const Lab& lab, Findings& findings) {
  const double value = 16 * 0.0447214;  // CF5 beside the light, at constant Le R^2
  for (int e : {1, 4, 6}) {
    Scene scene = lab.open_scene("sphere-light-offset");
    const double radius = std::pow(10.0, -e);
    for (Shape& shape : scene.shapes) {
      if (!shape.emission) continue;
      Sphere& sphere = std::get<Sphere>(shape.geometry);
      shape.emission->radiance *= std::pow(sphere.radius / radius, 2);
      sphere.radius = radius;
    }
    for (int k : {-30, 0, 30})
      for (const char* method : {"path", "bdpt"})
        compare(lab, findings,
                fmt::format("lamp of radius 1e-{} times 2^{}, power heuristic, {}", e, k, method),
                measured_mean(lab, scaled(scene, k), {method, 16, 16}, {64, 1, {}, MIS_POWER}),
                value, 1e-4);
  }
  const Scene scene = lab.open_scene("everything");
  for (const char* method : {"path", "bdpt", "vcm"}) {
    Sampling run = short_run;
    run.mis = MIS_POWER;
    const Film film = session_render(lab, scene, build_of(method), run).film;
    std::size_t differing = 0;
    for (int k : {-33, 33})
      differing +=
          different_pixels(film, session_render(lab, scaled(scene, k), build_of(method), run).film);
    findings.none(
        fmt::format("pixels that differ by the power heuristic, lengths times 2^-33 and 2^33, {}",
                    method),
        differing);
  }
}

}  // namespace pellucid::stability
