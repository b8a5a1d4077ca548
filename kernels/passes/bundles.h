// Buffer bundles as kernel parameters. A parameter list ends with the launch struct, so every
// bundle may end with a comma.
#ifndef PELLUCID_PASSES_BUNDLES_H
#define PELLUCID_PASSES_BUNDLES_H

#include "geom/scene_data.h"

#define CONST_PARAM(T, name, meaning) __global const T *name,
#define PARAM(T, name, meaning) __global T *name,
#define SCENE_PARAMS SCENE_BUFFERS(CONST_PARAM) const SceneInfo scene_info, const Camera camera,
#define FILM_PARAMS FILM_BUFFERS(PARAM)
#define SPLAT_PARAMS SPLAT_BUFFERS(PARAM)
#define LAYER_PARAMS LAYER_BUFFERS(PARAM)
#define FILTER_PARAMS FILTER_BUFFERS(CONST_PARAM)
#define AOV_PARAMS AOV_BUFFERS(PARAM)
#define LIGHT_VERTEX_PARAMS LIGHT_VERTEX_BUFFERS(PARAM)
#define EYE_VERTEX_PARAMS EYE_VERTEX_BUFFERS(PARAM)
#define GRID_PARAMS GRID_BUFFERS(PARAM)
#define VERTEX_COUNT_PARAMS VERTEX_COUNT_BUFFERS(PARAM)
#define DIAG_PARAMS DIAG_BUFFERS(PARAM)

// Who replays: RECORDER says of what path, whether with its vertices, and whether at all.
#if INTG_RECORD
#define RECORD_PARAMS RECORD_BUFFERS(PARAM)
#define RECORDER(number, light, vertices, active) \
  scene_data.recorder =                           \
      (Recorder){record, record_count, launch.record_capacity, number, light, vertices, active};
#else
#define RECORD_PARAMS
#define RECORDER(number, light, vertices, active)
#endif

#define SCENE_ASSIGN(T, name, meaning) scene_data.name = name;
/// The work-item's number in its pass, of which this launch is a part.
INLINE uint work_item(Launch launch) {
  return launch.item_first + (uint)get_global_id(0);
}

/// Declares `scene_data` from the kernel's parameters.
#define SCENE_FROM_PARAMS     \
  SceneData scene_data;       \
  SCENE_BUFFERS(SCENE_ASSIGN) \
  scene_data.diag = diag;     \
  scene_data.info = scene_info;

#endif
