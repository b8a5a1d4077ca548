// Reachability against brute force: every word of scatterings, every strategy, every method's
// flags; and what of a packed scene counts.
#include <gtest/gtest.h>

#include <algorithm>

#include "integrators/reach.h"
#include "integrators/registry.h"
#include "support/test_scenes.h"

namespace pellucid {
namespace {

using test::add_shape;
using test::empty_scene;

/// The flags that tell methods apart, `light` and `bdpt` included, whatever the registry has.
std::vector<Integrator> methods() {
  return {{"naive", "", {}, false, {}},
          {"reference", "", {INTG_UNIFORM}, false, {}},
          {"nee", "", {INTG_NEE}, false, {}},
          {"path", "", {INTG_NEE, INTG_MIS}, true, {}},
          {"light", "", {INTG_SPLAT}, false, {}},
          {"unconnected", "", {INTG_NEE, INTG_SPLAT, INTG_MIS}, true, {}},
          {"bdpt", "", {INTG_NEE, INTG_SPLAT, INTG_CONNECT, INTG_MIS}, true, {}},
          {"sppm", "", {INTG_NEE, INTG_MIS, INTG_MERGE}, true, {}},
          {"bpm", "", {INTG_MERGE}, true, {}},
          {"vcm", "", {INTG_NEE, INTG_SPLAT, INTG_CONNECT, INTG_MIS, INTG_MERGE}, true, {}}};
}

constexpr unsigned DELTA_LIGHTS = 1u << LIGHT_POINT | 1u << LIGHT_SPOT | 1u << LIGHT_DIRECTIONAL;

/// Scatterings from the light to the camera: 'D', 'N' (one whose lobes are all narrow) or 'S'.
using Word = std::string;

/// Those with a D or N, of lobes that the scene has, no longer than allowed. 7 letters hold the
/// shortest words of each combination of ends and neighbours, and room beyond.
std::vector<Word> words(const SceneOptics& scene) {
  std::vector<Word> all{""}, result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Word word = all[i];
    if (word.find_first_of("DN") != Word::npos) result.push_back(word);
    if (word.size() + 1 >= std::min(scene.max_depth.value_or(8), 8u)) continue;
    if (scene.lobes & LOBE_SPREAD) all.push_back(word + 'D');
    if (scene.lobes & LOBE_NARROW) all.push_back(word + 'N');
    if (scene.lobes & LOBE_DELTA) all.push_back(word + 'S');
  }
  return result;
}

/// Whether merging draws such paths. With NEE and without connections (`sppm`) it is at wide lobes
/// alone.
bool merges(const Integrator& m, const Word& word) {
  const bool everywhere = m.wishes.has(INTG_CONNECT) || !m.wishes.has(INTG_NEE);
  return m.wishes.has(INTG_MERGE) && word.find_first_of(everywhere ? "DN" : "D") != Word::npos;
}

/// Whether the strategy that draws s vertices from the light draws such paths: walks do what they
/// like, the edge that joins them needs densities at both ends.
bool draws(const Integrator& m, unsigned light, const Word& word, std::size_t s) {
  const std::size_t t = word.size() + 2 - s;
  const bool nee = m.wishes.has(INTG_NEE), splat = m.wishes.has(INTG_SPLAT);
  if (s == 0)
    return !(light & DELTA_LIGHTS) && (nee || !splat || word.find_first_of("DN") == Word::npos);
  if (t == 0 || (s == 1 && t == 1)) return false;
  if (s == 1 && !nee) return false;
  if (t == 1 && !splat) return false;
  if (s > 1 && t > 1 && !m.wishes.has(INTG_CONNECT)) return false;
  const bool light_end = s == 1 || word[s - 2] != 'S', eye_end = t == 1 || word[s - 1] != 'S';
  return light_end && eye_end;
}

bool aims(const Integrator& m, unsigned light, const Word& word) {
  if (merges(m, word)) return true;
  for (std::size_t s = 1; s <= word.size() + 1; ++s)
    if (draws(m, light, word, s)) return true;
  return false;
}

bool sees(const Integrator& m, unsigned light, const Word& word) {
  return draws(m, light, word, 0) || aims(m, light, word);
}

struct Truth {
  bool unreachable = false, by_chance = false;
  std::vector<std::string> all, some;
};

Truth brute_force(const Integrator& method, const SceneOptics& scene) {
  Truth truth;
  const std::vector<Integrator> among = methods();
  std::vector<bool> sees_all(among.size(), true), sees_some(among.size(), false);
  for (unsigned kind = LIGHT_TRIANGLE; kind <= LIGHT_SPOT; ++kind) {
    const unsigned light = 1u << kind;
    if (!(scene.lights & light)) continue;
    for (const Word& word : words(scene)) {
      if (sees(method, light, word)) {
        truth.by_chance |= !aims(method, light, word) && kind != LIGHT_ENVIRONMENT;
        continue;
      }
      truth.unreachable = true;
      for (std::size_t i = 0; i < among.size(); ++i) {
        const bool seen = sees(among[i], light, word);
        sees_all[i] = sees_all[i] && seen;
        sees_some[i] = sees_some[i] || seen;
      }
    }
  }
  for (std::size_t i = 0; i < among.size() && truth.unreachable; ++i) {
    if (sees_all[i]) truth.all.push_back(among[i].name);
    if (sees_some[i] && !sees_all[i]) truth.some.push_back(among[i].name);
  }
  return truth;
}

TEST(Reach, AgreesWithBruteForceOverAllPaths) {
  int unreachable = 0, by_chance = 0;
  for (unsigned lights = 0; lights < 1u << (LIGHT_SPOT + 1); ++lights)
    for (unsigned lobes : {0u, LOBE_DELTA, LOBE_SPREAD, LOBE_DELTA | LOBE_SPREAD,
                           LOBE_DELTA | LOBE_NARROW, LOBE_DELTA | LOBE_SPREAD | LOBE_NARROW})
      for (unsigned depth = 0; depth <= 6; ++depth) {  // 0: unlimited
        const SceneOptics scene{lights, lobes, depth ? std::optional(depth) : std::nullopt};
        for (const Integrator& m : methods()) {
          SCOPED_TRACE(m.name + ", lights " + std::to_string(lights) + ", lobes " +
                       std::to_string(lobes) + ", depth " + std::to_string(depth));
          const Truth truth = brute_force(m, scene);
          ASSERT_EQ(!unreachable_paths(m, scene).empty(), truth.unreachable);
          ASSERT_EQ(!chance_paths(m, scene).empty(), truth.by_chance);
          const Seers seers = seers_of_unreachable(m, scene, methods());
          ASSERT_EQ(seers.all, truth.all);
          ASSERT_EQ(seers.some, truth.some);
          unreachable += truth.unreachable, by_chance += truth.by_chance;
        }
      }
  EXPECT_GT(unreachable, 1000);
  EXPECT_GT(by_chance, 1000);
}

struct Row {
  const char* method;
  unsigned light;
  unsigned depth;  ///< the smallest at which something is out of reach; 0: never
  const char* what;
};

// The same for people: which class, and from which depth on, where D and S surfaces are.
TEST(Reach, NamesTheClass) {
  const unsigned point = 1u << LIGHT_POINT, ball = 1u << LIGHT_SPHERE;
  const Row rows[] = {{"naive", point, 2, "anything lit by point lights"},
                      {"reference", point, 2, "anything lit by point lights"},
                      {"nee", point, 3, "light of point lights that first meets a mirror"},
                      {"path", point, 3, "(L S+ D ... E)"},
                      {"light", point, 3, "surfaces lit by point lights, seen by way of a mirror"},
                      {"bdpt", point, 4, "caustics of point lights, seen by way of a mirror"},
                      {"bdpt", point | ball, 4, "caustics of point lights, seen"},
                      {"light", point | ball, 3, "(L ... D S+ E)"},
                      {"light", ball, 3, "surfaces lit by emitting surfaces, seen"},
                      {"naive", ball, 0, ""},
                      {"path", ball, 0, ""},
                      {"bdpt", ball, 0, ""},
                      {"sppm", point, 0, ""},
                      {"vcm", point, 0, ""}};
  for (const Row& row : rows) {
    SCOPED_TRACE(row.method);
    for (const Integrator& m : methods())
      for (unsigned depth = 1; m.name == row.method && depth <= 5; ++depth) {
        const auto got = unreachable_paths(m, {row.light, LOBE_DELTA | LOBE_SPREAD, depth});
        ASSERT_EQ(got.size(), row.depth && depth >= row.depth ? 1u : 0u) << depth;
        for (const std::string& text : got)
          EXPECT_NE(text.find(row.what), std::string::npos) << text;
      }
  }
}

TEST(Reach, TellsWhoSeesIt) {
  const SceneOptics scene{1u << LIGHT_POINT, LOBE_DELTA | LOBE_SPREAD, {}};
  SceneOptics shallow = scene;
  shallow.max_depth = 3;
  const auto sentence = [](const char* name, const SceneOptics& s) {
    for (const Integrator& m : methods())
      if (m.name == name) return blind_spots(m, s, methods()).at(0);
    return std::string();
  };
  const auto ends_with = [](const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
  };
  EXPECT_EQ(sentence("naive", shallow).find("'naive' cannot see anything lit by point lights; "),
            0u);
  EXPECT_PRED2(ends_with, sentence("naive", shallow),
               "; unconnected, bdpt, sppm, bpm, vcm can; nee, path, light can in part");
  EXPECT_PRED2(ends_with, sentence("path", shallow),
               "; light, unconnected, bdpt, sppm, bpm, vcm can");
  EXPECT_PRED2(ends_with, sentence("path", scene),
               "; sppm, bpm, vcm can; light, unconnected, bdpt can in part");
  EXPECT_PRED2(ends_with, sentence("bdpt", scene), "; sppm, bpm, vcm can");
  const Integrator path = methods()[3];
  EXPECT_PRED2(ends_with, blind_spots(path, scene, {path}).at(0), "; no method here can");
}

TEST(Reach, TellsThatNothingHoldsPhotons) {
  const unsigned point = 1u << LIGHT_POINT;
  const auto told = [](const char* name, const SceneOptics& scene) {
    for (const Integrator& m : methods())
      if (m.name == name)
        for (const std::string& text : blind_spots(m, scene, methods()))
          if (text.find("merges nothing") != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(told("sppm", {point, LOBE_DELTA, {}}));
  EXPECT_TRUE(told("sppm", {point, LOBE_NARROW, {}}));
  EXPECT_FALSE(told("sppm", {point, LOBE_SPREAD, {}}));
  EXPECT_TRUE(told("vcm", {point, LOBE_DELTA, {}}));
  EXPECT_FALSE(told("vcm", {point, LOBE_NARROW, {}}));
  EXPECT_FALSE(told("path", {point, LOBE_DELTA, {}}));
}

// ---- what of a scene counts

unsigned lights_of(const Scene& scene) {
  return optics_of(pack_scene(scene, {8}), {}).lights;
}

TEST(Optics, LightsThatShine) {
  Scene scene = empty_scene();
  add_shape(scene, Sphere{});
  EXPECT_EQ(lights_of(scene), 0u);
  scene.lights = {PointLight{{0, 0, 3}, Rgb(0.0)}};
  EXPECT_EQ(lights_of(scene), 0u) << "black, and nobody shines beside it";
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0)});
  EXPECT_EQ(lights_of(scene), 1u << LIGHT_ENVIRONMENT) << "black, beside another";
  scene.lights[0] = PointLight{{0, 0, 3}, Rgb(0.0, 0.0, 1.0)};
  EXPECT_EQ(lights_of(scene), 1u << LIGHT_ENVIRONMENT | 1u << LIGHT_POINT);
  scene.shapes[0].emission = Emission{Rgb(1.0), 1};
  EXPECT_EQ(lights_of(scene), 1u << LIGHT_ENVIRONMENT | 1u << LIGHT_POINT | 1u << LIGHT_SPHERE);
}

