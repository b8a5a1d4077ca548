// Static reachability, in the path notation of [Heckbert90] as [Veach97] extends it.
//
// A path with k segments has k - 1 scatterings between light L and camera E. Each is by a lobe with
// a density, D, or by one of a single direction, S (a plastic may do either). Lights are hittable
// (emitting surfaces, the environment) or not (point, spot, directional: a walk meets them with
// probability 0). L S* E is left out: from a hittable light every method sees it, the camera of
// `light` included, and a light without extent has no image. So here each path has a D.
//
// A strategy (s, t) draws s vertices from the light and t from the camera, t >= 1, and joins them
// by one edge. Walks follow S as well as D, but the edge has to be found: with probability 0 if the
// lobe at one of its ends is S. Hence
//   chance      s = 0            no edge to find: every path, if the light is hittable;
//   INTG_NEE    s = 1, t >= 2    paths whose first scattering is a D;
//   INTG_SPLAT  s >= 2, t = 1    paths whose last scattering is a D (also s = 1 by NEE of L D E);
//   INTG_CONNECT s, t >= 2       paths with two D in a row;
//   INTG_MERGE   a D of both     every path: no edge is needed, any light vertex near a D is taken
//                                for the one that would hit it. `sppm` does so at the first
//                                wide D from the camera alone, none whose lobes are all narrow (N).
// What escapes all strategies that aim is the paths for which each fails: a conjunction of
//   first S (NEE fails), last S (splats fail), no D D (connections fail),
// that is
//   naive, reference   any path
//   nee, path          L S+ D (D|S)* E     caustics and what they light
//   light              L (D|S)* D S+ E     what is seen in mirrors and through glass
//   bdpt               L S+ (D S+)+ E      caustics seen so: specular-diffuse-specular
//   sppm               L S+ N (N|S)* E     caustics on narrow gloss
//   bpm, vcm           none
//
// If the light is hittable, chance reaches those, except in `light`, whose camera counts emission
// behind S alone. Shortest of the class: L D E, one S more for each end that has to be one.
#include "integrators/reach.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/text.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

// What all paths of a class have in common; a class is any sum of these.
constexpr unsigned FIRST_DELTA = 1, LAST_DELTA = 2, ISOLATED_SPREAD = 4, ALL_NARROW = 8;

/// The class that no aiming strategy of the method draws.
unsigned not_aimed_at(const Integrator& method) {
  return (method.wishes.has(INTG_NEE) ? FIRST_DELTA : 0) |
         (method.wishes.has(INTG_SPLAT) ? LAST_DELTA : 0) |
         (method.wishes.has(INTG_CONNECT) ? ISOLATED_SPREAD : 0) |
         (method.wishes.has(INTG_MERGE) ? ALL_NARROW : 0);
}

/// Walks from the camera count the emission that they hit, after whatever scattering.
bool counts_chance_hits(const Integrator& method) {
  return method.wishes.has(INTG_NEE) || !method.wishes.has(INTG_SPLAT);
}

/// Whether a scene can have paths of the class with `more` scatterings than the shortest.
bool occurs(unsigned paths, const SceneOptics& scene, unsigned more = 0) {
  const unsigned deltas = (paths & FIRST_DELTA ? 1u : 0u) + (paths & LAST_DELTA ? 1u : 0u);
  const unsigned segments = 2 + deltas + more;
  const unsigned spread = paths & ALL_NARROW ? LOBE_NARROW : LOBE_NARROW | LOBE_SPREAD;
  return (scene.lobes & spread) && (deltas == 0 || (scene.lobes & LOBE_DELTA)) &&
         scene.max_depth.value_or(segments) >= segments;
}

constexpr unsigned EMITTERS = 1u << LIGHT_TRIANGLE | 1u << LIGHT_SPHERE | 1u << LIGHT_DISK;
constexpr unsigned HITTABLE = EMITTERS | 1u << LIGHT_ENVIRONMENT;

std::string names_of(unsigned lights) {
  const std::pair<unsigned, const char*> kinds[] = {{1u << LIGHT_POINT, "point lights"},
                                                    {1u << LIGHT_SPOT, "spot lights"},
                                                    {1u << LIGHT_DIRECTIONAL, "directional lights"},
                                                    {EMITTERS, "emitting surfaces"},
                                                    {1u << LIGHT_ENVIRONMENT, "the environment"}};
  std::vector<std::string> names;
  for (const auto& [bits, name] : kinds)
    if (lights & bits) names.push_back(name);
  if (names.size() < 2) return join(names);
  const std::string last = names.back();
  names.pop_back();
  return join(names) + " and " + last;
}

std::vector<std::string> describe(unsigned paths, unsigned lights, const SceneOptics& scene) {
  if (!lights || !occurs(paths, scene)) return {};
  constexpr const char* delta = "a mirror, smooth metal, glass or coat";
  const std::string names = names_of(lights);
  if (paths & ALL_NARROW)
    return {fmt::format("light of {} that first meets {}, on narrow gloss alone (L S+ N (N|S)* E)",
                        names, delta)};
  if ((paths & FIRST_DELTA) && (paths & LAST_DELTA))
    return {fmt::format("caustics of {}, seen by way of {} (L S+ D S+ E)", names, delta)};
  if (paths & FIRST_DELTA)
    return {fmt::format("light of {} that first meets {}: caustics (L S+ D ... E)", names, delta)};
  if (paths & LAST_DELTA)
    return {fmt::format("surfaces lit by {}, seen by way of {} (L ... D S+ E)", names, delta)};
  return {fmt::format("anything lit by {}", names)};
}

