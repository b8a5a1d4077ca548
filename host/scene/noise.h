// Arithmetic whose bits are the same on every machine: integer hash, gradient noise, sine by turns.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace pellucid {

/// Mixes all bits of a into all bits of the result.
std::uint32_t hash_bits(std::uint32_t a);
/// Uniform in [0, 1), the same for the same pair.
double hash_unit(std::uint32_t seed, std::uint32_t index);

/// Sum of `octaves` layers of gradient noise, each twice as fine and half as strong; in [-1, 1].
double fractal_noise(glm::dvec3 p, int octaves, std::uint32_t seed);

struct SineCosine {
  double sin, cos;
};
/// Sine and cosine of a whole-turn angle (1 = 360 degrees), exact at quarters. The C library's
/// differ in the last bit between machines, so scenes do not use them.
SineCosine sin_cos_turns(double turns);
/// Angle of the point (x, y) in turns, in [0, 1), exact at quarters; the point is not the origin.
double angle_turns(double y, double x);

}  // namespace pellucid
