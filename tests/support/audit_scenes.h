// Rooms that together hold every kind of material and of light, for tests of path weights.
#pragma once

#include "support/test_scenes.h"

namespace pellucid::test {

/// A room of textured and one-sided walls, full of spheres, disks, flat and smooth meshes of all
/// materials and lit by all kinds of light. `open`: without a ceiling, under a sky and a sun.
Scene audit_room(bool open);

/// Index in the room's materials of what tests ask for by name.
int audit_material(const Scene& scene, const std::string& name);

}  // namespace pellucid::test
