// AOVs against closed forms, pixel by pixel.
#include "render/aov.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "render_harness.h"

namespace pellucid::test {
namespace {

constexpr uint width = 40, height = 30;
constexpr double radius = 1.0, wall_z = -6.0;
const glm::dvec3 center(0.5, 0.25, -4.0);

Material named(MaterialKind kind, const Rgb& reflectance) {
  Material m;
  m.kind = kind;
  m.reflectance = reflectance;
  return m;
}

/// A sphere before a wall that fills the left of the picture; sky to the right. The camera stands
/// at the origin and looks along -z.
Scene still_life() {
  Scene scene;
  scene.settings.width = int(width);
  scene.settings.height = int(height);
  scene.settings.filter = PixelFilter::box;
  scene.camera.fov = 60;
  scene.materials = {named(MaterialKind::diffuse, Rgb(0.1, 0.2, 0.3)),
                     named(MaterialKind::mirror, Rgb(0.9, 0.8, 0.7))};
  Mesh wall;  // facing away: normals are told towards the camera all the same
  wall.positions = {{-99, -99, float(wall_z)},
                    {1, -99, float(wall_z)},
                    {1, 99, float(wall_z)},
                    {-99, 99, float(wall_z)}};
  wall.triangles = {{0, 2, 1}, {0, 3, 2}};
  Shape sheet, ball;
  sheet.geometry = wall;
  ball.geometry = Sphere{center, radius};
  ball.material = 1;
  scene.shapes = {sheet, ball};
  return scene;
}

using Channels = std::map<std::string, std::vector<float>>;

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const AovInfo& info : aov_table()) names.push_back(info.name);
  return names;
}

std::vector<AovChannel> make(const Scene& scene, const std::vector<std::string>& names,
                             RenderOptions options = {}) {
  const PackedScene packed = pack_scene(scene, {simd_width_for(test_device().info())});
  options.width = int(width);
  options.height = int(height);
  options.plan.extra_features = all_scene_features();
  std::vector<Counter> counters = make_counters();
  auto channels = render_aovs(test_device(), packed, names, options, counters).value();
  EXPECT_EQ(error_count(counters), 0u) << describe_counters(counters);
  return channels;
}

Channels by_name(const std::vector<AovChannel>& channels) {
  Channels out;
  for (const AovChannel& c : channels) out[c.name] = c.data;
  return out;
}

struct Expected {
  glm::dvec3 p{0}, n{0};
  double depth = INFINITY;
  int id = -1;
  bool near_edge = false;  ///< of the sphere or of the wall
};

/// What the ray through (x, y) of the film meets, in double.
Expected expected_at(double x, double y) {
  const double distance = 0.5 * width / std::tan(0.5 * 60 * 3.14159265358979323846 / 180);
  const glm::dvec3 d = glm::normalize(glm::dvec3(x - 0.5 * width, 0.5 * height - y, -distance));
  Expected e;
  const double b = glm::dot(d, center), inside = b * b - glm::dot(center, center) + radius * radius;
  const glm::dvec3 at_wall = d * (wall_z / d.z);
  e.near_edge = std::abs(inside) < 0.3 || std::abs(at_wall.x - 1) < 0.3;
  if (inside > 0) {
    e.p = d * (b - std::sqrt(inside));
    e.n = (e.p - center) / radius;
    e.id = 1;
  } else if (at_wall.x < 1) {
    e.p = at_wall;
    e.n = {0, 0, 1};
    e.id = 0;
  }
  if (e.id >= 0) e.depth = -e.p.z;
  return e;
}

TEST(Aov, geometry_of_sphere_wall_and_sky) {
  const Channels aov = by_name(make(still_life(), all_names()));
  std::map<int, int> seen;
  for (uint y = 0; y < height; ++y)
    for (uint x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      const Expected e = expected_at(x + 0.5, y + 0.5);
      ASSERT_EQ(aov.at("id.object")[i], float(e.id)) << x << "," << y;
      ASSERT_EQ(aov.at("id.material")[i], float(e.id)) << x << "," << y;
      ++seen[e.id];
      if (e.id < 0) {
        ASSERT_EQ(aov.at("Z")[i], INFINITY);
        for (const char* name : {"P.X", "P.Y", "P.Z"}) ASSERT_EQ(aov.at(name)[i], 0.0f);
        continue;
      }
      // At a distance of about 5 and slopes below 4 (next to the sphere's rim): 1e-5 is some 10
      // roundings of the ray's direction.
      ASSERT_NEAR(aov.at("Z")[i], e.depth, 1e-5 * e.depth);
      ASSERT_NEAR(aov.at("P.X")[i], e.p.x, 5e-5);
      ASSERT_NEAR(aov.at("P.Y")[i], e.p.y, 5e-5);
      ASSERT_NEAR(aov.at("P.Z")[i], e.p.z, 5e-5);
    }
  for (int id : {-1, 0, 1}) EXPECT_GT(seen[id], 50) << "all three fill some of the picture";
}

// A scene that is counted from its middle tells positions as its file has them.
TEST(Aov, positions_are_those_of_the_file) {
  Scene far = still_life();
  far.origin = {1024, -2048, 4096};
  const Channels a = by_name(make(still_life(), {"P", "id.object"})), b = by_name(make(far, {"P"}));
  for (std::size_t i = 0; i < width * height; ++i) {
    const float there = a.at("id.object")[i] < 0 ? 0 : 1;
    EXPECT_NEAR(b.at("P.X")[i], a.at("P.X")[i] + 1024 * there, 1e-3);
    EXPECT_NEAR(b.at("P.Y")[i], a.at("P.Y")[i] - 2048 * there, 1e-3);
    EXPECT_NEAR(b.at("P.Z")[i], a.at("P.Z")[i] + 4096 * there, 1e-3);
  }
}

