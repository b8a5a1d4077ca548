// The "principled" look: three materials and two weights.
#include "scene/principled.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pellucid {
namespace {

Material mixed(Material a, Material b, double amount) {
  if (amount <= 0.0) return a;
  if (amount >= 1.0) return b;
  Material mix;
  mix.kind = MaterialKind::mix;
  a.weight = 1.0 - amount;
  b.weight = amount;
  mix.parts = {std::move(a), std::move(b)};
  return mix;
}

}  // namespace

void metal_of_color(const Rgb& color, Rgb& eta, Rgb& k) {
  eta = Rgb(1.0);
  for (int c = 0; c < 3; ++c) {
    // k of 100, the most that a scene file may say, reflects all but 0.0004.
    const double share = color[c] < 1.0 ? color[c] / (1.0 - color[c]) : HUGE_VAL;
    k[c] = std::min(2.0 * std::sqrt(share), 100.0);
  }
}

Material principled_material(const Principled& look) {
  Material plastic;
  plastic.kind = MaterialKind::plastic;
  plastic.reflectance = look.base_color;
  plastic.ior = look.ior;
  plastic.alpha = look.roughness * look.roughness;
  Material glass = plastic;
  glass.kind = MaterialKind::dielectric;
  Material metal = plastic;
  metal.kind = MaterialKind::conductor;
  metal_of_color(look.base_color, metal.eta, metal.k);
  return mixed(mixed(std::move(plastic), std::move(glass), look.transmission), std::move(metal),
               look.metallic);
}

}  // namespace pellucid
