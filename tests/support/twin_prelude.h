// What the host writes before every kernel, here for the twin: all effects, width 8; the walks of
// `path`, with TWIN_CONNECT those of `bdpt`, with TWIN_MERGE those of `bpm`, with both of `vcm`.
// No include guard: twin.h includes it right before the kernel core and twin_prelude_end.h after.
#define SIMD_WIDTH 8
#define SIMD_BUILTINS 0
#define BVH_STACK 256
#define DEV_INT64_ATOMICS 0
#define FEAT_TRIANGLES 1
#define FEAT_SPHERES 1
#define FEAT_DISKS 1
#define FEAT_SMOOTH_NORMALS 1
#define FEAT_TEXTURE 1
#define FEAT_ONE_SIDED 1
#define FEAT_DIFFUSE 1
#define FEAT_OREN_NAYAR 1
#define FEAT_PHONG 1
#define FEAT_PLASTIC 1
#define FEAT_ROUGH_PLASTIC 1
#define FEAT_MIRROR 1
#define FEAT_CONDUCTOR 1
#define FEAT_ROUGH_CONDUCTOR 1
#define FEAT_DIELECTRIC 1
#define FEAT_ROUGH_DIELECTRIC 1
#define FEAT_THIN_DIELECTRIC 1
#define FEAT_MIX 1
#define FEAT_LIGHT_TRIANGLE 1
#define FEAT_LIGHT_SPHERE 1
#define FEAT_LIGHT_DISK 1
#define FEAT_LIGHT_POINT 1
#define FEAT_LIGHT_SPOT 1
#define FEAT_LIGHT_DIRECTIONAL 1
#define FEAT_LIGHT_ENVIRONMENT 1
#if defined(TWIN_MERGE) && !defined(TWIN_CONNECT)  // of `bpm`
#define INTG_NEE 0
#else
#define INTG_NEE 1
#endif
#define INTG_MIS INTG_NEE
#define INTG_UNIFORM 0
#ifdef TWIN_CONNECT
#define INTG_CONNECT 1
#else
#define INTG_CONNECT 0
#endif
#define INTG_SPLAT INTG_CONNECT
#ifdef TWIN_MERGE
#define INTG_MERGE 1
#else
#define INTG_MERGE 0
#endif
#ifdef TWIN_COMPACT  // vertices stored in half the bytes
#define INTG_COMPACT 1
#else
#define INTG_COMPACT 0
#endif
#define INTG_LAYERS 0
#define INTG_RECORD 0
#ifndef INTG_SOBOL
#define INTG_SOBOL 0
#endif
#define INTG_FILTER INTG_CONNECT
