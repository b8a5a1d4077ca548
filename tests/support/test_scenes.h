// The suite's small scenes, for tests.
#pragma once

#include "stability/small_scenes.h"

namespace pellucid::test {
using namespace pellucid::stability;
}