/// Lights of which the method never draws what it does not aim at.
unsigned never_found(const Integrator& method, const SceneOptics& scene) {
  if (method.merges_everywhere()) return 0;
  return counts_chance_hits(method) ? scene.lights & ~HITTABLE : scene.lights;
}

/// Whether paths of a class remain where those with all of `gained` in common are taken out.
bool gains(unsigned gained, unsigned paths, const SceneOptics& scene) {
  if (gained & (FIRST_DELTA | LAST_DELTA)) return occurs(paths, scene);
  if ((gained & ALL_NARROW) && (scene.lobes & LOBE_SPREAD)) return occurs(paths, scene);
  return (gained & ISOLATED_SPREAD) && occurs(paths, scene, 1);
}

uint packed_lobes(const PackedScene& scene, const ::Material& material) {
  if (material.kind != MATERIAL_MIX) return material.survive > 0.0f ? material.lobes : 0u;
  uint lobes = 0;
  for (uint i = 0; i < material.part_count; ++i)
    lobes |= packed_lobes(scene, scene.materials[material.first_part + i]) & ~LOBE_NARROW;
  return lobes | (lobes & LOBE_SPREAD ? material.lobes & LOBE_NARROW : 0u);
}

/// A surface's spread lobes are wide, or all narrow.
uint scattering_lobes(const PackedScene& scene, const ::Material& material) {
  const uint lobes = packed_lobes(scene, material);
  return lobes & LOBE_NARROW ? lobes & ~LOBE_SPREAD : lobes;
}

}  // namespace

SceneOptics optics_of(const PackedScene& scene, std::optional<unsigned> max_depth) {
  SceneOptics optics;
  optics.max_depth = max_depth;
  for (uint i = 0; i < scene.info.light_count; ++i) {
    const ::Light& light = scene.lights[i];
    const bool shines = light.value.x > 0.0f || light.value.y > 0.0f || light.value.z > 0.0f;
    if (shines && light.prob_pick > 0.0f) optics.lights |= 1u << light.kind;
  }
  if (scene.info.root == REF_EMPTY) return optics;  // its arrays hold a filler each
  for (const ::Shape& shape : scene.shapes)
    optics.lobes |= scattering_lobes(scene, scene.materials[shape.material]);
  return optics;
}

std::vector<std::string> unreachable_paths(const Integrator& method, const SceneOptics& scene) {
  return describe(not_aimed_at(method), never_found(method, scene), scene);
}

double least_effective(const Integrator& method, const SceneOptics& scene) {
  constexpr double enough_hits = 300;
  return chance_paths(method, scene).empty() ? 0 : enough_hits;
}

std::vector<std::string> chance_paths(const Integrator& method, const SceneOptics& scene) {
  if (method.merges_everywhere()) return {};
  return describe(not_aimed_at(method), scene.lights & EMITTERS & ~never_found(method, scene),
                  scene);
}

Seers seers_of_unreachable(const Integrator& method, const SceneOptics& scene,
                           const std::vector<Integrator>& among) {
  Seers seers;
  const unsigned paths = not_aimed_at(method), lights = never_found(method, scene);
  if (!lights || !occurs(paths, scene)) return seers;
  for (const Integrator& other : among) {
    const unsigned rest = paths | not_aimed_at(other);  // what both fail to aim at
    const unsigned gained = rest & ~paths;  // connections alone need a second D to gain anything
    const unsigned dark = lights & never_found(other, scene);
    if (!dark || !occurs(rest, scene)) {
      seers.all.push_back(other.name);
    } else if (dark != lights || gains(gained, paths, scene)) {
      seers.some.push_back(other.name);
    }
  }
  return seers;
}

std::vector<std::string> blind_spots(const Integrator& method, const SceneOptics& scene,
                                     const std::vector<Integrator>& among) {
  const Seers seers = seers_of_unreachable(method, scene, among);
  std::string who;
  if (!seers.all.empty()) who += fmt::format("; {} can", join(seers.all));
  if (!seers.some.empty()) who += fmt::format("; {} can in part", join(seers.some));
  if (who.empty()) who = "; no method here can";
  std::vector<std::string> sentences;
  const unsigned holds = method.merges_everywhere() ? LOBE_SPREAD | LOBE_NARROW : LOBE_SPREAD;
  if (method.wishes.has(INTG_MERGE) && !(scene.lobes & holds))
    sentences.push_back(fmt::format(
        "'{}' merges nothing here: no surface scatters {}, so none holds photons", method.name,
        holds & LOBE_NARROW ? "but by delta lobes"
                            : fmt::format("wider than roughness {:g}", std::sqrt(ALPHA_GATHER))));
  for (const std::string& what : unreachable_paths(method, scene))
    sentences.push_back(fmt::format("'{}' cannot see {}{}", method.name, what, who));
  return sentences;
}

}  // namespace pellucid
