// Sums of throughput cut off, and what is told of them.
#include "render/depth_cut.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/text.h"
#include "shared/limits.h"

namespace pellucid {

void DepthCut::add(const DepthCut& other) {
  const std::uint64_t steps = std::uint64_t(part) + other.part;
  whole += other.whole + (steps >> 32);
  part = uint(steps);
  paths += other.paths;
}

double DepthCut::share() const {
  return paths ? (double(whole) + std::ldexp(double(part), -32)) / double(paths) : 0.0;
}

const std::array<const char*, CUT_COUNT>& cut_names() {
  static const std::array<const char*, CUT_COUNT> names{"camera", "light"};
  return names;
}

void add_cuts(DepthCuts& into, const DepthCuts& other) {
  for (std::size_t i = 0; i < into.size(); ++i) into[i].add(other[i]);
}

void add_cut_words(DepthCuts& into, const std::vector<uint>& diag) {
  for (std::size_t i = 0; i < into.size(); ++i)
    into[i].add({diag.at(DIAG_CUTS + 2 * i + 1), diag.at(DIAG_CUTS + 2 * i), 0});
}

void add_cut_paths(DepthCuts& into, const Launch& launch, bool walks_from_lights,
                   std::uint64_t passes) {
  if (launch.max_depth > DEPTH_HARD_LIMIT) return;
  into[CUT_camera].paths += std::uint64_t(launch.window_width) * launch.window_height * passes;
  if (walks_from_lights) into[CUT_light].paths += launch.light_paths * passes;
}

namespace {

/// "camera paths 0.1342, light paths 0.2" of those that tell a share of at least `least`.
std::string shares(const DepthCuts& cuts, double least) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    if (cuts[i].paths && cuts[i].share() >= least)
      all.push_back(fmt::format("{} paths {:.4g}", cut_names()[i], cuts[i].share()));
  return join(all);
}

}  // namespace

std::string describe_cuts(const DepthCuts& cuts) {
  return shares(cuts, 0.0);
}

std::string cuts_verdict(const DepthCuts& cuts) {
  const std::string told = shares(cuts, std::numeric_limits<double>::min());
  if (told.empty()) return "";
  return fmt::format(
      "--max-depth cut off throughput: of what they started with, {} in the mean. So much could "
      "they still have carried: a hint, mostly from above, on lost brightness",
      told);
}

}  // namespace pellucid
