// Binned SAH construction of the binary tree, on all cores of the host.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"
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

using Bins = std::array<std::array<Bin, bin_count>, 3>;

/// From this many primitives on, one node's own work is spread over the cores.
constexpr std::uint32_t parallel_node = 1u << 16;
/// Subtrees of at most n / task_share primitives are built as tasks of their own. How the work is
/// cut depends on the input alone, so the tree does too.
constexpr std::uint32_t task_share = 64, smallest_task = 4096;

/// What all parts of a build read, and the order that they sort in disjoint ranges.
struct Input {
  const std::vector<Box>& boxes;
  const std::vector<std::uint8_t>& classes;
  LeafCapacity capacity;
  std::vector<glm::vec3> centers;
  std::vector<std::uint32_t> order;

  std::uint8_t class_of(std::uint32_t prim) const {
    return classes.empty() ? std::uint8_t{0} : classes[prim];
  }
};

struct Range {
  std::uint32_t node, first, count;
  int depth;
};

/// Builds one subtree; ranges of at most `task_size` primitives are left in `tasks`.
class Builder {
 public:
  Builder(Input& input, std::uint32_t task_size) : in_(input), task_size_(task_size) {}

  void run(const Range& root) {
    nodes.emplace_back();
    node({0, root.first, root.count, root.depth});
  }

  std::vector<BinaryNode> nodes;
  std::vector<Range> tasks;

 private:
  bool fits_leaf(std::uint32_t first, std::uint32_t count) const {
    const std::uint8_t c = in_.class_of(in_.order[first]);
    if (count > in_.capacity[c]) return false;
    for (std::uint32_t i = 1; i < count; ++i)
      if (in_.class_of(in_.order[first + i]) != c) return false;
    return true;
  }

  /// Boxes of the primitives and of their centres.
  std::pair<Box, Box> range_bounds(std::size_t begin, std::size_t end) const {
    std::pair<Box, Box> out;
    for (std::size_t i = begin; i < end; ++i) {
      out.first.add(in_.boxes[in_.order[i]]);
      out.second.add(in_.centers[in_.order[i]]);
    }
    return out;
  }

  std::pair<Box, Box> bounds(const Range& r) const {
    if (r.count < parallel_node) return range_bounds(r.first, r.first + r.count);
    std::vector<std::pair<Box, Box>> part(host_threads());
    parallel_chunks(r.first, r.count, part.size(),
                    [&](std::size_t c, std::size_t begin, std::size_t end) {
                      part[c] = range_bounds(begin, end);
                    });
    for (std::size_t c = 1; c < part.size(); ++c)
      part[0].first.add(part[c].first), part[0].second.add(part[c].second);
    return part[0];
  }

  void node(const Range& r) {
    if (r.count <= task_size_) {
      tasks.push_back(r);
      return;
    }
    const auto [box, centers] = bounds(r);
    nodes[r.node].box = box;
    if (fits_leaf(r.first, r.count)) {
      nodes[r.node].first = r.first;
      nodes[r.node].count = r.count;
      return;
    }
    const std::uint32_t middle = partition(r, centers);
    const auto left = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    nodes.emplace_back();
    nodes[r.node].left = left;
    nodes[r.node].right = left + 1;
    node({left, r.first, middle - r.first, r.depth + 1});
    node({left + 1, middle, r.first + r.count - middle, r.depth + 1});
  }

  std::uint32_t partition(const Range& r, const Box& centers) {
    const auto begin = in_.order.begin() + r.first, end = begin + r.count;
    const Split split = r.depth < max_sah_depth ? best_split(r, centers) : Split{};
    if (split.axis >= 0) {
      const float scale = bin_scale(centers, split.axis);
      const auto middle = std::stable_partition(begin, end, [&](std::uint32_t p) {
        return bin_index(in_.centers[p][split.axis], centers.low[split.axis], scale) < split.bin;
      });
      if (middle != begin && middle != end)
        return static_cast<std::uint32_t>(middle - in_.order.begin());
    }
    // All centres alike, or too deep: by class first (a leaf holds one class), then in halves.
    const std::uint8_t head = in_.class_of(in_.order[r.first]);
    const auto by_class =
        std::stable_partition(begin, end, [&](std::uint32_t p) { return in_.class_of(p) == head; });
    if (by_class != end) return static_cast<std::uint32_t>(by_class - in_.order.begin());
    return r.first + r.count / 2;
  }

