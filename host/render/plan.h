// A plan: an integrator's passes made ready on a device: buffers allocated, kernels built and
// bound.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cl/device.h"
#include "cl/sources.h"
#include "pack/pack.h"
#include "render/depth_cut.h"
#include "render/diagnostics.h"
#include "render/film.h"
#include "render/integrator.h"
#include "render/launch.h"
#include "render/launch_parts.h"
#include "render/memory.h"
#include "render/options.h"
#include "render/specialise.h"

namespace pellucid {

/// Parameter names of a bundle, from the kernels' own list (kernels/shared/buffers.h).
std::vector<std::string> bundle_buffers(Bundle bundle);

/// All buffers of Bundle::scene and Bundle::filter, uploaded.
std::map<std::string, Buffer> upload_scene(Device& device, const PackedScene& scene);

/// Adds the device's counters to `counters` and clears them.
void collect_counters(Device& device, const Buffer& diag, std::vector<Counter>& counters);

/// The group asked for, or the default within what the kernel can: a large kernel may allow less
/// than its device does. Throws DeviceError.
std::size_t group_for(const Kernel& kernel, std::size_t asked);
/// The same for a kernel of a pass, within what its domain can have.
std::size_t group_for_pass(const Pass& pass, const Kernel& kernel, std::size_t asked);

struct PassState {
  Pass pass;
  Kernel kernel;
  std::size_t group = 1;      ///< work-items per group
  unsigned launch_index = 0;  ///< parameter index of the launch struct
  LaunchParts parts;
  std::shared_ptr<PassTime> time = std::make_shared<PassTime>();
};

/// Parameter names of a pass in order, as its kernel declares them.
std::vector<std::string> parameter_names(const Pass& pass);

/// Work-items that the launch of a pass is about, in groups of `group`.
std::size_t domain_size(Domain domain, const Launch& launch, std::size_t group);

/// What the kernels of this scene, method and device are specialised for.
Specialisation specialise(const PackedScene& scene, const Integrator& integrator,
                          const DeviceInfo& device, const PlanOptions& options);

class Plan {
 public:
  /// Uploads the scene, allocates the film of a tile (cleared) and builds all passes, code
  /// generation included, so that the first iteration is as fast as the last. Throws DeviceError.
  Plan(Device device, const PackedScene& scene, const Integrator& integrator,
       const RenderOptions& options, const MemoryPlan& memory);

  /// Enqueues one iteration over the launch's tile; methods that store vertices wait for parts of
  /// it. Throws DeviceError where those of one row of pixels exceed memory.
  void enqueue(Launch launch);
  void finish();

  /// The first `pixels` of the tile's film.
  void read_film(FilmPixel* film, std::size_t pixels);
  void write_film(const FilmPixel* film, std::size_t pixels);
  /// The tile's layers: `pixels` of them from `first` on.
  void read_layers(Layers& layers, std::size_t first, std::size_t pixels);
  void write_layers(const Layers& layers, std::size_t first, std::size_t pixels);
  /// What a buffer of whole words holds.
  std::vector<uint> read_words(const std::string& buffer);
  /// Adds the device's counters to `counters`, and to `cuts` what --max-depth cut off, and clears
  /// them.
  void collect(std::vector<Counter>& counters, DepthCuts& cuts);

  std::map<std::string, std::size_t> memory() const;
  const std::vector<PassState>& passes() const { return passes_; }
  const Specialisation& specialisation() const { return specialisation_; }

 private:
  /// One side's vertices of sub-paths.
  struct Side {
    std::string name;                               ///< in front of its buffers' names
    std::string trace;                              ///< the pass that makes them
    std::map<std::string, std::size_t> per_vertex;  ///< bytes by buffer
    std::size_t paths = 0;                          ///< most of a launch
    std::size_t capacity = 0;                       ///< vertices
    std::size_t bytes() const {
      std::size_t sum = 0;
      for (const auto& [buffer, each] : per_vertex) sum += each;
      return sum;
    }
  };

  void bind(PassState& state);
  void warm_up();
  void launch(PassState& state, Launch launch);
  PassState& pass_named(const std::string& name);
  // plan_slices.cpp
  void run_slices(Launch launch);
  void run_merging(Launch launch);
  void run_slice_passes(const Launch& launch, bool light_stage);
  void run_whole(Launch launch);
  void splat_paths(Launch launch, uint first, uint end);
  bool traces_side(const Pass& pass) const;
  std::array<uint, 2> take_vertex_counts();
  bool settle_vertices(Launch launch);
  uint settle_light(Launch launch);
  bool make_room(const std::array<uint, 2>& needed);
  void resize(const std::array<std::size_t, 2>& capacity);

  Device device_;
  PlanOptions options_;
  Specialisation specialisation_;
  SceneInfo scene_info_;
  ::Camera camera_;
  std::size_t tile_pixels_;
  std::uint64_t memory_limit_;
  uint slice_rows_ = 1;  ///< fewer where vertices would exceed memory
  bool merges_;          ///< needs the vertices of all light paths at once
  Merging merging_;
  uint grid_bits_;
  std::vector<Side> sides_;  ///< light, eye; empty for methods that store none
  std::map<std::string, Buffer> buffers_;
  std::vector<PassState> passes_;
};

}  // namespace pellucid
