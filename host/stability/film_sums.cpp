// Sums that go on adding after 2^27 passes (numerics 21).
//
// A sum in float stops growing once it is 2^24 times what is added. The film's sums are whole
// numbers of 128 bits, which costs three additions with carry per channel and pass.
#include <algorithm>
#include <cmath>

#include "integrators/registry.h"
#include "render/session.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

/// Sums of so many equal passes out of those of one: a shift of whole numbers.
void shift_left(uint* words, int n, unsigned bits) {
  for (; bits > 0; --bits)
    for (int i = n; i-- > 0;) words[i] = words[i] << 1 | (i > 0 ? words[i - 1] >> 31 : 0u);
}

}  // namespace

void sums_never_stall(const Lab& lab, Findings& findings) {
  // A glowing wall: every sample is the same number.
  Scene scene = empty_scene();
  add_shape(scene, Sphere{{0, 0, 0}, 1.0}).emission = Emission{Rgb(1, 0.3, 1e-4), 2};
  scene.materials[0].reflectance = Rgb(0.0);
  scene.settings.width = scene.settings.height = 4;
  scene.settings.filter = PixelFilter::box;
  const PackedScene packed = pack_scene(scene, {simd_width_for(lab.device.info())});
  RenderOptions options;
  options.width = options.height = 4;
  options.plan.sampler = Sampler::random;
  options.plan.kernel_dir = lab.kernel_dir;
  options.max_depth = 1;
  options.passes = PassRange{0, 1};
  const Integrator& method = find_integrator("path");
  Session one(lab.device, packed, method, options);
  one.run({});
  const Film first = one.film();

  constexpr unsigned doublings = 27;
  constexpr std::uint64_t before = std::uint64_t{1} << doublings, more = 1024;
  Film film = first;
  for (FilmPixel& pixel : film.pixels) {
    for (auto& sum : pixel.sum) shift_left(sum, FILM_SUM_WORDS, doublings);
    for (auto& square : pixel.square) shift_left(square, FILM_SQUARE_WORDS, doublings);
    pixel.count[0] <<= doublings;
  }
  film.passes = {};
  film.passes.add({0, before});
  options.passes = PassRange{0, before + more};
  Session session(lab.device, packed, method, options, film);
  session.run({});
  double worst = 0;
  std::uint64_t stalled = 0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double sample = first.sums(i).sum[c], sum = session.film().sums(i).sum[c];
      worst = std::max(worst, std::abs(sum / (double(before + more) * sample) - 1));
      stalled += sum <= film.sums(i).sum[c];
    }
  findings.at_most("relative error of the mean after 2^27 passes", worst, 1e-6);
  findings.none("sums that stall", stalled);
}

}  // namespace pellucid::stability
