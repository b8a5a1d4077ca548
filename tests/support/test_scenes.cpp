// Small scenes in code.
#include "support/test_scenes.h"

#include <cmath>

namespace pellucid::test {

glm::dvec3 Random::direction() {
  const double z = uniform(-1, 1), phi = uniform(0, 6.283185307179586);
  const double r = std::sqrt((1 - z) * (1 + z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Scene empty_scene(double reflectance) {
  Scene scene;
  Material m;
  m.reflectance = Rgb(reflectance);
  scene.materials.push_back(m);
  return scene;
}

Shape& add_shape(Scene& scene, std::variant<Mesh, Sphere, Disk> geometry) {
  Shape shape;
  shape.geometry = std::move(geometry);
  scene.shapes.push_back(std::move(shape));
  return scene.shapes.back();
}

Mesh baked(RawMesh raw, const glm::dvec3& translation, double scale) {
  Mesh mesh;
  for (const glm::dvec3& p : raw.positions) mesh.positions.emplace_back(p * scale + translation);
  mesh.triangles = raw.triangles;
  return mesh;
}

Mesh lump(int triangles, const glm::dvec3& center) {
  DisplacedSphere shape;
  shape.triangles = triangles;
  return baked(generate(shape), center);
}

Mesh soup(Random& random, int triangles, double half, double size) {
  RawMesh raw;
  for (unsigned i = 0; i < unsigned(triangles); ++i) {
    const glm::dvec3 center = random.in_box(half);
    for (int k = 0; k < 3; ++k) raw.positions.push_back(center + random.in_box(size));
    raw.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return baked(std::move(raw));
}

Mesh scattered(Random& random, int triangles, double low, double high) {
  RawMesh raw;
  for (unsigned i = 0; i < unsigned(triangles); ++i) {
    const double place = std::pow(10.0, random.uniform(low, high));
    const double size = std::pow(10.0, random.uniform(low, high));
    const glm::dvec3 center = place * random.direction();
    for (int k = 0; k < 3; ++k) raw.positions.push_back(center + size * random.direction());
    raw.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return baked(std::move(raw));
}

}  // namespace pellucid::test
