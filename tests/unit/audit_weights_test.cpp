// Self-auditing MIS (numerics 6): real walks in rooms of all materials and lights are joined in
// every way; each path's recursive weights are compared with the densities of all its strategies
// multiplied out in double, and must add up to 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "support/audit_replay.h"
#include "support/audit_scenes.h"

namespace {

using namespace twin;
using namespace pellucid::test;

/// Double: rounding of some hundred operations. Float: the same; what it loses in cosines, squared
/// distances and densities of rough lobes is of the order of 1e-6 each. Photons are kept as floats.
constexpr double tolerance = is_float ? 1e-4 : merges ? 1e-5 : 1e-9;
/// Below this |cosine| or share of the room, float knows directions to less than the tolerance.
constexpr double graze = 1e-2;
/// Most of all paths that may be left out as grazing: 1.3 to 1.7 % are.
constexpr double grazing_share = 0.03;

class Audit {
 public:
  Audit(const TwinScene& twin, const Launch& launch) : twin_(twin), launch_(launch) {}

  void operator()(const FullPath& path) {
    if (path.nodes.empty()) {
      EXPECT_EQ(double(path.weight), 1.0) << "seen directly by nothing but strategy 0";
      return;
    }
    ++found_;
    if (grazes(path)) {
      ++grazing_;
      return;
    }
    note_kinds(path);
    const std::vector<double> exact =
        weights_of(launch_.mis, PathDensities(twin_, launch_, path).all());
    // `bpm` never connects, but paths that are connected serve as well for replays.
    if (connects || path.s == 0)
      note(worst_found_, std::abs(exact[path.s] - double(path.weight)), path, "found");
    const FullPath straight = straightened(twin_, path);
    if (on_rim(straight))
      ++on_rim_;
    else
      replay(straight);
  }

  void report(const char* name) const {
    const double share = double(grazing_) / found_;
    std::printf(
        "%s, %s: %d paths (%.2g %% grazing, %d on a rim), worst error of the weight found %.2g, of "
        "replayed "
        "weights %.2g, of their sum %.2g\n",
        name, launch_.mis == MIS_POWER ? "power" : "balance", found_, 100 * share, on_rim_,
        worst_found_, worst_replay_, worst_sum_);
    EXPECT_LT(worst_found_, tolerance);
    EXPECT_LT(worst_replay_, tolerance);
    EXPECT_LT(worst_sum_, std::min(tolerance, 1e-5));  // numerics 6
    EXPECT_LT(share, grazing_share);
    EXPECT_LE(on_rim_, is_float ? 4 : 0);
    if (!merges) return;
    std::printf("  merges have %.2g of the weights\n", merged_ / replayed_);
    EXPECT_GT(merged_ / replayed_, 0.1);  // both matter, over all radii
    EXPECT_LT(merged_ / replayed_, 0.9);
  }

  /// Counts of what the audited paths were made of.
  std::map<std::pair<uint, int>, int> lights;      ///< kind; 0 chance, 1 NEE, 2 connected, 3 splat
  std::map<std::pair<uint, bool>, int> materials;  ///< kind, delta
  std::map<std::size_t, int> lengths;              ///< segments

