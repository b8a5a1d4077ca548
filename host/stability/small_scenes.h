// Small scenes in code, and random numbers to make them from.
#pragma once

#include <glm/glm.hpp>
#include <random>

#include "scene/generate.h"
#include "scene/scene.h"

namespace pellucid::stability {

/// Deterministic uniform numbers and directions in double.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  /// Uniform in [low, high): 53 bits, computed here because std distributions differ by library.
  double uniform(double low = 0.0, double high = 1.0) {
    return low + (high - low) * (double(engine_() >> 11) * 0x1p-53);
  }
  /// A multiple of 2^-24 in [0, 1), as the kernels draw it.
  std::uint32_t word() { return std::uint32_t(engine_() >> 32); }
  double unit24() { return double(engine_() >> 40) * 0x1p-24; }
  unsigned below(unsigned n) { return unsigned((engine_() >> 32) * n >> 32); }
  glm::dvec3 in_box(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return {x, y, z};
  }
  glm::dvec3 direction();

 private:
  std::mt19937_64 engine_;
};

/// A scene with one white-ish diffuse material and nothing else.
Scene empty_scene(double reflectance = 0.5);
/// Adds a shape of material 0 and returns it.
Shape& add_shape(Scene& scene, std::variant<Mesh, Sphere, Disk> geometry);

Mesh baked(RawMesh raw, const glm::dvec3& translation = glm::dvec3(0.0), double scale = 1.0);
/// A closed lump of radius about 1, star-shaped around `center`.
Mesh lump(int triangles, const glm::dvec3& center = glm::dvec3(0.0));
/// Unconnected triangles with corners within `size` of points in [-half, half]^3.
Mesh soup(Random& random, int triangles, double half, double size);
/// Soup of very different sizes and places: exponents of ten uniform in [low, high].
Mesh scattered(Random& random, int triangles, double low, double high);

/// A grey lump without holes, under a bright sky and a sun, seen from within: exactly black.
/// `smooth`: with the normals of a ball, far from those of its facets.
Scene light_tight_box(bool smooth = false);

/// CF10 out of the shipped `slab`: a floor of reflectance 0.5 seen from below a pane from z = 1 to
/// 1.5, index 1.5, which a point light of intensity 1 at z = 2 shines through.
Scene pane_scene(Scene slab);

/// All lengths times 2^k. Intensities (W/sr) go with the square of a length; radiance and
/// irradiance stay.
Scene scaled(Scene scene, int k);

/// Mirrors at the axes of which `scale` is -1, then moves.
void transform_points(Scene& scene, const glm::dvec3& scale, const glm::dvec3& move);

/// Turns shapes, lights and camera about the origin; columns of `turn` are orthonormal and
/// right-handed.
Scene turned(Scene scene, const glm::dmat3& turn);

}  // namespace pellucid::stability
