// Complex indices of refraction of measured metals, reduced to linear Rec.709.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pellucid {

struct Metal {
  const char* name;
  Rgb eta, k;
};

const std::vector<Metal>& metals();
std::vector<std::string> metal_names();

}  // namespace pellucid
