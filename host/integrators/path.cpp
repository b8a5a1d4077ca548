// Methods that walk from the camera only: one megakernel, specialised by flags.
#include "integrators/registry.h"

namespace pellucid {

std::vector<Integrator> path_integrators() {
  const std::vector<Pass> passes{
      {"pt_mega", {Bundle::scene, Bundle::filter, Bundle::film, Bundle::diag}, Domain::tile, true},
      {"film_add", {Bundle::film, Bundle::diag}}};
  return {
      {"naive", "path tracing that finds light by chance only", {}, false, passes},
      {"nee",
       "next event estimation; chance counts only where it cannot reach",
       {INTG_NEE},
       false,
       passes,
       1},
      {"path", "both, weighted by MIS", {INTG_NEE, INTG_MIS}, true, passes, 1},
      {"reference",
       "uniform directions, no importance sampling: slow and simple",
       {INTG_UNIFORM},
       false,
       passes},
  };
}

}  // namespace pellucid
