// Sums that go on adding after 2^27 passes, and samples 1e8 times dimmer than those before them
// (numerics 21).
//
// A sum in float stops growing once it is 2^24 times what is added. The film's sums are whole
// numbers of 128 bits, which costs three additions with carry per channel and pass.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

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

constexpr int side = 4;

/// Picks up a film where it was left.
class Accumulation {
 public:
  explicit Accumulation(const Lab& lab) : lab_(lab) {
    options_.width = options_.height = side;
    options_.plan.sampler = Sampler::random;
    options_.plan.kernel_dir = lab.kernel_dir;
    options_.max_depth = 1;
  }
  Film run(Scene scene, std::uint64_t passes, std::optional<Film> film = {}) {
    scene.settings.width = scene.settings.height = side;
    scene.settings.filter = PixelFilter::box;
    const PackedScene packed = pack_scene(scene, {simd_width_for(lab_.device.info())});
    options_.passes = PassRange{0, passes};
    Session session(lab_.device, packed, find_integrator("path"), options_, std::move(film));
    session.run({});
    return session.film();
  }

 private:
  const Lab& lab_;
  RenderOptions options_;
};

void measure_passes(const Lab& lab, Findings& findings) {
  // A glowing wall: every sample is the same number.
  Scene scene = empty_scene(0.0);
  add_shape(scene, Sphere{{0, 0, 0}, 1.0}).emission = Emission{Rgb(1, 0.3, 1e-4), 2};
  Accumulation wall(lab);
  const Film first = wall.run(scene, 1);
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
  const Film last = wall.run(scene, before + more, film);
  double worst = 0;
  std::uint64_t stalled = 0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double sample = first.sums(i).sum[c], sum = last.sums(i).sum[c];
      worst = std::max(worst, std::abs(sum / (double(before + more) * sample) - 1));
      stalled += sum <= film.sums(i).sum[c];
    }
  findings.at_most("relative error of the mean after 2^27 passes", worst, 1e-6);
  findings.none("sums that stall", stalled);
}

/// A camera between a bright wall and a dim one turns round to the other after half of its passes.
/// A sum in float that has met the bright one first is left by the dim one where it was.
void measure_mixture(const Lab& lab, Findings& findings) {
  constexpr double bright = 1e6, dim = 1e-2, distance = 1, radius = 10;
  constexpr std::uint64_t each = 1024;
  Scene to_bright = empty_scene(0.0);
  for (double z : {-distance, distance})
    add_shape(to_bright, Disk{{0, 0, z}, {0, 0, z < 0 ? 1.0 : -1.0}, radius}).emission =
        Emission{Rgb(z < 0 ? bright : dim), 1};
  Scene to_dim = to_bright;
  to_dim.camera.forward *= -1.0, to_dim.camera.right *= -1.0;
  for (bool bright_first : {true, false}) {
    Accumulation walls(lab);
    const Film half = walls.run(bright_first ? to_bright : to_dim, each);
    const Film whole = walls.run(bright_first ? to_dim : to_bright, 2 * each, half);
    double worst = 0, mean = 0;
    for (std::size_t i = 0; i < whole.pixels.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const double sum = whole.sums(i).sum[c], added = sum - half.sums(i).sum[c];
        worst =
            std::max(worst, std::abs(added / (double(each) * (bright_first ? dim : bright)) - 1));
        mean = std::max(mean, std::abs(sum / (double(each) * (bright + dim)) - 1));
      }
    const char* order = bright_first ? "dim after bright" : "bright after dim";
    findings.at_most(fmt::format("relative error of what is added, {}", order), worst, 1e-6);
    findings.at_most(fmt::format("relative error of the mean of both, {}", order), mean, 1e-7);
  }
}

}  // namespace

void sums_never_stall(const Lab& lab, Findings& findings) {
  measure_passes(lab, findings);
  measure_mixture(lab, findings);
}

}  // namespace pellucid::stability
