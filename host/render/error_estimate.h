// How far a film is from what its method converges to, said with a stated confidence while the
// render goes on: what ends `--error`.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/film.h"

namespace pellucid {

/// What was known at one look at the film.
struct ErrorLook {
  std::uint64_t passes = 0;  ///< of the film
  double relmse = 0;         ///< as the film's own variances have it
  double expected = 0;       ///< that, or what groups say of each other if it is more
  double upper = 0;          ///< that of this film is less; infinite where nothing can be said
  std::size_t groups = 0;    ///< of passes, whose spread told so
  double spread = 0;         ///< relative standard deviation of a film's relMSE
  double effective = 0;      ///< pixels of group images that make up the estimate: few if a few
                             ///< bright ones carry it
};

/// Noise from batch means: passes are cut into groups of equal size, whose images are independent
/// for every method, whatever pixels of one pass share. Looks are taken when the film has 2^j
/// passes, with 4 to 16 groups; then neighbours join in pairs. Bias (of merging), and bright paths
/// that no pass has met yet, cannot be seen in it.
class ErrorEstimate {
 public:
  /// That all bounds of all looks hold.
  static constexpr double confidence = 0.95;
  /// Host memory for a picture of so many pixels.
  static std::uint64_t host_bytes(std::uint64_t pixels);

  /// `target`: the root of relMSE that is wanted. The passes that `film` has already are part of
  /// the picture but of no group. Looks that fewer pixels of groups carry than `least_effective`
  /// (ErrorLook::effective) bound nothing.
  ErrorEstimate(double target, const Film& film, double least_effective = 0);

  /// An earlier render found this bound for the very film of the constructor.
  void recall(double upper_root);

  /// Number of passes at which the film is to be shown next.
  std::uint64_t border() const;
  /// With exactly border() passes.
  void observe(const Film& film);
  /// The end, at any number of passes: a last look, unless there was one at just as many.
  void finish(const Film& film);

  double target() const { return target_; }
  const std::vector<ErrorLook>& looks() const { return looks_; }
  /// Whether the last look bounds the error by the target.
  bool reached() const;
  /// Passes with which the target will be reached if the error goes on to fall as 1/sqrt(passes);
  /// 0: nothing is known yet.
  std::uint64_t likely_end(const FilmSummary& now) const;

 private:
  std::vector<double> sums(const Film& film) const;
  void join_pairs();
  void look(const Film& film);

  double target_, least_effective_;
  std::uint64_t unit_;                      ///< passes that are independent of others only together
  std::vector<std::size_t> kept_;           ///< pixels of which groups keep means
  std::uint64_t passes_ = 0;                ///< of the film at the last border
  std::vector<double> sums_;                ///< then; [kept pixels][3]
  std::uint64_t next_look_, size_;          ///< in passes: of the film, and of a group
  std::vector<std::vector<float>> groups_;  ///< their means [group][kept pixels][3], in order
  std::uint64_t first_group_ = 0;           ///< whose passes begin at first_group_ * size_
  std::vector<ErrorLook> looks_;
};

}  // namespace pellucid
