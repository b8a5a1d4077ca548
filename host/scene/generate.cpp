// Meshes made from parameters.
#include "scene/generate.h"

#include <algorithm>
#include <cmath>

#include "scene/noise.h"

namespace pellucid {
namespace {

constexpr double pi = 3.14159265358979323846;

glm::dvec3 unit(glm::dvec3 v) {
  return v / std::sqrt(glm::dot(v, v));
}

/// The sphere as an octahedron whose edges are cut into n parts: 8 n^2 triangles. Rings run from
/// the north pole (+z) to the south pole; ring r has 4 min(r, 2n-r) vertices.
class OctahedronGrid {
 public:
  explicit OctahedronGrid(std::uint32_t n) : n_(n) {}

  std::uint32_t rings() const { return 2 * n_; }
  std::uint32_t quarter(std::uint32_t ring) const { return std::min(ring, 2 * n_ - ring); }

  /// Index of vertex j of quarter q of a ring; j may equal the length of the quarter.
  std::uint32_t index(std::uint32_t ring, std::uint32_t q, std::uint32_t j) const {
    const std::uint32_t side = quarter(ring);
    if (side == 0) return ring == 0 ? 0 : 4 * n_ * n_ + 1;
    // Vertices in the rings before this one: pole + sum of 4 min(r, 2n-r).
    const std::uint32_t before =
        ring <= n_ ? 1 + 2 * ring * (ring - 1) : 4 * n_ * n_ + 1 - 2 * side * (side + 1);
    return before + (q * side + j) % (4 * side);
  }

  glm::dvec3 direction(std::uint32_t ring, std::uint32_t q, std::uint32_t j) const {
    const glm::dvec3 axes[4] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    const double side = quarter(ring), z = static_cast<double>(n_) - ring;
    return unit((side - j) * axes[q] + static_cast<double>(j) * axes[(q + 1) % 4] +
                glm::dvec3(0.0, 0.0, z));
  }

 private:
  std::uint32_t n_;
};

void add_octahedron_triangles(const OctahedronGrid& grid, std::vector<glm::uvec3>& triangles) {
  for (std::uint32_t ring = 0; ring < grid.rings(); ++ring)
    for (std::uint32_t q = 0; q < 4; ++q) {
      const std::uint32_t upper = grid.quarter(ring), lower = grid.quarter(ring + 1);
      const bool north = lower > upper;
      for (std::uint32_t j = 0; j < std::max(upper, lower); ++j) {
        if (north) {  // one triangle points up; all but the last have a neighbour that points down
          triangles.emplace_back(grid.index(ring, q, j), grid.index(ring + 1, q, j),
                                 grid.index(ring + 1, q, j + 1));
          if (j < upper)
            triangles.emplace_back(grid.index(ring, q, j), grid.index(ring + 1, q, j + 1),
                                   grid.index(ring, q, j + 1));
        } else {
          triangles.emplace_back(grid.index(ring, q, j), grid.index(ring + 1, q, j),
                                 grid.index(ring, q, j + 1));
          if (j < lower)
            triangles.emplace_back(grid.index(ring, q, j + 1), grid.index(ring + 1, q, j),
                                   grid.index(ring + 1, q, j + 1));
        }
      }
    }
}

/// Texture coordinates of a direction, as those of an exact sphere: poles on the y axis, the middle
/// of the picture at +z.
glm::dvec2 sphere_uv(glm::dvec3 d) {
  const double across = std::sqrt(d.x * d.x + d.z * d.z);
  const double v = 0.5 + (d.y < 0.0 ? -1.0 : 1.0) * 2.0 * angle_turns(std::abs(d.y), across);
  if (across == 0.0) return {std::nan(""), v};
  const double u = 0.5 + angle_turns(d.x, d.z);
  return {u < 1.0 ? u : u - 1.0, v};
}

/// An nx by nz grid of cells over the xz plane, front side up; height(x, z) gives y.
template <class Height>
RawMesh make_sheet(int triangles, glm::dvec2 size, Height height) {
  const double cells = triangles / 2.0;
  const auto nx = static_cast<std::uint32_t>(
      std::clamp(std::round(std::sqrt(cells * size.x / size.y)), 1.0, cells));
  const auto nz = static_cast<std::uint32_t>(std::max(1.0, std::round(cells / nx)));
  RawMesh mesh;
  mesh.positions.reserve((nx + std::size_t{1}) * (nz + 1));
  for (std::uint32_t k = 0; k <= nz; ++k)
    for (std::uint32_t i = 0; i <= nx; ++i) {
      const double x = (static_cast<double>(i) / nx - 0.5) * size.x;
      const double z = (static_cast<double>(k) / nz - 0.5) * size.y;
      mesh.positions.emplace_back(x, height(x, z), z);
      mesh.uvs.emplace_back(static_cast<double>(i) / nx, 1.0 - static_cast<double>(k) / nz);
    }
  mesh.triangles.reserve(std::size_t{2} * nx * nz);
  for (std::uint32_t k = 0; k < nz; ++k)
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = k * (nx + 1) + i, b = a + nx + 1;
      mesh.triangles.emplace_back(a, b, b + 1);
      mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  return mesh;
}

struct CurveFrame {
  glm::dvec3 point, normal, binormal;
};

/// Point of a (p,q) torus knot at t turns, with two unit vectors across the curve. The curve lies
/// on a torus, and the torus' own normal is across it everywhere: the frame closes without a twist.
CurveFrame torus_knot_frame(const TorusKnot& knot, double t) {
  const SineCosine around = sin_cos_turns(knot.p * t), ring = sin_cos_turns(knot.q * t);
  const double minor = knot.ring * knot.radius, distance = knot.radius + minor * ring.cos;
  const glm::dvec3 outward(around.cos, around.sin, 0.0), along(-around.sin, around.cos, 0.0);
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dvec3 normal = ring.cos * outward + ring.sin * up;
  const glm::dvec3 tangent = unit(static_cast<double>(knot.p) * distance * along +
                                  knot.q * minor * (ring.cos * up - ring.sin * outward));
  return {distance * outward + minor * ring.sin * up, normal, glm::cross(tangent, normal)};
}

double torus_knot_length(const TorusKnot& knot) {
  constexpr int steps = 1024;
  double length = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) / steps, next = static_cast<double>(i + 1) / steps;
    const glm::dvec3 d = torus_knot_frame(knot, next).point - torus_knot_frame(knot, t).point;
    length += std::sqrt(glm::dot(d, d));
  }
  return length;
}

}  // namespace

