// The shipped scenes: they all load, say why they are here, and stand in scenes/README.md.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "scene/schema.h"
#include "scene_test_support.h"

namespace pellucid {
namespace {

namespace fs = std::filesystem;
const std::string scene_folder = PELLUCID_SOURCE_DIR "/scenes";

std::vector<fs::path> shipped() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(scene_folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  return files;
}

std::string readme() {
  std::ostringstream text;
  text << std::ifstream(scene_folder + "/README.md").rdbuf();
  return text.str();
}

TEST(SceneFiles, AllLoadWithoutWarnings) {
  ASSERT_GE(shipped().size(), 20u);
  std::set<std::string> names;
  for (const fs::path& file : shipped()) {
    SCOPED_TRACE(file.string());
    const Scene scene = load_scene(file.string());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_FALSE(scene.shapes.empty());
    EXPECT_GT(scene.description.size(), 40u);
    EXPECT_TRUE(scene.settings.spp);
    EXPECT_TRUE(names.insert(scene.name).second) << "two scenes have this name";
    EXPECT_NE(readme().find("`" + scene.name + "`"), std::string::npos) << "not in the README";
  }
}

TEST(SceneFiles, ReadmeNamesEveryKey) {
  const std::string text = readme();
  for (const ObjectSpec& spec : object_specs())
    for (const Field& field : spec.fields)
      EXPECT_NE(text.find("`" + std::string(field.key) + "`"), std::string::npos)
          << spec.name << "." << field.key;
}

TEST(SceneFiles, CornellBoxIsThePublishedOne) {
  const Scene scene = load_scene(scene_folder + "/gallery/cornell-box.json");
  int lights = 0;
  for (const Shape& shape : scene.shapes) {
    if (!shape.emission) continue;
    ++lights;
    const Mesh& mesh = std::get<Mesh>(shape.geometry);
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 p0 = mesh.positions[t.x];
      EXPECT_LT(glm::cross(mesh.positions[t.y] - p0, mesh.positions[t.z] - p0).y, 0.0f);
    }
    EXPECT_EQ(shape.emission->sides, 1);
    EXPECT_NEAR(shape.emission->radiance.r, 18.387, 1e-5);
  }
  EXPECT_EQ(lights, 1);
  EXPECT_LT(scene.camera.right.x, 0.0) << "the red wall, at large x, is on the left";
}

TEST(SceneFiles, GalleryKnotHasAtLeast200kTriangles) {
  const Scene scene = load_scene(scene_folder + "/gallery/gallery.json");
  std::size_t most = 0;
  for (const Shape& shape : scene.shapes)
    if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry))
      most = std::max(most, mesh->triangles.size());
  EXPECT_GE(most, 200000u);
}

TEST(SceneFiles, FoundByNameOrPath) {
  const std::string path = find_scene("cornell-box", {"/nowhere", scene_folder});
  EXPECT_EQ(path, scene_folder + "/gallery/cornell-box.json");
  EXPECT_EQ(find_scene("cornell-box.json", {scene_folder}), path);
  EXPECT_EQ(find_scene(path, {}), path);
  const std::string message = test::input_error([] { find_scene("cornel-box", {scene_folder}); });
  EXPECT_NE(message.find("Did you mean 'cornell-box'"), std::string::npos) << message;
  EXPECT_NE(message.find("furnace"), std::string::npos) << message;
}

}  // namespace
}  // namespace pellucid
