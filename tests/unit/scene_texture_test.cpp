// Textures of scene and MTL files: what they become, colour spaces, and everything that is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/image.h"
#include "image/tonemap.h"
#include "scene/generate.h"
#include "scene/obj.h"
#include "scene_test_support.h"

namespace pellucid {
namespace {

using test::TempFolder;

/// Writes a picture from its top row; the type of file goes by the suffix.
std::string write_picture(const TempFolder& folder, const std::string& name, int width, int height,
                          const std::vector<std::string>& channels, std::vector<float> values) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = channels;
  image.data = std::move(values);
  const std::string path = folder.path() + "/" + name;
  write_image(path, image);
  return path;
}

const std::vector<std::string> rgb{"R", "G", "B"};

/// A scene whose floor has this "texture" object.
std::string scene_text(const std::string& texture,
                       const std::string& shape = R"({"type": "rectangle", "material": "t",
                         "center": [0, 0, 0], "size": [1, 1]})") {
  return test::scene_with(shape, R"({"type": "environment", "radiance": 1})",
                          R"("t": {"type": "diffuse", "texture": )" + texture + "}");
}

Scene load_textured(const TempFolder& folder, const std::string& texture) {
  return load_scene(folder.write("scene.json", scene_text(texture)));
}

std::string texture_error(const TempFolder& folder, const std::string& texture) {
  return test::input_error([&] { load_textured(folder, texture); });
}

