// Materials that are made of others: mixes, "principled", MTL's PBR extension; spots; and emission
// from everything that has a surface.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/principled.h"
#include "scene_test_support.h"

namespace pellucid {
namespace {

using test::load_error;
using test::load_text;
using test::scene_with;

constexpr double pi = 3.14159265358979323846;

Material material_of(const std::string& text) {
  const Scene scene = load_text(scene_with("", "", "\"x\": " + text));
  return scene.materials.at(1);
}

TEST(SceneMaterials, SimpleKindsAndTheirDefaults) {
  const Material clay = material_of(R"({"type": "oren-nayar"})");
  EXPECT_EQ(clay.kind, MaterialKind::oren_nayar);
  EXPECT_EQ(clay.roughness, 0.5);
  EXPECT_EQ(clay.reflectance, Rgb(0.5));
  const Material toy = material_of(R"({"type": "plastic", "reflectance": 0.25, "ior": 1.4})");
  EXPECT_EQ(toy.kind, MaterialKind::plastic);
  EXPECT_EQ(toy.ior, 1.4);
  EXPECT_EQ(toy.alpha, 0.0);
  EXPECT_EQ(material_of(R"({"type": "plastic", "roughness": 0.5})").alpha, 0.25);
  const Material pane = material_of(R"({"type": "thin-dielectric", "ior": 1.25})");
  EXPECT_EQ(pane.kind, MaterialKind::thin_dielectric);
  EXPECT_EQ(pane.ior, 1.25);
}

TEST(SceneMaterials, MixesMayNameWhatComesLater) {
  const Scene scene = load_text(scene_with("", "", R"(
      "outer": {"type": "mix", "materials": ["inner", "m"], "amount": 0.25},
      "inner": {"type": "mix", "materials": ["shine", "m"]},
      "shine": {"type": "mirror"})"));
  ASSERT_EQ(scene.materials.size(), 4u);
  const Material& outer = scene.materials[1];
  EXPECT_EQ(outer.name, "outer");
  EXPECT_EQ(outer.kind, MaterialKind::mix);
  ASSERT_EQ(outer.parts.size(), 2u);
  EXPECT_EQ(outer.parts[0].weight, 0.75);
  EXPECT_EQ(outer.parts[1].weight, 0.25);
  EXPECT_EQ(outer.parts[1].name, "m");
  ASSERT_EQ(outer.parts[0].parts.size(), 2u);
  EXPECT_EQ(outer.parts[0].parts[0].kind, MaterialKind::mirror);
  EXPECT_EQ(outer.parts[0].parts[1].weight, 0.5);
  EXPECT_EQ(scene.materials[3].name, "shine");
  EXPECT_EQ(scene.materials[3].weight, 1.0);
}

TEST(SceneMaterials, BadMixesSayWhereAndWhy) {
  const auto error = [](const std::string& materials) {
    return load_error(scene_with("", "", materials));
  };
  const auto mix = [](const std::string& a, const std::string& b) {
    return R"({"type": "mix", "materials": [")" + a + R"(", ")" + b + R"("]})";
  };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(error("\"a\": " + mix("m", "a")), "materials.a.materials[1]: the mix \"a\" would contain");
  has(error("\"a\": " + mix("b", "m") + ", \"b\": " + mix("m", "a")),
      "materials.b.materials[1]: the mix \"a\" would contain itself");
  has(error("\"a\": " + mix("m", "n")), "there is no material \"n\"");
  has(error(R"("a": {"type": "mix", "materials": ["m"]})"), "two names");
  has(error(R"("a": {"type": "mix", "materials": ["m", 3]})"), "a text is needed");
  has(error(R"("a": {"type": "mix"})"), "needs the key \"materials\"");
  has(error(R"("a": {"type": "mix", "materials": ["m", "m"], "amount": 1.5})"), "out of range");
  // Every level doubles the parts; a long chain only adds to them, but would recurse.
  std::string doubling = "\"l0\": " + mix("m", "m"), chain = "\"c0\": " + mix("m", "m");
  for (int i = 1; i < 100; ++i) {
    const std::string before = std::to_string(i - 1), here = std::to_string(i);
    doubling += ", \"l" + here + "\": " + mix("l" + before, "l" + before);
    chain = "\"c" + here + "\": " + mix("m", "c" + before) + ", " + chain;
  }
  has(error(doubling), "at most 64 parts");
  has(error(chain), "at most 64 parts");
}

TEST(SceneMaterials, PrincipledIsAMix) {
  const Material plain = material_of(R"({"type": "principled", "baseColor": [0.1, 0.2, 0.3]})");
  EXPECT_EQ(plain.kind, MaterialKind::plastic);
  EXPECT_EQ(plain.alpha, 0.25);
  EXPECT_EQ(plain.reflectance, Rgb(0.1, 0.2, 0.3));
  const Material metal =
      material_of(R"({"type": "principled", "metallic": 1, "baseColor": 0.5, "roughness": 0.1})");
  EXPECT_EQ(metal.kind, MaterialKind::conductor);
  EXPECT_NEAR(metal.alpha, 0.01, 1e-15);
  const Material glass = material_of(R"({"type": "principled", "transmission": 1, "ior": 1.33})");
  EXPECT_EQ(glass.kind, MaterialKind::dielectric);
  EXPECT_EQ(glass.ior, 1.33);
  const Material all = material_of(R"({"type": "principled", "metallic": 0.25,
      "transmission": 0.5})");
  ASSERT_EQ(all.kind, MaterialKind::mix);
  EXPECT_EQ(all.parts[1].kind, MaterialKind::conductor);
  EXPECT_EQ(all.parts[1].weight, 0.25);
  EXPECT_EQ(all.parts[0].weight, 0.75);
  EXPECT_EQ(all.parts[0].parts[1].kind, MaterialKind::dielectric);
}

TEST(SceneMaterials, MetalOfAColorReflectsIt) {
  Rgb eta, k;
  metal_of_color({0.0, 0.5, 0.95}, eta, k);
  const Rgb r = ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k);
  EXPECT_NEAR(r.x, 0.0, 1e-12);
  EXPECT_NEAR(r.y, 0.5, 1e-12);
  EXPECT_NEAR(r.z, 0.95, 1e-12);
  metal_of_color(Rgb(1.0), eta, k);
  EXPECT_EQ(k, Rgb(100.0));
}

/// A scene of one square with this MTL material.
Scene with_mtl(const std::string& mtl) {
  const test::TempFolder folder;
  folder.write("m.mtl", "newmtl plain\nKd 1 1 1\nnewmtl a\n" + mtl);
  folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n");
  return load_scene(
      folder.write("s.json", scene_with(R"({"type": "mesh", "file": "m.obj"})",
                                        R"({"type": "environment", "radiance": 1})")));
}

TEST(SceneMaterials, MtlsPbrExtensionIsPrincipled) {
  const auto first = [](const std::string& mtl) { return with_mtl(mtl).materials.at(1); };
  const Material paint = first("Kd 0.25 0.5 0.75\nPr 0.5\nNi 1.4\nKs 1 1 1\nNs 20\nillum 2\n");
  EXPECT_EQ(paint.kind, MaterialKind::plastic);
  EXPECT_EQ(paint.name, "a");
  EXPECT_EQ(paint.alpha, 0.25);
  EXPECT_NEAR(paint.ior, 1.4, 1e-6);
  EXPECT_EQ(first("Kd 0.5 0.5 0.5\nPm 1\nPr 0.3\nillum 3\n").kind, MaterialKind::conductor);
  EXPECT_EQ(first("Kd 0.5 0.5 0.5\nPr 0\n").kind, MaterialKind::plastic);
  const Material mix = first("Kd 0.5 0.5 0.5\nPm 0.25\nPr 0.5\n");
  ASSERT_EQ(mix.kind, MaterialKind::mix);
  EXPECT_EQ(mix.parts[1].weight, 0.25);
  EXPECT_EQ(first("Kd 1 1 1\nPr 0.5\nd 0.5\n").kind, MaterialKind::dielectric);
  EXPECT_EQ(first("Kd 1 1 1\nPr 0.5\nd 0.5\n").alpha, 0.25);
  EXPECT_EQ(first("Kd 0.5 0.5 0.5\nillum 2\n").kind, MaterialKind::diffuse);
  EXPECT_EQ(with_mtl("Kd 1 1 1\nPr 0.5\nKe 3 2 1\n").shapes.at(0).emission->radiance, Rgb(3, 2, 1));
  const Scene wrong = with_mtl("Kd 2 1 1\nPr 1.5\nPm 0.5\n");
  ASSERT_EQ(wrong.warnings.size(), 2u);
  EXPECT_NE(wrong.warnings[1].find("Pr was scaled down to at most 1"), std::string::npos);
}

TEST(SceneMaterials, WhatPbrFilesAskForInVainIsListed) {
  const std::string zeros = "Kd 1 1 1\nPr 0.5\nPs 0\nPc 0\nPcr 0.03\naniso 0\nanisor 0\n";
  EXPECT_TRUE(with_mtl(zeros).warnings.empty());
  const Scene scene = with_mtl(
      "Kd 1 1 1\nPr 0.5\nPs 0.1\nPc 0.1\nPcr 0.1\naniso 0.5\nanisor 0.2\nnorm n.png\n"
      "map_Ke e.png\nmap_Pr r.png\n");
  const char* const kinds[] = {"\"Pc\"",     "\"Ps\"",     "\"aniso\"",
                               "\"map_Ke\"", "\"map_Pr\"", "\"norm\""};
  ASSERT_EQ(scene.warnings.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NE(scene.warnings[i].find(kinds[i]), std::string::npos) << scene.warnings[i];
}

TEST(SceneMaterials, Spots) {
  const Scene scene = load_text(scene_with("", R"(
      {"type": "spot", "position": [1, 2, 3], "target": [1, 0, 3], "intensity": 4},
      {"type": "spot", "position": [0, 0, 0], "direction": [0, 0, 5], "power": 10, "angle": 90,
       "falloff": 1},
      {"type": "spot", "position": [0, 0, 0], "direction": [0, 0, 5], "power": 12.5663706143592,
       "angle": 360, "falloff": 0})"));
  const auto spot = [&](std::size_t i) { return std::get<SpotLight>(scene.lights.at(i)); };
  EXPECT_EQ(spot(0).direction, glm::dvec3(0, -1, 0));
  EXPECT_EQ(spot(0).intensity, Rgb(4.0));
  EXPECT_NEAR(spot(0).outer, 30 * pi / 180, 1e-12);
  EXPECT_NEAR(spot(0).inner, 24 * pi / 180, 1e-12);
  EXPECT_EQ(spot(1).inner, 0.0);
  EXPECT_NEAR(spot(1).intensity.x * 2 * pi * (1 - 0.5 * (1 + std::cos(pi / 4))), 10, 1e-9);
  EXPECT_NEAR(spot(2).intensity.x, 1.0, 1e-12) << "a full sphere is a point light";
  const std::string place = R"({"type": "spot", "position": [0, 0, 0], )";
  EXPECT_NE(load_error(scene_with("", place + R"("intensity": 1})")).find("\"target\""),
            std::string::npos);
  EXPECT_NE(load_error(scene_with("", place + R"("intensity": 1, "target": [0, 0, 0]})"))
                .find("same point"),
            std::string::npos);
  EXPECT_NE(load_error(scene_with("", place + R"("direction": [0, 0, 0], "intensity": 1})"))
                .find("must not be zero"),
            std::string::npos);
}

/// Spheres, disks, rectangles, cubes, generated meshes and OBJ files all shine, whatever they are
/// made of.
TEST(SceneMaterials, EverythingCanEmit) {
  const test::TempFolder folder;
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  const char* const kinds[] = {R"("sphere")",
                               R"("disk")",
                               R"("cube")",
                               R"("rectangle", "center": [0, 0, 0], "size": [1, 1])",
                               R"("displaced-sphere", "triangles": 1000)",
                               R"("torus-knot", "triangles": 1000)",
                               R"("wave-surface", "triangles": 1000)",
                               R"("height-field", "triangles": 1000)",
                               R"("mesh", "file": "m.obj")"};
  for (const char* kind : kinds)
    for (const char* material : {"coat", "mixed", "glass"}) {
      const std::string shape = std::string("{\"type\": ") + kind + ", \"material\": \"" +
                                material + R"(", "emission": {"radiance": 2, "sides": 2}})";
      const Scene scene =
          load_scene(folder.write("s.json", scene_with(shape, "", R"("coat": {"type": "plastic"},
              "glass": {"type": "thin-dielectric"},
              "mixed": {"type": "mix", "materials": ["coat", "glass"]})")));
      ASSERT_EQ(scene.shapes.size(), 1u) << kind;
      ASSERT_TRUE(scene.shapes[0].emission) << kind;
      EXPECT_EQ(scene.shapes[0].emission->radiance, Rgb(2.0));
      EXPECT_TRUE(scene.warnings.empty());
    }
}

}  // namespace
}  // namespace pellucid