Material of_kind(MaterialKind kind, double reflectance = 0.5) {
  Material m;
  m.kind = kind;
  m.reflectance = Rgb(reflectance);
  return m;
}

unsigned lobes_of(const std::vector<Material>& materials, bool with_shape = true) {
  Scene scene = empty_scene();
  scene.materials = materials;
  if (with_shape) add_shape(scene, Sphere{});  // of the first material
  return optics_of(pack_scene(scene, {8}), {}).lobes & (LOBE_DELTA | LOBE_SPREAD);
}

TEST(Optics, LobesOfSurfaces) {
  const Material grey = of_kind(MaterialKind::diffuse), mirror = of_kind(MaterialKind::mirror);
  const Material black = of_kind(MaterialKind::diffuse, 0), dark = of_kind(MaterialKind::mirror, 0);
  EXPECT_EQ(lobes_of({grey}), LOBE_SPREAD);
  EXPECT_EQ(lobes_of({grey, mirror}), LOBE_SPREAD) << "nothing is made of the mirror";
  EXPECT_EQ(lobes_of({mirror, grey}), LOBE_DELTA);
  EXPECT_EQ(lobes_of({mirror}, false), 0u);
  EXPECT_EQ(lobes_of({black}), 0u);
  EXPECT_EQ(lobes_of({dark}), 0u);
  EXPECT_EQ(lobes_of({of_kind(MaterialKind::plastic)}), LOBE_DELTA | LOBE_SPREAD);
  EXPECT_EQ(lobes_of({of_kind(MaterialKind::dielectric)}), LOBE_DELTA);
  Material mix = of_kind(MaterialKind::mix);
  for (const Material* part : {&black, &mirror, &dark}) {
    mix.parts.push_back(*part);
    mix.parts.back().weight = 1.0 / 3;
  }
  EXPECT_EQ(lobes_of({mix}), LOBE_DELTA) << "black parts do nothing";
  mix.parts[0] = grey;
  mix.parts[0].weight = 1.0 / 3;
  EXPECT_EQ(lobes_of({mix}), LOBE_DELTA | LOBE_SPREAD);
}

// Of the methods that there are, each says what it is blind to, and somebody sees plain light.
TEST(Reach, RegistryIsSound) {
  const SceneOptics plain{DELTA_LIGHTS, LOBE_SPREAD, {}};
  for (const Integrator& m : integrators()) {
    const bool chance_alone = !m.wishes.has(INTG_NEE) && !m.walks_from_lights();
    EXPECT_EQ(unreachable_paths(m, plain).empty(), !chance_alone) << m.name;
    const Seers seers = seers_of_unreachable(m, plain, integrators());
    EXPECT_EQ(!seers.all.empty(), chance_alone) << m.name;
    EXPECT_TRUE(seers.some.empty()) << m.name;
  }
}

}  // namespace
}  // namespace pellucid