void expect_part(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(SceneTexture, RowsAreTurnedSoThatTheBottomComesFirst) {
  const TempFolder folder;
  write_picture(folder, "a.exr", 2, 2, rgb, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5f, 0.25f, 0.125f});
  const Scene scene = load_textured(folder, R"({"file": "a.exr"})");
  ASSERT_EQ(scene.images.size(), 1u);
  const TextureImage& image = scene.images[0];
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 2);
  ASSERT_EQ(image.texels.size(), 4u);
  EXPECT_EQ(image.texels[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(image.texels[1], glm::vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(image.texels[2], glm::vec3(1, 0, 0));
  const Texture& texture = scene.textures.at(0);
  EXPECT_EQ(texture.wrap, TextureWrap::repeat);
  EXPECT_FALSE(texture.nearest);
  EXPECT_EQ(texture.scale, glm::dvec2(1));
  EXPECT_EQ(texture.offset, glm::dvec2(0));
  EXPECT_EQ(std::get<Mesh>(scene.shapes[0].geometry).uvs.size(), 4u);
  EXPECT_EQ(scene.files.size(), 2u) << "the image is part of the scene's identity";
  EXPECT_EQ(scene.files[1].path, folder.path() + "/a.exr");
}

TEST(SceneTexture, AllKeys) {
  const TempFolder folder;
  write_picture(folder, "a.exr", 1, 1, rgb, {1, 1, 1});
  const Scene scene = load_textured(folder, R"({"file": "a.exr", "wrap": "mirror",
      "filter": "nearest", "colorSpace": "linear", "scale": [2, -3], "offset": [0.5, 7]})");
  const Texture& texture = scene.textures.at(0);
  EXPECT_EQ(texture.wrap, TextureWrap::mirror);
  EXPECT_TRUE(texture.nearest);
  EXPECT_EQ(texture.scale, glm::dvec2(2, -3));
  EXPECT_EQ(texture.offset, glm::dvec2(0.5, 7));
  EXPECT_EQ(load_textured(folder, R"({"file": "a.exr", "wrap": "clamp"})").textures[0].wrap,
            TextureWrap::clamp);
}

TEST(SceneTexture, ColourSpaces) {
  const TempFolder folder;
  // 8 bits: 0, 51, 128 and 255 of 255 in a file that holds display values.
  write_picture(folder, "a.png", 4, 1, {"Y"}, {0.0f, 0.2f, 128 / 255.0f, 1.0f});
  write_picture(folder, "a.exr", 1, 1, rgb, {0.5f, 0.5f, 0.5f});
  const auto texel = [&](const std::string& texture, std::size_t i) {
    return load_textured(folder, texture).images[0].texels[i];
  };
  const double expected[] = {0, std::pow((0.2 + 0.055) / 1.055, 2.4),
                             std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1};
  for (const char* file : {R"({"file": "a.png"})", R"({"file": "a.png", "colorSpace": "srgb"})"})
    for (std::size_t i = 0; i < 4; ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(texel(file, i)[c], expected[i], 1e-6) << file << " " << i;
  EXPECT_EQ(texel(R"({"file": "a.png"})", 3), glm::vec3(1.0f)) << "white is exactly 1";
  EXPECT_NEAR(texel(R"({"file": "a.png", "colorSpace": "linear"})", 1).x, 0.2, 1e-7);
  EXPECT_EQ(texel(R"({"file": "a.exr"})", 0), glm::vec3(0.5f)) << "floats are linear";
  EXPECT_NEAR(texel(R"({"file": "a.exr", "colorSpace": "srgb"})", 0).x, srgb_decode(0.5f), 1e-7);
}

TEST(SceneTexture, ColoursAreFoundAmongAllChannels) {
  const TempFolder folder;
  write_picture(folder, "a.exr", 1, 1, {"A", "B", "G", "R", "Z"}, {0.1f, 0.2f, 0.3f, 0.4f, 99});
  EXPECT_EQ(load_textured(folder, R"({"file": "a.exr"})").images[0].texels[0],
            glm::vec3(0.4f, 0.3f, 0.2f));
  // Alpha does not darken.
  write_picture(folder, "a.png", 1, 1, {"R", "G", "B", "A"}, {1, 1, 1, 0.25f});
  EXPECT_EQ(load_textured(folder, R"({"file": "a.png"})").images[0].texels[0], glm::vec3(1));
}

TEST(SceneTexture, AnImageIsReadOnce) {
  const TempFolder folder;
  write_picture(folder, "a.exr", 1, 1, rgb, {1, 1, 1});
  const std::string text = test::scene_with("", "", R"(
      "a": {"type": "diffuse", "texture": {"file": "a.exr"}},
      "b": {"type": "mirror", "texture": {"file": "./a.exr", "scale": [2, 2]}},
      "c": {"type": "phong", "texture": {"file": "a.exr", "colorSpace": "linear"}})");
  const Scene scene = load_scene(folder.write("s.json", text));
  EXPECT_EQ(scene.textures.size(), 3u);
  EXPECT_EQ(scene.images.size(), 2u) << "one for each colour space";
  EXPECT_EQ(scene.textures[0].image, scene.textures[1].image);
  EXPECT_EQ(*scene.materials[3].texture, 2);
  EXPECT_FALSE(scene.materials[0].texture);
}

TEST(SceneTexture, BadTexturesSayWhereAndWhy) {
  const TempFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = 1.0f / 0.0f;
  write_picture(folder, "good.exr", 1, 1, rgb, {1, 1, 1});
  expect_part(texture_error(folder, R"({"file": "god.exr"})"), "scene.json:");
  expect_part(texture_error(folder, R"({"file": "god.exr"})"), "Did you mean 'good.exr'");
  expect_part(texture_error(folder, R"({"file": "."})"), "is a folder");
  folder.write("text.png", "no picture");
  expect_part(texture_error(folder, R"({"file": "text.png"})"), "cannot read image");
  folder.write("empty.png", "");
  expect_part(texture_error(folder, R"({"file": "empty.png"})"), "the file is empty");
  for (const float value : {nan, inf, -inf, -0.5f, 1.5f}) {
    write_picture(folder, "bad.exr", 2, 2, rgb, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, value, 1});
    const std::string message = texture_error(folder, R"({"file": "bad.exr"})");
    expect_part(message, "channel g of its texel (1, 1), counted from the top left");
    expect_part(message, "scale the image");
  }
  expect_part(texture_error(folder, R"({"file": "good.exr", "wrap": "tile"})"), "\"repeat\"");
  expect_part(texture_error(folder, R"({"file": "good.exr", "scale": 2})"), "2 numbers");
  expect_part(texture_error(folder, R"({"path": "good.exr"})"), "\"file\"");
  expect_part(texture_error(folder, R"("good.exr")"), "an object is needed");
}

// A header that claims 70000 x 70000 pixels is refused before memory is asked for.
TEST(SceneTexture, TooManyTexelsAreRefusedUnread) {
  const TempFolder folder;
  std::string text = "P6\n70000 70000\n255\n";
  folder.write("huge.ppm", text + std::string(100, 'x'));
  expect_part(texture_error(folder, R"({"file": "huge.ppm"})"),
              "70000 x 70000 pixels are too many");
}

// ---- where pictures lie on shapes

const Mesh& mesh_of(const Scene& scene) {
  return std::get<Mesh>(scene.shapes.at(0).geometry);
}

Scene load_shape(const std::string& shape) {
  const TempFolder folder;
  write_picture(folder, "a.exr", 1, 1, rgb, {1, 1, 1});
  return load_scene(folder.write("s.json", scene_text(R"({"file": "a.exr"})", shape)));
}

TEST(SceneTexture, UntexturedShapesKeepNoCoordinates) {
  const Scene scene = test::load_text(test::scene_with(
      R"({"type": "rectangle", "material": "m", "center": [0, 0, 0], "size": [1, 1]},
         {"type": "torus-knot", "material": "m", "triangles": 1000})"));
  for (const Shape& shape : scene.shapes) EXPECT_TRUE(std::get<Mesh>(shape.geometry).uvs.empty());
}

/// u and v grow to the right and upwards as seen from the front: text is not mirrored.
void expect_not_mirrored(const Mesh& mesh) {
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec2 a = mesh.uvs[t.x], b = mesh.uvs[t.y], c = mesh.uvs[t.z];
    const glm::dvec2 e = b - a, f = c - a;
    ASSERT_GT(e.x * f.y - e.y * f.x, 0.0) << t.x << " " << t.y << " " << t.z;
  }
}

TEST(SceneTexture, RectanglesAndCubes) {
  const Scene rectangle = load_shape(R"({"type": "rectangle", "material": "t",
      "corner": [1, 2, 3], "edges": [[4, 0, 0], [0, 5, 0]]})");
  const Mesh& mesh = mesh_of(rectangle);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(glm::vec3(mesh.uvs[i], 0),
              (mesh.positions[i] - glm::vec3(1, 2, 3)) / glm::vec3(4, 5, 1));
  const Scene cube = load_shape(R"({"type": "cube", "material": "t", "size": 2})");
  expect_not_mirrored(mesh_of(cube));
  EXPECT_EQ(mesh_of(cube).triangles.size(), 12u);
  for (std::size_t i = 0; i < mesh_of(cube).positions.size(); ++i) {
    const glm::vec3 p = mesh_of(cube).positions[i];
    const bool side = i < 8 || i >= 16;  // -x, +x, (-y, +y,) -z, +z
    if (side) {
      EXPECT_EQ(mesh_of(cube).uvs[i].y, (p.y + 1) / 2) << "upright";
    }
  }
}

