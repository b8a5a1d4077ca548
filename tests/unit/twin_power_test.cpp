// CF11: what lights send into a black closed room with lossless things in it arrives on its walls,
// walk by walk, and is pi Le A for every side that emits.
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;
using pellucid::Emission;
using pellucid::Mesh;
using pellucid::Rgb;
using pellucid::Scene;

constexpr double pi_d = 3.14159265358979323846;

/// Material 0 is black; a lump of radius 4 is the room, with glass and mirrors inside.
Scene black_room() {
  Scene scene = empty_scene(0.0);
  pellucid::Material glass, mirror, pane;
  glass.kind = pellucid::MaterialKind::dielectric;
  mirror.kind = pellucid::MaterialKind::mirror;
  mirror.reflectance = Rgb(1.0);
  pane.kind = pellucid::MaterialKind::thin_dielectric;
  scene.materials.insert(scene.materials.end(), {glass, mirror, pane});
  Mesh walls = lump(500);
  for (glm::vec3& p : walls.positions) p *= 4.0f;
  add_shape(scene, walls);
  add_shape(scene, lump(200)).material = 1;
  add_shape(scene, pellucid::Sphere{{0, 1.5, 0}, 0.4}).material = 1;
  add_shape(scene, pellucid::Sphere{{1.5, 0, 0}, 0.5}).material = 2;
  add_shape(scene, pellucid::Disk{{-0.5, -1.2, 1}, {1, 2, 3}, 0.6}).material = 3;
  return scene;
}

struct Emitter {
  const char* name;
  std::variant<Mesh, pellucid::Sphere, pellucid::Disk> geometry;
  int sides;
  double area;
};

std::vector<Emitter> emitters() {
  const Mesh triangle = baked({{{-1.5, -1, 0}, {-1.5, 0, 0}, {-1.5, -1, 1}}, {}, {{0, 1, 2}}});
  return {{"triangle", triangle, 1, 0.5},
          {"triangle, both sides", triangle, 2, 0.5},
          {"sphere", pellucid::Sphere{{0, 0, 1.7}, 0.25}, 1, 4 * pi_d / 16},
          {"sphere, both sides", pellucid::Sphere{{0, 0, 1.7}, 0.25}, 2, 4 * pi_d / 16},
          {"disk", pellucid::Disk{{0, 0, -1.8}, {1, 0, 1}, 0.5}, 1, pi_d / 4},
          {"disk, both sides", pellucid::Disk{{0, 0, -1.8}, {1, 0, 1}, 0.5}, 2, pi_d / 4}};
}

/// Follows a walk to the wall that takes it; returns the power there over that at the start, or 0
/// if it is still on its way after `most` segments.
double arrives(const TwinScene& twin, Rng rng, PRIVATE LightWalk* w) {
  constexpr uint most = 400;
  Launch launch{};
  launch.max_depth = NONE;
  *w = light_walk_start(&twin.data, rng);
  const double start = double(w->walk.beta.x);
  Vertex v;
  while (w->depth < most) {
    if (!light_walk_next(&twin.data, {}, w, &v)) return -1;  // through the wall, or gone in silence
    if (!bsdf_is_delta(v.material)) return double(w->walk.beta.x) / start;
    if (!walk_scatter(&twin.data, launch, rng, DIM_LIGHT_WALK_BSDF(w->depth - 1u), &v, &w->walk))
      return -1;
  }
  return 0;
}

TEST(TwinPower, AllOfItArrives) {
  constexpr uint n = 20000;
  constexpr double le = 2;
  for (const Emitter& e : emitters()) {
    Scene scene = black_room();
    add_shape(scene, e.geometry).emission = Emission{Rgb(le), e.sides};
    const TwinScene twin(scene);
    double sum = 0, gain = 0;
    uint caught = 0, scattered = 0;
    for (uint i = 0; i < n; ++i) {
      Rng rng{};
      rng.path = i;
      rng.seed = 3;
      LightWalk w;
      const double share = arrives(twin, rng, &w);
      caught += share == 0;
      scattered += w.depth > 1;
      sum += double(w.walk.beta.x) / n;
      if (share == 0) continue;
      // Lobes weigh exactly 1; quotients of cosines, which undo each other, are rounded, the more
      // the smaller they are.
      EXPECT_NEAR(share, 1.0, is_float ? 1e-3 : 1e-11) << e.name;
      gain += (share - 1) / n;
    }
    EXPECT_NEAR(gain, 0, is_float ? 1e-6 : 1e-14) << e.name;
    // Total reflection in the ball of glass catches none that comes from outside; in the lump few.
    EXPECT_LT(caught, n / 1000) << e.name;
    EXPECT_GT(scattered, n / 20) << e.name << ": little has met glass or a mirror";
    // Every walk of a single light carries the same power, up to a few roundings.
    EXPECT_NEAR(sum / (pi_d * le * e.area * e.sides), 1.0, is_float ? 1e-5 : 1e-7) << e.name;
  }
}

// Several lights: each walk carries what its light has over the probability of the pick.
TEST(TwinPower, LightsShareTheWalks) {
  constexpr uint n = 100000;
  Scene scene = black_room();
  double power = 0, le = 1;
  for (const Emitter& e : emitters()) {
    if (e.sides == 2) continue;  // they stand in the same places
    add_shape(scene, e.geometry).emission = Emission{Rgb(le, 1, 1), 1};
    power += pi_d * le * e.area;
    le *= 4;
  }
  const TwinScene twin(scene);
  Moments arrived;
  for (uint i = 0; i < n; ++i) {
    Rng rng{};
    rng.path = i;
    rng.seed = 4;
    LightWalk w;
    const double share = arrives(twin, rng, &w);
    EXPECT_GE(share, 0);
    arrived.add(double(w.walk.beta.x));
  }
  EXPECT_GT(z_test(arrived, power, 1e-5 * power), family_alpha)
      << arrived.mean << " +- " << arrived.standard_error() << ", exact " << power;
  EXPECT_LT(arrived.standard_error(), 0.005 * power);
}

}  // namespace
