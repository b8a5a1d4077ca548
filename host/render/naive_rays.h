// What the benchmark holds against robust rays: the same tree, traversal and vector types with
// kernels/naive, which is as fast as can be and minds no rounding. No render uses it.
#pragma once

#include "pack/pack.h"

namespace pellucid {

/// PlanOptions::overlay of its programs.
constexpr const char* NAIVE_OVERLAY = "naive";

/// `scene`, which has triangles only, with edges in the place of second and third vertices, as
/// kernels/naive/geom/triangle.h wants its leaves.
PackedScene for_naive_rays(PackedScene scene);

}  // namespace pellucid
