// Static reachability: which lights can be found by chance, and what stands before those that
// cannot.
#include "integrators/reach.h"

namespace pellucid {

std::vector<std::string> unreachable_paths(const Integrator& integrator, FeatureSet scene) {
  const bool delta_light = scene.has(FEAT_LIGHT_POINT) || scene.has(FEAT_LIGHT_SPOT) ||
                           scene.has(FEAT_LIGHT_DIRECTIONAL);
  const bool delta_surface = scene.has(FEAT_MIRROR) || scene.has(FEAT_CONDUCTOR) ||
                             scene.has(FEAT_DIELECTRIC) || scene.has(FEAT_THIN_DIELECTRIC) ||
                             scene.has(FEAT_PLASTIC);
  if (!delta_light) return {};
  if (!integrator.wishes.has(INTG_NEE))
    return {"all light of point, spot and directional lights: chance never finds them"};
  if (delta_surface)
    return {
        "light of point, spot and directional lights that first meets a mirror, smooth metal, "
        "smooth glass or a smooth coat (caustics)"};
  return {};
}

}  // namespace pellucid
