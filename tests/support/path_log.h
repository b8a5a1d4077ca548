// What a path of the method `path` chooses at each of its vertices, told by the twin in float or in
// double from the same random numbers, and where two such walks part.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pack/pack.h"

namespace pellucid::test {

/// What became of a vertex's light sample.
enum class LightFate { none, hidden, rehit, seen };  ///< rehit: by the very triangle it leaves

/// One segment and the vertex that it leads to. What a path does not come to stays as it is here.
struct PathStep {
  uint prim = NONE;     ///< hit, or NONE: it has left the scene
  bool rehit = false;   ///< that is the very triangle which the segment leaves
  bool shines = false;  ///< light is found here by chance
  bool black = false;   ///< nothing scatters: met from behind, or along the surface
  uint light = NONE;    ///< picked by the light sample
  LightFate sample = LightFate::none;
  bool survives = true;  ///< roulette
  uint lobe = 0;         ///< twice the part of a mix, and 1 for the second lobe of that part
  bool goes_on = false;  ///< a direction was drawn
  bool through = false;  ///< to the other side of the surface
};

struct PathLog {
  std::array<double, 3> radiance{};  ///< [W/(m^2 sr)]
  uint rays = 0;                     ///< traced, those to lights included
  std::vector<PathStep> steps;
};

/// The path of pixel (x, y) in launch.iteration, in float and in double.
PathLog path_log_float(const PackedScene& packed, const Launch& launch, uint x, uint y);
PathLog path_log_double(const PackedScene& packed, const Launch& launch, uint x, uint y);

/// Why two walks part. One of them finds again the flat triangle that its ray leaves, which never
/// is right; or, in the order in which a walk chooses: another primitive is hit, light is found by
/// chance or not, a light sample is another one or hidden, roulette, the lobe, an end for another
/// reason, the side to which the path goes on.
enum class Parting { none, rehit, surface, emission, light, roulette, lobe, end, side };
constexpr int partings = 9;
const char* parting_name(Parting why);

/// What is chosen differently first.
Parting parting_of(const PathLog& a, const PathLog& b);

}  // namespace pellucid::test
