// OBJ and MTL: grouping, normals, materials, and everything tinyobjloader would let pass.
#include <gtest/gtest.h>

#include "scene/obj.h"
#include "scene_test_support.h"

namespace pellucid {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Model load_text_model(const std::string& obj, const std::string& mtl = "",
                      ModelOptions options = {}) {
  const test::TempFolder folder;
  if (!mtl.empty()) folder.write("m.mtl", mtl);
  return load_obj(folder.write("m.obj", obj), options);
}

Model load_bare(const std::string& obj) {
  ModelOptions options;
  options.materials = ModelMaterials::replaced;
  return load_text_model(obj, "", options);
}

/// The one material that an MTL text becomes.
Model load_material(const std::string& mtl) {
  return load_text_model("mtllib m.mtl\n" + square + "usemtl a\nf 1 2 3 4\n", "newmtl a\n" + mtl);
}

TEST(SceneObj, OnePartPerObjectAndMaterial) {
  const Model model = load_text_model(
      "mtllib m.mtl\n" + square +
          "o one\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\no two\nf -4 -3 -2 -1\n",
      "newmtl unused\nKd 1 0 0\nnewmtl a\nKd 0.1 0.2 0.3\nnewmtl b\nKd 0.4 0.4 0.4\nKe 1 2 3\n");
  ASSERT_EQ(model.parts.size(), 3u);
  EXPECT_EQ(model.parts[0].name, "one");
  EXPECT_EQ(model.parts[2].name, "two");
  ASSERT_EQ(model.materials.size(), 2u) << "materials not in use are left out";
  EXPECT_EQ(model.materials[static_cast<std::size_t>(model.parts[0].material)].name, "a");
  EXPECT_EQ(model.materials[static_cast<std::size_t>(model.parts[2].material)].name, "b");
  EXPECT_FALSE(model.parts[0].emission);
  EXPECT_EQ(model.parts[1].emission->radiance, Rgb(1, 2, 3));
  EXPECT_EQ(model.parts[2].mesh.triangles.size(), 2u);
  EXPECT_EQ(model.parts[2].mesh.positions.size(), 4u) << "corners are shared";
  EXPECT_EQ(model.files.size(), 2u);
}

TEST(SceneObj, NormalsAreUsedWhereGiven) {
  const std::string text = square + "vn 0 0 2\nf 1//1 2//1 3//1\nf 1 3 4\n";
  const Model smooth = load_bare(text);
  ASSERT_EQ(smooth.parts[0].mesh.normals.size(), smooth.parts[0].mesh.positions.size());
  for (const glm::dvec3& n : smooth.parts[0].mesh.normals) EXPECT_EQ(n, glm::dvec3(0, 0, 1));
  ModelOptions flat;
  flat.materials = ModelMaterials::replaced;
  flat.use_normals = false;
  EXPECT_TRUE(load_text_model(text, "", flat).parts[0].mesh.normals.empty());
  EXPECT_TRUE(load_bare(square + "f 1 2 3\n").parts[0].mesh.normals.empty());
}

TEST(SceneObj, MaterialsBecomeTheNearestOfOurs) {
  const auto first = [](const std::string& mtl) { return load_material(mtl).materials.at(0); };
  EXPECT_EQ(first("Kd 0.5 0.5 0.5\nillum 2\n").kind, MaterialKind::diffuse);
  EXPECT_EQ(first("Kd 0.5 0.5 0.5\nKs 1 1 1\nNs 9\nillum 1\n").kind, MaterialKind::diffuse);
  EXPECT_EQ(first("Kd 0 0 0\nKs 0.9 0.9 0.9\nillum 3\n").kind, MaterialKind::mirror);
  EXPECT_NEAR(first("Ks 0.9 0.9 0.9\nillum 3\n").reflectance.r, 0.9, 1e-6);
  EXPECT_EQ(first("illum 7\nNi 1.33\n").kind, MaterialKind::dielectric);
  EXPECT_NEAR(first("illum 7\nNi 1.33\n").ior, 1.33, 1e-6);
  EXPECT_EQ(first("d 0.2\n").kind, MaterialKind::dielectric);
  EXPECT_EQ(first("d 0.2\n").ior, 1.5);
  EXPECT_EQ(first("Kd 0.5 0.5 0.5\nTf 1 1 1\n").kind, MaterialKind::diffuse);
  EXPECT_EQ(first("Tf 0.9 0.9 0.9\n").kind, MaterialKind::dielectric);
  const Material glossy = first("Kd 0.8 0.8 0.8\nKs 0.8 0.4 0\nNs 30\nillum 2\n");
  EXPECT_EQ(glossy.kind, MaterialKind::phong);
  EXPECT_EQ(glossy.exponent, 30.0);
  EXPECT_NEAR(glossy.reflectance.r + glossy.specular.r, 1.0, 1e-12);
  EXPECT_NEAR(glossy.specular.g / glossy.specular.r, 0.5, 1e-6);
}

TEST(SceneObj, WhatIsMissingIsListedOncePerKind) {
  const test::TempFolder folder;
  folder.write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Ke a.png\nnewmtl b\nmap_Ke b.png\nbump c.png\n");
  folder.write("m.obj", "mtllib m.mtl\n" + square + "usemtl a\nf 1 2 3 4\nl 1 2\nl 2 3\n");
  const std::string mesh = R"({"type": "mesh", "file": "m.obj"})";
  const Scene scene =
      load_scene(folder.write("s.json", test::scene_with(mesh + "," + mesh, R"({"type":
          "environment", "radiance": 1})")));
  ASSERT_EQ(scene.warnings.size(), 3u);
  EXPECT_NE(scene.warnings[0].find("\"bump\""), std::string::npos);
  EXPECT_NE(scene.warnings[1].find("\"map_Ke\""), std::string::npos);
  EXPECT_NE(scene.warnings[2].find("\"l\""), std::string::npos);
}

TEST(SceneObj, BadFilesSayWhereAndWhy) {
  const struct {
    const char *text, *fragment;
  } cases[] = {
      {"", "no faces"},
      {"v 0 0 0\n", "no faces"},
      {"v 0 0\n", "m.obj:1: \"v\" needs 3 numbers"},
      {"v 0 0 nan\n", "\"nan\" is not a finite number"},
      {"v 0 0 inf\n", "not a finite number"},
      {"v 0 0 0x10\n", "not a finite number"},
      {"v 0 0 1e999\n", "not a finite number"},
      {"v 0 0 1e20\n", "out of range"},
      {"v 0 0 1,5\n", "not a finite number"},
      {"vn 0 0\n", "m.obj:1:"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "m.obj:4: the face asks for vertex 4"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "not a vertex index"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", "asks for vertex -4"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n", "not a vertex index"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n", "asks for normal 1"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n", "asks for texture coordinate 1"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2/ 3/\n", "not a texture coordinate index"},
      {"v 0 0 0\nv 1 0 0\nf 1 2\n", "at least three corners"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n", "join them"},
  };
  for (const auto& bad : cases) {
    const std::string message = test::input_error([&] { load_bare(bad.text); });
    EXPECT_NE(message.find(bad.fragment), std::string::npos) << bad.text << "\ngot: " << message;
  }
}

TEST(SceneObj, MaterialErrorsNameTheRemedy) {
  const auto error = [](const std::string& obj, const std::string& mtl) {
    return test::input_error([&] { load_text_model(obj, mtl); });
  };
  const std::string face = "usemtl a\nf 1 2 3\n";
  EXPECT_NE(error("mtllib gone.mtl\n" + square + face, "").find("gone.mtl' does not exist"),
            std::string::npos);
  EXPECT_NE(error("mtllib gone.mtl\n" + square + face, "").find("give the shape a \"material\""),
            std::string::npos);
  EXPECT_NE(error(square + "f 1 2 3\n", "").find("m.obj:5: the face has no material"),
            std::string::npos);
  EXPECT_NE(error(square + face, "").find("no mtllib"), std::string::npos);
  EXPECT_NE(error("mtllib m.mtl\n" + square + "usemtl grean\nf 1 2 3\n", "newmtl green\n")
                .find("Did you mean 'green'"),
            std::string::npos);
  EXPECT_NE(error("mtllib m.mtl\n" + square + face, "newmtl a\nKd 1 x 0\n").find("m.mtl:2:"),
            std::string::npos);
  EXPECT_NE(error("mtllib m.mtl\n" + square + face, "newmtl a\nKd -1 0 0\n").find("negative"),
            std::string::npos);
}

TEST(SceneObj, TrianglesWithoutAreaAreDroppedAndCounted) {
  const test::TempFolder folder;
  folder.write("m.obj", square + "f 1 2 3\nf 1 1 2\nf 1 2 2\nf 1 3 4\n");
  const Scene scene = load_scene(folder.write(
      "s.json", test::scene_with(R"({"type": "mesh", "file": "m.obj", "material": "m"})",
                                 R"({"type": "environment", "radiance": 1})")));
  EXPECT_EQ(std::get<Mesh>(scene.shapes[0].geometry).triangles.size(), 2u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("2 triangles without area"), std::string::npos);
}

TEST(SceneObj, ErrorsInModelsPointAtTheSceneToo) {
  const test::TempFolder folder;
  const std::string message = test::input_error([&] {
    load_scene(folder.write("s.json", test::scene_with(R"({"type": "mesh", "file": "x.obj"})")));
  });
  EXPECT_NE(message.find("s.json:3:"), std::string::npos) << message;
  EXPECT_NE(message.find("x.obj' does not exist"), std::string::npos) << message;
}

TEST(SceneObj, TruncationNeverCrashes) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1.5 1e0 0\nvt 0 0\nvn 0 0 1\ng a\ns off\nf 1/1/1 2/1/1 3/1/1\n";
  for (std::size_t length = 0; length <= text.size(); ++length)
    test::input_error([&] { load_bare(text.substr(0, length)); });
}

}  // namespace
}  // namespace pellucid
