// From the binary tree to wide nodes, and figures about the result.
#include <algorithm>

#include "base/error.h"
#include "bvh/bvh.h"

namespace pellucid::bvh {
namespace {

WideChild as_child(const BinaryNode& node) {
  WideChild child;
  child.box = node.box;
  child.first = node.first;
  child.count = node.count;
  return child;
}

/// Opens children of `root` until `width` are there, the largest inner one first.
std::vector<std::uint32_t> open_children(const BinaryTree& tree, std::uint32_t root, int width) {
  if (tree.nodes[root].count > 0) return {root};
  std::vector<std::uint32_t> open{tree.nodes[root].left, tree.nodes[root].right};
  while (static_cast<int>(open.size()) < width) {
    int largest = -1;
    double area = -1.0;
    for (size_t i = 0; i < open.size(); ++i) {
      const BinaryNode& node = tree.nodes[open[i]];
      if (node.count == 0 && node.box.half_area() > area) {
        area = node.box.half_area();
        largest = static_cast<int>(i);
      }
    }
    if (largest < 0) break;
    const BinaryNode& node = tree.nodes[open[largest]];
    open[largest] = node.left;
    open.insert(open.begin() + largest + 1, node.right);
  }
  return open;
}

void collapse_into(const BinaryTree& tree, std::uint32_t root, int width, WideTree& out) {
  const size_t index = out.nodes.size();
  out.nodes.emplace_back();
  const std::vector<std::uint32_t> open = open_children(tree, root, width);
  out.nodes[index].child_count = static_cast<int>(open.size());
  for (size_t i = 0; i < open.size(); ++i) {
    WideChild child = as_child(tree.nodes[open[i]]);
    if (child.count == 0) {
      child.node = static_cast<std::uint32_t>(out.nodes.size());
      collapse_into(tree, open[i], width, out);
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
  if (!tree.nodes.empty()) collapse_into(tree, 0, width, out);
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
