// The twin: the kernel core compiled as C++ with PELLUCID_REAL = float (namespace twin_f32) or
// double (twin_f64), on the very arrays that pack_scene makes for the device. At most one of the
// two per translation unit; `twin` names it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

// Shared structs stay global: the twin and host/pack mean the same types.
#include "pack/pack.h"
#include "shared/buffers.h"
#include "shared/features.h"
#include "shared/film_sums.h"
#include "shared/layers.h"
#include "shared/layout.h"
#include "shared/limits.h"
#include "support/twin_prelude.h"

// Every way to compile it has a name of its own: the linker must not take one's functions for
// another's.
#ifdef TWIN_COMPACT
#define TWIN_SUFFIX _compact
#elif defined(TWIN_CONNECT)
#define TWIN_SUFFIX _connect
#elif defined(TWIN_MERGE)
#define TWIN_SUFFIX _merge
#else
#define TWIN_SUFFIX
#endif
#define TWIN_PASTE(name, suffix) name##suffix
#define TWIN_NAMED(name, suffix) TWIN_PASTE(name, suffix)
#ifdef PELLUCID_REAL_IS_FLOAT
#define TWIN_NAMESPACE TWIN_NAMED(twin_f32, TWIN_SUFFIX)
#else
#define TWIN_NAMESPACE TWIN_NAMED(twin_f64, TWIN_SUFFIX)
#endif

// A feature missing from the prelude would silently count as 0 in #if.
#define TWIN_FEATURE_DEFINED(name, meaning) static_assert(name == 0 || name == 1, #name);
FEATURES(TWIN_FEATURE_DEFINED)
#undef TWIN_FEATURE_DEFINED

namespace TWIN_NAMESPACE {

#include "camera/camera.h"
#include "camera/filter.h"
#include "film/film.h"
#include "transport/connect.h"
#include "transport/light_walk.h"
#include "transport/path.h"
#if INTG_MERGE
#include "transport/merge.h"
#endif

constexpr bool is_float = sizeof(real) == sizeof(float);
constexpr bool merges = INTG_MERGE == 1;
constexpr bool connects = INTG_CONNECT == 1;
constexpr bool samples_lights = INTG_NEE == 1;

/// Kernel view of packed arrays, which must outlive it; counters go to `diag`.
inline SceneData scene_data(const pellucid::PackedScene& packed, std::vector<uint>& diag) {
  SceneData data{};
#define TWIN_POINTER(T, name, meaning) data.name = packed.name.data();
  SCENE_BUFFERS(TWIN_POINTER)
#undef TWIN_POINTER
  diag.assign(DIAG_COUNT, 0);
  data.diag = diag.data();
  data.info = packed.info;
  return data;
}

/// A packed scene together with the kernels' view of it.
struct TwinScene {
  explicit TwinScene(const pellucid::Scene& scene)
      : packed(pellucid::pack_scene(scene, {SIMD_WIDTH})), data(scene_data(packed, diag)) {}
  TwinScene(const TwinScene&) = delete;
  TwinScene& operator=(const TwinScene&) = delete;

  Hit trace(const Ray& ray) const { return bvh_trace(&data, ray, 0); }

  pellucid::PackedScene packed;
  std::vector<uint> diag;
  SceneData data;
};

inline real3 to_real3(const glm::dvec3& v) {
  return REAL3(v.x, v.y, v.z);
}
inline glm::dvec3 to_dvec3(real3 v) {
  return {double(v.x), double(v.y), double(v.z)};
}

}  // namespace TWIN_NAMESPACE

namespace twin = TWIN_NAMESPACE;

#include "support/twin_prelude_end.h"
