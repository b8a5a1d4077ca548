// probe_frame: the frames around a list of normals, for the test that they are right-handed and
// orthonormal. Reads: normals [n]. Writes: frames [n][2]: s, t. Domain: n normals. Atomics: none.
// Next: nothing.
#include "core/frame.h"
#include "shared/platform.h"

__kernel void probe_frame(__global const F4* normals, __global F4* frames, const uint n) {
  uint i = (uint)get_global_id(0);
  if (i >= n) return;
  Frame f = frame_from_normal(load3(normals[i]));
  frames[2 * i] = (F4)(f.s.x, f.s.y, f.s.z, 0.0f);
  frames[2 * i + 1] = (F4)(f.t.x, f.t.y, f.t.z, 0.0f);
}
