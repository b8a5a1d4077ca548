// Connections of vertices that almost coincide (numerics 14): in corners, and near a lamp without
// size, no sample towers over the mean.
//
// The geometry term 1 / d^2 has no bound, and naive code cuts off what it makes, which is bias.
// Weights with all strategies have one: what a connection of near vertices overrates, another finds
// better. Nothing is clamped. The price is that of weights: two running ratios of densities,
// carried along by every walk and stored with its vertices (transport/partials.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "scene/mesh_tools.h"
#include "stability/measurements.h"
#include "stability/renderer.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

/// The mean of a picture of one sample per pixel, and its brightest pixel over that.
double brightest(const Picture& picture) {
  double most = 0;
  for (const auto& pixel : picture.pixels) most = std::max(most, pixel[0].mean);
  return most / picture.image(0).mean;
}

double median(const Picture& picture) {
  std::vector<double> values;
  for (const auto& pixel : picture.pixels) values.push_back(pixel[0].mean);
  return median_of(std::move(values));
}

/// A cube of edge 2 from within, seen along its diagonal into a corner.
Scene cube_room() {
  Scene scene = empty_scene(0.7);
  add_shape(scene, baked(make_cube({0, 0, 0}, {2, 2, 2})));
  const glm::dvec3 f = glm::normalize(glm::dvec3(-1, -1, -1));
  scene.camera.origin = {0.3, 0.4, 0.35};
  scene.camera.forward = f;
  scene.camera.right = glm::normalize(glm::cross(f, glm::dvec3(0, 1, 0)));
  scene.camera.up = glm::cross(scene.camera.right, f);
  scene.camera.fov = 60;
  return scene;
}

}  // namespace

void near_vertices_make_no_fireflies(const Lab& lab, Findings& findings) {
  constexpr int size = 64;
  const Sampling one_sample{1, 1, 8, MIS_BALANCE};
  Scene corner = cube_room();
  const double y = 0.98;
  RawMesh panel = make_rectangle({-0.5, y, -0.5}, {1, 0, 0}, {0, 0, 1});
  add_shape(corner, baked(panel)).emission = Emission{Rgb(1.0), 1};
  Scene lamp = cube_room();
  PointLight point;
  point.position = {0.1, 0.9, -0.2};
  lamp.lights.push_back(point);
  const double usual = brightest(Renderer(lab, corner, {"path", size, size}).render(one_sample));
  for (const char* method : {"bdpt", "vcm"})
    findings.at_most(
        fmt::format("brightest sample of a corner, in those of path, {}", method),
        brightest(Renderer(lab, corner, {method, size, size}).render(one_sample)) / usual, 50);
  // Pixels are set beside the median of a quiet picture: one walk per pixel leaves most of `light`
  // black.
  const double level =
      median(Renderer(lab, lamp, {"bdpt", size, size}).render({32, 2, 8, MIS_BALANCE}));
  for (const char* method : {"nee", "path", "light", "bdpt", "sppm", "bpm", "vcm"}) {
    const Picture picture = Renderer(lab, lamp, {method, size, size}).render(one_sample);
    findings.at_most(
        fmt::format("brightest pixel near a lamp without size, in medians, {}", method),
        brightest(picture) * picture.image(0).mean / level, 1e3);
  }
}

}  // namespace pellucid::stability