 private:
  bool grazes(const FullPath& path) const {
    const PathDensities d(twin_, launch_, path);
    for (std::size_t i = 0; i <= path.nodes.size(); ++i) {
      if (i == 0 && d.light_is_surface() && d.cosine(0, 0) < graze) return true;
      if (!(i == 0 && d.light_at_infinity()) && d.distance2(i) < graze * graze) return true;
      if (i > 0 && (d.cosine(i, i - 1) < graze || d.cosine(i, i) < graze)) return true;
    }
    return false;
  }
  /// Rough glass transmits nothing beyond its half vectors' horizon, where lobes end in 0: there
  /// rounding may tell ends of the same path apart.
  bool on_rim(const FullPath& path) const {
    for (std::size_t i = 0; i < path.nodes.size(); ++i) {
      if (path.nodes[i].delta) continue;
      const real3 ends[] = {path.edges[i + 1], -path.edges[i]};
      bool brings[2];
      for (int importance : {0, 1}) {
        const Vertex v =
            vertex_at(&twin_.data, path.nodes[i].surface, ends[importance], importance);
        brings[importance] = !is_black(vertex_eval(&twin_.data, &v, ends[1 - importance]).f);
      }
      if (brings[0] != brings[1]) return true;
    }
    return false;
  }
  void note_kinds(const FullPath& path) {
    const std::size_t k = path.nodes.size();
    ++lights[{twin_.packed.lights[path.light].kind, path.s < 2        ? int(path.s)
                                                    : path.s == k + 1 ? 3
                                                                      : 2}];
    ++lengths[k + 1];
    for (const PathNode& node : path.nodes)
      ++materials[{twin_.packed.materials[node.surface.material].kind, node.delta}];
  }
  void replay(const FullPath& path) {
    const std::vector<double> exact =
        weights_of(launch_.mis, PathDensities(twin_, launch_, path).all());
    const Replay again(twin_, launch_, path);
    double sum = 0;
    for (std::size_t s = 0; s < exact.size(); ++s) {
      const double w = double(again.weight(s));
      if (s >= path.nodes.size() + 2) merged_ += exact[s];
      note(worst_replay_, std::abs(exact[s] - w), path, "replayed");
      sum += w;
    }
    note(worst_sum_, std::abs(sum - 1), path, "sum");
    ++replayed_;
  }
  void note(double& worst, double error, const FullPath& path, const char* what) {
    if (!(error < tolerance) && !(worst >= tolerance)) describe(path, error, what);
    if (!(error <= worst)) worst = error;  // also NaN
  }
  void describe(const FullPath& path, double error, const char* what) const {
    std::string text;
    for (const PathNode& node : path.nodes)
      text += " " + std::to_string(twin_.packed.materials[node.surface.material].kind) +
              (node.delta ? "d" : "");
    const std::vector<double> exact =
        weights_of(launch_.mis, PathDensities(twin_, launch_, path).all());
    const Replay again(twin_, launch_, path);  // of edges as they are
    for (std::size_t s = 0; s < exact.size(); ++s)
      text += "\n  s " + std::to_string(s) + ": exact " + std::to_string(exact[s]) + " replayed " +
              std::to_string(double(again.weight(s)));
    ADD_FAILURE() << what << ": off by " << error << ", found by s = " << path.s << " with "
                  << double(path.weight) << ", light of kind "
                  << twin_.packed.lights[path.light].kind << ", materials" << text;
  }

