// From the binary tree to wide nodes of least expected cost, and figures about the result.
#include <algorithm>

#include "base/error.h"
#include "bvh/bvh.h"

namespace pellucid::bvh {
namespace {

/// Expected visits of a random line, in units of half_area: a node and a leaf block cost the same.
constexpr double node_cost = 1.0, leaf_cost = 1.0;

/// Optimal collapse [Ylitie17 3.1]: for every binary node n and every i up to the width, the least
/// cost of representing its subtree by a forest of at most i roots, by dynamic programming from the
/// leaves up.
class Optimiser {
 public:
  Optimiser(const BinaryTree& tree, int width)
      : tree_(tree), width_(width), cost_(tree.nodes.size() * size_t(width)), left_(cost_.size()) {
    // Children have larger indices than their parents.
    for (size_t n = tree.nodes.size(); n-- > 0;) solve(n);
  }

  /// The subtrees that become children of the wide node for `n`.
  std::vector<std::uint32_t> children(std::uint32_t n) const {
    std::vector<std::uint32_t> out;
    if (tree_.nodes[n].count > 0) {
      out.push_back(n);
    } else {
      const int left = left_[at(n, 1)];
      gather(tree_.nodes[n].left, left, out);
      gather(tree_.nodes[n].right, width_ - left, out);
    }
    return out;
  }

 private:
  size_t at(size_t n, int roots) const { return n * size_t(width_) + size_t(roots - 1); }

  /// Best division of `roots` between the children: cost and how many go left.
  std::pair<double, int> distribute(const BinaryNode& node, int roots) const {
    std::pair<double, int> best{std::numeric_limits<double>::infinity(), 1};
    for (int k = 1; k < roots; ++k)
      best = std::min(
          best, {double(cost_[at(node.left, k)]) + double(cost_[at(node.right, roots - k)]), k});
    return best;
  }

  void solve(size_t n) {
    const BinaryNode& node = tree_.nodes[n];
    if (node.count > 0) {
      for (int i = 1; i <= width_; ++i) cost_[at(n, i)] = float(leaf_cost * node.box.half_area());
      return;
    }
    // One root: a wide node over the best forest of `width`. left_ of one root is that forest's
    // division.
    const auto [inside, left] = distribute(node, width_);
    cost_[at(n, 1)] = float(node_cost * node.box.half_area() + inside);
    left_[at(n, 1)] = std::uint8_t(left);
    for (int i = 2; i <= width_; ++i) {
      const auto [apart, k] = distribute(node, i);
      const bool open = apart < double(cost_[at(n, 1)]);
      cost_[at(n, i)] = open ? float(apart) : cost_[at(n, 1)];
      left_[at(n, i)] = open ? std::uint8_t(k) : std::uint8_t(0);  // 0: stays one root
    }
  }

  void gather(std::uint32_t n, int roots, std::vector<std::uint32_t>& out) const {
    const int left = roots > 1 && tree_.nodes[n].count == 0 ? left_[at(n, roots)] : 0;
    if (left == 0) {
      out.push_back(n);
      return;
    }
    gather(tree_.nodes[n].left, left, out);
    gather(tree_.nodes[n].right, roots - left, out);
  }

  const BinaryTree& tree_;
  int width_;
  std::vector<float> cost_;         // [node][roots - 1]
  std::vector<std::uint8_t> left_;  // [node][roots - 1]
};

WideChild as_child(const BinaryNode& node) {
  WideChild child;
  child.box = node.box;
  child.first = node.first;
  child.count = node.count;
  return child;
}

void collapse_into(const BinaryTree& tree, const Optimiser& best, std::uint32_t root,
                   WideTree& out) {
  const size_t index = out.nodes.size();
  out.nodes.emplace_back();
  const std::vector<std::uint32_t> open = best.children(root);
  out.nodes[index].child_count = static_cast<int>(open.size());
  for (size_t i = 0; i < open.size(); ++i) {
    WideChild child = as_child(tree.nodes[open[i]]);
    if (child.count == 0) {
      child.node = static_cast<std::uint32_t>(out.nodes.size());
      collapse_into(tree, best, open[i], out);
    }
    out.nodes[index].child[i] = child;
  }
}

std::uint32_t stack_below(const WideTree& tree, std::uint32_t node) {
  const WideNode& n = tree.nodes[node];
  std::uint32_t below = 0;
  for (int i = 0; i < n.child_count; ++i)
    if (n.child[i].count == 0) below = std::max(below, stack_below(tree, n.child[i].node));
  return below + static_cast<std::uint32_t>(n.child_count - 1);
}

std::uint32_t depth_below(const WideTree& tree, std::uint32_t node) {
  const WideNode& n = tree.nodes[node];
  std::uint32_t below = 0;
  for (int i = 0; i < n.child_count; ++i)
    if (n.child[i].count == 0) below = std::max(below, depth_below(tree, n.child[i].node));
  return below + 1;
}

}  // namespace

WideTree collapse(const BinaryTree& tree, int width) {
  PELLUCID_CHECK(width >= 2 && width <= max_width, "node width");
  WideTree out;
  out.order = tree.order;
  if (!tree.nodes.empty()) collapse_into(tree, Optimiser(tree, width), 0, out);
  return out;
}

std::uint32_t stack_bound(const WideTree& tree) {
  return tree.nodes.empty() ? 0 : stack_below(tree, 0);
}

Statistics statistics(const WideTree& tree) {
  Statistics s;
  if (tree.nodes.empty()) return s;
  Box root;
  for (int i = 0; i < tree.nodes[0].child_count; ++i) root.add(tree.nodes[0].child[i].box);
  const double root_area = std::max(root.half_area(), std::numeric_limits<double>::min());
  s.nodes = tree.nodes.size();
  s.sah_cost = 1.0;
  std::uint64_t children = 0;
  for (const WideNode& node : tree.nodes) {
    children += static_cast<std::uint64_t>(node.child_count);
    for (int i = 0; i < node.child_count; ++i) {
      s.sah_cost += node.child[i].box.half_area() / root_area;
      if (node.child[i].count > 0) ++s.leaves, s.primitives += node.child[i].count;
    }
  }
  s.mean_children = static_cast<double>(children) / static_cast<double>(s.nodes);
  s.mean_leaf_fill = static_cast<double>(s.primitives) / static_cast<double>(s.leaves);
  s.depth = depth_below(tree, 0);
  s.stack = stack_bound(tree);
  return s;
}

}  // namespace pellucid::bvh
