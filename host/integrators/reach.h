// What a method cannot see: classes of paths that it draws with probability 0 in a scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pack/pack.h"
#include "render/integrator.h"

namespace pellucid {

/// What decides which classes of paths carry light in a scene. Not its features: those may hold
/// lights that are black and materials that nothing is made of.
struct SceneOptics {
  unsigned lights = 0;                ///< 1 << LIGHT_*: one of that kind shines
  unsigned lobes = 0;                 ///< LOBE_*: a surface scatters so. SPREAD: with wide ones;
                                      ///< NARROW: with others
  std::optional<unsigned> max_depth;  ///< segments; absent = unlimited
};
SceneOptics optics_of(const PackedScene& scene, std::optional<unsigned> max_depth);

/// A noun phrase for every class of paths that can carry light in such a scene and that the method
/// never draws: black however long the render. Whether there are such paths is up to the geometry.
std::vector<std::string> unreachable_paths(const Integrator& method, const SceneOptics& scene);

/// The same for classes that the method finds only where a walk happens to hit an emitting surface:
/// noisy if that is small. (The environment lies behind every gap, so chance serves it well.)
std::vector<std::string> chance_paths(const Integrator& method, const SceneOptics& scene);

/// How many pixels of group images must carry an estimate of error that is believed
/// (ErrorEstimate): where light is found by chance alone, a few hits say too little of those to
/// come (accuracy.md 4: 300 restore the nominal level of a test); else any number.
double least_effective(const Integrator& method, const SceneOptics& scene);

/// Names of methods that draw paths which are unreachable for another one.
struct Seers {
  std::vector<std::string> all, some;  ///< every one of those paths; only a part of them
};
Seers seers_of_unreachable(const Integrator& method, const SceneOptics& scene,
                           const std::vector<Integrator>& among);

/// Whole sentences for the end of a render: what `method` cannot see, and which of `among` can;
/// and if it merges, whether any surface holds photons.
std::vector<std::string> blind_spots(const Integrator& method, const SceneOptics& scene,
                                     const std::vector<Integrator>& among);

}  // namespace pellucid
