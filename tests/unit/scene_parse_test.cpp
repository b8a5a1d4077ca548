// The native scene format: what it accepts, and how it refuses.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "scene/reader.h"
#include "scene_test_support.h"

namespace pellucid {
namespace {

using test::load_error;
using test::load_text;
using test::scene_with;

constexpr double pi = 3.14159265358979323846;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

TEST(SceneParse, SmallestSceneHasStatedDefaults) {
  const Scene scene =
      load_text(R"({"version": 1, "camera": {"origin": [0, 0, 5], "target": [0, 0, 0]}})");
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.settings.width, 512);
  EXPECT_EQ(scene.settings.height, 512);
  EXPECT_FALSE(scene.settings.spp || scene.settings.max_depth || scene.settings.integrator);
  EXPECT_EQ(scene.camera.fov, 45.0);
  EXPECT_EQ(scene.camera.fov_axis, FovAxis::x);
  expect_near(scene.camera.right, {1, 0, 0}, 0);
  expect_near(scene.camera.up, {0, 1, 0}, 0);
  expect_near(scene.camera.forward, {0, 0, -1}, 0);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("black"), std::string::npos);
  EXPECT_EQ(scene.files.size(), 1u);
}

TEST(SceneParse, CommentsByteOrderMarkAndSettings) {
  const Scene scene = load_text(
      "\xEF\xBB\xBF// head\n{\"version\": 1 /* one */, \"description\": \"why\",\n"
      "\"film\": {\"width\": 3, \"height\": 7}, // size\n"
      "\"integrator\": {\"name\": \"nee\", \"spp\": 9, \"maxDepth\": 4},\n"
      "\"camera\": {\"origin\": [0,0,0], \"target\": [0,0,1], \"fov\": 30, \"fovAxis\": "
      "\"larger\"}}");
  EXPECT_EQ(scene.description, "why");
  EXPECT_EQ(scene.settings.width, 3);
  EXPECT_EQ(scene.settings.height, 7);
  EXPECT_EQ(*scene.settings.integrator, "nee");
  EXPECT_EQ(*scene.settings.spp, 9);
  EXPECT_EQ(*scene.settings.max_depth, 4);
  EXPECT_EQ(scene.camera.fov_axis, FovAxis::larger);
}

