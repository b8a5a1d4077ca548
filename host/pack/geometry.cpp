// Shapes to triangles and quadrics, and the BVH over them as flat arrays.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/timer.h"
#include "pack/packer.h"

namespace pellucid {
namespace {

constexpr std::uint8_t class_triangle = 0, class_needle = 1, class_quadric = 2;

/// Longest edge over the height above it from which on a triangle is a needle: up to here rays
/// start far enough off for what is lost of distances (EXTENT_ERROR_ULPS).
constexpr double needle_aspect = 5;

uint emission_flags(const Shape& shape) {
  if (!shape.emission) return 0;
  return shape.emission->sides == 2 ? SHAPE_EMIT_FRONT | SHAPE_EMIT_BACK : SHAPE_EMIT_FRONT;
}

void add_mesh(const Mesh& mesh, uint shape_index, PackedScene& out) {
  const auto base = static_cast<uint>(out.positions.size());
  for (const glm::vec3& p : mesh.positions) out.positions.push_back(F4{p.x, p.y, p.z, 0.0f});
  if (!mesh.normals.empty()) {
    PELLUCID_CHECK(mesh.normals.size() == mesh.positions.size(), "one normal per position");
    out.normals.resize(base);  // shapes before it that have none
    for (const glm::vec3& n : mesh.normals) out.normals.push_back(F4{n.x, n.y, n.z, 0.0f});
  }
  if (!mesh.uvs.empty()) {
    PELLUCID_CHECK(mesh.uvs.size() == mesh.positions.size(), "one uv per position");
    out.uvs.resize(std::size_t{2} * base);
    for (const glm::vec2& uv : mesh.uvs) out.uvs.insert(out.uvs.end(), {uv.x, uv.y});
  }
  for (const glm::uvec3& t : mesh.triangles)
    out.triangles.push_back(Triangle{base + t.x, base + t.y, base + t.z, shape_index});
}

::Shape pack_shape(const Scene& scene, const ::Material& material, const Shape& shape,
                   FeatureSet& features) {
  ::Shape out{};
  out.material = static_cast<uint>(shape.material);
  out.flags = emission_flags(shape);
  out.first_light = NONE;
  if (shape.sides == 1 && !(material.lobes & LOBE_TRANSMIT)) {
    out.flags |= SHAPE_ONE_SIDED;
    features.set(FEAT_ONE_SIDED);
  }
  if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
    features.set(FEAT_TRIANGLES);
    if (!mesh->normals.empty()) {
      out.flags |= SHAPE_SMOOTH;
      features.set(FEAT_SMOOTH_NORMALS);
    }
  } else {
    features.set(std::holds_alternative<Sphere>(shape.geometry) ? FEAT_SPHERES : FEAT_DISKS);
  }
  const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
  if (textured(scene, shape) && !(mesh && mesh->uvs.empty())) {
    out.flags |= SHAPE_TEXTURED;
    features.set(FEAT_TEXTURE);
  }
  return out;
}

::Quadric pack_quadric(const Shape& shape, uint index) {
  ::Quadric out{};
  out.shape = index;
  if (const Sphere* s = std::get_if<Sphere>(&shape.geometry)) {
    out.kind = QUADRIC_SPHERE;
    out.center_radius = to_f4(s->center, s->radius);
    out.normal = to_f4(s->axes[1]);
    out.tangent = to_f4(s->axes[2], glm::determinant(s->axes) < 0.0 ? -1.0 : 1.0);
  } else {
    const Disk& d = std::get<Disk>(shape.geometry);
    out.kind = QUADRIC_DISK;
    out.center_radius = to_f4(d.center, d.radius);
    out.normal = to_f4(d.normal);
    const double turn = glm::dot(glm::cross(d.normal, d.u_axis), d.v_axis);
    out.tangent = to_f4(d.u_axis, turn < 0.0 ? -1.0 : 1.0);
  }
  return out;
}

/// Rounds a box computed in double outwards.
bvh::Box outward(const glm::dvec3& low, const glm::dvec3& high) {
  bvh::Box box;
  for (int a = 0; a < 3; ++a) {
    box.low[a] = std::nextafter(float(low[a]), -INFINITY);
    box.high[a] = std::nextafter(float(high[a]), INFINITY);
  }
  return box;
}

bvh::Box quadric_box(const Quadric& q) {
  const glm::dvec3 c(q.center_radius.x, q.center_radius.y, q.center_radius.z);
  const glm::dvec3 n(q.normal.x, q.normal.y, q.normal.z);
  const double r = q.center_radius.w;
  // A disk reaches r sin(angle to the axis) along each axis.
  const glm::dvec3 reach = q.kind == QUADRIC_SPHERE
                               ? glm::dvec3(r)
                               : r * glm::sqrt(glm::max(glm::dvec3(1.0) - n * n, glm::dvec3(0.0)));
  return outward(c - reach, c + reach);
}

std::vector<bvh::Box> boxes_of(const PackedScene& scene) {
  std::vector<bvh::Box> boxes(scene.triangles.size() + scene.quadrics.size());
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    const Triangle& t = scene.triangles[i];
    for (uint v : {t.v0, t.v1, t.v2})
      boxes[i].add(glm::vec3(scene.positions[v].x, scene.positions[v].y, scene.positions[v].z));
  }
  for (size_t i = 0; i < scene.quadrics.size(); ++i)
    boxes[scene.triangles.size() + i] = quadric_box(scene.quadrics[i]);
  return boxes;
}

