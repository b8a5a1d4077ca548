// Exclusive sums of a list by one work-group.
#ifndef PELLUCID_PASSES_SCAN_H
#define PELLUCID_PASSES_SCAN_H

#include "shared/limits.h"
#include "shared/platform.h"

/// Replaces list[i] by the sum of all before it; every work-item returns the sum of all that stand
/// before its own share's end, so the last one's is the total. All work-items of the group take
/// part; `ends` has room for each.
INLINE uint scan_exclusive(__global uint* list, uint n, __local uint* ends) {
  uint lane = (uint)get_local_id(0), lanes = (uint)get_local_size(0);
  uint share = (n + lanes - 1u) / lanes;
  uint begin = min(lane * share, n), end = min(begin + share, n);
  uint sum = 0u;
  for (uint i = begin; i < end; ++i) sum += list[i];
  ends[lane] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint before = 0u;
  for (uint i = 0u; i < lane; ++i) before += ends[i];
  for (uint i = begin; i < end; ++i) {
    uint count = list[i];
    list[i] = before;
    before += count;
  }
  return before;
}

#endif
