// Further channels of a picture: what the camera sees first, by a pass of its own over a fixed
// number of samples, so that they depend on scene, size, filter, sampler and seed alone.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "render/session.h"

namespace pellucid {

/// One entry of --aov and the EXR channels that it becomes.
struct AovInfo {
  std::string name;
  std::vector<std::string> channels;
  std::string doc;  ///< for --help
  bool filtered;    ///< a mean over samples of the pixel filter; else of the pixel's centre
  float (*value)(const AovPixel& pixel, std::size_t channel);  ///< sums for those that are filtered
};
/// In the order in which channels are written.
const std::vector<AovInfo>& aov_table();

/// Channels of the window for those of `names` that aov_table() has, each once; nothing is built or
/// allocated if there are none. `stop` is polled after every iteration; nothing if it said so. Adds
/// what went wrong to `counters`. Throws DeviceError.
std::optional<std::vector<AovChannel>> render_aovs(Device device, const PackedScene& scene,
                                                   const std::vector<std::string>& names,
                                                   const RenderOptions& options,
                                                   std::vector<Counter>& counters,
                                                   const std::function<bool()>& stop = {});

}  // namespace pellucid
