// Bare models: the camera sees all of them whatever their size and the picture's, and they are lit.
#include <gtest/gtest.h>

#include <cmath>

#include "scene_test_support.h"

namespace pellucid {
namespace {

/// A slanted box as OBJ, twice as wide as high, at an offset of many times its size.
std::string box(double scale, const std::string& before_faces = "") {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const double x = (i & 1) * 2.0 + 0.3 * ((i >> 1) & 1) + 7, y = ((i >> 1) & 1) - 5.0, z = i >> 2;
    char line[100];
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", x * scale, y * scale, z * scale);
    text += line;
  }
  return text + before_faces + "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";
}

Scene load_model(const std::string& text, const LoadOptions& options = {},
                 const std::string& name = "m.obj") {
  const test::TempFolder folder;
  return load_scene(folder.write(name, text), options);
}

/// How far the mesh reaches into the picture: 1 is its edge. Fails for points behind the camera.
glm::dvec2 reach(const Scene& scene) {
  const Camera& c = scene.camera;
  const double width = scene.settings.width, height = scene.settings.height;
  const bool along_x =
      c.fov_axis == FovAxis::x || (c.fov_axis == FovAxis::smaller && width <= height);
  const double tan_fov = std::tan(c.fov * 3.14159265358979323846 / 360);
  const double tan_x = along_x ? tan_fov : tan_fov * width / height;
  glm::dvec2 most{0.0};
  for (const glm::vec3& p : std::get<Mesh>(scene.shapes.at(0).geometry).positions) {
    const glm::dvec3 d = glm::dvec3(p) - c.origin;
    const double z = glm::dot(d, c.forward);
    EXPECT_GT(z, 0.0);
    most = glm::max(most, glm::abs(glm::dvec2(glm::dot(d, c.right) / (z * tan_x),
                                              glm::dot(d, c.up) / (z * tan_x * height / width))));
  }
  return most;
}

TEST(SceneBare, TheWholeModelIsInThePictureWithASmallMargin) {
  const std::vector<std::pair<int, int>> sizes = {{512, 512}, {1920, 800}, {100, 900},
                                                  {32768, 1}, {1, 32768},  {7, 5}};
  for (const double scale : {1e-9, 1e-3, 1.0, 1e5, 1e9})
    for (const auto& size : sizes) {
      SCOPED_TRACE(std::to_string(scale) + " " + std::to_string(size.first) + "x" +
                   std::to_string(size.second));
      LoadOptions options;
      options.size = size;
      const glm::dvec2 most = reach(load_model(box(scale), options));
      // The tighter side is filled to the stated 92 %; positions in float leave some 1e-6.
      EXPECT_NEAR(std::max(most.x, most.y), 0.92, 1e-4);
    }
}

TEST(SceneBare, FieldOfViewAndUpFollowOverrides) {
  for (const char* fov : {"camera.fov=5", "camera.fov=100", "camera.fovAxis=x"}) {
    const glm::dvec2 most = reach(load_model(box(1), {{fov}, {}}));
    EXPECT_NEAR(std::max(most.x, most.y), 0.92, 1e-4) << fov;
  }
  const Scene y_up = load_model(box(1)), z_up = load_model(box(1), {{"camera.up=[0, 0, 1]"}, {}});
  EXPECT_GT(y_up.camera.up.y, 0.9);
  EXPECT_LT(y_up.camera.forward.z, -0.5) << "seen from the front, +z";
  EXPECT_LT(y_up.camera.forward.y, -0.2) << "and from above";
  EXPECT_GT(z_up.camera.up.z, 0.9);
  EXPECT_GT(z_up.camera.forward.y, 0.5);
  const Scene own = load_model(box(1), {{"camera.origin=[90, 80, 70]"}, {}});
  EXPECT_EQ(own.camera.origin, glm::dvec3(90, 80, 70));
}

TEST(SceneBare, AnOpenModelIsLookedInto) {
  const std::string text = box(1);
  const std::size_t back = text.find("f 1 3 4 2\n");  // the side at z = 0
  std::string open = text;
  open.erase(back, std::string("f 1 3 4 2\n").size());
  for (std::size_t at = 0; (at = open.find("f ", at)) != std::string::npos; at += 2) {
    std::string corners = open.substr(at + 2, 7);  // fronts inwards
    std::swap(corners[2], corners[6]);
    open.replace(at + 2, 7, corners);
  }
  EXPECT_GT(load_model(open).camera.forward.z, 0.5);
}

TEST(SceneBare, DarkModelsAreLitAndBothAreTold) {
  const Scene dark = load_model(box(1));
  ASSERT_EQ(dark.lights.size(), 2u);
  const auto& light = std::get<DirectionalLight>(dark.lights[0]);
  EXPECT_GT(glm::dot(light.direction, dark.camera.forward), 0.5) << "a headlight";
  // A grey face towards the light is well exposed: between 40 % and 60 % of white.
  const double facing =
      (light.irradiance.x + 3.14159265 * std::get<ConstantEnvironment>(dark.lights[1]).radiance.x) *
      0.5 / 3.14159265;
  EXPECT_GT(facing, 0.4);
  EXPECT_LT(facing, 0.6);
  ASSERT_EQ(dark.notes.size(), 2u);
  EXPECT_NE(dark.notes[0].find("camera at ["), std::string::npos);
  EXPECT_NE(dark.notes[1].find("directional light of irradiance 2.4"), std::string::npos);
  EXPECT_TRUE(dark.warnings.empty());
  EXPECT_EQ(load_model(box(1), {{"lights.0={\"type\": \"environment\", \"radiance\": 1}"}, {}})
                .lights.size(),
            1u);
  EXPECT_TRUE(load_model(box(1), {{"lights=[]"}, {}}).lights.empty())
      << "asked for in so many words";
  EXPECT_EQ(load_model(box(1), {{"shapes.0.emission.radiance=3"}, {}}).lights.size(), 0u);
}

TEST(SceneBare, FacesWithoutMaterialAreGrey) {
  const Scene plain = load_model(box(1));
  EXPECT_EQ(plain.materials.at(0).reflectance, Rgb(0.5));
  EXPECT_TRUE(plain.warnings.empty());
  const Scene missing = load_model(box(1, "mtllib gone.mtl\nusemtl a\n"));
  ASSERT_EQ(missing.warnings.size(), 2u);
  EXPECT_NE(missing.warnings[0].find("gone.mtl"), std::string::npos);
  EXPECT_EQ(missing.materials.at(std::size_t(missing.shapes.at(0).material)).name, "grey");
  const Scene gold =
      load_model(box(1), {{"materials.grey={\"type\": \"conductor\", \"metal\": \"gold\"}"}, {}});
  EXPECT_EQ(gold.materials.at(0).kind, MaterialKind::conductor);
  EXPECT_EQ(load_model(box(1), {{"film.width=64", "integrator.spp=3"}, {}}).settings.spp, 3);
}

TEST(SceneBare, ErrorsNameTheModel) {
  EXPECT_NE(test::input_error([] { load_model("v 0 0 0\nf 1 2 3\n"); }).find("m.obj:2:"),
            std::string::npos);
  EXPECT_NE(
      test::input_error([] { load_scene("/none/bunny.ply"); }).find("bunny.ply' does not exist"),
      std::string::npos);
  const std::string message = test::input_error([] {
    load_model(box(1), {{"camera.fov=-1"}, {}});
  });
  EXPECT_EQ(message.rfind("-D camera.fov=-1: ", 0), 0u) << message;
}

}  // namespace
}  // namespace pellucid
