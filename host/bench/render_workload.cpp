// The workloads of `bench --only render`.
#include "bench/render_workload.h"

namespace pellucid {

const std::vector<RenderWorkload>& render_workloads() {
  static const std::vector<RenderWorkload> workloads{
      {"cornell-box", "light from wall to wall"},
      {"veach-mis", "rough metal under lamps of all sizes"},
      {"four-balls-background", "an environment seen through an opening"},
      {"four-balls-point", "a lamp without size, glass"},
      {"hidden-light-room", "nearly all light is indirect"},
      {"keyhole", "few directions lead anywhere"},
      {"glass-caustic", "caustics of a small lamp"},
      {"glass-lamp", "no shadow ray reaches the lamp"},
      {"pool", "caustics seen through what makes them"},
      {"mixed-room", "all of this at once"}};
  return workloads;
}

std::uint64_t workload_spp(const std::string& method) {
  if (method == "bdpt" || method == "sppm") return 32;
  if (method == "bpm" || method == "vcm") return 16;
  return 64;
}

}  // namespace pellucid
