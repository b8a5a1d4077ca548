// From triangles in object space and double to a Mesh in world space and float.
#include "scene/mesh_tools.h"

#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "scene/scene.h"

namespace pellucid {
namespace {

bool has_area(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 p0 = mesh.positions[t.x], p1 = mesh.positions[t.y], p2 = mesh.positions[t.z];
  const glm::dvec3 n = glm::cross(p1 - p0, p2 - p0);
  return n.x != 0.0 || n.y != 0.0 || n.z != 0.0;
}

/// Coordinates of one axis at three corners, made continuous: jumps of more than a half are seams.
void close_gap(glm::dvec2 (&uv)[3], int axis) {
  double most = 0.0, sum = 0.0;
  int known = 0;
  for (const glm::dvec2& c : uv)
    if (c[axis] > most) most = c[axis];
  for (glm::dvec2& c : uv) {
    if (most - c[axis] > 0.5) c[axis] += 1.0;
    if (!std::isnan(c[axis])) sum += c[axis], ++known;
  }
  for (glm::dvec2& c : uv)
    if (std::isnan(c[axis])) c[axis] = sum / known;
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

void cut_seams(RawMesh& mesh) {
  std::map<std::tuple<unsigned, double, double>, unsigned> copies;
  for (glm::uvec3& triangle : mesh.triangles) {
    glm::dvec2 uv[3];
    for (int i = 0; i < 3; ++i) uv[i] = mesh.uvs[triangle[i]];
    for (int axis = 0; axis < 2; ++axis) close_gap(uv, axis);
    for (int i = 0; i < 3; ++i) {
      const unsigned old = triangle[i];
      if (uv[i] == mesh.uvs[old]) continue;
      const auto next = static_cast<unsigned>(mesh.positions.size());
      const auto [copy, added] = copies.emplace(std::tuple(old, uv[i].x, uv[i].y), next);
      triangle[i] = copy->second;
      if (!added) continue;
      mesh.positions.push_back(mesh.positions[old]);
      if (!mesh.normals.empty()) mesh.normals.push_back(mesh.normals[old]);
      mesh.uvs.push_back(uv[i]);
    }
  }
  // No triangle uses a pole itself any more; what is left must still be a number.
  for (glm::dvec2& uv : mesh.uvs)
    if (std::isnan(uv.x)) uv.x = 0.0;
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
  mesh.uvs.reserve(raw.uvs.size());
  for (const glm::dvec2& uv : raw.uvs) mesh.uvs.emplace_back(uv);
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
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

RawMesh make_cube(glm::dvec3 center, glm::dvec3 size) {
  // Corner numbers: bit 0: +x, bit 1: +y, bit 2: +z. Faces: -x, +x, -y, +y, -z, +z.
  const unsigned faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  RawMesh mesh;
  for (unsigned face = 0; face < 6; ++face) {
    for (const unsigned corner : faces[face]) {
      const glm::dvec3 c(corner & 1u, (corner >> 1) & 1u, corner >> 2);
      const glm::dvec2 uv[6] = {{c.z, c.y},       {1.0 - c.z, c.y}, {c.x, c.z},
                                {c.x, 1.0 - c.z}, {1.0 - c.x, c.y}, {c.x, c.y}};
      mesh.positions.push_back(center + size * (c - 0.5));
      mesh.uvs.push_back(uv[face]);
    }
    mesh.triangles.emplace_back(4 * face, 4 * face + 1, 4 * face + 2);
    mesh.triangles.emplace_back(4 * face, 4 * face + 2, 4 * face + 3);
  }
  return mesh;
}

}  // namespace pellucid
