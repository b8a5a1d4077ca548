// What every launch of a render is told, before tiles and iterations.
#pragma once

#include <cstdint>

#include "pack/pack.h"
#include "render/film.h"
#include "render/options.h"

namespace pellucid {

/// For `window` of a picture of so many pixels; its tile is the whole window. `light_paths`: of an
/// iteration, for the whole picture; 0: one per pixel.
Launch make_launch(const PackedScene& scene, int width, int height, const Window& window,
                   uint light_paths = 0);

/// Radius of merging in the first pass where none is asked for: with that many light paths over the
/// scene's extent.
double default_radius(const PackedScene& scene, uint light_paths);

/// Least radius of merging that means something in this scene: passes shrink it no further.
double least_radius(const PackedScene& scene);
/// Throws UsageError where --radius asks for less.
void check_radius(const PackedScene& scene, double asked);

/// How methods merge: the radius of the first pass, how it shrinks and where it stops, world units;
/// whether at the first vertex of eye paths alone.
struct Merging {
  double first_radius = 0, alpha = 0.75, least_radius = 0;
  bool first_only = false;
};

/// As asked for, or by the scene's size and the light paths.
Merging merging_for(const PackedScene& scene, const RenderOptions& options);

/// In one pass.
double merging_radius(const Merging& merging, std::uint64_t pass);

/// What merging needs to know in launch.iteration, which alone decides on the radius.
void set_merging(Launch& launch, const Merging& merging);

/// The photon grid of the launch's radius: cells of twice that, so that a search sees 8, counted
/// from `origin`; a table of 2^grid_bits places.
void set_grid(Launch& launch, const F4& origin, uint grid_bits);

/// The launch for one tile.
void set_tile(Launch& launch, const Window& tile);

}  // namespace pellucid
