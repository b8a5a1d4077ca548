// Binned SAH construction of the binary tree.
#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "bvh/bvh.h"

namespace pellucid::bvh {
namespace {

constexpr int bin_count = 32;
/// Deeper than this, splits go to the middle: bounds the depth of pathological inputs by this +
/// log2(n).
constexpr int max_sah_depth = 64;

struct Bin {
  Box box;
  std::uint32_t count = 0;
};

struct Split {
  int axis = -1;
  int bin = 0;
  double cost = std::numeric_limits<double>::infinity();
};

class Builder {
 public:
  Builder(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& classes,
          const LeafCapacity& capacity)
      : boxes_(boxes), classes_(classes), capacity_(capacity), centers_(boxes.size()) {
    for (size_t i = 0; i < boxes.size(); ++i) {
      PELLUCID_CHECK(!boxes[i].empty(), "a primitive has an empty or NaN box");
      centers_[i] = 0.5f * boxes[i].low + 0.5f * boxes[i].high;  // halves first: no overflow
    }
    tree_.order.resize(boxes.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0u);
  }

  BinaryTree run() {
    if (!boxes_.empty()) {
      tree_.nodes.reserve(boxes_.size() / 2 + 1);
      tree_.nodes.emplace_back();
      node(0, 0, static_cast<std::uint32_t>(boxes_.size()), 0);
    }
    return std::move(tree_);
  }

 private:
  std::uint8_t class_of(std::uint32_t prim) const {
    return classes_.empty() ? std::uint8_t{0} : classes_[prim];
  }

  bool fits_leaf(std::uint32_t first, std::uint32_t count) const {
    const std::uint8_t c = class_of(tree_.order[first]);
    if (count > capacity_[c]) return false;
    for (std::uint32_t i = 1; i < count; ++i)
      if (class_of(tree_.order[first + i]) != c) return false;
    return true;
  }

  void node(std::uint32_t index, std::uint32_t first, std::uint32_t count, int depth) {
    Box box, centers;
    for (std::uint32_t i = first; i < first + count; ++i) {
      box.add(boxes_[tree_.order[i]]);
      centers.add(centers_[tree_.order[i]]);
    }
    tree_.nodes[index].box = box;
    if (fits_leaf(first, count)) {
      tree_.nodes[index].first = first;
      tree_.nodes[index].count = count;
      return;
    }
    const std::uint32_t middle = partition(first, count, centers, depth);
    const auto left = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    tree_.nodes.emplace_back();
    tree_.nodes[index].left = left;
    tree_.nodes[index].right = left + 1;
    node(left, first, middle - first, depth + 1);
    node(left + 1, middle, first + count - middle, depth + 1);
  }

  std::uint32_t partition(std::uint32_t first, std::uint32_t count, const Box& centers, int depth) {
    const auto begin = tree_.order.begin() + first, end = begin + count;
    const Split split = depth < max_sah_depth ? best_split(first, count, centers) : Split{};
    if (split.axis >= 0) {
      const auto middle = std::stable_partition(
          begin, end, [&](std::uint32_t p) { return bin_of(p, split.axis, centers) < split.bin; });
      if (middle != begin && middle != end)
        return static_cast<std::uint32_t>(middle - tree_.order.begin());
    }
    // All centres alike, or too deep: by class first (a leaf holds one class), then in halves.
    const auto by_class = std::stable_partition(
        begin, end, [&](std::uint32_t p) { return class_of(p) == class_of(tree_.order[first]); });
    if (by_class != end) return static_cast<std::uint32_t>(by_class - tree_.order.begin());
    return first + count / 2;
  }

  static int bin_index(float c, float low, float scale) {
    return std::clamp(static_cast<int>((c - low) * scale), 0, bin_count - 1);
  }
  int bin_of(std::uint32_t prim, int axis, const Box& centers) const {
    const float extent = centers.high[axis] - centers.low[axis];
    return bin_index(centers_[prim][axis], centers.low[axis], bin_count / extent);
  }

  Split best_split(std::uint32_t first, std::uint32_t count, const Box& centers) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centers.high[axis] - centers.low[axis];
      const float scale = bin_count / extent;
      if (!(extent > 0.0f) || !std::isfinite(scale)) continue;
      std::array<Bin, bin_count> bins;
      for (std::uint32_t i = first; i < first + count; ++i) {
        const std::uint32_t prim = tree_.order[i];
        Bin& bin = bins[bin_index(centers_[prim][axis], centers.low[axis], scale)];
        bin.box.add(boxes_[prim]);
        ++bin.count;
      }
      sweep(bins, axis, best);
    }
    return best;
  }

  static void sweep(const std::array<Bin, bin_count>& bins, int axis, Split& best) {
    std::array<double, bin_count> right_cost{};
    Box box;
    std::uint32_t count = 0;
    for (int b = bin_count - 1; b > 0; --b) {
      box.add(bins[b].box);
      count += bins[b].count;
      right_cost[b] = count * box.half_area();
    }
    box = Box{};
    count = 0;
    for (int b = 1; b < bin_count; ++b) {
      box.add(bins[b - 1].box);
      count += bins[b - 1].count;
      const double cost = count * box.half_area() + right_cost[b];
      if (cost < best.cost) best = {axis, b, cost};
    }
  }

  const std::vector<Box>& boxes_;
  const std::vector<std::uint8_t>& classes_;
  LeafCapacity capacity_;
  std::vector<glm::vec3> centers_;
  BinaryTree tree_;
};

}  // namespace

BinaryTree build(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& classes,
                 const LeafCapacity& capacity) {
  PELLUCID_CHECK(classes.empty() || classes.size() == boxes.size(), "one class per box");
  for (std::uint32_t c : capacity) PELLUCID_CHECK(c > 0, "a leaf holds at least one primitive");
  return Builder(boxes, classes, capacity).run();
}

}  // namespace pellucid::bvh
