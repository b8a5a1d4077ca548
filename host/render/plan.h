// A plan: an integrator's passes made ready on a device: buffers allocated, kernels built and
// bound.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cl/device.h"
#include "cl/sources.h"
#include "pack/pack.h"
#include "render/diagnostics.h"
#include "render/film.h"
#include "render/integrator.h"
#include "render/sampler.h"
#include "render/specialise.h"

namespace pellucid {

/// Work-items per group where nothing else is asked for: enough that dispatch costs nothing on
/// CPUs.
constexpr std::size_t default_group = 64;

struct PlanOptions {
  Sampler sampler = Sampler::sobol;
  FeatureSet extra_features;  ///< on top of what the scene needs
  std::string kernel_dir;     ///< read kernels from here instead of the binary
  std::size_t group = 0;      ///< work-items per group; 0: default_group or what the kernel can
  bool simd_builtins = true;
};

/// Parameter names of a bundle, from the kernels' own list (kernels/shared/buffers.h).
std::vector<std::string> bundle_buffers(Bundle bundle);

/// All buffers of Bundle::scene and Bundle::filter, uploaded.
std::map<std::string, Buffer> upload_scene(Device& device, const PackedScene& scene);

/// Adds the device's counters to `counters` and clears them.
void collect_counters(Device& device, const Buffer& diag, std::vector<Counter>& counters);

/// The group asked for, or the default within what the kernel can: a large kernel may allow less
/// than its device does. Throws DeviceError.
std::size_t group_for(const Kernel& kernel, std::size_t asked);

struct PassState {
  Pass pass;
  Kernel kernel;
  std::size_t group = 1;      ///< work-items per group
  unsigned launch_index = 0;  ///< parameter index of the launch struct
  PassTime time;
};

/// Parameter names of a pass in order, as its kernel declares them.
std::vector<std::string> parameter_names(const Pass& pass);

/// What the kernels of this scene, method and device are specialised for.
Specialisation specialise(const PackedScene& scene, const Integrator& integrator,
                          const DeviceInfo& device, const PlanOptions& options);

class Plan {
 public:
  /// Uploads the scene, allocates the film of a tile (cleared) and builds all passes, code
  /// generation included, so that the first iteration is as fast as the last. Throws DeviceError.
  Plan(Device device, const PackedScene& scene, const Integrator& integrator,
       const PlanOptions& options, std::size_t tile_pixels);

  /// Enqueues one iteration over the launch's tile; returns at once.
  void enqueue(const Launch& launch);
  void finish() { device_.finish(); }

  /// The first `pixels` of the tile's film.
  void read_film(FilmPixel* film, std::size_t pixels);
  void write_film(const FilmPixel* film, std::size_t pixels);
  /// Adds the device's counters to `counters` and clears them.
  void collect(std::vector<Counter>& counters);

  std::map<std::string, std::size_t> memory() const;
  const std::vector<PassState>& passes() const { return passes_; }
  const Specialisation& specialisation() const { return specialisation_; }

 private:
  void bind(PassState& state, const PackedScene& scene);
  void warm_up();

  Device device_;
  PlanOptions options_;
  Specialisation specialisation_;
  std::size_t tile_pixels_;
  std::map<std::string, Buffer> buffers_;
  std::vector<PassState> passes_;
};

}  // namespace pellucid