TEST(SceneTexture, GeneratedMeshesAreCutAtTheirSeams) {
  for (const char* shape :
       {R"({"type": "displaced-sphere", "material": "t", "triangles": 2000, "amplitude": 0})",
        R"({"type": "torus-knot", "material": "t", "triangles": 2000})",
        R"({"type": "wave-surface", "material": "t", "triangles": 2000})",
        R"({"type": "height-field", "material": "t", "triangles": 2000})"}) {
    SCOPED_TRACE(shape);
    const Scene scene = load_shape(shape);
    const Mesh& mesh = mesh_of(scene);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    expect_not_mirrored(mesh);
    for (const glm::uvec3& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const glm::vec2 uv = mesh.uvs[t[i]], next = mesh.uvs[t[(i + 1) % 3]];
        ASSERT_TRUE(uv.x >= 0 && uv.x <= 1.25 && uv.y >= 0 && uv.y <= 1) << uv.x << " " << uv.y;
        ASSERT_LT(std::abs(uv.x - next.x), 0.25f + 1e-6f);
        ASSERT_LT(std::abs(uv.y - next.y), 0.25f);
      }
  }
}

// A sphere of triangles shows a picture where an exact one does, and has no crease at its seam.
TEST(SceneTexture, DisplacedSphereAgreesWithTheExactSphere) {
  const Scene scene = load_shape(
      R"({"type": "displaced-sphere", "material": "t", "triangles": 2000, "amplitude": 0})");
  const Mesh& mesh = mesh_of(scene);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 n = mesh.normals[i], p = mesh.positions[i];
    ASSERT_GT(glm::dot(n, p), 0.998) << "normals were averaged before the cut";
    const double v = 0.5 + std::asin(p.y) / 3.14159265358979323846;
    ASSERT_NEAR(mesh.uvs[i].y, v, 1e-4);
    if (std::abs(p.y) > 0.9999) continue;
    double u = 0.5 + std::atan2(p.x, p.z) / 6.28318530717958647693 - mesh.uvs[i].x;
    ASSERT_NEAR(u - std::round(u), 0.0, 1e-6);
  }
}

