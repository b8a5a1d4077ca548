// Transforms: order of steps, mirroring, normals, and the shapes that take only similarities.
#include <gtest/gtest.h>

#include "scene_test_support.h"

namespace pellucid {
namespace {

using test::load_text;
using test::scene_with;

Scene transformed(const std::string& shape, const std::string& steps) {
  return load_text(
      scene_with("{\"material\": \"m\", " + shape + ", \"transform\": [" + steps + "]}"));
}

/// Whether all triangles, and the vertex normals if there are any, point away from the middle.
void expect_outward(const Mesh& mesh, glm::dvec3 middle, double sign = 1.0) {
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 p0 = mesh.positions[t.x], p1 = mesh.positions[t.y], p2 = mesh.positions[t.z];
    ASSERT_GT(sign * glm::dot(glm::cross(p1 - p0, p2 - p0), p0 - middle), 0.0);
    for (int i = 0; i < 3 && !mesh.normals.empty(); ++i)
      ASSERT_GT(sign * glm::dot(glm::dvec3(mesh.normals[t[i]]),
                                glm::dvec3(mesh.positions[t[i]]) - middle),
                0.0);
  }
}

const char* mirrors[] = {R"({"scale": [-1, 1, 1]})",
                         R"({"scale": [1, -1, 1]})",
                         R"({"scale": [1, 1, -1]})",
                         R"({"scale": -1})",
                         R"({"scale": [-1, -1, 1]})",
                         R"({"scale": [-3, 0.5, 2]})",
                         R"({"matrix": [0,1,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1]})"};

TEST(SceneTransform, MirroringKeepsTheFrontInFront) {
  for (const char* mirror : mirrors)
    for (const char* shape :
         {R"("type": "cube")", R"("type": "displaced-sphere", "triangles": 1000)"}) {
      SCOPED_TRACE(std::string(mirror) + shape);
      const Scene plain = transformed(shape, mirror);
      expect_outward(std::get<Mesh>(plain.shapes[0].geometry), glm::dvec3(0.0));
      const Scene flipped = transformed(std::string(shape) + ", \"flip\": true", mirror);
      expect_outward(std::get<Mesh>(flipped.shapes[0].geometry), glm::dvec3(0.0), -1.0);
    }
}

TEST(SceneTransform, NormalsStayPerpendicularUnderStretching) {
  const Scene scene =
      transformed(R"("type": "displaced-sphere", "triangles": 100000, "amplitude": 0)",
                  R"({"scale": [1, 4, 0.5]}, {"rotate": {"axis": [1, 2, 3], "degrees": 40}})");
  const Mesh& mesh = std::get<Mesh>(scene.shapes[0].geometry);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 p0 = mesh.positions[t.x], p1 = mesh.positions[t.y], p2 = mesh.positions[t.z];
    const glm::dvec3 flat = glm::normalize(glm::cross(p1 - p0, p2 - p0));
    ASSERT_NEAR(glm::length(glm::dvec3(mesh.normals[t.x])), 1.0, 1e-6);
    ASSERT_GT(glm::dot(flat, glm::dvec3(mesh.normals[t.x])), 0.98);
  }
}

TEST(SceneTransform, StepsActInTheOrderWritten) {
  const Scene scene = transformed(R"("type": "sphere", "center": [1, 0, 0], "radius": 1)",
                                  R"({"scale": 2}, {"rotate": {"axis": [0, 0, 2], "degrees": 90}},
                                     {"translate": [10, 0, 0]})");
  const Sphere& sphere = std::get<Sphere>(scene.shapes[0].geometry);
  EXPECT_EQ(sphere.center, glm::dvec3(10, 2, 0));
  EXPECT_DOUBLE_EQ(sphere.radius, 2.0);
}

TEST(SceneTransform, DisksKeepTheirFrontSide) {
  const Scene scene = transformed(R"("type": "disk", "normal": [0, 0, 1])",
                                  R"({"scale": [-2, 2, 2]},
                                     {"rotate": {"axis": [1, 0, 0], "degrees": -90}})");
  const Disk& disk = std::get<Disk>(scene.shapes[0].geometry);
  EXPECT_EQ(disk.normal, glm::dvec3(0, 1, 0));
  EXPECT_DOUBLE_EQ(disk.radius, 2.0);
}

TEST(SceneTransform, MatrixIsRowByRow) {
  const Scene scene =
      transformed(R"("type": "cube")", R"({"matrix": [1,0,0,10, 0,1,0,20, 0,0,1,30, 0,0,0,1]})");
  EXPECT_EQ(std::get<Mesh>(scene.shapes[0].geometry).positions[0], glm::vec3(9.5, 19.5, 29.5));
}

}  // namespace
}  // namespace pellucid
