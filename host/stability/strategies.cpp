// Densities that agree with what is sampled (numerics 6): all strategies that can find the paths of
// one length have the same mean, each by itself, unweighted.
//
// Where sample() and pdf() are written apart, one of them forgets a lobe's share, the roulette or
// the pick of the light, and weights that do not add up to 1 make a plausible picture. Here they
// are one function's business, and a walk carries the density that it drew its direction with
// (transport/walk.h): a number of each walk, and for each scattering that is weighed from both ends
// one more evaluation, of the reverse density. That weights add up to 1 on every path is for the
// tests of the twin, which weigh each strategy by brute force in double (tests/unit/audit_*).
#include <fmt/format.h>

#include <cmath>

#include "integrators/registry.h"
#include "render/layers.h"
#include "render/session.h"
#include "scene/mesh_tools.h"
#include "shared/layers.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

constexpr int side = 24;

/// Sum of a layer in all pixels and channels, as radiance.
double total(const Film& film, uint layer) {
  double sum = 0;
  for (std::size_t i = 0; i < film.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const uint* word =
          &film.layers.words[i * film.layers.words_per_pixel() + layer * LAYER_WORDS + 2 * c];
      sum += std::ldexp(double(word[1]), 32) + double(word[0]);
    }
  return sum / double(film.layers.scale);
}

/// Differences to light samples (s = 1), over seeds.
struct Difference {
  double sum = 0, square = 0;
  void add(double d) { sum += d, square += d * d; }
};

/// Three sides of a prism that do not meet, seen from its middle: a lamp and two glossy walls. No
/// vertices that are connected lie near each other, so that every strategy by itself is quick to
/// converge; light tracing and what meets the lamp by chance, too.
Scene open_prism() {
  Scene scene = empty_scene(0.5);
  Material coated, metal;
  coated.kind = MaterialKind::plastic, coated.reflectance = Rgb(0.6), coated.alpha = 0.5;
  metal.kind = MaterialKind::conductor, metal.alpha = 0.7;
  metal.eta = Rgb(0.2), metal.k = Rgb(3.9);
  scene.materials.push_back(coated), scene.materials.push_back(metal);
  const glm::dvec3 z(0, 0, 1);
  const double h = std::sqrt(0.75);
  const glm::dvec3 normals[] = {{0, 1, 0}, {-h, -0.5, 0}, {h, -0.5, 0}};
  const int materials[] = {1, 0, 2};
  for (std::size_t i : {0u, 1u, 2u}) {
    const glm::dvec3 n = normals[i], t = glm::cross(n, z);
    add_shape(scene, baked(make_rectangle(-n - z - t, 2.0 * z, 2.0 * t))).material = materials[i];
  }
  scene.shapes[1].emission = Emission{};
  Camera& c = scene.camera;
  c.forward = {0, -1, 0}, c.right = {1, 0, 0}, c.up = {0, 0, -1};
  c.fov = 75;  // the coated wall and nothing else
  return scene;
}

}  // namespace

void strategies_agree(const Lab& lab, Findings& findings) {
  constexpr int seeds = 12;
  constexpr uint longest = 3;
  Scene scene = open_prism();
  scene.settings.width = scene.settings.height = side;
  const PackedScene packed = pack_scene(scene, {simd_width_for(lab.device.info())});
  const Integrator method = with_layers(find_integrator("bdpt"), LAYERS_TECH, longest + 1);
  RenderOptions options;
  options.width = options.height = side;
  options.passes = PassRange{0, lab.count(896)};
  options.plan.extra_features = all_scene_features();
  options.plan.kernel_dir = lab.kernel_dir;
  double level[longest + 1] = {};
  Difference difference[longest + 1][longest + 1];
  for (int seed = 0; seed < seeds; ++seed) {
    options.seed = std::uint64_t(seed);
    Session session(lab.device, packed, method, options);
    session.run({});
    const Film& film = session.film();
    for (uint depth = 2; depth <= longest; ++depth) {
      const double nee = total(film, layer_of_unweighted(film.layers.set, 1, depth));
      level[depth] += nee / seeds;
      for (uint s = 0; s <= depth; ++s)
        difference[depth][s].add(total(film, layer_of_unweighted(film.layers.set, s, depth)) - nee);
    }
  }
  for (uint depth = 2; depth <= longest; ++depth)
    for (uint s = 0; s <= depth; ++s) {
      if (s == 1) continue;
      const Difference& d = difference[depth][s];
      const double mean = d.sum / seeds;
      const double noise =
          4.5 * std::sqrt((d.square / seeds - mean * mean) / (seeds - 1)) / level[depth];
      const std::string name = fmt::format("length {}: s = {} beside s = 1", depth, s);
      findings.at_most(name + ", relative difference", std::abs(mean) / level[depth], noise);
      findings.at_most(name + ", known to", noise, 0.02 / std::sqrt(lab.effort));
    }
}

}  // namespace pellucid::stability
