// Affine transforms of the scene file, in double.
#include "scene/transform.h"

#include <algorithm>
#include <cmath>

#include "scene/noise.h"
#include "scene/reader.h"

namespace pellucid {
namespace {

glm::dmat3 rotation(glm::dvec3 axis, double degrees) {
  const glm::dvec3 a = unit_of(axis);
  const SineCosine angle = sin_cos_turns(degrees / 360.0);
  const glm::dmat3 cross(0.0, a.z, -a.y, -a.z, 0.0, a.x, a.y, -a.x, 0.0);  // columns
  return angle.cos * glm::dmat3(1.0) + angle.sin * cross +
         (1.0 - angle.cos) * glm::outerProduct(a, a);
}

Affine read_step(const JsonNode& node) {
  const ObjectReader step(node, object_spec("transform step"));
  const std::string kind = step.exactly_one({"translate", "rotate", "scale", "matrix"});
  Affine result;
  if (kind == "translate") {
    result.offset = step.vector(kind);
  } else if (kind == "scale") {
    const glm::dvec3 s = step.vector(kind);
    result.linear = glm::dmat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z);
  } else if (kind == "rotate") {
    const ObjectReader turn(step.place(kind), object_spec("rotate"));
    const glm::dvec3 axis = turn.vector("axis");
    if (axis == glm::dvec3(0.0)) fail(turn.place("axis"), "an axis must not be zero");
    result.linear = rotation(axis, turn.number("degrees"));
  } else {
    const std::vector<double> m = step.numbers(kind);
    if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0)
      fail(step.place(kind), "the last four numbers must be 0, 0, 0, 1 (row by row)");
    result.linear = glm::dmat3(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]);
    result.offset = {m[3], m[7], m[11]};
  }
  const double det = glm::determinant(result.linear);
  if (!std::isfinite(det) || det == 0.0)
    fail(step.place(kind), "flattens space: its determinant is zero or not finite");
  return result;
}

}  // namespace

glm::dvec3 unit_of(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return glm::normalize(v / largest);
}

glm::dvec3 Affine::normal(glm::dvec3 n) const {
  // The cofactor matrix is the inverse transpose times the determinant, and needs no division.
  const glm::dmat3& m = linear;
  const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const glm::dvec3 v = unit_of(cofactor * unit_of(n));
  return mirrors() ? -v : v;
}

std::optional<double> Affine::uniform_scale() const {
  const double scale = std::cbrt(std::abs(glm::determinant(linear)));
  const glm::dmat3 error = glm::transpose(linear) * linear / (scale * scale) - glm::dmat3(1.0);
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r)
      if (!(std::abs(error[c][r]) < 1e-6)) return std::nullopt;  // room for typed matrices
  return scale;
}

Affine read_transform(const JsonNode& steps) {
  Affine total;
  for (const JsonNode& node : steps.items) {
    const Affine step = read_step(node);
    total.offset = step.point(total.offset);
    total.linear = step.linear * total.linear;
  }
  const double det = glm::determinant(total.linear);
  if (!std::isfinite(det) || det == 0.0)
    fail(steps, "all steps together flatten space or leave the range of numbers");
  return total;
}

}  // namespace pellucid