TEST(SceneParse, Materials) {
  const Scene scene = load_text(scene_with("", "", R"(
      "srgb": {"type": "diffuse", "reflectance": {"srgb": [1, 0.5, 0]}},
      "grey": {"type": "mirror", "reflectance": 0.25},
      "glass": {"type": "dielectric", "ior": 1.33, "roughness": 0.5},
      "gold": {"type": "conductor", "metal": "gold", "alpha": 0.1},
      "own": {"type": "conductor", "eta": [1, 2, 3], "k": 4},
      "phong": {"type": "phong", "diffuse": 0.3, "specular": 0.7, "exponent": 90})"));
  ASSERT_EQ(scene.materials.size(), 7u);
  const auto& m = scene.materials;
  EXPECT_EQ(m[1].kind, MaterialKind::diffuse);
  expect_near(m[1].reflectance, {1.0, 0.21404114, 0.0}, 1e-7);
  EXPECT_EQ(m[2].kind, MaterialKind::mirror);
  expect_near(m[2].reflectance, Rgb(0.25), 0);
  EXPECT_EQ(m[3].kind, MaterialKind::dielectric);
  EXPECT_EQ(m[3].ior, 1.33);
  EXPECT_EQ(m[3].alpha, 0.25);
  EXPECT_EQ(m[4].kind, MaterialKind::conductor);
  EXPECT_EQ(m[4].alpha, 0.1);
  expect_near(m[4].k, {3.983160, 2.385721, 1.603215}, 0);
  expect_near(m[5].eta, {1, 2, 3}, 0);
  expect_near(m[5].k, Rgb(4.0), 0);
  EXPECT_EQ(m[5].alpha, 0.0);
  EXPECT_EQ(m[6].kind, MaterialKind::phong);
  EXPECT_EQ(m[6].exponent, 90.0);
}

TEST(SceneParse, Lights) {
  const Scene scene = load_text(scene_with("", R"(
      {"type": "point", "position": [1, 2, 3], "power": 12.566370614359172},
      {"type": "point", "position": [1, 2, 3], "intensity": [1, 2, 3]},
      {"type": "directional", "direction": [0, 0, -7], "irradiance": 2},
      {"type": "environment", "radiance": 0.5},
      {"type": "point", "position": [0, 0, 0], "intensity": 0})"));
  ASSERT_EQ(scene.lights.size(), 4u) << "a light of no power cannot be picked";
  expect_near(std::get<PointLight>(scene.lights[0]).intensity, Rgb(1.0), 1e-12);
  expect_near(std::get<PointLight>(scene.lights[1]).intensity, {1, 2, 3}, 0);
  expect_near(std::get<DirectionalLight>(scene.lights[2]).direction, {0, 0, -1}, 0);
  expect_near(std::get<ConstantEnvironment>(scene.lights[3]).radiance, Rgb(0.5), 0);
  EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(SceneParse, Shapes) {
  const Scene scene = load_text(scene_with(R"(
      {"type": "sphere", "name": "ball", "material": "m", "center": [1, 2, 3], "radius": 4},
      {"type": "disk", "material": "m", "normal": [0, 0, 3], "flip": true,
       "emission": {"radiance": [1, 2, 3], "sides": 2}},
      {"type": "rectangle", "material": "m", "corner": [0, 0, 0], "edges": [[2, 0, 0], [0, 3, 0]]},
      {"type": "rectangle", "material": "m", "center": [0, 0, 1], "size": [2, 4], "sides": 1},
      {"type": "cube", "material": "m", "size": [1, 2, 3]},
      {"type": "displaced-sphere", "material": "m", "triangles": 1000},
      {"type": "torus-knot", "material": "m", "triangles": 1000, "smooth": false},
      {"type": "wave-surface", "material": "m", "triangles": 1000},
      {"type": "height-field", "material": "m", "triangles": 1000, "seed": 5})"));
  ASSERT_EQ(scene.shapes.size(), 9u);
  const auto& s = scene.shapes;
  EXPECT_EQ(s[0].name, "ball");
  EXPECT_EQ(s[0].sides, 2);
  EXPECT_FALSE(s[0].emission);
  EXPECT_EQ(std::get<Sphere>(s[0].geometry).radius, 4.0);
  expect_near(std::get<Disk>(s[1].geometry).normal, {0, 0, -1}, 0);
  EXPECT_EQ(s[1].emission->sides, 2);
  EXPECT_EQ(std::get<Mesh>(s[2].geometry).triangles.size(), 2u);
  EXPECT_EQ(s[3].sides, 1);
  EXPECT_EQ(std::get<Mesh>(s[3].geometry).positions[0], glm::vec3(-1, -2, 1));
  EXPECT_EQ(std::get<Mesh>(s[4].geometry).triangles.size(), 12u);
  EXPECT_EQ(std::get<Mesh>(s[5].geometry).normals.size(),
            std::get<Mesh>(s[5].geometry).positions.size());
  EXPECT_TRUE(std::get<Mesh>(s[6].geometry).normals.empty());
}

TEST(SceneParse, FourBallsCameraHasThePublishedCornerRays) {
  const Scene scene = load_scene(PELLUCID_SOURCE_DIR "/scenes/gallery/four-balls-sun.json");
  const Camera& c = scene.camera;
  const double t = std::tan(c.fov * pi / 360.0);
  const auto ray = [&](double x, double y) {
    return glm::normalize(c.forward + t * (x * c.right + y * c.up));
  };
  expect_near(ray(-1, 1), {-0.35132, 0.88341, 0.31010}, 2e-5);
  expect_near(ray(1, 1), {0.36347, 0.87848, 0.31010}, 2e-5);
  expect_near(ray(-1, -1), {-0.35159, 0.84466, -0.40366}, 2e-5);
  expect_near(ray(1, -1), {0.36321, 0.83973, -0.40366}, 2e-5);
}

struct BadInput {
  const char* what;
  std::string text;
  std::vector<std::string> fragments;  ///< all must be in the message
};

std::string sphere_with(const std::string& keys) {
  return scene_with("{\"type\": \"sphere\", \"material\": \"m\", " + keys + "}");
}
std::string material_with(const std::string& text) {
  return scene_with("", "", "\"x\": " + text);
}

const std::vector<BadInput> bad_inputs = {
    {"empty file", "", {"scene.json:1:1", "unexpected end of input"}},
    {"not JSON", "hello", {"scene.json:1:", "not valid JSON"}},
    {"not an object", "[1]", {"an object is needed here, not a list"}},
    {"no version", R"({"camera": {"origin": [0,0,1], "target": [0,0,0]}})", {"\"version\""}},
    {"other version", R"({"version": 2})", {"version", "out of range"}},
    {"no camera", R"({"version": 1})", {"\"camera\""}},
    {"misspelt key", R"({"version": 1, "camara": {}})", {"1:16", "Did you mean 'camera'"}},
    {"key of later versions", R"({"version": 1, "textures": {}})", {"unknown key \"textures\""}},
    {"duplicated key", "{\"version\": 1,\n \"version\": 1}", {"2:2", "given twice"}},
    {"wrong type",
     sphere_with(R"("radius": "big")"),
     {"shapes[0].radius", "a number is needed here, not a text"}},
    {"negative radius",
     sphere_with(R"("radius": -1)"),
     {"scene.json:3:", "shapes[0].radius", "-1 is out of range"}},
    {"huge radius", sphere_with(R"("radius": 1e200)"), {"out of range"}},
    {"overflow", sphere_with(R"("radius": 1e999)"), {"number overflow"}},
    {"NaN", sphere_with(R"("radius": NaN)"), {"not valid JSON"}},
    {"null", sphere_with(R"("radius": null)"), {"not null"}},
    {"short vector", sphere_with(R"("center": [1, 2])"), {"a list of 3 numbers", "a list of 2"}},
    {"mixed vector", sphere_with(R"("center": [1, 2, "x"])"), {"shapes[0].center[2]"}},
    {"no material", scene_with(R"({"type": "sphere"})"), {"\"material\""}},
    {"unknown material",
     scene_with(R"({"type": "sphere", "material": "n"})"),
     {"no material \"n\"", "\"m\""}},
    {"unknown shape",
     scene_with(R"({"type": "spher", "material": "m"})"),
     {"Did you mean 'sphere'", "\"torus-knot\""}},
    {"no type", scene_with(R"({"material": "m"})"), {"needs the key \"type\""}},
    {"type not text", scene_with(R"({"type": 3})"), {"shapes[0].type", "a text is needed"}},
    {"shape not object", scene_with("3"), {"shapes[0]", "an object is needed"}},
    {"flipped sphere", sphere_with(R"("flip": true)"), {"unknown key \"flip\""}},
    {"sides", sphere_with(R"("sides": 3)"), {"at least 1 and at most 2"}},
    {"fraction", sphere_with(R"("sides": 1.5)"), {"a whole number"}},
    {"dark emission",
     sphere_with(R"("emission": {"radiance": -1})"),
     {"shapes[0].emission.radiance", "out of range"}},
    {"emission key", sphere_with(R"("emission": {"radience": 1})"), {"Did you mean 'radiance'"}},
    {"stretched sphere",
     sphere_with(R"("transform": [{"scale": [1, 2, 1]}])"),
     {"uniform scale", "displaced-sphere"}},
    {"sphere scaled away",
     sphere_with(R"("transform": [{"scale": 1e11}, {"scale": 1e11}])"),
     {"shapes[0].transform", "a radius of 1e+22", "lengths lie between 1e-11 and 1e+11"}},
    {"sphere scaled to nothing",
     sphere_with(R"("transform": [{"scale": 1e-30}])"),
     {"shapes[0].transform", "a radius of 1e-30"}},
    {"disk moved away",
     scene_with(R"({"type": "disk", "material": "m", "transform": [{"translate": [1e11, 0, 0]},
                    {"translate": [1e11, 0, 0]}]})"),
     {"shapes[0].transform", "a center at 2e+11 0 0"}},
    {"zero in a text", sphere_with(R"("name": "a\u0000b")"), {"shapes[0].name", "zero character"}},
    {"text after a zero byte", scene_with("") + std::string(1, '\0') + "{", {"a zero byte"}},
    {"flat scale", sphere_with(R"("transform": [{"scale": [1, 0, 1]}])"), {"flattens space"}},
    {"two steps in one",
     sphere_with(R"("transform": [{"scale": 2, "translate": [0, 0, 0]}])"),
     {"not both"}},
    {"empty step", sphere_with(R"("transform": [{}])"), {"needs one of the keys", "\"matrix\""}},
    {"zero axis",
     sphere_with(R"("transform": [{"rotate": {"axis": [0, 0, 0], "degrees": 1}}])"),
     {"an axis must not be zero"}},
    {"projective matrix",
     sphere_with(R"("transform": [{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]}])"),
     {"the last four numbers"}},
    {"rectangle forms",
     scene_with(R"({"type": "rectangle", "material": "m", "corner": [0,0,0], "size": [1,1]})"),
     {"goes with \"center\""}},
    {"one edge",
     scene_with(R"({"type": "rectangle", "material": "m", "corner": [0,0,0], "edges": [[1,0,0]]})"),
     {"two edges"}},
    {"no area",
     scene_with(R"({"type": "rectangle", "material": "m", "corner": [0,0,0],
                   "edges": [[1,0,0],[2,0,0]]})"),
     {"no triangle with an area"}},
    {"far away",
     scene_with(R"({"type": "cube", "material": "m", "transform": [{"scale": 1e9},
                   {"scale": 1e9}]})"),
     {"beyond coordinates"}},
    {"too few triangles",
     scene_with(R"({"type": "torus-knot", "material": "m", "triangles": 10})"),
     {"at least 1000"}},
    {"too many triangles",
     scene_with(R"({"type": "torus-knot", "material": "m", "triangles": 1e9})"),
     {"10000000"}},
    {"no knot",
     scene_with(R"({"type": "torus-knot", "material": "m", "triangles": 1000, "p": 2, "q": 4})"),
     {"common divisor"}},
    {"reflectance over 1",
     material_with(R"({"type": "diffuse", "reflectance": [0, 1.1, 0]})"),
     {"materials.x.reflectance[1]", "at most 1"}},
    {"srgb over 1",
     material_with(R"({"type": "diffuse", "reflectance": {"srgb": [0, 0, 255]}})"),
     {"srgb[2]"}},
    {"colour object",
     material_with(R"({"type": "diffuse", "reflectance": {"rgb": [0, 0, 0]}})"),
     {"\"srgb\""}},
    {"colour text",
     material_with(R"({"type": "diffuse", "reflectance": "red"})"),
     {"a colour is needed"}},
    {"both widths",
     material_with(R"({"type": "dielectric", "roughness": 0.1, "alpha": 0.1})"),
     {"not both"}},
    {"unknown metal",
     material_with(R"({"type": "conductor", "metal": "golt"})"),
     {"Did you mean 'gold'"}},
    {"no metal", material_with(R"({"type": "conductor"})"), {"\"metal\" or \"eta\""}},
    {"eta alone", material_with(R"({"type": "conductor", "eta": 1})"), {"needs \"k\""}},
    {"metal and k",
     material_with(R"({"type": "conductor", "metal": "gold", "k": 1})"),
     {"not both"}},
    {"bright phong",
     material_with(R"({"type": "phong", "diffuse": 0.5, "specular": 0.6})"),
     {"must be at most 1"}},
    {"point light",
     scene_with("", R"({"type": "point", "position": [0, 0, 0]})"),
     {"\"intensity\" or \"power\""}},
    {"two skies",
     scene_with("", R"({"type": "environment", "radiance": 1},
                         {"type": "environment", "radiance": 1})"),
     {"at most one environment", "lights[0]"}},
    {"zero direction",
     scene_with("", R"({"type": "directional", "direction": [0, 0, 0], "irradiance": 1})"),
     {"must not be zero"}},
    {"camera in its target",
     R"({"version": 1, "camera": {"origin": [1,1,1], "target": [1,1,1]}})",
     {"camera.target", "same point"}},
    {"up along the view",
     R"({"version": 1, "camera": {"origin": [0,9,0], "target": [0,0,0]}})",
     {"up points along"}},
    {"fov",
     R"({"version": 1, "camera": {"origin": [0,9,0], "target": [0,0,0], "fov": 180}})",
     {"camera.fov"}},
    {"fov axis",
     R"({"version": 1, "camera": {"origin": [0,9,1], "target": [0,0,0], "fovAxis": "z"}})",
     {"\"smaller\" or \"larger\""}},
    {"absurd film",
     R"({"version": 1, "camera": {"origin": [0,9,1], "target": [0,0,0]},
           "film": {"width": 32768, "height": 32768}})",
     {"too many"}},
    {"no film",
     R"({"version": 1, "camera": {"origin": [0,9,1], "target": [0,0,0]},
           "film": {"width": 0}})",
     {"film.width"}},
    {"deep nesting", std::string(100000, '['), {"nested deeper"}},
    {"text after the end", R"({"version": 1} x)", {"not valid JSON"}},
    {"broken UTF-8", "{\"version\": 1, \"\xff\": 1}", {"not valid JSON"}},
};

