// Launches in parts, by the time that the last ones took.
#include "render/launch_parts.h"

#include <algorithm>

namespace pellucid {
namespace {

/// Where nothing is known yet: enough to keep a large device's units busy for a moment.
constexpr std::size_t first_items = 1024;
/// What a launch should take at most is 0.1 s. Pictures have regions that take longer than others,
/// and machines have other things to do.
constexpr double wanted_seconds = 0.04;
/// A launch that is no more than a few work-groups tells little about one of many.
constexpr double most_growth = 8.0;

}  // namespace

LaunchParts::LaunchParts(std::size_t items)
    : fixed_(items > 0), settled_(fixed_), items_(items ? items : first_items) {}

void LaunchParts::enqueue(Device& device, Kernel& kernel, unsigned launch_index, Launch launch,
                          std::size_t items, std::size_t group,
                          const std::shared_ptr<PassTime>& time) {
  for (std::size_t first = 0; first < items;) {
    launch.item_first = uint(first);
    kernel.set_bytes(launch_index, &launch, sizeof launch);
    // Whole groups: those of a part's end would do what the next part begins with.
    const std::size_t part = std::max(items_ / group, std::size_t{1}) * group;
    device.launch(kernel, std::min(part, items - first), group, time);
    first += part;
    if (settled_ || first >= items) continue;
    device.finish();
    learn(*time);
  }
}

void LaunchParts::learn(PassTime& time) {
  if (!fixed_ && time.longest_lately > 0) {
    const double factor = std::min(wanted_seconds / time.longest_lately, most_growth);
    settled_ = settled_ || factor < most_growth;
    constexpr double most = 1u << 30;
    items_ = std::size_t(std::clamp(double(items_) * factor, 1.0, most));
  }
  time.longest_lately = 0;
}

}  // namespace pellucid
