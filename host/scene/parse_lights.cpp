// Camera, lights and emission of the scene file.
#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "scene/parse.h"
#include "scene/transform.h"

namespace pellucid {
namespace {

constexpr double pi = 3.14159265358979323846;

/// A direction of any length but zero, made unit length.
glm::dvec3 unit_vector(const ObjectReader& reader, const std::string& key) {
  const glm::dvec3 v = reader.vector(key);
  if (v == glm::dvec3(0.0)) fail(reader.place(key), "a direction must not be zero");
  return unit_of(v);
}

FovAxis fov_axis(const std::string& name) {
  if (name == "x") return FovAxis::x;
  if (name == "y") return FovAxis::y;
  return name == "smaller" ? FovAxis::smaller : FovAxis::larger;
}

}  // namespace

Camera parse_camera(const JsonNode& node) {
  const ObjectReader reader(node, object_spec("camera"));
  Camera camera;
  camera.origin = reader.vector("origin");
  const glm::dvec3 view = reader.vector("target") - camera.origin;
  const double distance = glm::length(view);
  if (!(distance > 0.0)) fail(reader.place("target"), "target and origin are the same point");
  camera.forward = view / distance;
  const glm::dvec3 right = glm::cross(camera.forward, unit_vector(reader, "up"));
  // Within about a ten-thousandth of a degree the picture's rotation would be left to rounding.
  if (!(glm::length(right) > 1e-6))
    fail(reader.place("up"), "up points along the view direction; choose another up");
  camera.right = glm::normalize(right);
  camera.up = glm::cross(camera.right, camera.forward);
  camera.fov = reader.number("fov");
  camera.fov_axis = fov_axis(reader.text("fovAxis"));
  return camera;
}

Emission parse_emission(const JsonNode& node) {
  const ObjectReader reader(node, object_spec("emission"));
  return {reader.color("radiance"), reader.integer("sides")};
}

namespace {

SpotLight parse_spot(const ObjectReader& reader) {
  SpotLight spot;
  spot.position = reader.vector("position");
  if (reader.exactly_one({"target", "direction"}) == "target") {
    const glm::dvec3 view = reader.vector("target") - spot.position;
    if (!(glm::length(view) > 0.0))
      fail(reader.place("target"), "target and position are the same point");
    spot.direction = glm::normalize(view);
  } else {
    spot.direction = unit_vector(reader, "direction");
  }
  spot.outer = 0.5 * reader.number("angle") * pi / 180.0;
  spot.inner = spot.outer * (1.0 - reader.number("falloff"));
  spot.intensity = reader.exactly_one({"intensity", "power"}) == "power"
                       ? reader.color("power") / spot_solid_angle(spot)
                       : reader.color("intensity");
  return spot;
}

}  // namespace

Light parse_light(const JsonNode& node) {
  const ObjectSpec& spec = typed_spec(node, "light");
  const ObjectReader reader(node, spec);
  if (spec.name == "light/point") {
    const bool by_power = reader.exactly_one({"intensity", "power"}) == "power";
    return PointLight{reader.vector("position"),
                      by_power ? reader.color("power") / (4.0 * pi) : reader.color("intensity")};
  }
  if (spec.name == "light/spot") return parse_spot(reader);
  if (spec.name == "light/directional")
    return DirectionalLight{unit_vector(reader, "direction"), reader.color("irradiance")};
  PELLUCID_CHECK(spec.name == "light/environment", "a light of the table has no parser");
  return ConstantEnvironment{reader.color("radiance")};
}

}  // namespace pellucid