TEST(Aov, means_of_normals_and_colours) {
  const Channels aov = by_name(make(still_life(), all_names()));
  const Scene scene = still_life();
  int compared = 0;
  for (uint y = 0; y < height; ++y)
    for (uint x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      const Expected e = expected_at(x + 0.5, y + 0.5);
      if (e.near_edge) continue;
      ++compared;
      glm::dvec3 mean(0);  // over the pixel, as the box filter has it
      constexpr int side = 16;
      for (int k = 0; k < side * side; ++k)
        mean += expected_at(x + (k % side + 0.5) / side, y + (k / side + 0.5) / side).n /
                double(side * side);
      const Rgb colour = e.id < 0 ? Rgb(0) : scene.materials[std::size_t(e.id)].reflectance;
      for (int c = 0; c < 3; ++c) {
        const std::string axis(1, "XYZ"[c]), channel(1, "RGB"[c]);
        // 64 stratified samples of a normal that turns by up to 0.1 within a pixel.
        ASSERT_NEAR(aov.at("N." + axis)[i], mean[c], 2e-3) << x << "," << y;
        ASSERT_EQ(aov.at("N." + axis)[i], aov.at("Ng." + axis)[i]) << "nothing is smooth here";
        ASSERT_NEAR(aov.at("albedo." + channel)[i], colour[c], 1e-6) << x << "," << y;
      }
    }
  EXPECT_GT(compared, 600);
}

TEST(Aov, shading_normals_are_not_geometric_ones) {
  Scene scene = still_life();
  Mesh& wall = std::get<Mesh>(scene.shapes[0].geometry);
  const glm::vec3 tilted = glm::normalize(glm::vec3(0.6f, 0.0f, 0.8f));
  wall.normals.assign(wall.positions.size(), tilted);
  const Channels aov = by_name(make(scene, all_names()));
  const std::size_t corner = 0;  // the wall
  EXPECT_NEAR(aov.at("N.X")[corner], 0.6, 1e-6);
  EXPECT_NEAR(aov.at("N.Z")[corner], 0.8, 1e-6);
  EXPECT_NEAR(aov.at("Ng.Z")[corner], 1.0, 1e-6);
}

TEST(Aov, albedo_of_each_material) {
  Scene scene = still_life();
  Material metal = named(MaterialKind::conductor, Rgb(0));
  metal.eta = Rgb(0.2, 0.5, 1.0), metal.k = Rgb(3.0, 2.0, 1.0);
  Material paint = named(MaterialKind::phong, Rgb(0.1, 0.2, 0.3));
  paint.specular = Rgb(0.4, 0.3, 0.2);
  Material coated = named(MaterialKind::plastic, Rgb(0.0));
  coated.ior = 1.5;
  const Material glass = named(MaterialKind::dielectric, Rgb(0));
  const auto fresnel = [](double eta, double k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
  };
  const std::pair<Material, Rgb> cases[] = {
      {metal, {fresnel(0.2, 3), fresnel(0.5, 2), fresnel(1, 1)}},
      {paint, Rgb(0.5)},
      {glass, Rgb(1.0)},
      {coated, Rgb(0.04)},  // the coat alone: ((n-1)/(n+1))^2
  };
  for (const auto& [material, colour] : cases) {
    scene.materials[0] = material;
    const Channels aov = by_name(make(scene, {"albedo"}));
    EXPECT_NEAR(aov.at("albedo.R")[0], colour.x, 1e-5);
    EXPECT_NEAR(aov.at("albedo.G")[0], colour.y, 1e-5);
    EXPECT_NEAR(aov.at("albedo.B")[0], colour.z, 1e-5);
  }
}

TEST(Aov, a_window_is_a_part_of_the_whole) {
  Scene scene = still_life();
  scene.settings.filter = PixelFilter::gaussian;
  constexpr uint x0 = 7, y0 = 5, columns = 20, rows = 11;
  RenderOptions crop;
  crop.crop = Window{x0, y0, columns, rows};
  const auto part = make(scene, all_names(), crop), whole = make(scene, all_names());
  ASSERT_EQ(part.size(), whole.size());
  for (std::size_t c = 0; c < whole.size(); ++c) {
    EXPECT_EQ(part[c].name, whole[c].name);
    for (uint y = 0; y < rows; ++y)
      for (uint x = 0; x < columns; ++x)
        ASSERT_EQ(part[c].data[y * columns + x], whole[c].data[(y + y0) * width + x + x0])
            << whole[c].name;
  }
  RenderOptions other;
  other.seed = 1;
  EXPECT_NE(by_name(make(scene, {"N"}, other)).at("N.X"), by_name(whole).at("N.X"));
  EXPECT_EQ(by_name(make(scene, {"Z"}, other)).at("Z"), by_name(whole).at("Z"));
}

TEST(Aov, only_what_is_asked_for) {
  EXPECT_TRUE(make(still_life(), {}).empty());
  EXPECT_TRUE(make(still_life(), {"variance", "samples"}).empty());
  const auto channels = make(still_life(), {"id.object", "Z", "Z"});
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].name, "Z");
  EXPECT_EQ(channels[1].name, "id.object");
}

}  // namespace
}  // namespace pellucid::test
