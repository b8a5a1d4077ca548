// Bare models: a camera framed on what there is, and a light of a strength that knows no scale.
#include "scene/bare_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "scene/reader.h"

namespace pellucid {
namespace {

constexpr double pi = 3.14159265358979323846;
/// Three-quarter view: to the right of the front, and from above.
constexpr double azimuth = 30 * pi / 180, elevation = 20 * pi / 180;
constexpr double filled = 0.92;  ///< share of the picture, along its tighter side
/// A grey 0.5 surface that faces the light comes out at (2.4 + pi 0.25) 0.5 / pi = 0.51, which is
/// 189 of 255 in the picture, whatever the model's size: neither light knows distance.
constexpr double irradiance = 2.4, sky = 0.25;
constexpr double light_right = 0.35, light_down = 0.45;  ///< over the left shoulder

JsonNode parse_addition(const std::string& text) {
  return parse_json(std::make_shared<const JsonSource>(JsonSource{"the bare model", text, false}));
}

JsonNode& member(JsonNode& object, const std::string& key) {
  for (JsonMember& m : object.members)
    if (m.key == key) return m.value;
  object.members.push_back({key, 0, {}});
  return object.members.back().value;
}

/// Calls visit(p) for points whose hull holds all shapes.
template <typename Visit>
void for_each_point(const Scene& scene, const Visit& visit) {
  const auto box = [&](const glm::dvec3& center, double reach) {
    for (int i = 0; i < 8; ++i)
      visit(center + reach * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  };
  if (scene.shapes.empty()) box({}, 1.0);  // overrides took the model away
  for (const Shape& shape : scene.shapes) {
    if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry))
      for (const glm::uvec3& t : mesh->triangles)
        for (int i = 0; i < 3; ++i) visit(glm::dvec3(mesh->positions[t[i]]));
    if (const Sphere* s = std::get_if<Sphere>(&shape.geometry)) box(s->center, s->radius);
    if (const Disk* d = std::get_if<Disk>(&shape.geometry)) box(d->center, d->radius);
  }
}

/// The mean direction that meshes face, at most 1 long: zero if closed, else towards the opening.
glm::dvec3 mean_facing(const Scene& scene) {
  glm::dvec3 sum{0.0};
  double area = 0.0;
  for (const Shape& shape : scene.shapes)
    if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry))
      for (const glm::uvec3& t : mesh->triangles) {
        const glm::dvec3 p0 = mesh->positions[t.x];
        const glm::dvec3 cross = glm::cross(glm::dvec3(mesh->positions[t.y]) - p0,
                                            glm::dvec3(mesh->positions[t.z]) - p0);
        sum += cross;
        area += glm::length(cross);
      }
  return area > 0.0 ? sum / area : sum;
}

struct View {
  glm::dvec3 right, up, forward;
};

