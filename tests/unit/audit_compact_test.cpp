// Vertices stored in half the bytes: how far connections are off.
#define TWIN_COMPACT

#include <gtest/gtest.h>

#include "support/audit_vertices.h"

namespace {

using namespace twin;
using namespace pellucid::test;

double angle_between(real3 a, real3 b) {
  return double(length3(cross3(a, b)));
}

void expect_close(const EndVertex& a, const EndVertex& b) {
  EXPECT_EQ(float(a.v.surface.p.x), float(b.v.surface.p.x));
  EXPECT_EQ(float(a.v.surface.p.y), float(b.v.surface.p.y));
  EXPECT_EQ(float(a.v.surface.p.z), float(b.v.surface.p.z));
  EXPECT_LT(angle_between(a.v.surface.ng, b.v.surface.ng), 6.5e-5);
  EXPECT_LT(angle_between(a.v.surface.ns, b.v.surface.ns), 6.5e-5);
  const real largest = max3(a.beta);
  EXPECT_LE(double(max3(abs3(a.beta - b.beta))), 1.0 / 255 * double(largest));
  EXPECT_NEAR(double(b.partials.dVCM), double(a.partials.dVCM), 0x1p-16 * double(a.partials.dVCM));
  EXPECT_NEAR(double(partials_dVC(b.partials)), double(partials_dVC(a.partials)),
              0x1p-16 * double(partials_dVC(a.partials)));
  EXPECT_GE(float(b.v.surface.offset), float(a.v.surface.offset)) << "it must still clear";
  EXPECT_LE(float(b.v.surface.offset), 2 * float(a.v.surface.offset));
  EXPECT_NEAR(double(b.v.surface.u), double(a.v.surface.u), 1e-3);
  EXPECT_NEAR(double(b.v.surface.v), double(a.v.surface.v), 1e-3);
  EXPECT_EQ(a.v.surface.material, b.v.surface.material);
  expect_flags(a, b);
  EXPECT_EQ(a.depth, b.depth);
}

TEST(AuditCompact, IsOffByAHundredth) {
  EXPECT_LE(2 * sizeof(CompactVertex), sizeof(PathVertex));
  for (bool open : {false, true}) {
    const TwinScene twin(audit_room(open));
    StorageErrors e = store_and_connect(twin, storage_launch(), expect_close);
    std::printf(
        "compact: %d vertices, %d black; %d pairs, %d lost; error of values: median "
        "%.2g, 99%% %.2g, of their sum %.2g; worst of weights %.2g\n",
        e.vertices, e.turned_black, e.pairs, e.lost, e.quantile(0.5), e.quantile(0.99),
        e.back_sum / e.value_sum - 1, e.worst_weight);
    EXPECT_GT(e.vertices, 1000);
    // Directions turn by 6.5e-5, so what grazes by less may end up on the other side.
    EXPECT_LE(e.turned_black, e.vertices / 1000);
    EXPECT_LE(e.lost, e.pairs / 1000);
    // Colours to 1/255 of the largest channel, twice.
    EXPECT_LT(e.quantile(0.5), 1e-2);
    EXPECT_NEAR(e.back_sum / e.value_sum, 1.0, 2e-3);
  }
}

}  // namespace
