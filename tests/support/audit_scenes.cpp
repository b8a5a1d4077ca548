// The rooms.
#include "support/audit_scenes.h"

#include <algorithm>

namespace pellucid::test {
namespace {

Material named(const std::string& name, MaterialKind kind, const Rgb& reflectance,
               double alpha = 0.0) {
  Material m;
  m.name = name;
  m.kind = kind;
  m.reflectance = reflectance;
  m.alpha = m.roughness = alpha;
  m.specular = Rgb(0.4, 0.5, 0.3);
  m.exponent = 20.0;
  m.eta = Rgb(0.2, 0.9, 1.1);
  m.k = Rgb(3.9, 2.5, 2.4);
  return m;
}

Material mixed(const std::string& name, std::vector<Material> parts, double first) {
  Material m = named(name, MaterialKind::mix, Rgb(0.5));
  m.parts = std::move(parts);
  m.parts[0].weight = first;
  for (std::size_t i = 1; i < m.parts.size(); ++i)
    m.parts[i].weight = (1 - first) / double(m.parts.size() - 1);
  return m;
}

std::vector<Material> all_materials() {
  using K = MaterialKind;
  const Rgb red(0.8, 0.4, 0.3), white(0.9);
  std::vector<Material> all = {named("diffuse", K::diffuse, red),
                               named("oren-nayar", K::oren_nayar, white, 0.6),
                               named("phong", K::phong, Rgb(0.4, 0.3, 0.2)),
                               named("plastic", K::plastic, red),
                               named("rough plastic", K::plastic, red, 0.2),
                               named("mirror", K::mirror, white),
                               named("metal", K::conductor, white),
                               named("rough metal", K::conductor, white, 0.3),
                               named("glass", K::dielectric, white),
                               named("rough glass", K::dielectric, white, 0.3),
                               named("pane", K::thin_dielectric, white)};
  Material textured = named("textured", K::diffuse, white);
  textured.texture = 0;
  Material textured_phong = named("textured phong", K::phong, Rgb(0.6));
  textured_phong.texture = 0;
  all.push_back(textured);
  all.push_back(mixed("paint and metal", {all[1], all[7]}, 0.6));
  all.push_back(mixed("mirror, plastic and glass", {all[5], all[3], all[8]}, 0.2));
  all.push_back(mixed("frosted clay", {all[9], all[0], textured_phong}, 0.5));
  return all;
}

void add_uvs(Mesh& mesh) {
  for (const glm::vec3& p : mesh.positions)
    mesh.uvs.emplace_back(0.7f * p.x + 0.2f * p.z, 0.6f * p.y - 0.3f * p.z);
}

/// Object number i of material `material`: the shapes take turns.
void add_object(Scene& scene, Random& random, int i, int material, const glm::dvec3& at) {
  const glm::dvec3 place = at + random.in_box(0.1);
  const double radius = random.uniform(0.35, 0.5);
  Shape* shape = nullptr;
  if (i % 4 == 0) {
    shape = &add_shape(scene, Sphere{place, radius});
  } else if (i % 4 == 1) {
    // Along an axis: a slanted normal is packed as floats, so its length is off by 1e-8, which the
    // double twin would see in narrow lobes.
    const glm::dvec3 normal(i % 3 == 0, i % 3 == 1, i % 3 == 2);
    shape = &add_shape(scene, Disk{place, normal, 1.3 * radius});
  } else {
    Mesh mesh = lump(i % 4 == 2 ? 80 : 40, place);
    for (glm::vec3& p : mesh.positions)
      p = glm::vec3(place) + (p - glm::vec3(place)) * float(radius);
    if (i % 4 == 2)
      for (const glm::vec3& p : mesh.positions)
        mesh.normals.push_back(glm::normalize(p - glm::vec3(place)));
    add_uvs(mesh);
    shape = &add_shape(scene, std::move(mesh));
  }
  shape->material = material;
}

void add_walls(Scene& scene, bool open) {
  const int textured = audit_material(scene, "textured");
  const double h = 2.0;
  const glm::dvec3 corner(-h), far(h), x(2 * h, 0, 0), y(0, 2 * h, 0), z(0, 0, 2 * h);
  const RawMesh walls[] = {make_rectangle(corner, x, y),  // fronts face inwards
                           make_rectangle(corner, y, z), make_rectangle(corner, z, x),
                           make_rectangle(far, -z, -y),  make_rectangle(far, -x, -z),
                           make_rectangle(far, -y, -x)};
  for (int i = open ? 1 : 0; i < 6; ++i) {
    Mesh mesh = baked(walls[i]);
    add_uvs(mesh);
    Shape& wall = add_shape(scene, std::move(mesh));
    wall.material = i % 2 ? textured : i == 2 ? 1 : 0;
    wall.sides = i % 3 == 0 ? 1 : 2;
  }
}

void add_lights(Scene& scene, bool open) {
  const auto emitter = [&](std::variant<Mesh, Sphere, Disk> geometry, double radiance, int sides) {
    Shape& shape = add_shape(scene, std::move(geometry));
    shape.emission = Emission{Rgb(radiance), sides};
    shape.material = audit_material(scene, sides == 1 ? "rough plastic" : "diffuse");
  };
  const auto triangle = [](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return baked({{a, b, c}, {}, {{0, 1, 2}}});
  };
  emitter(triangle({-1.9, -1.9, 1.6}, {-1.9, -0.9, 1.6}, {-0.9, -1.9, 1.6}), 8, 1);
  emitter(triangle({1.0, 1.6, 0.0}, {1.8, 1.5, 0.1}, {1.4, 1.7, 0.8}), 8, 2);
  emitter(Sphere{{1.5, -1.5, 1.5}, 0.25}, 4, 1);
  emitter(Sphere{{-1.6, 1.6, -1.2}, 0.2}, 4, 2);
  emitter(Disk{{0.0, 1.8, 1.2}, {0.0, -1.0, 0.0}, 0.4}, 4, 1);
  emitter(Disk{{-1.6, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.3}, 4, 2);
  scene.lights.push_back(PointLight{{0.1, 0.7, 0.6}, Rgb(1.0)});
  scene.lights.push_back(SpotLight{{0.6, -0.7, 1.4}, {0, 0, -1}, Rgb(6.0), 0.4, 0.7});
  if (!open) return;
  scene.lights.push_back(DirectionalLight{{0, 0, 1}, Rgb(0.5)});
  scene.lights.push_back(ConstantEnvironment{Rgb(0.1)});
}

}  // namespace

Scene audit_room(bool open) {
  Scene scene;
  scene.materials = all_materials();
  TextureImage image{2, 2, {}};
  for (float grey : {0.9f, 0.5f, 0.7f, 1.0f}) image.texels.emplace_back(grey);
  scene.images.push_back(image);
  scene.textures.emplace_back();
  Random random(open ? 11 : 12);
  add_walls(scene, open);
  const int count = int(scene.materials.size());
  for (int i = 0; i < 18; ++i) {  // a 3 x 3 x 2 grid; other shapes per material in the other room
    const glm::dvec3 at(-1.2 + 1.2 * (i % 3), -1.2 + 1.2 * (i / 3 % 3), i < 9 ? -1.0 : 0.8);
    add_object(scene, random, i + (open ? 1 : 0), i % count, at);
  }
  add_lights(scene, open);
  scene.camera.origin = {-0.6, -1.9, 0.0};
  scene.camera.forward = {0, 1, 0};
  scene.camera.right = {1, 0, 0};
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = 90;
  scene.settings.width = scene.settings.height = 32;
  return scene;
}

int audit_material(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [&](const Material& m) { return m.name == name; });
  return int(found - scene.materials.begin());
}

}  // namespace pellucid::test
