// What a method cannot see: classes of paths that it draws with probability 0 in a scene.
#pragma once

#include <string>
#include <vector>

#include "render/integrator.h"

namespace pellucid {

/// One sentence per class of paths that carries light in a scene with these features and that
/// `integrator` never samples. Empty: the method sees everything.
std::vector<std::string> unreachable_paths(const Integrator& integrator, FeatureSet scene);

}  // namespace pellucid
