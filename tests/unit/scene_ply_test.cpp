// PLY: formats, types, polygons, properties that are skipped, and every way to be broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "scene/model.h"
#include "scene_test_support.h"

namespace pellucid {
namespace {

Model load(const std::string& text, ModelOptions options = {ModelMaterials::lenient, true}) {
  const test::TempFolder folder;
  return load_model(folder.write("m.ply", text), options);
}

std::string error_of(const std::string& text) {
  return test::input_error([&] { load(text); });
}

std::string header(const std::string& format, const std::string& vertex, const std::string& list) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex 5\n" + vertex +
         "element face 2\nproperty uchar flags\nproperty list " + list +
         " vertex_indices\nend_header\n";
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string ascii_data = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n5e-1 5e-1 +1\n7 4 0 1 2 3\n7 3 0 1 4\n";

/// Appends a number as a value of the named type, in either order of bytes.
void put(std::string& out, const std::string& type, double value, bool big) {
  const auto bytes = [&](auto v) {
    char raw[sizeof v];
    std::memcpy(raw, &v, sizeof v);
    if (big) std::reverse(raw, raw + sizeof v);
    out.append(raw, sizeof v);
  };
  if (type == "char" || type == "int8") bytes(static_cast<std::int8_t>(value));
  if (type == "uchar" || type == "uint8") bytes(static_cast<std::uint8_t>(value));
  if (type == "short" || type == "int16") bytes(static_cast<std::int16_t>(value));
  if (type == "ushort" || type == "uint16") bytes(static_cast<std::uint16_t>(value));
  if (type == "int" || type == "int32") bytes(static_cast<std::int32_t>(value));
  if (type == "uint" || type == "uint32") bytes(static_cast<std::uint32_t>(value));
  if (type == "float" || type == "float32") bytes(static_cast<float>(value));
  if (type == "double" || type == "float64") bytes(value);
}

const double corners[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};

std::string binary(bool big, const std::string& count_type, const std::string& index_type) {
  std::string text = header(big ? "binary_big_endian" : "binary_little_endian",
                            "property double x\nproperty list uchar short more\n"
                            "property float y\nproperty float z\n",
                            count_type + " " + index_type);
  for (const auto& corner : corners) {
    put(text, "double", corner[0], big);
    put(text, "uchar", 2, big);
    for (double item : {-1.0, 300.0}) put(text, "short", item, big);
    put(text, "float", corner[1], big);
    put(text, "float", corner[2], big);
  }
  const std::vector<std::vector<double>> faces = {{0, 1, 2, 3}, {0, 1, 4}};
  for (const auto& face : faces) {
    put(text, "uchar", 7, big);
    put(text, count_type, static_cast<double>(face.size()), big);
    for (double index : face) put(text, index_type, index, big);
  }
  return text;
}

void expect_the_tent(const Model& model) {
  ASSERT_EQ(model.parts.size(), 1u);
  const RawMesh& mesh = model.parts[0].mesh;
  ASSERT_EQ(mesh.positions.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(mesh.positions[i], glm::dvec3(corners[i][0], corners[i][1], corners[i][2]));
  const std::vector<glm::uvec3> fan = {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}};
  EXPECT_EQ(mesh.triangles, fan);
}

TEST(ScenePly, AllFormatsAndTypesGiveTheSameMesh) {
  expect_the_tent(load(header("ascii", xyz, "uchar int") + ascii_data));
  for (const bool big : {false, true})
    for (const char* count : {"char", "uchar", "short", "ushort", "int", "uint", "uint8", "int32"})
      for (const char* index : {"char", "uchar", "short", "ushort", "int", "uint", "uint16"}) {
        SCOPED_TRACE(std::string(big ? "big " : "little ") + count + " " + index);
        expect_the_tent(load(binary(big, count, index)));
      }
}

TEST(ScenePly, CarriageReturnsAndBlankLinesAreFine) {
  std::string text = header("ascii", xyz, "uchar int") + "\n" + ascii_data + "\n\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.insert(at, "\r");
  expect_the_tent(load(text));
}

TEST(ScenePly, NormalsAreUsedAndMadeWhereTheyVanish) {
  const std::string with = xyz + "property float nx\nproperty float ny\nproperty float nz\n";
  const std::string data =
      "0 0 0 0 0 2\n1 0 0 0 0 1\n1 1 0 0 0 0\n0 1 0 1 0 0\n.5 .5 1 0 1 0\n7 4 0 1 2 3\n7 3 0 1 4\n";
  const std::string text = header("ascii", with, "uchar int") + data;
  const Model model = load(text);
  const std::vector<glm::dvec3>& normals = model.parts[0].mesh.normals;
  ASSERT_EQ(normals.size(), 5u);
  EXPECT_EQ(normals[0], glm::dvec3(0, 0, 1)) << "unit length";
  EXPECT_EQ(normals[2], glm::dvec3(0, 0, 1)) << "made from the faces around";
  EXPECT_EQ(normals[3], glm::dvec3(1, 0, 0));
  EXPECT_TRUE(load(text, {ModelMaterials::lenient, false}).parts[0].mesh.normals.empty());
}

TEST(ScenePly, BrokenFilesNameLineOrByte) {
  const std::string good = header("ascii", xyz, "uchar int") + ascii_data;
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string text = good;
    text.replace(text.find(old), old.size(), now);
    return error_of(text);
  };
  const std::vector<std::array<std::string, 3>> cases = {
      {"ply\n", "plyy\n", "m.ply:1: a PLY file begins"},
      {"ascii", "asci", "m.ply:2: the format is"},
      {"1.0", "2.0", "m.ply:2: the format is"},
      {"format ascii 1.0\n", "", "no line \"format\""},
      {"vertex 5", "vertex five", "m.ply:4: an element reads"},
      {"vertex 5", "vertex 5000000000", "2^32"},
      {"float y", "floa y", "m.ply:6: there is no type \"floa\""},
      {"property float y", "properti float y", "m.ply:6: \"properti\""},
      {"property float y\n", "", "vertices need the properties x, y and z"},
      {"end_header", "end_headers", "m.ply:11: \"end_headers\""},
      {"1 0 0\n", "1 zero 0\n", "m.ply:13: \"zero\" is not a number"},
      {"1 0 0\n", "1 nan 0\n", "m.ply:13: nan is out of range"},
      {"1 0 0\n", "1 1e30 0\n", "m.ply:13: 1e+30 is out of range"},
      {"1 0 0\n", "1 0\n", "m.ply:13: the line ends too early"},
      {"1 0 0\n", "1 0 0 0\n", "m.ply:13: the line has more values"},
      {"7 4 0 1 2 3", "7 4 0 1 2 5", "m.ply:17: 5 is no vertex index (0 to 4)"},
      {"7 4 0 1 2 3", "7 4 0 1 2 -1", "m.ply:17: -1 is no vertex index"},
      {"7 4 0 1 2 3", "7 2 0 1", "m.ply:17: a face of 2 corners"},
      {"7 4 0 1 2 3", "7 -4 0 1 2 3", "m.ply:17: -4 is no length of a list"},
      {"7 3 0 1 4\n", "", "the file ends too early"},
      {"vertex_indices", "corners", "faces need the list vertex_indices"},
      {"face 2", "strip 2", "no faces"},
      {"property float x\n", "property float w\n", "vertices need the properties x, y and z"},
  };
  for (const auto& [old, now, part] : cases) {
    const std::string message = with(old, now);
    EXPECT_NE(message.find(part), std::string::npos) << old << " -> " << now << "\n" << message;
  }
  std::string cut = binary(false, "uchar", "int");
  const std::size_t end = cut.size() - 3;
  cut.resize(end);
  EXPECT_NE(error_of(cut).find("m.ply: byte " + std::to_string(end - 1)), std::string::npos)
      << error_of(cut);
  EXPECT_NE(error_of("").find("header"), std::string::npos);
  EXPECT_NE(error_of(good.substr(0, 60)).find("end_header"), std::string::npos);
}

TEST(ScenePly, CountsThatNoFileCouldHoldEndAtItsEnd) {
  std::string text = header("binary_little_endian", xyz, "uchar int");
  text.replace(text.find("vertex 5"), 8, "vertex 4000000000");
  EXPECT_NE(error_of(text).find("ends too early"), std::string::npos);
}

TEST(ScenePly, MeshShapesNeedAMaterial) {
  const test::TempFolder folder;
  folder.write("m.ply", header("ascii", xyz, "uchar int") + ascii_data);
  const auto load_shape = [&](const std::string& shape) {
    return load_scene(folder.write("s.json", test::scene_with(shape)));
  };
  const Scene scene = load_shape(R"({"type": "mesh", "file": "m.ply", "material": "m"})");
  EXPECT_EQ(std::get<Mesh>(scene.shapes.at(0).geometry).triangles.size(), 3u);
  EXPECT_EQ(scene.files.size(), 2u);
  const std::string message =
      test::input_error([&] { load_shape(R"({"type": "mesh", "file": "m.ply"})"); });
  EXPECT_NE(message.find("give the shape the key \"material\""), std::string::npos) << message;
  EXPECT_NE(test::input_error([&] {
              load_shape(R"({"type": "mesh", "file": "m.stl", "material": "m"})");
            }).find(".obj and .ply"),
            std::string::npos);
}

}  // namespace
}  // namespace pellucid
