// What a render leaves behind beside its pixels: evidence in the image, statistics as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cl/device.h"
#include "render/session.h"
#include "scene/scene.h"

namespace pellucid {

/// Where the wall time went, in seconds.
struct RenderSeconds {
  double load = 0, bvh = 0, kernels = 0, render = 0, write = 0, total = 0;
};

/// Everything the report tells about a finished (or stopped) render.
struct RenderFacts {
  const Scene* scene = nullptr;
  const PackedScene* packed = nullptr;
  const Integrator* integrator = nullptr;
  const DeviceInfo* device = nullptr;
  const Session* session = nullptr;
  RenderOptions options;
  std::string scene_hash;
  FilmSummary film;
  RenderSeconds seconds;
};

/// EXR attributes: samplesPerPixel, worldToCamera, ... and pellucid:*. `deterministic` leaves out
/// time, host and device.
void add_evidence(const RenderFacts& facts, bool deterministic, Image& image);

/// The document of --stats and --json.
nlohmann::json render_stats(const RenderFacts& facts);

}  // namespace pellucid