TEST(SceneParse, BadInputsSayWhereAndWhy) {
  for (const BadInput& bad : bad_inputs) {
    SCOPED_TRACE(bad.what);
    const std::string message = load_error(bad.text);
    ASSERT_FALSE(message.empty()) << "was accepted: " << bad.text;
    EXPECT_NE(message.find("scene.json:"), std::string::npos) << message;
    EXPECT_NE(message.find('^'), std::string::npos) << message;
    for (const std::string& fragment : bad.fragments)
      EXPECT_NE(message.find(fragment), std::string::npos)
          << "wanted: " << fragment << "\ngot: " << message;
  }
}

TEST(SceneParse, ErrorsPointAtThePlace) {
  const std::string message = load_error("{\"version\": 1,\n  // note\n  \"camera\": 7}");
  EXPECT_NE(message.find("scene.json:3:13: camera: an object is needed here, not a number\n"
                         "    3 |   \"camera\": 7}\n"
                         "      |             ^"),
            std::string::npos)
      << message;
}

TEST(SceneParse, LongLinesAreShownAroundThePlace) {
  const std::string message =
      load_error("{" + std::string(500, ' ') + "\"versoin\": 1" + std::string(500, ' ') + "}");
  EXPECT_NE(message.find("\"versoin\": 1"), std::string::npos);
  EXPECT_LT(message.size(), 600u);
}

