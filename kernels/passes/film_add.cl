// film_add: folds an iteration's samples (and its splats, if the method makes any) into the film.
// Reads: samples [pixels], splats. Writes: film [pixels], splats (cleared), diag. Domain: pixels.
// Flags: INTG_SPLAT, INTG_MERGE, INTG_SOBOL. Atomics: diag only. Next: the next iteration.
#include "film/film.h"
#include "passes/bundles.h"

__kernel void film_add(FILM_PARAMS
#if INTG_SPLAT || INTG_MERGE
                           SPLAT_PARAMS
#endif
                               DIAG_PARAMS const Launch launch) {
  uint pixel = work_item(launch);
  if (pixel >= launch.tile_width * launch.tile_height) return;
  F4 sample = samples[pixel];
#if INTG_SPLAT || INTG_MERGE
  __global uint* word = splats + (size_t)pixel * SPLAT_WORDS;
  sample.x += splat_value(word, launch.splat_scale);
  sample.y += splat_value(word + 2, launch.splat_scale);
  sample.z += splat_value(word + 4, launch.splat_scale);
  film_count(&film[pixel], word[6], word[7]);
  for (int i = 0; i < SPLAT_WORDS; ++i) word[i] = 0u;
#endif
  film_accumulate(&film[pixel], diag, launch, sample);
}
