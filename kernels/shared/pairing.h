// Which light path an eye path is connected with, for kernels and for the host that slices both.
#ifndef PELLUCID_SHARED_PAIRING_H
#define PELLUCID_SHARED_PAIRING_H

#include "shared/platform.h"

/// Light path of pixel `pixel` (row by row) of a picture of so many `pixels`. Rows of pixels go
/// with runs of light paths, whatever the number of these.
INLINE uint paired_light_path(uint pixel, uint pixels, uint light_paths) {
  if (light_paths == pixels) return pixel;
  return (uint)((ulong)pixel * light_paths / pixels);
}

#endif
