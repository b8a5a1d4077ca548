// From triangles in object space and double to a Mesh in world space and float.
#include "scene/mesh_tools.h"

#include <cmath>
#include <utility>
#include "scene/scene.h"

namespace pellucid {
namespace {

bool has_area(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 p0 = mesh.positions[t.x], p1 = mesh.positions[t.y], p2 = mesh.positions[t.z];
  const glm::dvec3 n = glm::cross(p1 - p0, p2 - p0);
  return n.x != 0.0 || n.y != 0.0 || n.z != 0.0;
}

}  // namespace

void add_smooth_normals(RawMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 p0 = mesh.positions[t.x];
    const glm::dvec3 n = glm::cross(mesh.positions[t.y] - p0, mesh.positions[t.z] - p0);
    for (int i = 0; i < 3; ++i) mesh.normals[t[i]] += n;
  }
  for (glm::dvec3& n : mesh.normals) {
    const double length = glm::length(n);
    n = length > 0.0 ? n / length : glm::dvec3(0.0, 0.0, 1.0);  // only if all around has no area
  }
}

BakedMesh bake_mesh(RawMesh raw, const Affine& transform, bool flip) {
  BakedMesh result;
  Mesh& mesh = result.mesh;
  mesh.positions.reserve(raw.positions.size());
  for (const glm::dvec3& p : raw.positions) {
    const glm::dvec3 q = transform.point(p);
    for (int i = 0; i < 3; ++i) result.finite &= std::abs(q[i]) <= largest_length;
    mesh.positions.emplace_back(q);
  }
  raw.positions = {};
  mesh.normals.reserve(raw.normals.size());
  for (const glm::dvec3& n : raw.normals) {
    const glm::dvec3 world = transform.normal(n);
    mesh.normals.emplace_back(flip ? -world : world);
  }
  raw.normals = {};
  const bool reverse = flip != transform.mirrors();
  mesh.triangles = std::move(raw.triangles);
  std::size_t kept = 0;
  for (glm::uvec3 t : mesh.triangles) {
    if (reverse) std::swap(t.y, t.z);
    if (has_area(mesh, t)) mesh.triangles[kept++] = t;
  }
  result.dropped = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  return result;
}

RawMesh make_rectangle(glm::dvec3 corner, glm::dvec3 edge0, glm::dvec3 edge1) {
  RawMesh mesh;
  mesh.positions = {corner, corner + edge0, corner + edge0 + edge1, corner + edge1};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

RawMesh make_cube(glm::dvec3 center, glm::dvec3 size) {
  RawMesh mesh;
  for (unsigned i = 0; i < 8; ++i)  // bit 0: +x, bit 1: +y, bit 2: +z
    mesh.positions.push_back(center + size * (glm::dvec3(i & 1u, (i >> 1) & 1u, i >> 2) - 0.5));
  const unsigned faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& f : faces) {
    mesh.triangles.emplace_back(f[0], f[1], f[2]);
    mesh.triangles.emplace_back(f[0], f[2], f[3]);
  }
  return mesh;
}

}  // namespace pellucid
