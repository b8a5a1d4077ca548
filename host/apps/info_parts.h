// The kinds of files that `info` knows, a function each.
#pragma once

#include <string>

#include "apps/command.h"
#include "apps/device_input.h"
#include "scene/load.h"

namespace pellucid {

/// info_scene.cpp: contents, effects, methods, kernels, BVH, memory.
ExitCode scene_info(const std::string& file, const LoadOptions& options, const DeviceFlags& device,
                    const CommonOptions& common);

/// info_image.cpp: size, metadata, statistics of every channel.
ExitCode image_info(const std::string& file, const CommonOptions& common);

/// info_checkpoint.cpp: passes, missing ones, identity, counters.
ExitCode checkpoint_info(const std::string& file, const CommonOptions& common);

}  // namespace pellucid
