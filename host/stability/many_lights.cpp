// Picks of lights (numerics 38): the picture of all lights is the sum of the pictures of each.
//
// Lights are picked by power from an alias table that is built in double, and light of no power is
// never picked: one look-up per light sample.
#include <fmt/format.h>

#include "stability/estimates.h"
#include "stability/measurements.h"

namespace pellucid::stability {
namespace {

/// The scene with one of its lights alone.
Scene only(Scene scene, std::size_t which) {
  std::size_t i = 0;
  for (Shape& shape : scene.shapes)
    if (shape.emission && i++ != which) shape.emission.reset();
  std::vector<Light> kept;
  for (const Light& light : scene.lights)
    if (i++ == which) kept.push_back(light);
  scene.lights = kept;
  return scene;
}

std::size_t light_count(const Scene& scene) {
  std::size_t n = scene.lights.size();
  for (const Shape& shape : scene.shapes) n += shape.emission.has_value();
  return n;
}

}  // namespace

void lights_add_up(const Lab& lab, Findings& findings) {
  Scene scene = lab.open_scene("equal-lights");
  // A lamp of a thousandth of the others' power is all that is blue: without it the third channel
  // is black, and picked with another probability than it is weighed by, of another brightness.
  for (Shape& shape : scene.shapes)
    if (shape.emission) shape.emission->radiance.z = 0;
  std::get<ConstantEnvironment>(scene.lights.at(0)).radiance.z = 0;
  PointLight weak;
  weak.position = {0, 0, 0.9};
  weak.intensity = Rgb(0, 0, 0.03);
  scene.lights.push_back(weak);
  constexpr double resolution = 0.1;  // of blue; the other channels are judged by their own noise
  for (const char* method : {"nee", "path", "light", "bdpt", "vcm"}) {
    std::array<Estimate, 3> sum{};
    const std::size_t n = light_count(scene);
    for (std::size_t i = 0; i < n; ++i) {
      const std::array<Estimate, 3> one = Renderer(lab, only(scene, i), {method, 16, 16})
                                              .measure({lab.count(512), 1 + i, {}, MIS_BALANCE})
                                              .image;
      for (std::size_t c = 0; c < 3; ++c)
        sum[c].mean += one[c].mean, sum[c].variance += one[c].variance;
    }
    compare_means(lab, findings, fmt::format("sum of {} pictures of one light each, {}", n, method),
                  measured_means(lab, scene, {method, 16, 16}, {}, resolution), sum, resolution);
  }
}

}  // namespace pellucid::stability
