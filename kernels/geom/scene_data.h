// The scene's buffers as one struct of pointers, built from the kernel's parameters.
#ifndef PELLUCID_GEOM_SCENE_DATA_H
#define PELLUCID_GEOM_SCENE_DATA_H

#include "shared/buffers.h"

#if INTG_RECORD
/// Where a work-item writes down what its path does (transport/record.h).
typedef struct Recorder {
  GLOBAL PathEvent* events;
  GLOBAL uint* count;  // of all work-items
  uint capacity;
  uint path;      // PathEvent.path
  uint on_light;  // PathEvent.on_light
  int walk;       // its vertices, too
  int on;
} Recorder;
#endif

#define BUFFER_POINTER(T, name, meaning) GLOBAL const T* name;
typedef struct SceneData {
  SCENE_BUFFERS(BUFFER_POINTER)
  GLOBAL uint* diag;  // counters
  SceneInfo info;
#if INTG_RECORD
  Recorder recorder;
#endif
} SceneData;

/// Counts an event of shared/buffers.h.
INLINE void diag_count(PRIVATE const SceneData* scene, uint counter) {
  diag_add(scene->diag, counter);
}

/// A ray of a walk has left the scene: if that says it is closed, it has a crack.
INLINE void scene_left(PRIVATE const SceneData* scene) {
  if (scene->info.closed) diag_count(scene, DIAG_escaped);
}

#endif
