// Renders through the library, without the command line: a scene by name, a method, pictures with
// means and variances. A render of which the device counts an error throws NumericError.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/session.h"
#include "scene/scene.h"
#include "stability/lab.h"

namespace pellucid::stability {

/// What a kernel is built from and a scene is packed for.
struct Build {
  std::string method = "path";
  int width = 32, height = 32;
  bool specialised = false;  ///< false: kernels hold all effects, so that tests share programs
  std::size_t group = 64;
  bool simd_builtins = true;
  int simd_width = 0;                 ///< 0: what the device prefers
  Sampler sampler = Sampler::random;  ///< independent samples, as statistics want them
  PixelFilter filter = PixelFilter::box;
  uint light_paths = 0;  ///< of an iteration; 0: one per pixel
  double radius = 0;     ///< of merging in the first pass; 0: by the scene
  double radius_alpha = 0.75;
  bool merge_first_only = false;
  bool compact_vertices = false;
  double vertices_per_path = 4;  ///< room at first
  bool int64_atomics = true;
  uint slice_rows = 0;  ///< 0: as planned
  std::optional<std::uint64_t> growth =
      {};  ///< most bytes of the device beyond what is planned at first
  FloatMode float_mode = FloatMode::strict;
  std::size_t launch_items = 0;  ///< work-items of a launch; 0: as many as are quick enough
  bool roulette = true;  ///< false: walks go on wherever anything is scattered, textured or not
};

/// Mean and variance of that mean.
struct Estimate {
  double mean = 0, variance = 0;
  double error() const;
};

struct Picture {
  int width = 0, height = 0;
  Film film;
  std::vector<std::array<Estimate, 3>> pixels;  ///< out of film_image()

  explicit Picture(Film accumulated);
  Estimate image(int channel) const;
  /// (sum x)^2 / sum x^2 over the samples of a block of pixels: how many of them matter.
  double effective_samples(int channel, int x0, int y0, int block) const;
  double block_mean(int channel, int x0, int y0, int block) const;
  /// Tile t of TILES_ACROSS^2, by rows, of a picture that these divide.
  Estimate tile(int channel, int t) const;
};

constexpr int TILES_ACROSS = 4;

/// The same bits in every accumulator of every pixel.
bool same_film(const Film& a, const Film& b);
/// Pixels that differ in any accumulator.
std::size_t different_pixels(const Film& a, const Film& b);

/// As good as no limit, but for the one path in 10^7 that total reflection catches in a ball of
/// glass, and that would be counted as an error after thousands of segments.
constexpr uint long_enough = 1000;

struct Sampling {
  std::uint64_t spp = 64, seed = 1;
  std::optional<uint> max_depth;
  uint mis = MIS_BALANCE;
};

/// Means of the picture, of its tiles and of its pixels.
struct Measured {
  std::array<Estimate, 3> image;
  std::array<std::array<Estimate, 3>, TILES_ACROSS * TILES_ACROSS> tiles;
  std::vector<std::array<Estimate, 3>> pixels;
};

/// A method ready on a scene: kernels are built once, then any number of pictures are made.
class Renderer {
 public:
  Renderer(const Lab& lab, const Scene& scene, const Build& build);
  Picture render(const Sampling& run);
  /// Until an error estimate says that the error is below `target`, or run.spp.
  std::pair<Picture, ErrorEstimate> render_to(double target, const Sampling& run);
  /// Pixels of methods that splat or merge share light paths: there the spread of runs tells the
  /// error.
  Measured measure(const Sampling& run);
  /// spp for which the image's mean is known to `relative` (standard error) by a pilot of its own
  /// seed; `most` bounds the answer, and a render that then is too noisy fails as inconclusive.
  std::uint64_t spp_for(const Sampling& run, double relative, std::uint64_t most);
  /// What depth caps cut off since the last call.
  DepthCuts take_cuts() { return std::exchange(cuts_, {}); }
  /// Rays that have left a closed scene since the last call.
  std::uint64_t take_escapes() { return std::exchange(escapes_, 0); }
  const PackedScene& packed() const { return packed_; }
  const Plan& plan() const { return plan_; }

 private:
  void check_counters();
  Launch launch_for(const Sampling& run);
  Film black_film(const Launch& launch);
  /// Goes on to so many passes in all, and reads the film.
  void advance(Film& film, Launch launch, std::uint64_t passes);

  Build build_;
  PackedScene packed_;
  Plan plan_;
  DepthCuts cuts_{};
  std::uint64_t escapes_ = 0;
};

/// What camera rays of a square picture meet first, by channel (`render --aov`): a float per pixel.
std::map<std::string, std::vector<float>> first_surfaces(const Lab& lab, const Scene& scene,
                                                         const std::vector<std::string>& channels,
                                                         int size);

/// Renderer::render through a Session, as the program renders.
Picture session_render(const Lab& lab, const Scene& scene, const Build& build, const Sampling& run,
                       const RenderHooks& hooks = {});

}  // namespace pellucid::stability