TEST(SceneParse, TruncationNeverCrashesAndNeverPasses) {
  const std::string text = scene_with(
      R"({"type": "sphere", "material": "m" /* c */, "transform": [{"rotate": {"axis": [0, 1, 0],
      "degrees": -12.5e0}}]})",
      R"({"type": "environment", "radiance": {"srgb": [1, 1, 1]}})");
  ASSERT_EQ(load_error(text), "");
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_NE(load_error(text.substr(0, length)), "") << "length " << length;
}

TEST(SceneParse, FileErrorsNameTheFile) {
  const test::TempFolder folder;
  folder.write("scene.json", "{}");
  using test::input_error;
  EXPECT_NE(input_error([&] {
              load_scene(folder.path() + "/scen.json");
            }).find("Did you mean 'scene.json'"),
            std::string::npos);
  EXPECT_NE(input_error([&] { load_scene(folder.path()); }).find("is a folder"), std::string::npos);
  EXPECT_NE(input_error([&] { load_scene("/dev/zero"); }).find("a device"), std::string::npos);
}

TEST(SceneParse, EveryDefaultOfTheTablesIsValid) {
  for (const ObjectSpec& spec : object_specs())
    for (const Field& field : spec.fields) {
      SCOPED_TRACE(spec.name + "." + field.key);
      EXPECT_STRNE(field.doc, "");
      if (field.fallback == required || *field.fallback == '\0') continue;
      const ObjectSpec single{spec.name, spec.doc, {field}};
      const std::string text = std::string("{\"") + field.key + "\": " + field.fallback + "}";
      const JsonNode node = parse_json("default", text);
      EXPECT_NO_THROW(ObjectReader(node, single));
    }
}

}  // namespace
}  // namespace pellucid
