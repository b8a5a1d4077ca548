// What a render leaves behind beside its pixels: evidence in the image, statistics as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cl/device.h"
#include "integrators/reach.h"
#include "render/checkpoint.h"
#include "render/session.h"
#include "scene/scene.h"

namespace pellucid {

/// Everything the report tells about a finished (or stopped) render.
struct RenderFacts {
  const Scene* scene = nullptr;
  const PackedScene* packed = nullptr;
  const Integrator* integrator = nullptr;
  const DeviceInfo* device = nullptr;
  const Session* session = nullptr;
  RenderOptions options;
  std::string scene_hash, kernels_hash;
  FilmSummary film;
  double render_seconds = 0;  ///< of all passes of the film, those of earlier runs included

  /// What decides which paths the method can see. Needs the scene packed.
  SceneOptics optics() const { return optics_of(*packed, options.max_depth); }
};

/// Everything that changes what is rendered and is no matter of effort.
std::string settings_text(const Scene& scene, const RenderOptions& options);

using Evidence = std::map<std::string, MetaValue>;

/// EXR attributes that do not change while a render goes on: worldToCamera, ... and pellucid:*.
Evidence lasting_evidence(const RenderFacts& facts);

/// Those that tell what a film is made of: samplesPerPixel, pellucid:passes, counters, depthCut,
/// error, renderTimeSeconds.
void add_progress(const Film& film, const FilmSummary& summary,
                  const std::vector<Counter>& counters, const DepthCuts& cuts, double seconds,
                  Evidence& evidence);

/// pellucid:relmseUpper and pellucid:relmseConfidence, if they are known of just this film.
void add_error(const Film& film, const ErrorEstimate& error, Evidence& evidence);

/// What add_error() left in a checkpoint: a bound of the root of relMSE of its film.
std::optional<double> known_error(const Evidence& evidence);

/// Whole sentences on what no estimate of the noise can know in this render.
std::vector<std::string> error_unknown(const RenderFacts& facts);

/// "error of 1 % reached: ..."
std::string error_verdict(const ErrorEstimate& error);

/// Takes out time, host and device, for files that must be the same wherever they are made.
void make_deterministic(Evidence& evidence);

/// Shares by kind of path that a cap cut off; empty without a cap.
nlohmann::json cuts_json(const DepthCuts& cuts);

/// What must agree for checkpoints to be of the same picture.
std::map<std::string, std::string> identity(const RenderFacts& facts);

/// "balance", "power" or "max".
const char* mis_name(uint mis);

/// The document of --stats and --json.
nlohmann::json render_stats(const RenderFacts& facts);

}  // namespace pellucid