RawMesh generate(const DisplacedSphere& shape) {
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(shape.triangles / 8.0)));
  const OctahedronGrid grid(n);
  RawMesh mesh;
  mesh.positions.resize(std::size_t{4} * n * n + 2);
  mesh.uvs.resize(mesh.positions.size());
  for (std::uint32_t ring = 0; ring <= grid.rings(); ++ring)
    for (std::uint32_t q = 0; q < 4; ++q)
      for (std::uint32_t j = 0; j < std::max(grid.quarter(ring), 1u); ++j) {
        const glm::dvec3 d = grid.direction(ring, q, j);
        const double bump = fractal_noise(shape.frequency * d, shape.octaves, shape.seed);
        mesh.positions[grid.index(ring, q, j)] =
            d * (shape.radius * (1.0 + shape.amplitude * bump));
        mesh.uvs[grid.index(ring, q, j)] = sphere_uv(d);
      }
  mesh.triangles.reserve(std::size_t{8} * n * n);
  add_octahedron_triangles(grid, mesh.triangles);
  return mesh;
}

RawMesh generate(const TorusKnot& shape) {
  const double cells = shape.triangles / 2.0, tube = shape.tube * shape.radius;
  // Cells about as long as wide; at least a hexagon across and three times that along.
  const double aspect = 2.0 * pi * tube / torus_knot_length(shape);
  const auto across = static_cast<std::uint32_t>(
      std::clamp(std::round(std::sqrt(cells * aspect)), 6.0, cells / 18.0));
  const auto along = static_cast<std::uint32_t>(std::round(cells / across));
  RawMesh mesh;
  mesh.positions.reserve(std::size_t{along} * across);
  for (std::uint32_t i = 0; i < along; ++i) {
    const CurveFrame frame = torus_knot_frame(shape, static_cast<double>(i) / along);
    for (std::uint32_t k = 0; k < across; ++k) {
      const SineCosine angle = sin_cos_turns(static_cast<double>(k) / across);
      mesh.positions.push_back(frame.point +
                               tube * (angle.cos * frame.normal + angle.sin * frame.binormal));
      mesh.uvs.emplace_back(static_cast<double>(i) / along,
                            static_cast<double>((across - k) % across) / across);
    }
  }
  mesh.triangles.reserve(std::size_t{2} * along * across);
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t k = 0; k < across; ++k) {
      const std::uint32_t i1 = (i + 1) % along, k1 = (k + 1) % across;
      const std::uint32_t a = i * across + k, b = i1 * across + k;
      const std::uint32_t c = i1 * across + k1, d = i * across + k1;
      mesh.triangles.emplace_back(a, d, c);
      mesh.triangles.emplace_back(a, c, b);
    }
  return mesh;
}

RawMesh generate(const WaveSurface& shape) {
  struct Wave {
    double x, z, phase, height;
  };
  std::vector<Wave> waves;
  double total = 0.0, step = 1.0;
  for (int i = 0; i < shape.waves; ++i) {
    const auto base = static_cast<std::uint32_t>(3 * i);
    const SineCosine heading = sin_cos_turns(hash_unit(shape.seed, base));
    // Each wave is somewhat shorter than the one before, and lower in the same proportion.
    const double shrink = step * (0.8 + 0.2 * hash_unit(shape.seed, base + 1));
    step *= 0.75;
    const double length = shape.wavelength * shrink;
    waves.push_back(
        {heading.cos / length, heading.sin / length, hash_unit(shape.seed, base + 2), shrink});
    total += shrink;
  }
  return make_sheet(shape.triangles, shape.size, [&](double x, double z) {
    double sum = 0.0;
    for (const Wave& w : waves) sum += w.height * sin_cos_turns(w.x * x + w.z * z + w.phase).sin;
    return shape.amplitude * sum / total;
  });
}

RawMesh generate(const HeightField& shape) {
  const double scale = shape.frequency / std::max(shape.size.x, shape.size.y);
  return make_sheet(shape.triangles, shape.size, [&](double x, double z) {
    return shape.height * fractal_noise({x * scale, 0.37, z * scale}, shape.octaves, shape.seed);
  });
}

}  // namespace pellucid
