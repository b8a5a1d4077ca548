// Vertices of real walks, stored and read back: what storage does to connections. The vertex's
// format is that of TWIN_COMPACT. Needs TWIN_CONNECT.
#pragma once

#include <algorithm>
#include <cstdio>

#include "support/audit_paths.h"
#include "support/audit_scenes.h"

namespace TWIN_NAMESPACE {

struct StorageErrors {
  int vertices = 0, turned_black = 0;
  int pairs = 0, lost = 0;             ///< pairs that connected before; those that do no more
  double value_sum = 0, back_sum = 0;  ///< of all connections' values, before and after
  double worst_weight = 0;
  std::vector<double> value_errors;  ///< relative, of each connection's value
  double quantile(double q) {
    std::sort(value_errors.begin(), value_errors.end());
    return value_errors[std::size_t(q * double(value_errors.size() - 1))];
  }
};

/// Calls check(before, after) for the vertices of many walks, and connects both.
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
        const StoredVertex stored = vertex_pack(&end.v, end.beta, end.partials, end.depth);
        const EndVertex back = vertex_unpack(&twin.data, stored, importance);
        ++errors.vertices;
        errors.turned_black += back.v.black;
        check(end, back);
        before[importance].push_back(end);
        after[importance].push_back(back);
      }
    for (std::size_t i = 0; i < before[0].size(); ++i)
      for (std::size_t j = 0; j < before[1].size(); ++j) {
        Connection a, b;
        if (!connect_vertices(&twin.data, launch, &before[0][i], &before[1][j], &a)) continue;
        ++errors.pairs;
        errors.value_sum += double(a.value.x);
        if (!connect_vertices(&twin.data, launch, &after[0][i], &after[1][j], &b)) {
          ++errors.lost;
          continue;
        }
        errors.back_sum += double(b.value.x);
        errors.value_errors.push_back(std::abs(double(b.value.x) / double(a.value.x) - 1));
        errors.worst_weight =
            std::max(errors.worst_weight, std::abs(double(a.weight) - double(b.weight)));
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
  return launch;
}

}  // namespace TWIN_NAMESPACE
