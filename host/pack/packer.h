// The steps of pack_scene, one file each. Every step adds the features it packs.
#pragma once

#include "pack/pack.h"

namespace pellucid {

inline F4 to_f4(const glm::dvec3& v, double w = 0.0) {
  return F4{float(v.x), float(v.y), float(v.z), float(w)};
}

/// materials.cpp: one material that is no mix, with its feature.
::Material pack_material(const Material& material, FeatureSet& features);
/// materials.cpp: the scene's materials in its order, then the parts of mixes.
void pack_materials(const std::vector<Material>& materials, PackedScene& out);

/// geometry.cpp: shapes, triangles, quadrics (in scene order: primitive ids do not depend on the
/// BVH).
void pack_shapes(const Scene& scene, PackedScene& out);
/// textures.cpp: images as texels, in half precision.
void pack_textures(const Scene& scene, PackedScene& out);
/// geometry.cpp: BVH over them, flattened; bounds.
void pack_bvh(PackedScene& out);

/// lights.cpp: lights of shapes and of the scene, with one alias table by power.
void pack_lights(const Scene& scene, PackedScene& out);

/// filter.cpp: the pixel filter.
void pack_filter(const Scene& scene, PackedScene& out);

}  // namespace pellucid