void set_bounds(const std::vector<bvh::Box>& boxes, SceneInfo& info) {
  bvh::Box all;
  for (const bvh::Box& b : boxes) all.add(b);
  if (all.empty()) return;
  const glm::vec3 reach = glm::max(glm::abs(all.low), glm::abs(all.high));
  info.bounds_reach = F4{reach.x, reach.y, reach.z, 0.0f};
  const glm::dvec3 center = 0.5 * (glm::dvec3(all.low) + glm::dvec3(all.high));
  info.center_radius = to_f4(center, glm::length(glm::dvec3(all.high) - center));
}

using Corners = std::array<glm::dvec3, 3>;

Corners corners_of(const Triangle& t, const PackedScene& scene) {
  const auto at = [&](uint v) {
    return glm::dvec3(scene.positions[v].x, scene.positions[v].y, scene.positions[v].z);
  };
  return {at(t.v0), at(t.v1), at(t.v2)};
}

/// By class: which leaf a primitive goes to must not depend on its neighbours, as its hits do not.
std::vector<std::uint8_t> classes_of(const PackedScene& scene) {
  std::vector<std::uint8_t> classes;
  for (const Triangle& t : scene.triangles) {
    const Corners c = corners_of(t, scene);
    const glm::dvec3 a = c[1] - c[0], b = c[2] - c[0], d = c[2] - c[1];
    const double edge2 = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(d, d)});
    const glm::dvec3 n = glm::cross(a, b);  // edge^2 over its length is the aspect
    const bool needle = edge2 * edge2 > needle_aspect * needle_aspect * glm::dot(n, n);
    classes.push_back(needle ? class_needle : class_triangle);
  }
  classes.resize(classes.size() + scene.quadrics.size(), class_quadric);
  return classes;
}

/// Flattens wide nodes and leaves into the arrays of PackedScene.
class Flattener {
 public:
  Flattener(const bvh::WideTree& tree, const std::vector<std::uint8_t>& classes, PackedScene& out)
      : tree_(tree), classes_(classes), out_(out), width_(size_t(out.simd_width)) {}

  void run() {
    out_.nodes.assign(tree_.nodes.size() * 7 * width_, 0.0f);
    for (size_t i = 0; i < tree_.nodes.size(); ++i) node(i);
    if (out_.leaf_prims.size() / width_ > REF_INDEX_MASK || tree_.nodes.size() > REF_INDEX_MASK)
      throw InputError("the scene has more geometry than 2^26 leaf blocks can hold");
  }

 private:
  void node(size_t index) {
    float* base = &out_.nodes[index * 7 * width_];
    for (size_t i = 0; i < width_; ++i) {
      const bool used = i < size_t(tree_.nodes[index].child_count);
      const bvh::WideChild child = used ? tree_.nodes[index].child[i] : bvh::WideChild{};
      for (int axis = 0; axis < 3; ++axis) {
        // Empty slots: inverted and finite, so that no ray enters them and no NaN arises.
        base[(2 * axis) * width_ + i] = used ? child.box.low[axis] : FLT_MAX_HALF;
        base[(2 * axis + 1) * width_ + i] = used ? child.box.high[axis] : -FLT_MAX_HALF;
      }
      const uint ref = used ? reference(child) : REF_EMPTY;
      std::memcpy(&base[6 * width_ + i], &ref, sizeof ref);
    }
  }

