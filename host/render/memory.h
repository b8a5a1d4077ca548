// What a render needs in memory, before anything is allocated, and how the picture is tiled where
// it does not fit at once.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cl/device.h"
#include "pack/pack.h"
#include "render/film.h"
#include "render/integrator.h"
#include "render/options.h"

namespace pellucid {

struct MemoryPlan {
  std::map<std::string, std::size_t> buffers;  ///< name and bytes on the device
  std::vector<Window> tiles;     ///< bands of rows, of which the device holds one at a time
  std::uint64_t film_bytes = 0;  ///< the whole film, kept by the host
  uint slice_rows = 1;           ///< rows of a tile in one slice (render/integrator.h)
  std::uint64_t limit = 0;       ///< most bytes on the device, as buffers of vertices grow

  std::uint64_t device_bytes() const;
  std::size_t tile_pixels() const;  ///< of the largest tile
};

/// Most light paths of one launch that stores their vertices: those that slices of so many rows are
/// paired with.
std::size_t slice_paths(const RenderOptions& options, std::size_t rows);

/// Rows of a tile in one slice, at most.
uint slice_rows(const Integrator& integrator, const RenderOptions& options, std::size_t tile_rows);

/// Buffers that have a place for every vertex of a side ("light" or "eye"), and its bytes.
std::map<std::string, std::size_t> vertex_buffers(const Integrator& integrator,
                                                  const PlanOptions& options,
                                                  const std::string& side);

/// Cells of the photon grid, as a power of two: about as many as light paths.
uint grid_bits_for(const RenderOptions& options);

/// Name and size of every device buffer that rendering `scene` with `integrator` needs at first for
/// a tile of so many rows.
std::map<std::string, std::size_t> buffer_sizes(const PackedScene& scene,
                                                const Integrator& integrator,
                                                const RenderOptions& options, std::size_t rows);

/// Plans for the options' window of the picture within what the device reports and, if given,
/// options.memory bytes of it. Throws DeviceError with the figures where not even one row of pixels
/// fits, or the host cannot hold the film.
MemoryPlan plan_memory(const DeviceInfo& device, const PackedScene& scene,
                       const Integrator& integrator, const RenderOptions& options);

}  // namespace pellucid
