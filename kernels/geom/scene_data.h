// The scene's buffers as one struct of pointers, built from the kernel's parameters.
#ifndef PELLUCID_GEOM_SCENE_DATA_H
#define PELLUCID_GEOM_SCENE_DATA_H

#include "shared/buffers.h"

#define BUFFER_POINTER(T, name, meaning) GLOBAL const T* name;
typedef struct SceneData {
  SCENE_BUFFERS(BUFFER_POINTER)
  GLOBAL uint* diag;  // counters
  SceneInfo info;
} SceneData;

/// Counts an event of shared/buffers.h.
INLINE void diag_count(PRIVATE const SceneData* scene, uint counter) {
  diag_add(scene->diag, counter);
}

#endif
