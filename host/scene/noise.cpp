// Arithmetic whose bits are the same on every machine: only +, -, *, /, floor and integers.
#include "scene/noise.h"

#include <cmath>

namespace pellucid {
namespace {

constexpr double two_pi = 6.283185307179586476925;

/// Dot product with one of 12 edge directions of a cube, chosen by hash [Perlin02].
double gradient_dot(std::uint32_t hash, double x, double y, double z) {
  const std::uint32_t h = hash % 12u;
  const double u = h < 8 ? x : y;  // first nonzero component
  const double v = h < 4 ? y : z;  // second one
  return ((hash & 0x100u) ? -u : u) + ((hash & 0x200u) ? -v : v);
}

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
double mix(double a, double b, double t) {
  return a + t * (b - a);
}

double gradient_noise(glm::dvec3 p, std::uint32_t seed) {
  const glm::dvec3 cell(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const glm::dvec3 f = p - cell;
  const auto lattice = [](double c) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(c));
  };
  const std::uint32_t ix = lattice(cell.x), iy = lattice(cell.y), iz = lattice(cell.z);
  double corner[8];
  for (std::uint32_t c = 0; c < 8; ++c) {
    const std::uint32_t dx = c & 1u, dy = (c >> 1) & 1u, dz = c >> 2;
    const std::uint32_t hash =
        hash_bits(ix + dx + hash_bits(iy + dy + hash_bits(iz + dz + hash_bits(seed))));
    corner[c] = gradient_dot(hash, f.x - dx, f.y - dy, f.z - dz);
  }
  const double u = fade(f.x), v = fade(f.y), w = fade(f.z);
  return mix(mix(mix(corner[0], corner[1], u), mix(corner[2], corner[3], u), v),
             mix(mix(corner[4], corner[5], u), mix(corner[6], corner[7], u), v), w);
}

}  // namespace

std::uint32_t hash_bits(std::uint32_t a) {
  a += 0x9e3779b9u;  // keeps zero from mapping to zero
  a = (a ^ (a >> 16)) * 0x21f0aaadu;
  a = (a ^ (a >> 15)) * 0x735a2d97u;
  return a ^ (a >> 15);
}

double hash_unit(std::uint32_t seed, std::uint32_t index) {
  return hash_bits(index + hash_bits(seed)) * 0x1p-32;
}

double fractal_noise(glm::dvec3 p, int octaves, std::uint32_t seed) {
  double sum = 0.0, strength = 1.0, total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * gradient_noise(p, seed + static_cast<std::uint32_t>(i));
    total += strength;
    strength *= 0.5;
    p *= 2.0;
  }
  const double value = sum / total;
  return value < -1.0 ? -1.0 : value > 1.0 ? 1.0 : value;
}

SineCosine sin_cos_turns(double turns) {
  turns -= std::floor(turns);
  const int quarter = static_cast<int>(std::floor(turns * 4.0 + 0.5));
  const double x = (turns - quarter * 0.25) * two_pi;  // in [-pi/4, pi/4]
  const double x2 = x * x;
  // Taylor series; the terms left out are below 1e-19.
  double s = 0.0, c = 0.0;
  for (int n = 8; n >= 1; --n) {
    s = x2 * (1.0 - s) / ((2.0 * n) * (2.0 * n + 1.0));
    c = x2 * (1.0 - c) / ((2.0 * n - 1.0) * (2.0 * n));
  }
  s = x * (1.0 - s);
  c = 1.0 - c;
  switch (quarter & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double angle_turns(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  double turns = 0.25 * ay / (ax + ay);  // off by at most 0.07 radians, which Newton cubes
  for (int step = 0; step < 3; ++step) {
    const SineCosine at = sin_cos_turns(turns);
    turns += (ay * at.cos - ax * at.sin) / (ax * at.cos + ay * at.sin) / two_pi;
  }
  if (x < 0.0) turns = 0.5 - turns;
  if (y < 0.0) turns = 1.0 - turns;
  return turns < 1.0 ? turns : 0.0;
}

}  // namespace pellucid
