// BVH construction: the validator holds on ordinary and on hostile input, the stack bound is
// sharp, the figures are right and the result is a function of the input.
#include <gtest/gtest.h>

#include <functional>

#include "base/error.h"
#include "bvh/bvh.h"
#include "support/test_scenes.h"

namespace pellucid::bvh {
namespace {

using test::Random;

struct Input {
  std::string name;
  std::vector<Box> boxes;
  std::vector<std::uint8_t> classes;
};

Box box_at(const glm::dvec3& center, double half) {
  Box box;
  box.add(glm::vec3(center - half));
  box.add(glm::vec3(center + half));
  return box;
}

std::vector<Box> make(int n, const std::function<Box(int)>& f) {
  std::vector<Box> boxes;
  for (int i = 0; i < n; ++i) boxes.push_back(f(i));
  return boxes;
}

std::vector<Input> inputs() {
  Random random(1);
  std::vector<Input> all;
  all.push_back({"none", {}, {}});
  all.push_back({"one", make(1, [](int) { return box_at({1, 2, 3}, 0.5); }), {}});
  all.push_back({"nine", make(9, [](int i) { return box_at(glm::dvec3(i), 0.1); }), {}});
  const auto anywhere = [&](int) { return box_at(random.in_box(10), random.uniform(0, 0.3)); };
  all.push_back({"random", make(20000, anywhere), {}});
  all.push_back({"all equal", make(5000, [](int) { return box_at({1, 1, 1}, 1); }), {}});
  all.push_back({"points in one place", make(1000, [](int) { return box_at({3, 3, 3}, 0); }), {}});
  all.push_back({"collinear", make(5000, [](int i) { return box_at({i * 0.1, 0, 0}, 0.01); }), {}});
  all.push_back(
      {"geometric",
       make(250, [](int i) { return box_at(glm::dvec3(std::pow(1.4, i % 120), 0, 0), 0.0); }),
       {}});
  all.push_back({"nested shells",
                 make(100000, [](int i) { return box_at(glm::dvec3(0), 1 + 1e-3 * i); }),
                 {}});
  all.push_back({"huge", make(1000, [&](int) { return box_at(random.in_box(1e15), 1e14); }), {}});
  all.push_back(
      {"subnormal", make(1000, [&](int) { return box_at(random.in_box(1e-39), 0); }), {}});
  Input mixed{"mixed classes", make(5000, anywhere), {}};
  for (size_t i = 0; i < mixed.boxes.size(); ++i) mixed.classes.push_back(random.below(2) == 1);
  all.push_back(mixed);
  Input mixed_equal{"mixed classes in one place",
                    make(500,
                         [](int) {
                           return box_at({0, 0, 0}, 1);
                         }),
                    {}};
  for (int i = 0; i < 500; ++i) mixed_equal.classes.push_back(i % 3 == 0);
  all.push_back(mixed_equal);
  return all;
}

/// Deepest stack of a traversal that meets every box and may enter children in any order: after
/// entering child i of c, the other c - 1 wait in the worst case.
std::uint32_t worst_stack(const WideTree& tree, std::uint32_t node, std::uint32_t waiting) {
  const WideNode& n = tree.nodes[node];
  std::uint32_t worst = waiting;
  for (int i = 0; i < n.child_count; ++i) {
    const std::uint32_t here = waiting + std::uint32_t(n.child_count) - 1;
    worst = std::max(worst, n.child[i].count > 0 ? here : worst_stack(tree, n.child[i].node, here));
  }
  return worst;
}

TEST(BvhBuild, ValidForEveryInputWidthAndLeafSize) {
  for (const Input& input : inputs())
    for (int width : {2, 4, 8, 16}) {
      SCOPED_TRACE(input.name + " width " + std::to_string(width));
      const LeafCapacity capacity{std::uint32_t(width), 1, 1};
      const WideTree tree = collapse(build(input.boxes, input.classes, capacity), width);
      ASSERT_NO_THROW(validate(tree, input.boxes, input.classes, capacity));
      EXPECT_EQ(stack_bound(tree), tree.nodes.empty() ? 0u : worst_stack(tree, 0, 0));
      for (const WideNode& node : tree.nodes) EXPECT_LE(node.child_count, width);
    }
}

TEST(BvhBuild, DepthOfHostileInputsIsBounded) {
  for (const Input& input : inputs()) {
    const WideTree tree = collapse(build(input.boxes, input.classes, {8, 1, 1}), 8);
    const Statistics s = statistics(tree);
    EXPECT_LE(s.depth, 64u + 18u) << input.name;  // SAH depth + log2 of the rest
    // The kernels' stack is compiled for the scene; more than this would not fit private memory.
    EXPECT_LE(s.stack, 256u) << input.name;
  }
}

TEST(BvhBuild, StatisticsAddUp) {
  const Input random = inputs()[3];
  const WideTree tree = collapse(build(random.boxes, {}, {8, 1, 1}), 8);
  const Statistics s = statistics(tree);
  EXPECT_EQ(s.primitives, random.boxes.size());
  EXPECT_EQ(s.nodes, tree.nodes.size());
  // Every node but the root and every leaf is a child of exactly one node.
  EXPECT_NEAR(s.mean_children * double(s.nodes), double(s.nodes - 1 + s.leaves), 1e-6);
  EXPECT_NEAR(s.mean_leaf_fill * double(s.leaves), double(s.primitives), 1e-6);
  EXPECT_GT(s.mean_children, 4.0);
  EXPECT_GT(s.mean_leaf_fill, 2.0);
  EXPECT_EQ(s.stack, stack_bound(tree));
}

TEST(BvhBuild, SurfaceAreaHeuristicBeatsOrder) {
  // Two far clusters given alternately: the first split must separate them.
  const auto boxes = make(1000, [](int i) {
    return box_at({i % 2 ? 1000.0 : 0.0, i * 1e-3, 0}, 0.1);
  });
  const BinaryTree tree = build(boxes, {}, {8, 1, 1});
  const BinaryNode &left = tree.nodes[tree.nodes[0].left], &right = tree.nodes[tree.nodes[0].right];
  EXPECT_LT(left.box.half_area() + right.box.half_area(), 0.01 * tree.nodes[0].box.half_area());
}

TEST(BvhBuild, SameInputSameTree) {
  const Input input = inputs()[3];
  const WideTree a = collapse(build(input.boxes, {}, {8, 1, 1}), 8);
  const WideTree b = collapse(build(input.boxes, {}, {8, 1, 1}), 8);
  ASSERT_EQ(a.order, b.order);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (size_t i = 0; i < a.nodes.size(); ++i)
    for (int k = 0; k < a.nodes[i].child_count; ++k) {
      EXPECT_EQ(a.nodes[i].child[k].node, b.nodes[i].child[k].node);
      EXPECT_EQ(a.nodes[i].child[k].box.low, b.nodes[i].child[k].box.low);
    }
}

TEST(BvhBuild, RefusesWhatHasNoBox) {
  std::vector<Box> boxes(3, box_at({0, 0, 0}, 1));
  boxes[1] = Box{};
  EXPECT_THROW(build(boxes, {}, {8, 1, 1}), InternalError);
  boxes[1] = box_at({0, 0, 0}, 1);
  boxes[1].low.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(build(boxes, {}, {8, 1, 1}), InternalError);
  EXPECT_THROW(build({box_at({0, 0, 0}, 1)}, {0, 0}, {8, 1, 1}), InternalError);
}

/// The validator must be able to fail.
class Validator : public ::testing::Test {
 protected:
  Validator() : input(inputs()[3]), tree(collapse(build(input.boxes, {}, {8, 1, 1}), 8)) {}
  void expect_refused() { EXPECT_THROW(validate(tree, input.boxes, {}, {8, 1, 1}), InternalError); }
  WideChild& some_leaf() {
    for (WideNode& node : tree.nodes)
      for (int i = 0; i < node.child_count; ++i)
        if (node.child[i].count > 1) return node.child[i];
    throw std::logic_error("no leaf");
  }
  Input input;
  WideTree tree;
};

TEST_F(Validator, SeesALostPrimitive) {
  --some_leaf().count;
  expect_refused();
}
TEST_F(Validator, SeesADuplicate) {
  const WideChild& leaf = some_leaf();
  tree.order[leaf.first] = tree.order[leaf.first + 1];
  expect_refused();
}
TEST_F(Validator, SeesABoxThatIsTooSmall) {
  WideChild& leaf = some_leaf();
  leaf.box.high.x = std::nextafter(leaf.box.high.x, -1e9f);
  expect_refused();
}
TEST_F(Validator, SeesACycle) {
  for (WideNode& node : tree.nodes)
    for (int i = 0; i < node.child_count; ++i)
      if (node.child[i].count == 0) node.child[i].node = 0;
  expect_refused();
}
TEST_F(Validator, SeesALeafOverCapacity) {
  EXPECT_THROW(validate(tree, input.boxes, {}, {1, 1, 1}), InternalError);
}
TEST_F(Validator, SeesAMixedLeaf) {
  std::vector<std::uint8_t> classes(input.boxes.size(), 0);
  classes[tree.order[some_leaf().first]] = 1;
  EXPECT_THROW(validate(tree, input.boxes, classes, {8, 8}), InternalError);
}

}  // namespace
}  // namespace pellucid::bvh
