// What a render is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pack/features.h"
#include "render/film.h"
#include "render/float_mode.h"
#include "render/sampler.h"

namespace pellucid {

/// Work-items per group where nothing else is asked for: enough that dispatch costs nothing on
/// CPUs.
constexpr std::size_t default_group = 64;

struct PlanOptions {
  Sampler sampler = Sampler::sobol;
  FloatMode float_mode = FloatMode::strict;
  FeatureSet extra_features;     ///< on top of what the scene needs
  std::string kernel_dir;        ///< read kernels from here instead of the binary
  std::string overlay;           ///< see KernelFiles; for the benchmark alone
  std::size_t group = 0;         ///< work-items per group; 0: default_group or what the kernel can
  std::size_t launch_items = 0;  ///< work-items of a launch; 0: as many as take 40 ms or so
  bool simd_builtins = true;
  bool int64_atomics = true;      ///< where the device has them
  bool compact_vertices = false;  ///< sub-paths' vertices in half the bytes
  double vertices_per_path = 4;   ///< that buffers have room for at first; they grow
};

struct RenderOptions {
  int width = 512, height = 512;      ///< of the whole picture; must agree with the packed camera
  std::optional<Window> crop;         ///< the part to render; absent: all of it
  std::optional<PassRange> passes;    ///< global passes to have in the end
  std::optional<double> seconds;      ///< ends the render after the iteration in hand
  std::optional<double> known_error;  ///< bound of it for the film to go on with
  double least_effective = 0;         ///< see ErrorEstimate
  std::optional<double> error;        ///< root of relMSE: ends it when an ErrorEstimate says so
  std::uint64_t seed = 0;
  std::optional<uint> max_depth;  ///< segments; absent = unlimited
  uint mis = MIS_BALANCE;
  std::optional<uint>
      light_paths;  ///< of an iteration, for the whole picture; absent: one per pixel
  std::optional<double>
      radius;  ///< of merging in the first pass, world units; absent: by the scene
  bool merge_first_only = false;  ///< at the first vertex of eye paths that can
  double radius_alpha = 0.75;     ///< how fast it shrinks: as pass^((alpha - 1) / 2) [Knaus11]
  std::optional<std::uint64_t> memory;  ///< most bytes on the device
  std::size_t record_events = 0;        ///< that a replay has room for
  uint record_path = NONE;              ///< light path of which it writes down all
  std::uint64_t host_bytes = 0;         ///< what the host needs beside the film, as for checkpoints
  PlanOptions plan;

  uint light_path_count() const { return light_paths.value_or(uint(width) * uint(height)); }
  Window window() const { return crop.value_or(Window{0, 0, width, height}); }
};

}  // namespace pellucid
