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

namespace pellucid {

struct MemoryPlan {
  std::map<std::string, std::size_t> buffers;  ///< name and bytes on the device
  std::vector<Window> tiles;     ///< bands of rows, of which the device holds one at a time
  std::uint64_t film_bytes = 0;  ///< the whole film, kept by the host

  std::uint64_t device_bytes() const;
  std::size_t tile_pixels() const;  ///< of the largest tile
};

/// Name and size of every device buffer that rendering `scene` with `integrator` needs for a tile
/// of so many pixels.
std::map<std::string, std::size_t> buffer_sizes(const PackedScene& scene,
                                                const Integrator& integrator, std::size_t pixels);

/// Plans for `window` of the picture within what the device reports and, if given, `limit` bytes of
/// device memory; `host_bytes` are needed by the host beside the film. Throws DeviceError with the
/// figures where not even one row of pixels fits, or the host cannot hold the film.
MemoryPlan plan_memory(const DeviceInfo& device, const PackedScene& scene,
                       const Integrator& integrator, const Window& window,
                       std::optional<std::uint64_t> limit, std::uint64_t host_bytes);

}  // namespace pellucid