TEST(SceneTexture, ExactShapesAreTurnedWithTheirPicture) {
  const Scene ball = load_shape(R"({"type": "sphere", "material": "t", "transform":
      [{"scale": [-2, 2, 2]}, {"rotate": {"axis": [0, 1, 0], "degrees": 90}}]})");
  const Sphere& sphere = std::get<Sphere>(ball.shapes[0].geometry);
  EXPECT_NEAR(glm::length(sphere.axes[0] - glm::dvec3(0, 0, 1)), 0, 1e-12) << "mirrored, turned";
  EXPECT_NEAR(glm::length(sphere.axes[1] - glm::dvec3(0, 1, 0)), 0, 1e-12);
  EXPECT_NEAR(glm::length(sphere.axes[2] - glm::dvec3(1, 0, 0)), 0, 1e-12);
  const auto disk = [](const std::string& rest) {
    return std::get<Disk>(
        load_shape(R"({"type": "disk", "material": "t", )" + rest + "}").shapes[0].geometry);
  };
  EXPECT_EQ(disk(R"("radius": 1)").u_axis, glm::dvec3(1, 0, 0));
  EXPECT_EQ(disk(R"("radius": 1)").v_axis, glm::dvec3(0, 1, 0));
  EXPECT_EQ(disk(R"("normal": [5, 0, 0])").u_axis, glm::dvec3(0, 0, -1)) << "upright";
  EXPECT_EQ(disk(R"("normal": [5, 0, 0])").v_axis, glm::dvec3(0, 1, 0));
  EXPECT_EQ(disk(R"("normal": [0, 5, 0])").v_axis, glm::dvec3(0, 0, -1)) << "a floor";
}

// ---- OBJ and MTL

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

struct Loaded {
  Scene scene;
  std::string error;
};

/// Loads a square with this MTL text; images/a.exr lies beside it.
Loaded load_mtl(const std::string& mtl, const std::string& faces = "f 1/1 2/2 3/3 4/4\n") {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() + "/images");
  write_picture(folder, "images/a.exr", 1, 1, rgb, {0.5f, 0.5f, 0.5f});
  folder.write("images/m.mtl", "newmtl a\n" + mtl);
  folder.write("m.obj", "mtllib images/m.mtl\n" + square + "usemtl a\n" + faces);
  Loaded loaded;
  loaded.error = test::input_error([&] {
    loaded.scene = load_scene(
        folder.write("s.json", test::scene_with(R"({"type": "mesh", "file": "m.obj"})",
                                                R"({"type": "environment", "radiance": 1})")));
  });
  return loaded;
}

TEST(SceneTexture, MapKdMultipliesKd) {
  const Loaded l = load_mtl("Kd 0.25 0.5 1\nmap_Kd a.exr\n");
  EXPECT_EQ(l.error, "");
  EXPECT_TRUE(l.scene.warnings.empty());
  const Material& m = l.scene.materials.back();
  ASSERT_TRUE(m.texture);
  EXPECT_EQ(m.reflectance, Rgb(0.25, 0.5, 1));
  const Mesh& mesh = mesh_of(l.scene);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(mesh.uvs[i], glm::vec2(mesh.positions[i]));
  EXPECT_EQ(load_mtl("map_Kd a.exr\n").scene.materials.back().reflectance, Rgb(1))
      << "without Kd the picture alone";
  EXPECT_TRUE(
      load_mtl("Kd .5 .5 .5\nKs .5 .5 .5\nNs 9\nmap_Kd a.exr\n").scene.materials.back().texture)
      << "Phong's diffuse part";
}

