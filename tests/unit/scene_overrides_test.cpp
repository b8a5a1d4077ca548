// Overrides of the command line: what they set, what they add, and errors that name the option.
#include <gtest/gtest.h>

#include "scene_test_support.h"

namespace pellucid {
namespace {

Scene load_with(std::vector<std::string> overrides) {
  const test::TempFolder folder;
  const std::string shapes = R"({"type": "sphere", "material": "m"})";
  return load_scene(folder.write("s.json", test::scene_with(shapes)), {std::move(overrides), {}});
}

std::string error_of(const std::string& definition) {
  return test::input_error([&] { load_with({definition}); });
}

TEST(SceneOverrides, SetValuesByEitherKindOfPath) {
  EXPECT_EQ(load_with({"camera.fov=30"}).camera.fov, 30.0);
  EXPECT_EQ(load_with({"/camera/fov=30"}).camera.fov, 30.0);
  EXPECT_EQ(load_with({"camera.fov=30", "camera.fov=20"}).camera.fov, 20.0) << "the last one wins";
  EXPECT_EQ(load_with({"/film/width=64"}).settings.width, 64);
  EXPECT_EQ(load_with({"camera.origin=[0, 0, 9]"}).camera.origin.z, 9.0);
  EXPECT_EQ(load_with({"description=a = b, \"c\""}).description, "a = b, \"c\"");
  EXPECT_EQ(load_with({"description=\"12\""}).description, "12");
  EXPECT_EQ(load_with({"integrator.name=nee"}).settings.integrator, "nee");
  const auto radius = [](const Scene& s) { return std::get<Sphere>(s.shapes[0].geometry).radius; };
  EXPECT_EQ(radius(load_with({"shapes.0.radius=2"})), 2.0);
  EXPECT_EQ(radius(load_with({"shapes[0].radius=2"})), 2.0);
  EXPECT_EQ(radius(load_with({"/shapes/0/radius=2"})), 2.0);
}

TEST(SceneOverrides, AddWhatIsMissing) {
  const Scene named = load_with({"/materials/a~1b~0.c/type=mirror", "shapes.0.material=a/b~.c"});
  EXPECT_EQ(named.materials.at(1).name, "a/b~.c");
  EXPECT_EQ(named.shapes[0].material, 1);
  const std::string sphere = R"({"type": "sphere", "material": "m"})";
  EXPECT_EQ(load_with({"shapes.1=" + sphere, "shapes.-=" + sphere}).shapes.size(), 3u);
  EXPECT_EQ(load_with({"lights.0.type=environment", "lights.0.radiance=1"}).lights.size(), 1u);
  EXPECT_EQ(load_with({"shapes.0.transform.-.scale=3"}).shapes.size(), 1u);
  EXPECT_TRUE(load_with({"shapes=[]"}).shapes.empty());
}

TEST(SceneOverrides, ErrorsNameTheOption) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"camera.fov=1000", "camera.fov: 1000 is out of range"},
      {"camera.fov=wide", "a number is needed here, not a text"},
      {"camera.origin=[1, 2", "not valid JSON"},
      {"camra.fov=3", "Did you mean 'camera'?"},
      {"camera.fob=3", "Did you mean 'fov'?"},
      {"shapes.0.material=n", "there is no material \"n\""},
      {"materials.mm.reflectance=1", "materials.mm: a material needs the key \"type\""},
      {"version.x=3", "nothing in it can be called \"x\""},
      {"shapes.9.radius=1", "no item \"9\""},
      {"shapes.x.radius=1", "no item \"x\""},
      {"film=3", "an object is needed here"},
      {"film.width=1e999", "a number is needed"},
      {"description=", "must not be empty"},
  };
  for (const auto& [definition, part] : cases) {
    const std::string message = error_of(definition);
    EXPECT_EQ(message.rfind("-D " + definition + ": ", 0), 0u) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.find(" | "), std::string::npos) << "no line of the file: " << message;
  }
  const std::string near = error_of("materials.floor2.reflectance=1");
  EXPECT_EQ(near.find("Did you mean"), std::string::npos) << near;
}

TEST(SceneOverrides, MissingNamesSuggestNearOnes) {
  const test::TempFolder folder;
  const std::string path =
      folder.write("s.json", test::scene_with("", "", R"("copper": {"type": "mirror"})"));
  const std::string message = test::input_error([&] {
    load_scene(path, {{"materials.coper.reflectance=0.5"}, {}});
  });
  EXPECT_NE(message.find("Did you mean 'copper'?"), std::string::npos) << message;
}

TEST(SceneOverrides, OtherFormsAreUsageErrors) {
  const std::string deep = "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=1";
  for (const std::string& text : {std::string("camera.fov"), std::string("=3"), std::string("/=3"),
                                  std::string("a..b=3"), std::string("/a~2=3"), deep})
    EXPECT_THROW(load_with({text}), UsageError) << text;
}

TEST(SceneOverrides, AreKeptForTheHash) {
  const Scene scene = load_with({"camera.fov=30"});
  EXPECT_EQ(scene.overrides, std::vector<std::string>{"camera.fov=30"});
  ASSERT_EQ(scene.files.size(), 1u);
  EXPECT_EQ(scene.files[0].hash.size(), 32u);
}

}  // namespace
}  // namespace pellucid
