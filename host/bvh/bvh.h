// Bounding volume hierarchies over spans of boxes. Knows no scene and no device: primitives are
// indices with a box and a class; a leaf holds primitives of one class only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace pellucid::bvh {

struct Box {
  glm::vec3 low{std::numeric_limits<float>::infinity()};
  glm::vec3 high{-std::numeric_limits<float>::infinity()};

  void add(const glm::vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void add(const Box& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
  bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  /// Half the surface area; 0 when empty.
  double half_area() const {
    if (empty()) return 0.0;
    const glm::dvec3 d = glm::dvec3(high) - glm::dvec3(low);
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

/// Binary tree: inner nodes have two children, leaves a range of `order`.
struct BinaryNode {
  Box box;
  std::uint32_t left = 0, right = 0;   ///< inner: node indices
  std::uint32_t first = 0, count = 0;  ///< leaf (count > 0): range in order
};
struct BinaryTree {
  std::vector<BinaryNode> nodes;     ///< nodes[0] is the root; empty without primitives
  std::vector<std::uint32_t> order;  ///< primitive indices, leaf by leaf
};

/// How many primitives of a class fit into one leaf.
constexpr int max_classes = 3;
using LeafCapacity = std::array<std::uint32_t, max_classes>;

/// Builds by binned SAH [Wald07]. `classes` (one per box, < max_classes) may be empty: all class 0.
/// Ties and equal centroids are split by position in `order`, so the result is a function of the
/// input.
BinaryTree build(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& classes,
                 const LeafCapacity& capacity);

constexpr int max_width = 16;
struct WideChild {
  Box box;
  std::uint32_t node = 0;              ///< inner: index of a wide node
  std::uint32_t first = 0, count = 0;  ///< leaf (count > 0): range in order
};
struct WideNode {
  int child_count = 0;
  std::array<WideChild, max_width> child;
};
struct WideTree {
  std::vector<WideNode> nodes;  ///< nodes[0] is the root; empty without primitives
  std::vector<std::uint32_t> order;
};

/// Collapses to nodes of up to `width` children at the least expected cost [Ylitie17].
WideTree collapse(const BinaryTree& tree, int width);

/// Most entries that depth-first traversal can have on its stack: over all root-to-leaf walks, the
/// sum of (children - 1).
std::uint32_t stack_bound(const WideTree& tree);

struct Statistics {
  std::uint64_t nodes = 0, leaves = 0, primitives = 0;
  std::uint32_t depth = 0, stack = 0;
  double mean_children = 0, mean_leaf_fill = 0;  ///< children per node, primitives per leaf
  double sah_cost = 0;  ///< expected nodes + leaves visited by a random line that hits the root
};
Statistics statistics(const WideTree& tree);

/// Throws InternalError unless every primitive is in exactly one leaf, every box contains what is
/// below it, and leaves are of one class and within capacity.
void validate(const WideTree& tree, const std::vector<Box>& boxes,
              const std::vector<std::uint8_t>& classes, const LeafCapacity& capacity);

}  // namespace pellucid::bvh
