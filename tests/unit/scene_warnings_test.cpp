// Warnings of what makes pictures depend on rounding: lights that lie on a surface, scenes far from
// the origin, and needles.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "scene/coplanar.h"
#include "scene/distance.h"
#include "scene/mesh_tools.h"
#include "scene/needles.h"
#include "scene/thin_glass.h"
#include "scene/thin_shells.h"
#include "scene_test_support.h"

namespace pellucid {
namespace {

Mesh square(double half, double y, bool downwards) {
  Mesh mesh;
  const auto h = float(half), z = float(y);
  mesh.positions = {{-h, z, -h}, {h, z, -h}, {h, z, h}, {-h, z, h}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (!downwards)
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

/// A light of half width 1 at height 1, and another surface.
Scene with(Shape other, bool downwards = true) {
  Scene scene;
  scene.materials.emplace_back();
  Shape light;
  light.name = "panel";
  light.emission = Emission{};
  light.geometry = square(1, 1, downwards);
  other.name = "other";
  scene.shapes = {light, std::move(other)};
  return scene;
}

Shape shape_of(std::variant<Mesh, Sphere, Disk> geometry) {
  Shape shape;
  shape.geometry = std::move(geometry);
  return shape;
}

TEST(SceneWarnings, LightsOnASurfaceAreNamed) {
  for (bool light_down : {true, false})
    for (bool ceiling_down : {true, false}) {
      const std::string text =
          coplanar_warning(with(shape_of(square(5, 1, ceiling_down)), light_down));
      EXPECT_NE(text.find("panel"), std::string::npos);
      EXPECT_NE(text.find("other"), std::string::npos);
    }
  EXPECT_NE(coplanar_warning(with(shape_of(Disk{{0, 1, 0}, {0, 1, 0}, 3, {1, 0, 0}, {0, 0, 1}}))),
            "");
  EXPECT_NE(coplanar_warning(with(shape_of(square(5, 1 + 0x1p-23, true)))), "") << "one ulp";
}

TEST(SceneWarnings, LightsBesideOrOffASurfaceAreNot) {
  EXPECT_EQ(coplanar_warning(with(shape_of(square(5, 1.001, true)))), "") << "clear of it";
  EXPECT_EQ(coplanar_warning(with(shape_of(Sphere{{0, 2, 0}, 1}))), "") << "a sphere touches it";
  Mesh beside = square(1, 1, true);
  for (glm::vec3& p : beside.positions) p.x += 2;
  EXPECT_EQ(coplanar_warning(with(shape_of(beside))), "") << "they share an edge";
  Scene dark = with(shape_of(square(5, 1, true)));
  dark.shapes[0].emission.reset();
  EXPECT_EQ(coplanar_warning(dark), "") << "no light";
}

TEST(SceneWarnings, LampsThatStandOnAFloorAreNot) {
  const BakedMesh box = bake_mesh(make_cube({0, 0.5, 0}, {1, 1, 1}), {}, false);
  Shape floor = shape_of(square(5, 0, false));
  Scene scene = with(std::move(floor));
  scene.shapes[0].geometry = box.mesh;
  EXPECT_EQ(coplanar_warning(scene), "");
}

TEST(SceneWarnings, WhatLiesFarApartIsToldWithItsError) {
  const auto at = [](double distance) {
    Scene scene;
    for (double x : {0.0, distance}) scene.shapes.push_back(shape_of(Sphere{{x, 0, 0}, 1}));
    return distance_warning(scene);
  };
  EXPECT_EQ(at(0), "");
  EXPECT_EQ(at(2e4), "");
  EXPECT_NE(at(2e6).find("6 %"), std::string::npos) << at(2e6);
  EXPECT_EQ(distance_warning(Scene()), "") << "nothing there";
}

TEST(SceneWarnings, FilesInFloatsFarAwayAreTold) {
  const auto at = [](double distance) {
    return rounded_file_warning("box", make_cube({distance, 0, 0}, {1, 1, 1}));
  };
  EXPECT_EQ(at(0), "");
  EXPECT_EQ(at(1e4), "");
  EXPECT_NE(at(1e6).find("6 %"), std::string::npos) << at(1e6);
  EXPECT_EQ(at(1e6 + 0.1), "") << "more digits than floats have";
}

TEST(SceneWarnings, ThinGlassIsMeasured) {
  const auto pane = [](double thickness, MaterialKind kind) {
    Scene scene;
    scene.materials.emplace_back();
    scene.materials[0].kind = kind;
    if (kind == MaterialKind::mix) {
      scene.materials[0].parts.resize(2);
      scene.materials[0].parts[1].kind = MaterialKind::dielectric;
    }
    const BakedMesh box = bake_mesh(make_cube({0, 0, 0}, {4, thickness, 4}), {}, false);
    scene.shapes.push_back(shape_of(box.mesh));
    return thin_glass_warning(scene);
  };
  EXPECT_EQ(pane(1e-4, MaterialKind::dielectric), "");
  EXPECT_NE(pane(1e-6, MaterialKind::dielectric).find("1e-06 thick"), std::string::npos)
      << pane(1e-6, MaterialKind::dielectric);
  EXPECT_EQ(pane(1e-6, MaterialKind::diffuse), "") << "no glass";
  EXPECT_NE(pane(1e-6, MaterialKind::mix), "") << "of glass and paint";
}

Scene balls(const std::vector<std::pair<Sphere, MaterialKind>>& list) {
  Scene scene;
  for (const auto& [sphere, kind] : list) {
    scene.materials.emplace_back().kind = kind;
    scene.shapes.push_back(shape_of(sphere));
    scene.shapes.back().material = int(scene.materials.size() - 1);
    scene.shapes.back().name = "ball " + std::to_string(scene.shapes.size());
  }
  return scene;
}

constexpr auto glass = MaterialKind::dielectric, paint = MaterialKind::diffuse,
               film = MaterialKind::thin_dielectric;

TEST(SceneWarnings, ShellsOfGlassAreMeasured) {
  const auto shell = [](double thickness, const glm::dvec3& off = {}, double x = 0) {
    return thin_shell_warning(balls({{Sphere{{x, 0, 0}, 1}, glass},
                                     {Sphere{glm::dvec3(x, 0, 0) + off, 1 - thickness}, glass}}));
  };
  for (double thickness : {0.5, 1e-2, 1e-5}) EXPECT_EQ(shell(thickness), "") << thickness;
  for (double thickness : {1e-6, 1e-7, 0.0}) EXPECT_NE(shell(thickness), "") << thickness;
  EXPECT_NE(shell(1e-6).find("ball 1"), std::string::npos) << shell(1e-6);
  EXPECT_NE(shell(1e-6).find("1e-06 apart"), std::string::npos) << shell(1e-6);
  EXPECT_NE(shell(1e-6).find("keep them 3.3e-06 apart"), std::string::npos) << shell(1e-6);
  EXPECT_NE(shell(1e-5, {0, 9e-6, 0}), "") << "near on one side";
  EXPECT_NE(shell(0, {0, 1e-5, 0}), "") << "they intersect";
  EXPECT_EQ(shell(1e-2, {1e-3, 0, 0}), "");
  EXPECT_EQ(shell(1e-5, {}, 1), "");
  EXPECT_NE(shell(1e-5, {}, 10), "") << "far from the middle points are less well known";
}

TEST(SceneWarnings, ShellsOfOtherMaterialsAreMeasured) {
  const auto pair = [](MaterialKind outer, MaterialKind inner) {
    return thin_shell_warning(
        balls({{Sphere{{0, 0, 0}, 1}, outer}, {Sphere{{0, 0, 0}, 1 - 1e-7}, inner}}));
  };
  EXPECT_NE(pair(glass, paint), "") << "coated";
  EXPECT_NE(pair(paint, glass), "");
  EXPECT_NE(pair(film, paint), "");
  EXPECT_EQ(pair(paint, paint), "") << "nothing comes between them";
  Scene mixed = balls({{Sphere{{0, 0, 0}, 1}, MaterialKind::mix}, {Sphere{}, paint}});
  EXPECT_EQ(thin_shell_warning(mixed), "");
  mixed.materials[0].parts.resize(2);
  mixed.materials[0].parts[1].kind = glass;
  EXPECT_NE(thin_shell_warning(mixed), "");
}

TEST(SceneWarnings, BallsThatMeetInASpotAreNot) {
  const auto beside = [](const Sphere& other) {
    return thin_shell_warning(balls({{Sphere{{0, 0, 0}, 1}, glass}, {other, glass}}));
  };
  EXPECT_EQ(beside(Sphere{{2, 0, 0}, 1}), "") << "they touch";
  EXPECT_EQ(beside(Sphere{{2 + 1e-7, 0, 0}, 1}), "");
  EXPECT_EQ(beside(Sphere{{1.5, 0, 0}, 1}), "") << "they intersect";
  EXPECT_EQ(beside(Sphere{{5, 0, 0}, 1 - 1e-7}), "") << "far apart";
  EXPECT_EQ(beside(Sphere{{0, -0.1, 0}, 0.9}), "") << "one lies in the other";
  EXPECT_EQ(beside(Sphere{{0, -0.6, 0}, 0.4}), "");
  EXPECT_EQ(beside(Sphere{{0, 1, 0}, 1e-5}), "") << "a drop on it";
}

/// One pair among many is found, whatever the rows that the others stand in.
TEST(SceneWarnings, OneShellAmongManyIsFound) {
  std::vector<std::pair<Sphere, MaterialKind>> list;
  constexpr int side = 20;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z)
        list.emplace_back(Sphere{glm::dvec3(x, y, z) - 0.5 * side, 0.5}, glass);
  EXPECT_EQ(thin_shell_warning(balls(list)), "");
  for (std::size_t i : {std::size_t{0}, list.size() / 2, list.size() - 1}) {
    auto with = list;
    with.emplace_back(Sphere{list[i].first.center, 0.5 + 1e-6}, paint);
    EXPECT_NE(thin_shell_warning(balls(with)), "") << i;
  }
}

TEST(SceneWarnings, FarScenesAreCountedFromTheirMiddle) {
  const test::TempFolder folder;
  const auto load = [&](const std::string& at) {
    return load_scene(folder.write(
        "far.json", R"({"version": 1, "camera": {"origin": [)" + at + R"(, 0, 5], "target": [)" +
                        at + R"(, 0, 0]}, "materials": {"m": {"type": "diffuse"}}, "shapes": [
        {"type": "rectangle", "material": "m", "corner": [)" +
                        at + R"(, 0, 0], "edges": [[2, 0, 0], [0, 2, 0]]},
        {"type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 0.5,
         "transform": [{"translate": [)" +
                        at + R"(, 0, 0]}]}],
        "lights": [{"type": "point", "position": [)" +
                        at + R"(, 0, 1], "intensity": 1}]})"));
  };
  const Scene near = load("100"), far = load("1e7");
  EXPECT_EQ(near.origin, glm::dvec3(0));
  EXPECT_TRUE(near.notes.empty());
  EXPECT_EQ(far.origin, glm::dvec3(1e7, 0, 0)) << "a multiple of 4, the first power of 2 above 2.5";
  ASSERT_EQ(far.notes.size(), 1u);
  EXPECT_TRUE(far.warnings.empty());
  EXPECT_EQ(far.camera.origin, glm::dvec3(0, 0, 5));
  EXPECT_EQ(std::get<Mesh>(far.shapes[0].geometry).positions[0], glm::vec3(0, 0, 0));
  EXPECT_EQ(std::get<Sphere>(far.shapes[1].geometry).center, glm::dvec3(0, 0, 0));
  EXPECT_EQ(std::get<PointLight>(far.lights[0]).position, glm::dvec3(0, 0, 1));
}

// A triangle of which floats would leave nothing, in a file with more digits than these.
TEST(SceneWarnings, FarModelsKeepTheirDigits) {
  const test::TempFolder folder;
  const std::string obj = "v 100000000.25 0 0\nv 100000000.5 0 0\nv 100000000.25 0.25 0\nf 1 2 3\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "100000000.25 0 0\n100000000.5 0 0\n100000000.25 0.25 0\n3 0 1 2\n";
  for (const std::string& file : {folder.write("far.obj", obj), folder.write("far.ply", ply)}) {
    const Scene scene = load_scene(file);
    EXPECT_EQ(scene.origin, glm::dvec3(1e8 + 0.5, 0, 0)) << file;
    const Mesh& mesh = std::get<Mesh>(scene.shapes[0].geometry);
    EXPECT_EQ(mesh.positions[0], glm::vec3(-0.25, 0, 0)) << file;
    EXPECT_EQ(mesh.positions[1], glm::vec3(0, 0, 0)) << file;
    EXPECT_LT(glm::length(scene.camera.origin), 2) << file;
    EXPECT_TRUE(scene.warnings.empty()) << file << scene.warnings[0];
  }
}

TEST(SceneWarnings, NeedlesAreCounted) {
  const auto with_width = [](float width) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, width, 0}, {1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    Scene scene;
    scene.shapes.push_back(shape_of(mesh));
    return needle_warning(scene);
  };
  EXPECT_EQ(with_width(1e-4f), "");
  EXPECT_NE(with_width(1e-5f).find("has 1 triangles"), std::string::npos) << with_width(1e-5f);
}

}  // namespace
}  // namespace pellucid
