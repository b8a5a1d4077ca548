// probe_layout: the device's own sizes and offsets of every shared struct, compared with the
// host's. Writes: out [words]. Domain: 1. Next: nothing.
#include "shared/layout.h"
#include "shared/probe.h"

#define PROBE_SIZE(T) out[i++] = (uint)sizeof(T);
// Not by a null pointer: its bits are the device's own affair (all ones in Mesa).
#define PROBE_FIELD(T, field)                                 \
  {                                                           \
    T whole;                                                  \
    out[i++] = (uint)((uchar*)&whole.field - (uchar*)&whole); \
  }

__kernel void probe_layout(__global uint* out) {
  uint i = 0;
  LAYOUT_STRUCTS(PROBE_SIZE)
  LAYOUT_FIELDS(PROBE_FIELD)
}
