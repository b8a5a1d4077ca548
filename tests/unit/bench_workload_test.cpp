// Figures and scores of `bench --only render` are compared under one name: what it names is pinned.
#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "bench/figure.h"
#include "bench/method_bench.h"
#include "bench/render_workload.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace pellucid {
namespace {

std::string workload_hash() {
  Hasher hasher;
  for (const RenderWorkload& workload : render_workloads()) {
    hasher.add(workload.scene);
    for (const SourceFile& file :
         load_scene(find_scene(workload.scene, {PELLUCID_SCENE_DIR})).files)
      hasher.add(file.hash);
  }
  for (const char* method : {"path", "naive", "nee", "light", "bdpt", "sppm", "bpm", "vcm"})
    hasher.add(std::string(method) + std::to_string(workload_spp(method)));
  for (double number : {double(WORKLOAD_SIZE), double(WORKLOAD_REFERENCE_SPP),
                        WORKLOAD_REFERENCE_RADIUS, SCORE_RELMSE})
    hasher.add(std::to_string(number));
  return hasher.hex();
}

TEST(BenchWorkload, AnotherWorkloadHasAnotherName) {
  EXPECT_STREQ(RENDER_WORKLOAD, "render-2");
  EXPECT_EQ(workload_hash(), "1aaf9cd6b7bb28aaf29daf27e9e78a51")
      << "raise RENDER_WORKLOAD, since its figures are of other work now; then put both here";
}

MethodCell cell(const char* scene, const char* method, double relmse, double seconds) {
  MethodCell c;
  c.scene = scene;
  c.method = method;
  c.relmse = relmse;
  c.relmse_error = 0.1 * relmse;
  c.seconds = seconds;
  c.paths = 1000;
  c.efficiency = 1 / (relmse * seconds);
  return c;
}

TEST(BenchWorkload, AScoreIsAGeometricMeanOfWhatIsSeen) {
  std::vector<MethodCell> cells{cell("a", "path", 0.01, 2), cell("a", "light", 0.02, 1),
                                cell("b", "path", 0.04, 2), cell("b", "light", 1, 1)};
  cells[3].sees_all = false;
  const std::vector<MethodScore> scores = method_scores(cells);
  ASSERT_EQ(scores.size(), 2u);
  EXPECT_EQ(scores[0].method, "path");
  EXPECT_NEAR(scores[0].score, 0.25, 1e-12);  // of 1/2 and 1/8
  EXPECT_NEAR(scores[0].samples_per_s, 500, 1e-9);
  EXPECT_NEAR(std::log(scores[0].high / scores[0].score), 2 * std::sqrt(0.02) / 2, 1e-12);
  EXPECT_EQ(scores[1].scenes, std::vector<std::string>{"a"});
  EXPECT_NEAR(scores[1].score, 0.5, 1e-12);
}

TEST(BenchWorkload, AFailureLeavesNoScore) {
  std::vector<MethodCell> cells{cell("a", "path", 0.01, 2), cell("b", "path", 0.04, 2)};
  cells[1].failed = "out of memory";
  EXPECT_TRUE(method_scores(cells).empty());
}

TEST(BenchFigure, RangesOfMediansAreTheOrderStatisticsOfTheTables) {
  // [Conover99] table A3, 95 %: so many values are left out at either end.
  for (const auto& [n, out] : {std::pair{1, 0},
                               {5, 0},
                               {6, 0},
                               {8, 0},
                               {9, 1},
                               {11, 1},
                               {12, 2},
                               {15, 3},
                               {20, 5},
                               {30, 9}}) {
    std::vector<double> values;
    for (int i = n; i > 0; --i) values.push_back(i);
    const MedianRange range = median_range(values);
    EXPECT_EQ(range.low, out + 1) << n;
    EXPECT_EQ(range.high, n - out) << n;
    EXPECT_NEAR(range.median, (n + 1) / 2.0, 0.51) << n;
  }
}

}  // namespace
}  // namespace pellucid