  const TwinScene& twin_;
  const Launch& launch_;
  int found_ = 0, grazing_ = 0, on_rim_ = 0, replayed_ = 0;
  double merged_ = 0;  ///< weight of merges, over all replays
  double worst_found_ = 0, worst_replay_ = 0, worst_sum_ = 0;
};

/// Merging finds as much as other strategies somewhere between: powers of two, whose inverses are
/// exact as floats.
constexpr float merging[] = {0x1p-20f, 0x1p-10f, 0x1p-5f, 0x1p-2f, 1, 0x1p2f, 0x1p7f, 0x1p20f};

Launch launch_of(uint heuristic) {
  Launch launch{};
  launch.width = launch.height = 32;
  launch.seed = 99;
  launch.max_depth = 12;
  launch.mis = heuristic;
  launch.light_paths = 700;  // not the number of pixels
  return launch;
}

void expect_all_kinds(Audit& audit, bool open) {
  for (uint kind = LIGHT_TRIANGLE; kind <= LIGHT_SPOT; ++kind) {
    if (!open && (kind == LIGHT_DIRECTIONAL || kind == LIGHT_ENVIRONMENT)) continue;
    const bool delta = kind == LIGHT_POINT || kind == LIGHT_SPOT || kind == LIGHT_DIRECTIONAL;
    for (int how = delta ? 1 : 0; how < 4; ++how)
      if (how != 1 || samples_lights) {
        EXPECT_GT((audit.lights[{kind, how}]), 10) << "light kind " << kind << ", strategy " << how;
      }
  }
  for (uint kind = 0; kind <= MATERIAL_MIX; ++kind) {
    const bool only_delta = kind == MATERIAL_MIRROR || kind == MATERIAL_CONDUCTOR ||
                            kind == MATERIAL_DIELECTRIC || kind == MATERIAL_THIN_DIELECTRIC;
    if (!only_delta) {
      EXPECT_GT((audit.materials[{kind, false}]), 100) << "material " << kind;
    }
    if (only_delta || kind == MATERIAL_PLASTIC || kind == MATERIAL_MIX) {
      EXPECT_GT((audit.materials[{kind, true}]), 100) << "material " << kind;
    }
  }
  for (std::size_t n = 2; n <= 12; ++n) EXPECT_GT(audit.lengths[n], 100) << n << " segments";
}

/// The walks go on wherever they are scattered, by dark texels, too.
void turn_off_roulette(pellucid::PackedScene& packed) {
  for (::Material& m : packed.materials)
    if (m.survive > 0) m.survive = m.untextured = 1;
}

void audit(const char* name, bool open, uint heuristic, bool roulette = true) {
  TwinScene twin(audit_room(open));
  if (!roulette) turn_off_roulette(twin.packed);
  Launch launch = launch_of(heuristic);
  Audit audit(twin, launch);
  int scattered = 0, at_risk = 0;  // vertices; those where roulette may end the walk
  const auto record = [&](const FullPath& path) { audit(path); };
  for (uint path = 0; path < 1024 * 8; ++path) {
    launch.iteration = path / 1024;
    if (merges) {
      launch.mis_vm = merging[launch.iteration];
      launch.mis_deep = 0.125f;
    }
    PathFinder<decltype(record)> finder(twin, launch, record);
    const real3 radiance = finder.run(path % 1024);
    for (int importance : {0, 1})
      for (const EndVertex& end : finder.ends(importance))
        ++scattered, at_risk += end.v.material.survive < 1;
    const Ray ray = finder.camera_ray_of(path % 1024);
    std::vector<StoredVertex> vertices(64);
    uint taken = 0, rays = 0;
    real cut;
    VertexStore store = vertex_store_at(vertices.data(), &taken, 64);
    const real3 whole =
        path_radiance(&twin.data, launch, {path % 1024, launch.iteration, launch.seed}, ray,
                      camera_pdf_w(twin.packed.camera, ray.d), &store, &rays, &cut);
    ASSERT_EQ(radiance.x, whole.x) << "the audited walk is not the one that renders";
  }
  audit.report(name);
  expect_all_kinds(audit, open);
  EXPECT_GT(at_risk, roulette ? scattered / 2 : -1);
  EXPECT_LE(at_risk, roulette ? scattered : 0) << "walks go on";
}

TEST(AuditWeights, ClosedRoomBalance) {
  audit("closed", false, MIS_BALANCE);
}
TEST(AuditWeights, ClosedRoomPower) {
  audit("closed", false, MIS_POWER);
}
TEST(AuditWeights, OpenRoomBalance) {
  audit("open", true, MIS_BALANCE);
}
TEST(AuditWeights, OpenRoomPower) {
  audit("open", true, MIS_POWER);
}
TEST(AuditWeights, WithoutRouletteBalance) {
  audit("closed, no roulette", false, MIS_BALANCE, false);
  audit("open, no roulette", true, MIS_BALANCE, false);
}
TEST(AuditWeights, WithoutRoulettePower) {
  audit("closed, no roulette", false, MIS_POWER, false);
  audit("open, no roulette", true, MIS_POWER, false);
}

}  // namespace