TEST(SceneTexture, MapKdOptions) {
  const auto texture = [](const std::string& line) {
    const Loaded l = load_mtl("Kd 1 1 1\nmap_Kd " + line + "\n");
    EXPECT_EQ(l.error, "");
    return l.scene.textures.at(0);
  };
  EXPECT_EQ(texture("-s 2 3 1 a.exr").scale, glm::dvec2(2, 3));
  EXPECT_EQ(texture("-s 2 3 a.exr").scale, glm::dvec2(2, 3));
  EXPECT_EQ(texture("-s 2 a.exr").scale, glm::dvec2(2, 1));
  EXPECT_EQ(texture("-o .25 -1 0 -s 4 4 4 a.exr").offset, glm::dvec2(0.25, -1));
  EXPECT_EQ(texture("-clamp on a.exr").wrap, TextureWrap::clamp);
  EXPECT_EQ(texture("-clamp off a.exr").wrap, TextureWrap::repeat);
  EXPECT_EQ(texture("..\\images\\a.exr").scale, glm::dvec2(1)) << "backslashes";
  const Loaded other = load_mtl(
      "Kd 1 1 1\nmap_Kd -mm 0 2 -blendu off a.exr\nmap_Kd -mm 0 1 a.exr\n"
      "map_Ke a.exr\nbump a.exr\n");
  ASSERT_EQ(other.scene.warnings.size(), 4u) << "each once";
  expect_part(other.scene.warnings[1], "map_Kd -blendu");
  expect_part(other.scene.warnings[2], "map_Kd -mm");
  expect_part(other.scene.warnings[3], "map_Ke");
}

TEST(SceneTexture, MapKdErrorsSayWhereAndWhy) {
  const auto error = [](const std::string& line) {
    return load_mtl("Kd 1 1 1\nmap_Kd " + line + "\n").error;
  };
  expect_part(error("b.exr"), "m.mtl:3: ");
  expect_part(error("b.exr"), "s.json:");
  expect_part(error("b.exr"), "Did you mean 'a.exr'");
  expect_part(error(""), "m.mtl:3: map_Kd needs the name of a file");
  expect_part(error("-s 2 2 2"), "needs the name of a file");
  expect_part(error("-s a.exr"), "not a finite number");
  expect_part(error("-clamp a.exr"), "\"on\" or \"off\"");
  expect_part(error("-magic a.exr"), "no option \"-magic\"");
  expect_part(load_mtl("map_Kd a.exr\n", "vt 0 x\nf 1/1 2/2 3/3\n").error, "not a finite number");
}

TEST(SceneTexture, FacesWithoutCoordinatesAreTold) {
  const Loaded l = load_mtl("Kd 1 1 1\nmap_Kd a.exr\n", "f 1/1 2/2 3/3\nf 1 3 4\n");
  EXPECT_EQ(l.error, "");
  ASSERT_EQ(l.scene.warnings.size(), 1u);
  expect_part(l.scene.warnings[0], "no texture coordinates (vt)");
  EXPECT_TRUE(mesh_of(l.scene).uvs.empty());
  const Loaded glass = load_mtl("d 0.5\nmap_Kd a.exr\n");
  ASSERT_EQ(glass.scene.warnings.size(), 1u);
  expect_part(glass.scene.warnings[0], "glass, metal and mirrors");
  // What the scene itself asks for must be possible.
  const TempFolder folder;
  write_picture(folder, "a.exr", 1, 1, rgb, {1, 1, 1});
  folder.write("m.obj", square + "f 1 2 3\n");
  const std::string text =
      scene_text(R"({"file": "a.exr"})", R"({"type": "mesh", "file": "m.obj", "material": "t"})");
  expect_part(test::input_error([&] { load_scene(folder.write("s.json", text)); }),
              "faces without texture coordinates");
}

TEST(SceneTexture, CornersAreSharedUnlessCoordinatesDiffer) {
  ModelOptions options;
  options.materials = ModelMaterials::replaced;
  options.textured = true;
  const TempFolder folder;
  const std::string path = folder.write("m.obj", square + "f 1/1 2/2 3/3\nf 1/1 3/4 4/4\n");
  const Model model = load_obj(path, options);
  EXPECT_EQ(model.parts[0].mesh.positions.size(), 5u) << "vertex 3 has two";
  options.textured = false;
  EXPECT_EQ(load_obj(path, options).parts[0].mesh.positions.size(), 4u);
}

}  // namespace
}  // namespace pellucid
