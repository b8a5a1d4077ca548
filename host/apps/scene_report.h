// What `info` and `render --dry-run` tell alike: effects, memory against limits, kinds of things.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cl/device.h"
#include "pack/features.h"
#include "scene/scene.h"

namespace pellucid {

/// {word: bool} for every feature of `among`.
nlohmann::json feature_flags(FeatureSet set, FeatureSet among);
/// Everything a kernel can be specialised for.
FeatureSet all_features();

/// Device, driver and what it has room for.
nlohmann::json device_facts(const DeviceInfo& device);

using Memory = std::map<std::string, std::size_t>;
/// One line: bytes per buffer (largest first), total and largest against the device's limits.
std::string memory_text(const Memory& buffers, const DeviceInfo& device);

/// How many there are of each kind: "conductor": 2.
std::map<std::string, int> material_kinds(const Scene& scene);
/// Shapes that emit count as one light each.
std::map<std::string, int> light_kinds(const Scene& scene);
std::map<std::string, int> shape_kinds(const Scene& scene);
/// "2 conductor, 1 diffuse".
std::string counts_text(const std::map<std::string, int>& counts);

}  // namespace pellucid
