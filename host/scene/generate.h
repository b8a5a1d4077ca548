// Meshes made from parameters: the same bits on every machine, front side outwards or up.
#pragma once

#include <cstdint>

#include "scene/mesh_tools.h"

namespace pellucid {

/// Closed; a star-shaped lump, so it never meets itself. Radius changes by up to amplitude *
/// radius.
struct DisplacedSphere {
  int triangles = 1000;
  double radius = 1.0, amplitude = 0.15, frequency = 3.0;
  int octaves = 4;
  std::uint32_t seed = 0;
};
/// Closed tube along a (p,q) torus knot about the z axis; ring and tube are relative to radius.
struct TorusKnot {
  int triangles = 1000;
  int p = 2, q = 3;
  double radius = 1.0, ring = 0.45, tube = 0.2;
};
/// A sheet over the xz plane, y = sum of sines, |y| <= amplitude.
struct WaveSurface {
  int triangles = 1000;
  glm::dvec2 size{2.0};
  double amplitude = 0.1;
  int waves = 5;
  double wavelength = 0.7;
  std::uint32_t seed = 0;
};
/// A sheet over the xz plane, y = fractal noise, |y| <= height.
struct HeightField {
  int triangles = 1000;
  glm::dvec2 size{2.0};
  double height = 0.3, frequency = 3.0;
  int octaves = 6;
  std::uint32_t seed = 0;
};

RawMesh generate(const DisplacedSphere& shape);
RawMesh generate(const TorusKnot& shape);
RawMesh generate(const WaveSurface& shape);
RawMesh generate(const HeightField& shape);

}  // namespace pellucid
