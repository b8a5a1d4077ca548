// Roulette (numerics 24): walks that end by chance and walks that go on as far as a cap have the
// same means.
//
// Walks survive with the albedo of their material, local and so known from either end: the other
// end's weights hold the same probability (transport/walk.h). A number per scattering, which walks
// that end early save many times over. Naive code uses probabilities above 1, or leaves them out of
// MIS weights.
#include "integrators/registry.h"
#include "stability/estimates.h"
#include "stability/measurements.h"

namespace pellucid::stability {

void roulette_changes_no_mean(const Lab& lab, Findings& findings) {
  const Scene scene = lab.open_scene("equal-shading");
  const Sampling run{64, 1, 8, MIS_BALANCE};
  for (const char* method : {"naive", "nee", "path", "light", "bdpt", "sppm", "bpm", "vcm"}) {
    Build build{method, 16, 16};
    if (find_integrator(method).uses(Bundle::grid)) build.radius = 0.05, build.radius_alpha = 1;
    constexpr double resolution = 2 * usual_resolution;
    constexpr double each = 0.8 * resolution;  // their difference is noisier by the root of 2
    const auto with = measured_means(lab, scene, build, run, each);
    build.roulette = false;
    const auto without = measured_means(lab, scene, build, run, each);
    compare_means(lab, findings, std::string("with and without roulette, ") + method, with, without,
                  resolution);
  }
}

}  // namespace pellucid::stability
