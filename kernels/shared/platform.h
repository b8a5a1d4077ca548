// What differs between OpenCL C and C++ for code that both compile: scalar, vector and
// address-space names. Kernel files are compiled three times: as OpenCL C, and (the twin) as host
// C++ with `real` = float and double. Nothing else may ask which language it is in.
#ifndef PELLUCID_SHARED_PLATFORM_H
#define PELLUCID_SHARED_PLATFORM_H

#ifdef __OPENCL_C_VERSION__
#define PELLUCID_DEVICE 1
#define GLOBAL __global
#define PRIVATE __private
#define INLINE static inline __attribute__((always_inline))
typedef float4 F4;
typedef uint4 U4;
#else
#define PELLUCID_DEVICE 0
#define GLOBAL
#define PRIVATE
#define INLINE inline
#include <cstddef>
#include <cstdint>
using uint = std::uint32_t;
using ulong = std::uint64_t;
struct alignas(16) F4 {
  float x, y, z, w;
};
struct alignas(16) U4 {
  uint x, y, z, w;
};
#endif

#endif
