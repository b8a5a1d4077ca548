// Packing of geometry and features: blocks, references, primitive ids, flags.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <set>

#include "base/error.h"
#include "pack/pack.h"
#include "support/test_scenes.h"

namespace pellucid {
namespace {

using test::add_shape;
using test::empty_scene;
using test::Random;

Scene mixed_scene() {
  Random random(1);
  Scene scene = empty_scene();
  add_shape(scene, Sphere{{1, 2, 3}, 0.5});
  add_shape(scene, test::soup(random, 300, 4, 0.5));
  add_shape(scene, Disk{{-1, 0, 2}, {0, 1, 0}, 0.25});
  add_shape(scene, test::lump(500, {5, 0, 0}));
  return scene;
}

uint child_ref(const PackedScene& s, uint node, int lane) {
  const auto w = size_t(s.simd_width);
  uint ref;
  std::memcpy(&ref, &s.nodes[(node * 7 + 6) * w + size_t(lane)], sizeof ref);
  return ref;
}

/// Walks every reference from the root as the kernels read it; counts how often each primitive is
/// met (padding lanes apart) and checks each leaf against its box.
struct Walker {
  const PackedScene& s;
  std::map<uint, int> met;

  void node(uint index) {
    for (int lane = 0; lane < s.simd_width; ++lane) {
      const uint ref = child_ref(s, index, lane);
      if (ref == REF_EMPTY) {
        EXPECT_GT(bound(index, 0, lane), bound(index, 1, lane)) << "empty slots are inverted";
      } else if (ref & REF_LEAF) {
        leaf(ref, index, lane);
      } else {
        ASSERT_GT(ref, index);
        node(ref);
      }
    }
  }
  float bound(uint index, int plane, int lane) const {
    return s.nodes[(index * 7 + size_t(plane)) * size_t(s.simd_width) + size_t(lane)];
  }
  void leaf(uint ref, uint index, int lane) {
    const uint at = ref & REF_INDEX_MASK;
    EXPECT_EQ((ref >> REF_COUNT_SHIFT) & REF_COUNT_MASK, 0u) << "one block";
    if (((ref >> REF_KIND_SHIFT) & REF_KIND_MASK) == LEAF_QUADRICS) {
      ++met[s.info.triangle_count + at];
      return;
    }
    const auto w = size_t(s.simd_width);
    std::set<uint> here;
    for (size_t i = 0; i < w; ++i) {
      const uint prim = s.leaf_prims[at * w + i];
      here.insert(prim);
      const Triangle& t = s.triangles[prim];
      const uint vertices[3] = {t.v0, t.v1, t.v2};
      for (size_t v = 0; v < 3; ++v) {
        const float xyz[3] = {s.positions[vertices[v]].x, s.positions[vertices[v]].y,
                              s.positions[vertices[v]].z};
        for (size_t axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(s.leaves[(at * 9 + v * 3 + axis) * w + i], xyz[axis]);
          EXPECT_LE(bound(index, int(2 * axis), lane), xyz[axis]);
          EXPECT_GE(bound(index, int(2 * axis) + 1, lane), xyz[axis]);
        }
      }
    }
    for (uint prim : here) ++met[prim];
  }
};

TEST(PackLayout, EveryPrimitiveIsInExactlyOneLeafWithItsVertices) {
  for (int width : {4, 8, 16}) {
    SCOPED_TRACE(width);
    const PackedScene s = pack_scene(mixed_scene(), {width});
    EXPECT_EQ(s.simd_width, width);
    Walker walker{s, {}};
    walker.node(s.info.root);
    EXPECT_EQ(walker.met.size(), s.triangles.size() + s.quadrics.size());
    for (const auto& [prim, times] : walker.met) EXPECT_EQ(times, 1) << prim;
    EXPECT_EQ(s.stack_bound, s.bvh.stack);
    EXPECT_EQ(s.leaf_prims.size() * 9, s.leaves.size());
  }
}

/// Longest edge over the height above it.
double aspect_of(const PackedScene& s, uint prim) {
  const auto at = [&](uint v) {
    return glm::dvec3(s.positions[v].x, s.positions[v].y, s.positions[v].z);
  };
  const Triangle& t = s.triangles[prim];
  const glm::dvec3 a = at(t.v0), b = at(t.v1), c = at(t.v2);
  const double edge = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  return edge * edge / glm::length(glm::cross(b - a, c - a));
}

// Hits of a triangle must not depend on which others stand beside it: layouts differ in that.
TEST(PackLayout, LongTrianglesHaveLeavesOfTheirOwn) {
  Scene scene = empty_scene();
  Mesh lump = test::lump(500);
  for (glm::vec3& p : lump.positions) p.y *= p.x > 0 ? 6.0f : 1.0f;
  add_shape(scene, lump);
  for (int width : {4, 8}) {
    const PackedScene s = pack_scene(scene, {width});
    size_t needles = 0, others = 0;
    for (size_t at = 0; at < s.nodes.size(); at += size_t(7 * width))
      for (int lane = 0; lane < width; ++lane) {
        uint ref;
        std::memcpy(&ref, &s.nodes[at + size_t(6 * width + lane)], sizeof ref);
        if (ref == REF_EMPTY || !(ref & REF_LEAF)) continue;
        const bool needle = ((ref >> REF_KIND_SHIFT) & REF_KIND_MASK) == LEAF_NEEDLES;
        for (int i = 0; i < width; ++i)
          EXPECT_EQ(
              aspect_of(s, s.leaf_prims[(ref & REF_INDEX_MASK) * size_t(width) + size_t(i)]) > 5,
              needle);
        ++(needle ? needles : others);
      }
    EXPECT_GT(needles, 10u);
    EXPECT_GT(others, 10u);
  }
}

TEST(PackLayout, PrimitiveIdsDoNotDependOnTheWidth) {
  const PackedScene a = pack_scene(mixed_scene(), {4}), b = pack_scene(mixed_scene(), {16});
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  EXPECT_EQ(
      std::memcmp(a.triangles.data(), b.triangles.data(), a.triangles.size() * sizeof(Triangle)),
      0);
  EXPECT_EQ(std::memcmp(a.shapes.data(), b.shapes.data(), a.shapes.size() * sizeof(::Shape)), 0);
  EXPECT_EQ(std::memcmp(&a.info, &b.info, sizeof a.info), 0);
}

TEST(PackLayout, ShapesOwnTheirPrimitives) {
  const Scene scene = mixed_scene();
  const PackedScene s = pack_scene(scene, {8});
  const auto triangles = uint(std::get<Mesh>(scene.shapes[1].geometry).triangles.size());
  const auto more = uint(std::get<Mesh>(scene.shapes[3].geometry).triangles.size());
  EXPECT_EQ(s.info.triangle_count, triangles + more);
  EXPECT_EQ(s.shapes[1].first_prim, 0u);
  EXPECT_EQ(s.shapes[3].first_prim, triangles);
  EXPECT_EQ(s.shapes[0].first_prim, triangles + more);
  EXPECT_EQ(s.shapes[2].first_prim, triangles + more + 1);
  for (uint i = 0; i < s.triangles.size(); ++i)
    EXPECT_EQ(s.triangles[i].shape, i < triangles ? 1u : 3u);
  EXPECT_EQ(s.quadrics[0].shape, 0u);
  EXPECT_EQ(s.quadrics[0].kind, QUADRIC_SPHERE);
  EXPECT_EQ(s.quadrics[1].shape, 2u);
  EXPECT_EQ(s.quadrics[1].kind, QUADRIC_DISK);
  EXPECT_EQ(s.quadrics[1].normal.y, 1.0f);
}

TEST(PackLayout, NothingAtAll) {
  const PackedScene s = pack_scene(empty_scene(), {8});
  EXPECT_EQ(s.info.root, REF_EMPTY);
  EXPECT_EQ(s.info.light_count, 0u);
  EXPECT_EQ(s.info.environment, NONE);
  EXPECT_EQ(s.stack_bound, 0u);
  EXPECT_FALSE(s.nodes.empty() || s.leaves.empty() || s.leaf_prims.empty() || s.quadrics.empty() ||
               s.triangles.empty() || s.positions.empty() || s.normals.empty() ||
               s.shapes.empty() || s.materials.empty() || s.lights.empty());
}

TEST(PackLayout, NormalsStandBesideTheirPositions) {
  Scene scene = empty_scene();
  add_shape(scene, test::lump(100));
  Mesh smooth = test::lump(200, {3, 0, 0});
  for (const glm::vec3& p : smooth.positions)
    smooth.normals.push_back(glm::normalize(p - glm::vec3(3, 0, 0)));
  const size_t before = std::get<Mesh>(scene.shapes[0].geometry).positions.size();
  add_shape(scene, smooth);
  add_shape(scene, test::lump(100, {-3, 0, 0}));
  const PackedScene s = pack_scene(scene, {8});
  ASSERT_EQ(s.normals.size(), s.positions.size());
  for (size_t i = 0; i < smooth.normals.size(); ++i)
    EXPECT_EQ(s.normals[before + i].x, smooth.normals[i].x);
  EXPECT_EQ(s.shapes[0].flags & SHAPE_SMOOTH, 0u);
  EXPECT_NE(s.shapes[1].flags & SHAPE_SMOOTH, 0u);
}

FeatureSet features_of(const Shape& shape, const Material& material) {
  Scene scene;
  scene.settings.filter = PixelFilter::box;  // which needs no code
  scene.materials = {material};
  scene.shapes = {shape};
  scene.shapes[0].material = 0;
  return pack_scene(scene, {8}).features;
}

TEST(PackFeatures, OneFlagPerKindOfMaterial) {
  Shape sphere;
  sphere.geometry = Sphere{};
  const auto expect = [&](MaterialKind kind, double alpha, double ior, Feature feature,
                          uint packed) {
    Material m;
    m.kind = kind;
    m.alpha = alpha;
    m.ior = ior;
    m.eta = Rgb(0.2), m.k = Rgb(3.0);
    EXPECT_EQ(features_of(sphere, m), FeatureSet({FEAT_SPHERES, feature}));
    Scene scene;
    scene.materials = {m};
    EXPECT_EQ(pack_scene(scene, {8}).materials[0].kind, packed);
  };
  expect(MaterialKind::diffuse, 0, 1.5, FEAT_DIFFUSE, MATERIAL_DIFFUSE);
  expect(MaterialKind::phong, 0, 1.5, FEAT_PHONG, MATERIAL_PHONG);
  expect(MaterialKind::mirror, 0, 1.5, FEAT_MIRROR, MATERIAL_MIRROR);
  expect(MaterialKind::conductor, 0, 1.5, FEAT_CONDUCTOR, MATERIAL_CONDUCTOR);
  expect(MaterialKind::conductor, 0.1, 1.5, FEAT_ROUGH_CONDUCTOR, MATERIAL_ROUGH_CONDUCTOR);
  expect(MaterialKind::oren_nayar, 0, 1.5, FEAT_OREN_NAYAR, MATERIAL_OREN_NAYAR);
  expect(MaterialKind::plastic, 0, 1.5, FEAT_PLASTIC, MATERIAL_PLASTIC);
  expect(MaterialKind::plastic, 0.1, 1.5, FEAT_ROUGH_PLASTIC, MATERIAL_ROUGH_PLASTIC);
  expect(MaterialKind::thin_dielectric, 0, 1.5, FEAT_THIN_DIELECTRIC, MATERIAL_THIN_DIELECTRIC);
  expect(MaterialKind::dielectric, 0, 1.5, FEAT_DIELECTRIC, MATERIAL_DIELECTRIC);
  expect(MaterialKind::dielectric, 0.1, 1.5, FEAT_ROUGH_DIELECTRIC, MATERIAL_ROUGH_DIELECTRIC);
  // Both sides of the switches to a delta.
  expect(MaterialKind::conductor, 0.99 * ALPHA_DELTA, 1.5, FEAT_CONDUCTOR, MATERIAL_CONDUCTOR);
  expect(MaterialKind::conductor, 1.01 * ALPHA_DELTA, 1.5, FEAT_ROUGH_CONDUCTOR,
         MATERIAL_ROUGH_CONDUCTOR);
  expect(MaterialKind::dielectric, 0.1, 1.0, FEAT_DIELECTRIC, MATERIAL_DIELECTRIC);
}

Material part(MaterialKind kind, double weight) {
  Material m;
  m.kind = kind;
  m.weight = weight;
  return m;
}

/// Parts stand after the scene's own materials, in order, mixes in mixes opened; what has no weight
/// leaves neither code nor data.
TEST(PackMaterials, MixesBecomeListsOfParts) {
  Material inner = part(MaterialKind::mix, 0.75);
  inner.parts = {part(MaterialKind::mirror, 0.5), part(MaterialKind::dielectric, 0.5)};
  Material outer = part(MaterialKind::mix, 1);
  outer.parts = {part(MaterialKind::diffuse, 0.25), inner};
  Material one = outer;
  one.parts[0].weight = 1, one.parts[1].weight = 0;
  Scene scene;
  scene.settings.filter = PixelFilter::box;
  scene.materials = {part(MaterialKind::phong, 1), outer, one};
  const PackedScene s = pack_scene(scene, {8});
  ASSERT_EQ(s.materials.size(), 6u);
  EXPECT_EQ(s.materials[0].weight, 1.0f);
  EXPECT_EQ(s.materials[1].kind, MATERIAL_MIX);
  EXPECT_EQ(s.materials[1].first_part, 3u);
  EXPECT_EQ(s.materials[1].part_count, 3u);
  EXPECT_EQ(s.materials[1].lobes, LOBE_DELTA | LOBE_SPREAD | LOBE_TRANSMIT);
  EXPECT_EQ(s.materials[2].kind, MATERIAL_DIFFUSE);
  const uint kinds[] = {MATERIAL_DIFFUSE, MATERIAL_MIRROR, MATERIAL_DIELECTRIC};
  const float weights[] = {0.25f, 0.375f, 0.375f}, survives[] = {0.5f, 0.5f, 1.0f};
  float survive = 0;
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(s.materials[3 + i].kind, kinds[i]);
    EXPECT_EQ(s.materials[3 + i].weight, weights[i]);
    survive += weights[i] * survives[i];
  }
  EXPECT_EQ(s.materials[1].survive, survive);
  EXPECT_EQ(s.features,
            FeatureSet({FEAT_PHONG, FEAT_DIFFUSE, FEAT_MIRROR, FEAT_DIELECTRIC, FEAT_MIX}));
  scene.materials = {one};
  EXPECT_EQ(pack_scene(scene, {8}).features, FeatureSet({FEAT_DIFFUSE}));
}

TEST(PackFeatures, OneFlagPerKindOfShape) {
  const Material m;
  Shape shape;
  shape.geometry = Disk{};
  EXPECT_EQ(features_of(shape, m), FeatureSet({FEAT_DISKS, FEAT_DIFFUSE}));
  shape.geometry = test::lump(100);
  EXPECT_EQ(features_of(shape, m), FeatureSet({FEAT_TRIANGLES, FEAT_DIFFUSE}));
  shape.sides = 1;
  EXPECT_EQ(features_of(shape, m), FeatureSet({FEAT_TRIANGLES, FEAT_DIFFUSE, FEAT_ONE_SIDED}));
  Mesh smooth = test::lump(100);
  smooth.normals.assign(smooth.positions.size(), glm::vec3(0, 0, 1));
  shape.sides = 2;
  shape.geometry = smooth;
  EXPECT_EQ(features_of(shape, m), FeatureSet({FEAT_TRIANGLES, FEAT_DIFFUSE, FEAT_SMOOTH_NORMALS}));
}

TEST(PackFeatures, GlassIsNeverOneSided) {
  Material m;
  m.kind = MaterialKind::dielectric;
  Shape shape;
  shape.geometry = Sphere{};
  shape.sides = 1;
  EXPECT_EQ(features_of(shape, m), FeatureSet({FEAT_SPHERES, FEAT_DIELECTRIC}));
  Material milk = part(MaterialKind::mix, 1);
  milk.parts = {part(MaterialKind::diffuse, 0.5), part(MaterialKind::thin_dielectric, 0.5)};
  EXPECT_FALSE(features_of(shape, milk).has(FEAT_ONE_SIDED));
  milk.parts[1].kind = MaterialKind::plastic;
  EXPECT_TRUE(features_of(shape, milk).has(FEAT_ONE_SIDED));
}

TEST(PackFeatures, RequestsOfTheUser) {
  EXPECT_EQ(parse_feature_request("auto"), FeatureSet{});
  EXPECT_EQ(parse_feature_request("all"), all_scene_features());
  EXPECT_EQ(parse_feature_request("+phong,+disks"), FeatureSet({FEAT_PHONG, FEAT_DISKS}));
  EXPECT_FALSE(all_scene_features().has(INTG_NEE));
  for (const char* wrong : {"phong", "+fong", "+phong,", "+nee"})
    EXPECT_THROW(parse_feature_request(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace pellucid
