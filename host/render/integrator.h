// An integrator is a table: what it asks of kernels and which passes make an iteration.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "pack/features.h"
#include "shared/layers.h"

namespace pellucid {

/// Bundles of kernels/shared/buffers.h, in the order of a kernel's parameters.
enum class Bundle {
  scene,
  filter,
  film,
  splat,
  light_vertices,
  eye_vertices,
  vertex_counts,
  grid,
  aov,
  layers,
  record,
  diag
};

/// What a pass has one work-item for. Tiles are cut into slices, rows of pixels with the light
/// paths that go with them, so that vertices of sub-paths need little memory. Passes over slices
/// come first, one slice after another; then those over the tile. Where vertices are merged, every
/// slice needs those of all light paths: what stands before camera_trace then runs once, for all.
enum class Domain {
  tile,         ///< pixels of the tile
  slice,        ///< pixels of the slice
  light_paths,  ///< light paths of the slice
  sub_paths,    ///< light paths and pixels of the slice
  sides,        ///< two work-groups: the light's side and the eye's
  photons,      ///< light vertices, or cells of the grid if these are more
  blocks,       ///< blocks of the photon sort
};

/// One kernel per iteration. `name` is the file passes/<name>.cl, its kernel, its timer and its row
/// in every report.
struct Pass {
  std::string name;
  std::vector<Bundle> bundles;  ///< parameters before the launch struct
  Domain domain = Domain::tile;
  bool gathers = false;  ///< adds to layers and to the record, where they are asked for
  uint digit = 0;        ///< of the photon sort
};

struct Integrator {
  std::string name;
  std::string summary;       ///< one line for --help
  FeatureSet wishes;         ///< INTG_* flags
  bool weighs = false;       ///< combines strategies, so --mis has an effect
  std::vector<Pass> passes;  ///< in order
  uint most_s = 0;           ///< most vertices of a path that are drawn from the light's end; from
                             ///< LAYER_LENGTH_MAX on any number
  uint layers = 0;           ///< set of layers that are kept (render/layers.h)

  bool walks_from_lights() const { return wishes.has(INTG_SPLAT) || wishes.has(INTG_MERGE); }
  /// At all vertices of eye paths, weighed against all strategies; `sppm` does so at one, where its
  /// eye paths end.
  bool merges_everywhere() const {
    return wishes.has(INTG_MERGE) && (wishes.has(INTG_CONNECT) || !wishes.has(INTG_NEE));
  }

  /// Names of the kernels, each once.
  std::vector<std::string> kernels() const {
    std::vector<std::string> names;
    for (const Pass& pass : passes)
      if (std::find(names.begin(), names.end(), pass.name) == names.end())
        names.push_back(pass.name);
    return names;
  }

  /// Gives a bundle to the passes that gather, in front of `diag`.
  void add_to_gathering(Bundle bundle) {
    for (Pass& pass : passes) {
      if (!pass.gathers) continue;
      const auto diag = std::find(pass.bundles.begin(), pass.bundles.end(), Bundle::diag);
      pass.bundles.insert(diag, bundle);
    }
  }

  bool uses(Bundle bundle) const {
    for (const Pass& pass : passes)
      if (std::find(pass.bundles.begin(), pass.bundles.end(), bundle) != pass.bundles.end())
        return true;
    return false;
  }
};

}  // namespace pellucid