  static int bin_index(float c, float low, float scale) {
    return std::clamp(static_cast<int>((c - low) * scale), 0, bin_count - 1);
  }
  /// Bins per length along an axis; 0 where centres do not differ enough to tell bins apart.
  static float bin_scale(const Box& centers, int axis) {
    const float extent = centers.high[axis] - centers.low[axis];
    const float scale = bin_count / extent;
    return extent > 0.0f && std::isfinite(scale) ? scale : 0.0f;
  }

  /// Bins of all three axes for a part of `order`.
  Bins bin_range(std::size_t begin, std::size_t end, const Box& centers,
                 const glm::vec3& scale) const {
    Bins bins;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t prim = in_.order[i];
      const Box box = in_.boxes[prim];
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[axis][bin_index(in_.centers[prim][axis], centers.low[axis], scale[axis])];
        bin.box.add(box);
        ++bin.count;
      }
    }
    return bins;
  }

  Bins bin(const Range& r, const Box& centers, const glm::vec3& scale) const {
    if (r.count < parallel_node) return bin_range(r.first, r.first + r.count, centers, scale);
    std::vector<Bins> part(host_threads());
    parallel_chunks(r.first, r.count, part.size(),
                    [&](std::size_t c, std::size_t begin, std::size_t end) {
                      part[c] = bin_range(begin, end, centers, scale);
                    });
    for (std::size_t c = 1; c < part.size(); ++c)
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t k = 0; k < std::size_t(bin_count); ++k) {
          part[0][axis][k].box.add(part[c][axis][k].box);
          part[0][axis][k].count += part[c][axis][k].count;
        }
    return part[0];
  }

  Split best_split(const Range& r, const Box& centers) const {
    const glm::vec3 scale{bin_scale(centers, 0), bin_scale(centers, 1), bin_scale(centers, 2)};
    const Bins bins = bin(r, centers, scale);
    Split best;
    for (int axis = 0; axis < 3; ++axis)
      if (scale[axis] > 0.0f) sweep(bins[std::size_t(axis)], axis, best);
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

  Input& in_;
  std::uint32_t task_size_;
};

/// Puts a subtree in the place of node `at`; its nodes go to the end.
void splice(const std::vector<BinaryNode>& subtree, std::uint32_t at,
            std::vector<BinaryNode>& nodes) {
  const auto shift = static_cast<std::uint32_t>(nodes.size()) - 1;  // subtree[0] goes to `at`
  const auto moved = [&](BinaryNode node) {
    if (node.count == 0) node.left += shift, node.right += shift;
    return node;
  };
  nodes[at] = moved(subtree[0]);
  for (std::size_t i = 1; i < subtree.size(); ++i) nodes.push_back(moved(subtree[i]));
}

Input prepare(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& classes,
              const LeafCapacity& capacity) {
  Input in{boxes, classes, capacity, std::vector<glm::vec3>(boxes.size()),
           std::vector<std::uint32_t>(boxes.size())};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    PELLUCID_CHECK(!boxes[i].empty(), "a primitive has an empty or NaN box");
    in.centers[i] = 0.5f * boxes[i].low + 0.5f * boxes[i].high;  // halves first: no overflow
  }
  std::iota(in.order.begin(), in.order.end(), 0u);
  return in;
}

}  // namespace

BinaryTree build(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& classes,
                 const LeafCapacity& capacity) {
  PELLUCID_CHECK(classes.empty() || classes.size() == boxes.size(), "one class per box");
  for (std::uint32_t c : capacity) PELLUCID_CHECK(c > 0, "a leaf holds at least one primitive");
  BinaryTree tree;
  if (boxes.empty()) return tree;
  Input in = prepare(boxes, classes, capacity);
  const auto n = static_cast<std::uint32_t>(boxes.size());
  Builder top(in, std::max(smallest_task, n / task_share));
  top.run({0, 0, n, 0});
  std::vector<std::vector<BinaryNode>> subtrees(top.tasks.size());
  parallel_tasks(top.tasks.size(), [&](std::size_t i) {
    Builder builder(in, 0);
    builder.run(top.tasks[i]);
    subtrees[i] = std::move(builder.nodes);
  });
  tree.nodes = std::move(top.nodes);
  for (std::size_t i = 0; i < subtrees.size(); ++i)
    splice(subtrees[i], top.tasks[i].node, tree.nodes);
  tree.order = std::move(in.order);
  return tree;
}

}  // namespace pellucid::bvh
