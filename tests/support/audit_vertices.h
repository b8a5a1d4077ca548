// Vertices of real walks, stored and read back: what storage does to connections and merges. The
// vertex's format is that of TWIN_COMPACT. Needs TWIN_CONNECT.
#pragma once

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/audit_paths.h"
#include "support/audit_scenes.h"

namespace TWIN_NAMESPACE {

struct StorageErrors {
  int vertices = 0, turned_black = 0;
  int pairs = 0, lost = 0;             ///< pairs that brought something; those that do no more
  double value_sum = 0, back_sum = 0;  ///< of all their values, before and after
  double worst_weight = 0;
  std::vector<double> value_errors;  ///< relative, of each
  double quantile(double q) {
    std::sort(value_errors.begin(), value_errors.end());
    return value_errors[std::size_t(q * double(value_errors.size() - 1))];
  }
  /// What a pair brought before, and after if it still does.
  template <typename Pair>
  void compare(const Pair& before, const Pair& after, bool found) {
    ++pairs;
    value_sum += double(before.value.x);
    if (!found) {
      ++lost;
      return;
    }
    back_sum += double(after.value.x);
    value_errors.push_back(std::abs(double(after.value.x) / double(before.value.x) - 1));
    worst_weight = std::max(worst_weight, std::abs(double(before.weight) - double(after.weight)));
  }
};

/// The vertex as it comes back from memory.
inline EndVertex stored(const TwinScene& twin, const EndVertex& end) {
  const StoredVertex s = vertex_pack(&end.v, end.beta, end.partials, end.depth);
  EndVertex back = vertex_unpack(&twin.data, s, end.v.context.importance);
#ifdef TWIN_MERGE
  back.partials.trust = end.partials.trust;  // passes know it by the vertex' place in its path
#endif
  return back;
}

/// All flags are back; where merges are weighed, one tells first vertices instead of emission.
inline void expect_flags(const EndVertex& a, const EndVertex& b) {
#ifdef TWIN_MERGE
  EXPECT_EQ(a.v.surface.flags & ~VERTEX_FIRST, b.v.surface.flags & ~VERTEX_FIRST);
  EXPECT_EQ(a.partials.trust == real(1), (b.v.surface.flags & VERTEX_FIRST) != 0u);
#else
  EXPECT_EQ(a.v.surface.flags, b.v.surface.flags);
#endif
}

/// The light vertex as if its walk had come to where the eye's vertex is.
inline EndVertex moved(const TwinScene& twin, EndVertex light, const EndVertex& eye) {
  const real3 wo = light.v.wo;
  light.v = vertex_at(&twin.data, eye.v.surface, wo, 1);
  return light;
}

/// Calls check(before, after) for the vertices of many walks; connects both, and merges them.
template <typename Check>
StorageErrors store_and_connect(const TwinScene& twin, Launch launch, Check check) {
  StorageErrors errors;
  const auto ignore = [](const FullPath&) {};
  for (uint path = 0; path < 1024; ++path) {
    PathFinder<decltype(ignore)> finder(twin, launch, ignore);
    finder.run(path);
    std::vector<EndVertex> before[2], after[2];
    for (int importance : {0, 1})
      for (const EndVertex& end : finder.ends(importance)) {
        if (bsdf_is_delta(end.v.material)) continue;
        const EndVertex back = stored(twin, end);
        ++errors.vertices;
        errors.turned_black += back.v.black;
        check(end, back);
        before[importance].push_back(end);
        after[importance].push_back(back);
      }
    for (std::size_t i = 0; i < before[0].size(); ++i)
      for (std::size_t j = 0; j < before[1].size(); ++j) {
        Connection a, b;
        const bool meets = connect_vertices(&twin.data, launch, &before[0][i], &before[1][j], &a);
        if (meets)
          errors.compare(a, b,
                         connect_vertices(&twin.data, launch, &after[0][i], &after[1][j], &b));
#ifdef TWIN_MERGE
        Merge c, d;
        const EndVertex light = moved(twin, before[1][j], before[0][i]), back = stored(twin, light);
        if (merge_ends(twin, launch, before[0][i], light, &c))
          errors.compare(c, d, merge_ends(twin, launch, after[0][i], back, &d));
#endif
      }
  }
  return errors;
}

inline Launch storage_launch() {
  Launch launch{};
  launch.width = launch.height = 32;
  launch.light_paths = 1024;
  launch.seed = 7;
  launch.max_depth = 12;
  launch.mis = MIS_BALANCE;
  if (merges) launch.mis_vm = launch.merge_scale = 1, launch.mis_deep = 0.5f;
  return launch;
}

}  // namespace TWIN_NAMESPACE
