// The "principled" look of asset pipelines in terms of ours; native scenes and MTL share it.
#pragma once

#include "scene/scene.h"

namespace pellucid {

struct Principled {
  Rgb base_color{0.5};        ///< of the plastic's base and of the metal
  double metallic = 0.0;      ///< weight of the metal
  double transmission = 0.0;  ///< weight of glass in what is no metal
  double roughness = 0.5;     ///< alpha = roughness^2, of all parts
  double ior = 1.5;           ///< of coat and glass
};

/// Metal, plastic and glass, mixed by weight; a single material where one weight is 1. Without
/// name.
Material principled_material(const Principled& look);

/// Index of a metal that reflects `color` at normal incidence: eta = 1, k = 2 sqrt(c / (1 - c))
/// [PBRT4]. Toward grazing angles it goes to white, as metals do.
void metal_of_color(const Rgb& color, Rgb& eta, Rgb& k);

}  // namespace pellucid
