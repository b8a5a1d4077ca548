// Splats of walks from the lights (numerics 20): corners of wide pictures are as bright as their
// centre, and a crop has the pixels of the whole.
//
// Naive code writes the importance of a pixel down twice, forgets its area or cos^-3, divides by
// the paths of the crop, and adds floats in the order of arrival. Here camera rays and splats have
// one importance function (camera/camera.h), splats count paths of the whole picture, and sums of
// them are whole numbers: a splat is three atomic additions of 64 bits, or six of 32 where devices
// have no others (film/film.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "integrators/registry.h"
#include "stability/estimates.h"
#include "stability/exact.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int size = 24, block = 6;
constexpr int corner[] = {0, size - block}, middle = (size - block) / 2;

/// Where blocks of pixels begin, those that are looked at together.
using Blocks = std::vector<std::array<int, 2>>;
const Blocks corners{
    {corner[0], corner[0]}, {corner[0], corner[1]}, {corner[1], corner[0]}, {corner[1], corner[1]}};
const Blocks centre{{middle, middle}};

/// What light tracing has there, by the spread of runs, beside the radiance that is everywhere;
/// `seen` of it comes with no walk.
void compare_blocks(const Lab& lab, Findings& findings, const std::string& what, const Scene& scene,
                    const Blocks& blocks, uint paths, double seen, double splatted,
                    double resolution) {
  constexpr int runs = 16;
  Build build{"light", size, size};
  build.light_paths = paths;
  build.sampler = Sampler::sobol;
  Renderer renderer(lab, scene, build);
  double mean = 0, square = 0;
  for (std::uint64_t k = 0; k < runs; ++k) {
    const Picture p = renderer.render({16 * lab.count(1), 1 + k, 2, MIS_BALANCE});
    double x = -seen;
    for (const auto& [x0, y0] : blocks) x += p.block_mean(0, x0, y0, block) / double(blocks.size());
    mean += x / runs, square += x * x / runs;
  }
  compare(lab, findings, what, {mean, (square - mean * mean) / (runs - 1)}, splatted, 1e-5,
          resolution);
}

/// A white ball around the camera, and there, too, a spot for each block of pixels, whose cone is
/// full wherever the block is and little wider, so that what walks find counts. Its radiance is
/// rho I / pi = 1/2, by the law of CF2.
Scene lit_ball(double fov, const Blocks& blocks) {
  Scene scene = empty_scene();
  add_shape(scene, Sphere{});
  scene.camera.fov = fov;
  const double half = std::tan(0.5 * fov * pi / 180);
  const auto towards = [&](double x, double y) {
    const double px = (2 * x / size - 1) * half, py = (1 - 2 * y / size) * half;
    return glm::normalize(scene.camera.forward + px * scene.camera.right + py * scene.camera.up);
  };
  for (const auto& [x, y] : blocks) {
    SpotLight spot;
    spot.intensity = Rgb(pi);
    spot.direction = towards(x + 0.5 * block, y + 0.5 * block);
    double widest = 0;
    for (int i : {0, block})
      for (int k : {0, block})
        widest = std::max(widest, std::acos(glm::dot(spot.direction, towards(x + i, y + k))));
    spot.inner = 1.02 * widest, spot.outer = 1.03 * widest;
    scene.lights.push_back(spot);
  }
  return scene;
}

/// With the light of lamps without size, and with that of a mesh [CF14]: up to two segments.
void measure_corners(const Lab& lab, Findings& findings) {
  for (double fov : {5.0, 60.0, 150.0}) {
    const std::string what = fmt::format(" of {:g} degrees", fov);
    // Corners of very wide pictures are slivers, which fill a sixth of their cone.
    const bool wide = fov > 120;
    compare_blocks(lab, findings, "corners" + what, lit_ball(fov, corners), corners,
                   wide ? 3 << 14 : 1 << 12, 0, 0.5, 0.003);
    compare_blocks(lab, findings, "centre" + what, lit_ball(fov, centre), centre, 1 << 12, 0, 0.5,
                   0.003);
  }
  // Walks of all the lamp's triangles go everywhere, 1 in 40 to where it is looked at: a wide view
  // sees most. Le and rho Le of the red channel.
  constexpr double wide_view = 100;
  Scene furnace = lab.open_scene("furnace");
  furnace.camera.fov = wide_view;
  for (const Blocks* blocks : {&corners, &centre})
    compare_blocks(lab, findings,
                   fmt::format("{} of {:g} degrees in a shining lump",
                               blocks == &corners ? "corners" : "centre", wide_view),
                   furnace, *blocks, 1 << 15, 0.5, 0.25, usual_resolution);
}

constexpr int packed_side = 24;

Film render_part(const Lab& lab, const PackedScene& packed, const char* method,
                 const std::optional<Window>& crop) {
  RenderOptions options;
  options.width = packed_side, options.height = packed_side;
  options.crop = crop;
  options.passes = PassRange{0, 16};
  options.plan.extra_features = all_scene_features();
  options.plan.kernel_dir = lab.kernel_dir;
  Session session(lab.device, packed, find_integrator(method), options);
  session.run({});
  return session.film();
}

void measure_crop(const Lab& lab, Findings& findings) {
  Scene scene = lab.open_scene("everything");
  scene.settings.width = scene.settings.height = packed_side;
  const PackedScene packed = pack_scene(scene, {simd_width_for(lab.device.info())});
  const Window part{5, 9, 11, 7};
  for (const char* method : {"path", "light", "bdpt", "vcm"}) {
    const Film whole = render_part(lab, packed, method, {});
    const Film crop = render_part(lab, packed, method, part);
    std::uint64_t differing = 0;
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x) {
        const FilmPixel& a = crop.pixels[std::size_t(y * part.width + x)];
        const FilmPixel& b = whole.pixels[std::size_t((part.y0 + y) * packed_side + part.x0 + x)];
        differing += std::memcmp(a.sum, b.sum, sizeof a.sum) != 0;
      }
    findings.none(fmt::format("pixels of a crop that differ from the whole, {}", method),
                  differing);
  }
}

}  // namespace

void splats_fall_where_rays_come_from(const Lab& lab, Findings& findings) {
  measure_corners(lab, findings);
  measure_crop(lab, findings);
}

}  // namespace pellucid::stability
