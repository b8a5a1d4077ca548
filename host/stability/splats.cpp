// Splats of walks from the lights (numerics 20): corners of wide pictures are as bright as their
// centre, and a crop has the pixels of the whole.
//
// Camera rays and splats have one importance function (camera/camera.h), splats count paths of the
// whole picture, and sums of them are whole numbers.
#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "integrators/registry.h"
#include "stability/estimates.h"
#include "stability/exact.h"
#include "stability/measurements.h"

namespace pellucid::stability {
namespace {

/// CF1 up to two segments, of which the longer ones are splats: at corners and in the middle.
void measure_corners(const Lab& lab, Findings& findings) {
  constexpr int size = 24, block = 6, runs = 32;
  constexpr double seen = 0.5, splatted = 0.25;  // Le and rho Le of the red channel
  Scene scene = lab.open_scene("furnace");
  for (double fov : {5.0, 60.0, 150.0}) {
    scene.camera.fov = fov;
    Build build{"light", size, size};
    const bool narrow = fov < 10;  // few vertices are in it
    build.light_paths = narrow ? 1 << 16 : 1 << 14;
    Renderer renderer(lab, scene, build);
    double mean[2] = {}, square[2] = {};
    for (std::uint64_t k = 0; k < runs; ++k) {
      const Picture p = renderer.render({lab.count(8), 1 + k, 2, MIS_BALANCE});
      constexpr int end = size - block, middle = size / 2 - block;
      const double corners = (p.block_mean(0, 0, 0, block) + p.block_mean(0, end, 0, block) +
                              p.block_mean(0, 0, end, block) + p.block_mean(0, end, end, block)) /
                             4;
      const double values[2] = {corners - seen, p.block_mean(0, middle, middle, 2 * block) - seen};
      for (int i : {0, 1}) mean[i] += values[i] / runs, square[i] += values[i] * values[i] / runs;
    }
    for (int i : {0, 1})
      compare(lab, findings, fmt::format("{} of {:g} degrees", i ? "centre" : "corners", fov),
              {mean[i], (square[i] - mean[i] * mean[i]) / (runs - 1)}, splatted, 1e-5,
              (narrow ? 7 : 3) * usual_resolution);
  }
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
