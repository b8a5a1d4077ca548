// From triangles in object space and double to a Mesh in world space and float.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/transform.h"

namespace pellucid {

/// Triangles in object space; `normals` is empty or has one unit vector per position, `uvs` is
/// empty or has one pair.
struct RawMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::dvec2> uvs = {};  ///< u NaN: undefined, as at the pole of a sphere
};

/// Gives every vertex the mean of its triangles' normals, weighted by area.
void add_smooth_normals(RawMesh& mesh);

/// Where texture coordinates jump from 1 to 0 inside a triangle, it gets vertices of its own that
/// go on beyond 1; at a pole each triangle gets the mean longitude of its other corners.
void cut_seams(RawMesh& mesh);

struct BakedMesh {
  Mesh mesh;
  std::size_t dropped = 0;  ///< triangles of exactly zero area, left out
  bool finite = true;       ///< false: a coordinate left the range of numbers
};

/// Transforms, keeps the front side in front under mirroring, turns it round once more if `flip`,
/// and drops triangles without area. Consumes the raw mesh to save memory.
BakedMesh bake_mesh(RawMesh raw, const Affine& transform, bool flip);

/// Two triangles; front side = edge0 x edge1; u grows along edge0, v along edge1.
RawMesh make_rectangle(glm::dvec3 corner, glm::dvec3 edge0, glm::dvec3 edge1);
/// Twelve triangles, front side outwards. Every face shows the whole texture: upright at the sides,
/// u along x at top and bottom.
RawMesh make_cube(glm::dvec3 center, glm::dvec3 size);

}  // namespace pellucid
