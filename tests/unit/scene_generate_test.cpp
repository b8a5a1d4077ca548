// Generated meshes: closed where they should be, of the asked size, and the same everywhere.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "scene/generate.h"
#include "scene/noise.h"

namespace pellucid {
namespace {

/// FNV-1a over everything in the mesh.
std::uint64_t hash_mesh(const Mesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](const void* data, std::size_t bytes) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ p[i]) * 0x100000001b3u;
  };
  add(mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
  add(mesh.normals.data(), mesh.normals.size() * sizeof(glm::vec3));
  add(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
  return hash;
}

/// Every edge belongs to exactly two triangles, which run along it in opposite directions.
bool is_watertight(const std::vector<glm::uvec3>& triangles) {
  std::map<std::pair<unsigned, unsigned>, int> edges;
  for (const glm::uvec3& t : triangles)
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1) return false;
  }
  return !triangles.empty();
}

/// Vertices at the same place as one: copies with texture coordinates of their own open no gap.
std::vector<glm::uvec3> welded(const RawMesh& mesh) {
  std::map<std::array<double, 3>, unsigned> places;
  std::vector<glm::uvec3> triangles = mesh.triangles;
  for (glm::uvec3& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3& p = mesh.positions[t[i]];
      t[i] = places.emplace(std::array{p.x, p.y, p.z}, unsigned(places.size())).first->second;
    }
  return triangles;
}

double signed_volume(const RawMesh& mesh) {
  double volume = 0.0;
  for (const glm::uvec3& t : mesh.triangles)
    volume +=
        glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6.0;
  return volume;
}

void expect_count(const RawMesh& mesh, int asked) {
  EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), asked, 0.1 * asked);
}

const int sizes[] = {1000, 1058, 1200, 5000, 33333, 200000};

TEST(SceneGenerate, ClosedShapesAreWatertightAndOutwards) {
  for (int triangles : sizes) {
    SCOPED_TRACE(triangles);
    DisplacedSphere sphere;
    sphere.triangles = triangles;
    const RawMesh lump = generate(sphere);
    EXPECT_TRUE(is_watertight(lump.triangles));
    EXPECT_GT(signed_volume(lump), 3.0);
    expect_count(lump, triangles);
    RawMesh cut = lump;
    cut_seams(cut);
    EXPECT_GT(cut.positions.size(), lump.positions.size());
    EXPECT_TRUE(is_watertight(welded(cut)));

    TorusKnot parameters;
    parameters.triangles = triangles;
    const RawMesh knot = generate(parameters);
    EXPECT_TRUE(is_watertight(knot.triangles));
    EXPECT_GT(signed_volume(knot), 0.5);
    expect_count(knot, triangles);
  }
  const RawMesh cube = make_cube({1, 2, 3}, {1, 2, 4});
  EXPECT_TRUE(is_watertight(welded(cube)));
  EXPECT_NEAR(signed_volume(cube), 8.0, 1e-12);
}

TEST(SceneGenerate, AnglesAreThoseOfTheLibrary) {
  constexpr double two_pi = 6.283185307179586476925;
  const double quarters[4][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(angle_turns(quarters[i][0], quarters[i][1]), 0.25 * i);
  for (int i = 0; i < 100000; ++i) {
    const double y = 2 * hash_unit(1, unsigned(i)) - 1, x = 2 * hash_unit(2, unsigned(i)) - 1;
    const double turns = std::atan2(y, x) / two_pi;
    ASSERT_NEAR(angle_turns(y, x), turns < 0 ? turns + 1 : turns, 4e-16) << y << " " << x;
  }
}

TEST(SceneGenerate, SheetsFaceUpAndHaveTheAskedSize) {
  for (int triangles : sizes) {
    SCOPED_TRACE(triangles);
    WaveSurface wave;
    wave.triangles = triangles;
    wave.size = {4.0, 1.0};
    HeightField ground;
    ground.triangles = triangles;
    for (const RawMesh& mesh : {generate(wave), generate(ground)}) {
      expect_count(mesh, triangles);
      glm::dvec3 low(1e30), high(-1e30);
      for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
      const bool is_wave = high.x > 1.5;
      EXPECT_DOUBLE_EQ(high.x - low.x, is_wave ? 4.0 : 2.0);
      EXPECT_DOUBLE_EQ(high.z - low.z, is_wave ? 1.0 : 2.0);
      EXPECT_LE(high.y, is_wave ? wave.amplitude : ground.height);
      EXPECT_GT(high.y - low.y, 0.02);
      for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 p0 = mesh.positions[t.x];
        ASSERT_GT(glm::cross(mesh.positions[t.y] - p0, mesh.positions[t.z] - p0).y, 0.0);
      }
    }
  }
}

