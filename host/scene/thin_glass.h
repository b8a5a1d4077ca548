// Glass so thin that rays which enter it start beyond its other side.
#pragma once

#include <string>

#include "scene/scene.h"

namespace pellucid {

/// Whether rays go through it, all of it or a part of a mix.
bool lets_rays_in(const Material& material);

/// What to tell the user of the first pane of glass thinner than what keeps rays off surfaces; ""
/// where there is none.
std::string thin_glass_warning(const Scene& scene);

}  // namespace pellucid
