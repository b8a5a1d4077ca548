// MTL materials in terms of ours.
#pragma once

#include <tiny_obj_loader.h>

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace pellucid {

struct MtlSurface {
  Material material;
  std::optional<Emission> emission;
};

/// The nearest of our materials, and warnings where it had to be changed to keep physics.
/// `principled`: the file gives the material's Pr or Pm.
MtlSurface convert_mtl(const tinyobj::material_t& mtl, bool principled,
                       std::vector<std::string>& warnings);

}  // namespace pellucid