TEST(SceneGenerate, DefaultKnotKeepsClearOfItself) {
  // The tube meets itself if two strands come closer than two radii, or it bends sharper than one.
  TorusKnot thin;
  thin.triangles = 20000;
  thin.tube = 0.001;
  const RawMesh mesh = generate(thin);
  std::vector<glm::dvec3> curve;
  for (int i = 0; i < 600; ++i)
    curve.push_back(mesh.positions[mesh.positions.size() * static_cast<std::size_t>(i) / 600]);
  const double tube = TorusKnot{}.tube;
  const int n = static_cast<int>(curve.size());
  double nearest = 1e30, tightest = 1e30;
  for (int i = 0; i < n; ++i) {
    const glm::dvec3 a = curve[i], b = curve[(i + 10) % n], c = curve[(i + 20) % n];
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    tightest = std::min(tightest, glm::length(b - a) * glm::length(c - b) * glm::length(c - a) /
                                      (4.0 * area));  // radius of the circle through all three
    for (int j = i + 80; j < n && j - i < n - 80; ++j)
      nearest = std::min(nearest, glm::length(curve[i] - curve[j]));
  }
  EXPECT_GT(nearest, 2.0 * tube + 0.01);
  EXPECT_GT(tightest, tube);
}

TEST(SceneGenerate, SmoothNormalsAreUnitAndOutwards) {
  RawMesh mesh = generate(DisplacedSphere{});
  add_smooth_normals(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0, 1e-12);
    ASSERT_GT(glm::dot(mesh.normals[i], mesh.positions[i]), 0.0);
  }
}

TEST(SceneGenerate, SameBitsOnEveryMachine) {
  const auto hash_of = [](RawMesh raw) {
    add_smooth_normals(raw);
    return hash_mesh(bake_mesh(std::move(raw), Affine{}, false).mesh);
  };
  EXPECT_EQ(hash_of(generate(DisplacedSphere{})), 12512542404627930397u);
  EXPECT_EQ(hash_of(generate(TorusKnot{})), 4148920941576005664u);
  EXPECT_EQ(hash_of(generate(WaveSurface{})), 2174576863017217618u);
  EXPECT_EQ(hash_of(generate(HeightField{})), 10077748537511471087u);
}

TEST(SceneGenerate, SeedsDiffer) {
  HeightField a, b;
  b.seed = 1;
  EXPECT_NE(generate(a).positions, generate(b).positions);
}

TEST(SceneGenerate, SineAndCosineByTurns) {
  for (int i = -1000; i <= 1000; ++i) {
    const double turns = i / 360.0;
    const SineCosine value = sin_cos_turns(turns);
    EXPECT_NEAR(value.sin, std::sin(turns * 6.283185307179586), 2e-14) << i;
    EXPECT_NEAR(value.cos, std::cos(turns * 6.283185307179586), 2e-14) << i;
  }
  EXPECT_EQ(sin_cos_turns(0.25).sin, 1.0);
  EXPECT_EQ(sin_cos_turns(0.25).cos, 0.0);
  EXPECT_EQ(sin_cos_turns(0.5).cos, -1.0);
}

}  // namespace
}  // namespace pellucid
