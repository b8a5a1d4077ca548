// What every launch of a render is told, before tiles and iterations.
#pragma once

#include <cstdint>

#include "pack/pack.h"
#include "render/film.h"

namespace pellucid {

/// For `window` of a picture of so many pixels; its tile is the whole window. `light_paths`: of an
/// iteration, for the whole picture; 0: one per pixel.
Launch make_launch(const PackedScene& scene, int width, int height, const Window& window,
                   uint light_paths = 0);

/// The launch for one tile.
void set_tile(Launch& launch, const Window& tile);

}  // namespace pellucid
