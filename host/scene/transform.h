// Affine transforms of the scene file, in double.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scene/json_tree.h"

namespace pellucid {

/// The vector, which is not zero, made unit length; scaled first, so that squares neither vanish
/// nor overflow.
glm::dvec3 unit_of(glm::dvec3 v);

/// p -> linear * p + offset.
struct Affine {
  glm::dmat3 linear{1.0};
  glm::dvec3 offset{0.0};

  glm::dvec3 point(glm::dvec3 p) const { return linear * p + offset; }
  bool mirrors() const { return glm::determinant(linear) < 0.0; }
  /// Turns a normal so that it stays normal and on the same side of its surface; unit length.
  glm::dvec3 normal(glm::dvec3 n) const;
  /// The factor by which all lengths grow, if that is one number (rotations and mirrors allowed).
  std::optional<double> uniform_scale() const;
};

/// Steps in the order written: the first one acts first.
Affine read_transform(const JsonNode& steps);

}  // namespace pellucid
