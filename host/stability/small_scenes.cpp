// Small scenes in code.
#include "stability/small_scenes.h"

#include <cmath>

namespace pellucid::stability {

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

Scene light_tight_box(bool smooth) {
  Scene scene = empty_scene(0.9);
  Mesh mesh = lump(5000);
  if (smooth)
    for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p));
  add_shape(scene, std::move(mesh));
  scene.lights.push_back(ConstantEnvironment{Rgb(1e6)});
  DirectionalLight sun;
  sun.irradiance = Rgb(1e6);
  scene.lights.push_back(sun);
  scene.camera.fov = 90;
  return scene;
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

Scene pane_scene(Scene scene) {
  scene.materials.push_back(Material{});
  scene.materials.back().reflectance = Rgb(0.5);
  const auto paper = uint(scene.materials.size() - 1);
  for (Shape& shape : scene.shapes) {
    Mesh& mesh = std::get<Mesh>(shape.geometry);
    if (shape.name == "pane") {  // 40 x 40 x 0.125 about z = -0.0625: now from z = 1 to 1.5
      for (glm::vec3& p : mesh.positions) p.z = p.z < -0.1f ? 1.0f : 1.5f;
    } else {
      shape.emission.reset();
      shape.material = paper;
      for (glm::vec3& p : mesh.positions) p = {p.x * 0.04f, p.y * 0.04f, 0};  // 4 x 4
    }
  }
  PointLight point;
  point.position = {0, 0, 2};
  point.intensity = Rgb(1.0);
  scene.lights = {point};
  scene.camera.origin = {0, 0, 0.75};
  scene.camera.forward = {0, 0, -1};
  scene.camera.fov = 90;
  return scene;
}

Scene scaled(Scene scene, int k) {
  const double f = std::ldexp(1.0, k);
  scene.camera.origin *= f;
  for (Shape& shape : scene.shapes) {
    if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
      for (glm::vec3& p : mesh->positions) p *= float(f);
    } else if (Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
      sphere->center *= f;
      sphere->radius *= f;
    } else {
      Disk& disk = std::get<Disk>(shape.geometry);
      disk.center *= f;
      disk.radius *= f;
    }
  }
  for (Light& light : scene.lights)
    if (PointLight* point = std::get_if<PointLight>(&light)) {
      point->position *= f;
      point->intensity *= f * f;
    } else if (SpotLight* spot = std::get_if<SpotLight>(&light)) {
      spot->position *= f;
      spot->intensity *= f * f;
    }
  return scene;
}

void transform_points(Scene& scene, const glm::dvec3& scale, const glm::dvec3& move) {
  const auto point = [&](const glm::dvec3& p) { return p * scale + move; };
  const bool mirrored = scale.x * scale.y * scale.z < 0;
  for (Shape& shape : scene.shapes) {
    if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
      for (glm::vec3& p : mesh->positions) p = point(p);
      for (glm::vec3& n : mesh->normals) n *= glm::vec3(scale);
      if (mirrored)
        for (glm::uvec3& t : mesh->triangles) std::swap(t.y, t.z);
    } else if (Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
      sphere->center = point(sphere->center);
    } else {
      Disk& disk = std::get<Disk>(shape.geometry);
      disk.center = point(disk.center);
      disk.normal *= scale;
    }
  }
  for (Light& light : scene.lights)
    if (PointLight* lamp = std::get_if<PointLight>(&light)) {
      lamp->position = point(lamp->position);
    } else if (SpotLight* spot = std::get_if<SpotLight>(&light)) {
      spot->position = point(spot->position);
      spot->direction *= scale;
    } else if (DirectionalLight* sun = std::get_if<DirectionalLight>(&light)) {
      sun->direction *= scale;
    }
  Camera& c = scene.camera;
  c.origin = point(c.origin);
  for (glm::dvec3* d : {&c.right, &c.up, &c.forward}) *d *= scale;
}

Scene turned(Scene scene, const glm::dmat3& turn) {
  for (Shape& shape : scene.shapes) {
    if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
      for (glm::vec3& p : mesh->positions) p = turn * glm::dvec3(p);
      for (glm::vec3& n : mesh->normals) n = turn * glm::dvec3(n);
    } else if (Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
      sphere->center = turn * sphere->center;
      sphere->axes = turn * sphere->axes;
    } else {
      Disk& disk = std::get<Disk>(shape.geometry);
      for (glm::dvec3* v : {&disk.center, &disk.normal, &disk.u_axis, &disk.v_axis}) *v = turn * *v;
    }
  }
  for (Light& light : scene.lights)
    if (PointLight* lamp = std::get_if<PointLight>(&light)) {
      lamp->position = turn * lamp->position;
    } else if (SpotLight* spot = std::get_if<SpotLight>(&light)) {
      spot->position = turn * spot->position;
      spot->direction = turn * spot->direction;
    } else if (DirectionalLight* sun = std::get_if<DirectionalLight>(&light)) {
      sun->direction = turn * sun->direction;
    }
  Camera& c = scene.camera;
  for (glm::dvec3* v : {&c.origin, &c.right, &c.up, &c.forward}) *v = turn * *v;
  return scene;
}

}  // namespace pellucid::stability
