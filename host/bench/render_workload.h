// The fixed work of `bench --only render`: what its figures and scores are figures of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pellucid {

/// To be raised with every change of what follows, of the scenes, or of what a score means: figures
/// are compared under this name (tests/unit/bench_workload_test.cpp).
constexpr const char* RENDER_WORKLOAD = "render-2";

struct RenderWorkload {
  const char* scene;
  const char* trait;  ///< what is hard about it
};

/// One shipped scene for every trait that sets methods apart.
const std::vector<RenderWorkload>& render_workloads();

/// Passes of a run. Methods whose passes take longer have fewer, so that all take about as long:
/// errors then need no long way to equal time.
std::uint64_t workload_spp(const std::string& method);

constexpr int WORKLOAD_SIZE = 64;                       ///< pixels per side
constexpr std::uint64_t WORKLOAD_REFERENCE_SPP = 4096;  ///< of a scene's referee
/// Share of the default radius that the referee merges within, where it does: its bias has to be
/// small beside that of the methods.
constexpr double WORKLOAD_REFERENCE_RADIUS = 0.25;
/// A score counts pictures of this error: 10 % of noise.
constexpr double SCORE_RELMSE = 0.01;

}  // namespace pellucid
