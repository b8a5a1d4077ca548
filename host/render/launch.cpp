// Launches: sizes, and the steps in which films and splats count.
#include "render/launch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

/// As a float, with digits to spare for its inverse.
float power_of_two(int exponent) {
  return std::ldexp(1.0f, std::clamp(exponent, -126, 126));
}

/// Steps per unit of radiance. A light path brings about power / radius^2 times what the camera
/// makes of it, D^2 / light paths; a power of two keeps scaled scenes exact.
float splat_scale(const PackedScene& scene, uint light_paths) {
  const double r = scene.info.center_radius.w > 0.0f ? scene.info.center_radius.w : 1.0;
  const double distance = scene.camera.forward.w;
  const double typical = scene.light_power / (r * r) * (distance * distance) / light_paths;
  int exponent = 0;
  if (typical > 0) std::frexp(typical, &exponent);
  return power_of_two(SPLAT_FRACTION_BITS - exponent);
}

}  // namespace

Launch make_launch(const PackedScene& scene, int width, int height, const Window& window,
                   uint light_paths) {
  Launch launch{};
  launch.width = uint(width), launch.height = uint(height);
  launch.window_x = uint(window.x0), launch.window_y = uint(window.y0);
  launch.window_width = uint(window.width), launch.window_height = uint(window.height);
  set_tile(launch, window);
  launch.light_paths = light_paths ? light_paths : launch.width * launch.height;
  launch.max_depth = NONE;
  launch.film_lsb = scene.brightness_exponent - FILM_FRACTION_BITS;
  launch.splat_scale = splat_scale(scene, launch.light_paths);
  launch.layer_scale = power_of_two(LAYER_FRACTION_BITS - scene.brightness_exponent);
  return launch;
}

double default_radius(const PackedScene& scene, uint light_paths) {
  constexpr double share = 1.5;  // with 512x512 paths 0.003 of the scene's radius, as SmallVCM
  const double r = scene.info.center_radius.w > 0.0f ? scene.info.center_radius.w : 1.0;
  return share * r / std::sqrt(double(light_paths));
}

double least_radius(const PackedScene& scene) {
  const F4& reach = scene.info.bounds_reach;
  const double largest = std::max({reach.x, reach.y, reach.z});
  return std::max(double(MERGE_RADIUS_ULPS * UNIT_ROUNDOFF) * largest, double(MERGE_RADIUS_MIN));
}

void check_radius(const PackedScene& scene, double asked) {
  if (asked >= least_radius(scene)) return;
  throw UsageError(
      fmt::format("--radius {}: this scene's coordinates are rounded so much that merging means "
                  "something only from {:.3g} on; ask for that, or move the scene nearer to the "
                  "origin",
                  asked, least_radius(scene)));
}

Merging merging_for(const PackedScene& scene, const RenderOptions& options) {
  return {options.radius.value_or(default_radius(scene, options.light_path_count())),
          options.radius_alpha, least_radius(scene), options.merge_first_only};
}

double merging_radius(const Merging& merging, std::uint64_t pass) {
  // [Knaus11]: as a function of the pass, so that passes may be done in any order.
  const double shrunk =
      merging.first_radius * std::pow(double(pass) + 1.0, 0.5 * (merging.alpha - 1));
  return std::max(shrunk, merging.least_radius);
}

void set_merging(Launch& launch, const Merging& merging) {
  constexpr double pi = 3.14159265358979323846;
  const double radius = merging_radius(merging, launch.iteration);
  const double eta = pi * radius * radius * launch.light_paths;
  launch.radius = float(radius);
  launch.merge_scale = float(1 / eta);
  launch.mis_vm = float(eta);
  launch.mis_deep = merging.first_only ? 0.0f : MERGE_DEEP_TRUST;
}

static_assert(GRID_BITS_MAX < SORT_DIGIT_BITS * SORT_PASSES,
              "NONE, the key of what is in no cell, is sorted behind all cells");

void set_grid(Launch& launch, const F4& origin, uint grid_bits) {
  launch.grid_x = origin.x, launch.grid_y = origin.y, launch.grid_z = origin.z;
  launch.cells_per_unit = 1 / (2 * launch.radius);
  launch.grid_bits = grid_bits;
}

void set_tile(Launch& launch, const Window& tile) {
  launch.tile_x = uint(tile.x0), launch.tile_y = uint(tile.y0);
  launch.tile_width = uint(tile.width), launch.tile_height = uint(tile.height);
}

}  // namespace pellucid
