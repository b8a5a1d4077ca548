// Vertices stored whole come back as they were, up to the rounding of doubles to float.
#include <gtest/gtest.h>

#include "support/audit_vertices.h"

namespace {

using namespace twin;
using namespace pellucid::test;

void expect_float(real before, real after) {
  EXPECT_EQ(float(before), float(after));
}

void expect_same(const EndVertex& a, const EndVertex& b) {
  const real3 pairs[][2] = {{a.v.surface.p, b.v.surface.p},
                            {a.v.surface.ng, b.v.surface.ng},
                            {a.v.surface.ns, b.v.surface.ns},
                            {a.beta, b.beta}};
  for (const auto& [x, y] : pairs) {
    expect_float(x.x, y.x);
    expect_float(x.y, y.y);
    expect_float(x.z, y.z);
  }
  expect_float(a.partials.dVCM, b.partials.dVCM);
  expect_float(partials_dVC(a.partials), partials_dVC(b.partials));
  expect_float(a.v.surface.offset, b.v.surface.offset);
  expect_float(a.v.surface.u, b.v.surface.u);
  expect_float(a.v.surface.v, b.v.surface.v);
  EXPECT_EQ(a.v.surface.material, b.v.surface.material);
  expect_flags(a, b);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.v.context.importance, b.v.context.importance);
  // To the world and back: some roundoffs of 1.
  EXPECT_NEAR(double(a.v.context.wo.x), double(b.v.context.wo.x), 1e-6);
  EXPECT_NEAR(double(a.v.context.wo.y), double(b.v.context.wo.y), 1e-6);
  EXPECT_NEAR(double(a.v.context.wo.z), double(b.v.context.wo.z), 1e-6);
}

TEST(AuditVertex, FullComesBackAsItWas) {
  for (bool open : {false, true}) {
    const TwinScene twin(audit_room(open));
    StorageErrors e = store_and_connect(twin, storage_launch(), expect_same);
    std::printf(
        "full: %d vertices, %d black; %d pairs, %d lost; error of values: median "
        "%.2g, 99%% %.2g, of their sum %.2g; worst of weights %.2g\n",
        e.vertices, e.turned_black, e.pairs, e.lost, e.quantile(0.5), e.quantile(0.99),
        e.back_sum / e.value_sum - 1, e.worst_weight);
    EXPECT_GT(e.vertices, 1000);
    EXPECT_EQ(e.turned_black, 0);
    EXPECT_LE(e.lost, e.pairs / 10000);
    EXPECT_LT(e.quantile(0.99), 1e-4);
    EXPECT_NEAR(e.back_sum / e.value_sum, 1.0, 1e-5);
  }
}

}  // namespace