  uint reference(const bvh::WideChild& child) {
    if (child.count == 0) return child.node;
    const uint first_prim = tree_.order[child.first];
    if (classes_[first_prim] == class_quadric)
      return REF_LEAF | (LEAF_QUADRICS << REF_KIND_SHIFT) |
             (first_prim - static_cast<uint>(out_.triangles.size()));
    const auto block = static_cast<uint>(out_.leaf_prims.size() / width_);
    add_block(child);
    const uint kind = classes_[first_prim] == class_needle ? LEAF_NEEDLES : LEAF_TRIANGLES;
    return REF_LEAF | (kind << REF_KIND_SHIFT) | block;
  }

  /// A block in lanes; unused lanes repeat the last triangle (a zero triangle would give 0 * inf).
  void add_block(const bvh::WideChild& child) {
    const size_t at = out_.leaves.size();
    out_.leaves.resize(at + 9 * width_);
    for (size_t lane = 0; lane < width_; ++lane) {
      const uint prim = tree_.order[child.first + std::min<size_t>(lane, child.count - 1)];
      out_.leaf_prims.push_back(prim);
      const Triangle& t = out_.triangles[prim];
      // Rounding could open a collinear triangle; with one vertex repeated none is ever hit.
      const bool open = has_area(t);
      const uint vertices[3] = {t.v0, open ? t.v1 : t.v0, open ? t.v2 : t.v0};
      for (size_t v = 0; v < 3; ++v) {
        const F4& p = out_.positions[vertices[v]];
        const float xyz[3] = {p.x, p.y, p.z};
        for (size_t axis = 0; axis < 3; ++axis)
          out_.leaves[at + (3 * v + axis) * width_ + lane] = xyz[axis];
      }
    }
  }

  bool has_area(const Triangle& t) const {
    const Corners c = corners_of(t, out_);
    return glm::cross(c[1] - c[0], c[2] - c[0]) != glm::dvec3(0.0);
  }

  /// Finite stand-in for infinity that survives (bound - origin) / direction without overflow to
  /// NaN.
  static constexpr float FLT_MAX_HALF = 1.7e38f;

  const bvh::WideTree& tree_;
  const std::vector<std::uint8_t>& classes_;
  PackedScene& out_;
  size_t width_;
};

}  // namespace

void pack_shapes(const Scene& scene, PackedScene& out) {
  size_t triangles = 0;
  for (const Shape& shape : scene.shapes)
    if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) triangles += mesh->triangles.size();
  constexpr size_t most = size_t{1} << 30;  // primitive ids stay far from NONE
  if (triangles > most) throw InputError("the scene has more than 2^30 triangles");
  uint first_triangle = 0, first_quadric = static_cast<uint>(triangles);
  for (const Shape& shape : scene.shapes) {
    const auto index = static_cast<uint>(out.shapes.size());
    ::Shape packed =
        pack_shape(scene, out.materials.at(std::size_t(shape.material)), shape, out.features);
    if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
      packed.first_prim = first_triangle;
      first_triangle += static_cast<uint>(mesh->triangles.size());
      add_mesh(*mesh, index, out);
    } else {
      packed.first_prim = first_quadric++;
      out.quadrics.push_back(pack_quadric(shape, index));
    }
    out.shapes.push_back(packed);
  }
  if (!out.normals.empty()) out.normals.resize(out.positions.size());
  out.info.triangle_count = static_cast<uint>(triangles);
  out.info.closed = scene.closed;
}

void pack_bvh(PackedScene& out) {
  const Timer timer;
  const std::vector<bvh::Box> boxes = boxes_of(out);
  const std::vector<std::uint8_t> classes = classes_of(out);
  const auto lanes = static_cast<std::uint32_t>(out.simd_width);
  const bvh::LeafCapacity capacity{lanes, lanes, 1};
  const bvh::WideTree tree = bvh::collapse(bvh::build(boxes, classes, capacity), out.simd_width);
  Flattener(tree, classes, out).run();
  out.info.root = tree.nodes.empty() ? REF_EMPTY : 0u;
  out.bvh = bvh::statistics(tree);
  out.stack_bound = out.bvh.stack;
  set_bounds(boxes, out.info);
  out.bvh_seconds = timer.seconds();
}

}  // namespace pellucid
