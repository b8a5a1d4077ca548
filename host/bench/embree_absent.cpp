// Without Embree the benchmark tells our own figures only.
#include "base/error.h"
#include "bench/embree_rays.h"

namespace pellucid {

struct EmbreeRays::Impl {};
bool EmbreeRays::available() {
  return false;
}
EmbreeRays::EmbreeRays(const PackedScene&, bool) {
  throw InternalError("built without Embree");
}
EmbreeRays::~EmbreeRays() = default;
double EmbreeRays::build_seconds() const {
  return 0;
}
void EmbreeRays::set_rays(const std::vector<TraceRay>&) {}
double EmbreeRays::trace(bool, int) {
  return 0;
}
std::vector<TraceHit> EmbreeRays::hits() const {
  return {};
}

}  // namespace pellucid
