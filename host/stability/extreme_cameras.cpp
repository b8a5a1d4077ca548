// Cameras at their limits (numerics 35): fields of view from a thousandth of a degree to 170; rays
// as double has them. Naive code derives directions from whole pixels or loses them in tan and its
// inverse. There are no apertures and no orthographic cameras.
//
// Rays are made from a corner and two steps that the host computes in double (pack/pack.cpp), which
// costs kernels nothing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stability/measurements.h"
#include "stability/renderer.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

constexpr int size = 32;
constexpr double pi = 3.14159265358979323846;

/// Largest distance, in pixels, between where rays through pixel centres meet a sheet just as large
/// as the view and where they should.
double worst_pixel(const Lab& lab, double fov) {
  const double half = std::tan(0.5 * fov * pi / 180);
  Scene scene = empty_scene();
  const auto h = float(1.5 * half);
  Mesh sheet;
  sheet.positions = {{-h, -h, -1}, {h, -h, -1}, {h, h, -1}, {-h, h, -1}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  add_shape(scene, std::move(sheet));
  scene.camera.fov = fov;
  std::map<std::string, std::vector<float>> aov = first_surfaces(lab, scene, {"P"}, size);
  double worst = 0;
  const double pixel = 2 * half / size;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const std::size_t i = std::size_t(y * size + x);
      const double px = (x + 0.5 - 0.5 * size) * pixel, py = (0.5 * size - y - 0.5) * pixel;
      worst =
          std::max(worst, std::hypot(double(aov.at("P.X")[i]) - px, double(aov.at("P.Y")[i]) - py));
    }
  return worst / pixel;
}

}  // namespace

void cameras_keep_their_rays(const Lab& lab, Findings& findings) {
  for (double fov : {1e-3, 0.1, 10.0, 90.0, 150.0, 170.0})
    findings.at_most(fmt::format("rays off their pixel's centre, in pixels, {:g} degrees", fov),
                     worst_pixel(lab, fov), 0.01);
}

}  // namespace pellucid::stability
