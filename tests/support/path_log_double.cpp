// Compiled with PELLUCID_REAL=double only.
#include "support/path_log_twin.h"

namespace pellucid::test {

PathLog path_log_double(const PackedScene& packed, const Launch& launch, uint x, uint y) {
  return twin::logged_path(packed, launch, x, y);
}

}  // namespace pellucid::test
