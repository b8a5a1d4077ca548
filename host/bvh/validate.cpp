// Checks of a finished tree.
#include "base/error.h"
#include "bvh/bvh.h"

namespace pellucid::bvh {
namespace {

bool contains(const Box& outer, const Box& inner) {
  return glm::all(glm::lessThanEqual(outer.low, inner.low)) &&
         glm::all(glm::greaterThanEqual(outer.high, inner.high));
}

struct Checker {
  const WideTree& tree;
  const std::vector<Box>& boxes;
  const std::vector<std::uint8_t>& classes;
  const LeafCapacity& capacity;
  std::vector<std::uint8_t> seen;
  std::vector<std::uint8_t> visited;

  void leaf(const WideChild& child) {
    const std::uint32_t head = tree.order.at(child.first);
    const std::uint8_t leaf_class = classes.empty() ? 0 : classes.at(head);
    PELLUCID_CHECK(child.count <= capacity[leaf_class], "leaf over capacity");
    for (std::uint32_t i = child.first; i < child.first + child.count; ++i) {
      const std::uint32_t prim = tree.order.at(i);
      PELLUCID_CHECK(seen.at(prim)++ == 0, "primitive in two leaves");
      PELLUCID_CHECK(contains(child.box, boxes[prim]), "leaf box too small");
      PELLUCID_CHECK((classes.empty() ? 0 : classes[prim]) == leaf_class, "mixed leaf");
    }
  }

  void node(std::uint32_t index, const Box* outer) {
    PELLUCID_CHECK(visited.at(index)++ == 0, "node reached twice");
    const WideNode& n = tree.nodes[index];
    PELLUCID_CHECK(n.child_count >= 1 && n.child_count <= max_width, "child count");
    for (int i = 0; i < n.child_count; ++i) {
      const WideChild& child = n.child[i];
      PELLUCID_CHECK(!outer || contains(*outer, child.box), "child outside its parent");
      if (child.count > 0) {
        leaf(child);
      } else {
        node(child.node, &child.box);
      }
    }
  }
};

}  // namespace

void validate(const WideTree& tree, const std::vector<Box>& boxes,
              const std::vector<std::uint8_t>& classes, const LeafCapacity& capacity) {
  PELLUCID_CHECK(tree.nodes.empty() == boxes.empty(), "tree and primitives");
  Checker checker{tree,
                  boxes,
                  classes,
                  capacity,
                  std::vector<std::uint8_t>(boxes.size(), 0),
                  std::vector<std::uint8_t>(tree.nodes.size(), 0)};
  if (!boxes.empty()) checker.node(0, nullptr);
  for (std::uint8_t s : checker.seen) PELLUCID_CHECK(s == 1, "primitive in no leaf");
}

}  // namespace pellucid::bvh