/// Looks at the front, which is +z where y is up (and -y where z is); into the model where it is
/// open: closed models face all directions alike, and keep the front.
View choose_view(const Scene& scene, const glm::dvec3& up) {
  const glm::dvec3 side = std::abs(up.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 front = glm::normalize(glm::cross(side, up)), right = glm::cross(up, front);
  const glm::dvec3 facing = mean_facing(scene);
  const auto level = [&](int quarter) {
    const double angle = azimuth + quarter * pi / 2;
    return std::sin(angle) * right + std::cos(angle) * front;
  };
  constexpr double closed = 0.02;  // holes in scans open less
  glm::dvec3 best = level(0);
  double most = glm::dot(facing, best) + closed;
  for (int quarter = 1; quarter < 4; ++quarter) {
    const double seen = glm::dot(facing, level(quarter));
    if (seen <= most) continue;
    most = seen;
    best = level(quarter);
  }
  View view;
  view.forward = -(std::cos(elevation) * best + std::sin(elevation) * up);
  view.right = glm::normalize(glm::cross(view.forward, up));
  view.up = glm::cross(view.right, view.forward);
  return view;
}

struct Frame {
  glm::dvec3 origin, target;
};

/// The nearest pinhole on this side from which all points lie within the picture: each side of the
/// picture is a plane through the pinhole, and two opposite planes touch the points.
Frame fit(const Scene& scene, const View& view, double tan_x, double tan_y) {
  glm::dvec3 low{INFINITY}, high{-INFINITY};
  for_each_point(scene, [&](const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  });
  const glm::dvec3 middle = 0.5 * low + 0.5 * high;
  glm::dvec4 most{-INFINITY};  // of how far each side's plane must stand off, seen from the middle
  double nearest = INFINITY;
  for_each_point(scene, [&](const glm::dvec3& p) {
    const glm::dvec3 q = p - middle;
    const double x = glm::dot(q, view.right), y = glm::dot(q, view.up);
    const double z = glm::dot(q, view.forward);
    most = glm::max(most, glm::dvec4(x - tan_x * z, -x - tan_x * z, y - tan_y * z, -y - tan_y * z));
    nearest = std::min(nearest, z);
  });
  constexpr double gap = 0.01;  // between pinhole and model, of its size
  const double back =
      std::min({-0.5 * (most[0] + most[1]) / tan_x, -0.5 * (most[2] + most[3]) / tan_y,
                nearest - gap * glm::length(high - low)});
  const glm::dvec3 target =
      middle + 0.5 * (most[0] - most[1]) * view.right + 0.5 * (most[2] - most[3]) * view.up;
  return {target + back * view.forward, target};
}

/// Adds origin and target where overrides give none.
View add_camera(Scene& scene, JsonNode& camera) {
  const bool own_origin = camera.find("origin"), own_target = camera.find("target");
  const JsonNode stand_in = parse_addition("[[0, 0, 1], [0, 0, 0]]");
  if (!own_origin) member(camera, "origin") = stand_in.items[0];
  if (!own_target) member(camera, "target") = stand_in.items[1];
  const ObjectReader reader(camera, object_spec("camera"));  // checks what overrides gave
  const glm::dvec3 up = reader.vector("up");
  const double up_length = glm::length(up);
  if (!(up_length > 0.0)) fail(reader.place("up"), "a direction must not be zero");
  const View view = choose_view(scene, up / up_length);
  const double width = scene.settings.width, height = scene.settings.height;
  const std::string axis = reader.text("fovAxis");
  const bool along_x = axis == "x" || (axis == "smaller" && width <= height) ||
                       (axis == "larger" && width >= height);
  const double tan_fov = std::tan(reader.number("fov") * pi / 360.0);
  const double tan_x = filled * (along_x ? tan_fov : tan_fov * width / height);
  const Frame frame = fit(scene, view, tan_x, tan_x * height / width);
  const auto set = [&](const char* key, const glm::dvec3& v) {
    member(camera, key) = parse_addition(fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x, v.y, v.z));
  };
  if (!own_origin) set("origin", frame.origin + scene.origin);
  if (!own_target) set("target", frame.target + scene.origin);
  const glm::dvec3 o = reader.vector("origin"), t = reader.vector("target");
  scene.notes.push_back(fmt::format(
      "{}: camera at [{:.6g}, {:.6g}, {:.6g}] looks at [{:.6g}, {:.6g}, {:.6g}], field of view "
      "{:g} degrees ({} side)",
      scene.path, o.x, o.y, o.z, t.x, t.y, t.z, reader.number("fov"), axis));
  return view;
}

void add_light(const View& view, JsonNode& lights, Scene& scene) {
  const glm::dvec3 direction =
      glm::normalize(view.forward + light_right * view.right - light_down * view.up);
  lights = parse_addition(
      fmt::format(R"([{{"type": "directional", "direction": {}, "irradiance": {}}},)"
                  R"({{"type": "environment", "radiance": {}}}])",
                  fmt::format("[{:.17g}, {:.17g}, {:.17g}]", direction.x, direction.y, direction.z),
                  irradiance, sky));
  scene.notes.push_back(
      fmt::format("{}: it gives no light, so a directional light of irradiance {} shines over the "
                  "camera's left "
                  "shoulder under a grey sky of radiance {}; -D lights=[...] replaces both",
                  scene.path, irradiance, sky));
}

}  // namespace

JsonNode bare_model_document(const std::string& path) {
  JsonNode root = parse_json(std::make_shared<const JsonSource>(
      JsonSource{path,
                 R"({"version": 1, "camera": {"fov": 30, "fovAxis": "smaller"},
                     "materials": {"grey": {"type": "diffuse", "reflectance": 0.5}},
                     "shapes": [{"type": "mesh", "name": "model", "file": "model"}],
                     "lights": []})",
                 false}));
  // By hand, since JSON knows no file names that are not UTF-8.
  const std::filesystem::path file(path);
  JsonNode& shape = member(root, "shapes").items[0];
  member(shape, "name").text = file.stem().string();
  member(shape, "file").text = file.filename().string();
  return root;
}

int bare_material(const SceneBuilder& builder) {
  const auto found = builder.material_index.find("grey");
  if (found != builder.material_index.end()) return found->second;
  throw InputError(
      "a bare model needs the material \"grey\" for faces that have none; add to "
      "\"materials\" instead of replacing it");
}

void complete_bare_model(Scene& scene, JsonNode& document) {
  const View view = add_camera(scene, member(document, "camera"));
  JsonNode& lights = member(document, "lights");
  const bool lit = std::any_of(scene.shapes.begin(), scene.shapes.end(),
                               [](const Shape& shape) { return shape.emission.has_value(); });
  const bool given = lights.source != document.source;  // by an override, even if it is empty
  if (!lit && !given && lights.items.empty()) add_light(view, lights, scene);
}

}  // namespace pellucid
