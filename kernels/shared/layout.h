// Every struct that crosses between host and kernels, written once. Fields are 32-bit scalars, F4
// or U4 in 16-byte rows; enums are #defines that the packer range-checks; padding is spelled out.
#ifndef PELLUCID_SHARED_LAYOUT_H
#define PELLUCID_SHARED_LAYOUT_H

#include "shared/platform.h"

#if PELLUCID_DEVICE
#define LAYOUT_CHECK(T, bytes) typedef char layout_check_##T[(sizeof(T) == (bytes)) ? 1 : -1]
#else
#define LAYOUT_CHECK(T, bytes) static_assert(sizeof(T) == (bytes), "layout of " #T)
#endif

/// "No such index" for every reference.
#define NONE 0xffffffffu

// ---- geometry
// -------------------------------------------------------------------------------------

/// A triangle of the scene; primitive ids 0 .. triangle_count-1. Written by pack.
typedef struct Triangle {
  uint v0, v1, v2;  // indices into positions and normals, counter-clockwise seen from the front
  uint shape;       // index into shapes
} Triangle;
LAYOUT_CHECK(Triangle, 16);

#define QUADRIC_SPHERE 0u
#define QUADRIC_DISK 1u
/// An analytic surface; primitive id = triangle_count + index. Written by pack.
typedef struct Quadric {
  F4 center_radius;  // world units
  F4 normal;         // unit: of a disk's front; a sphere's north pole, for its texture
  F4 tangent;        // unit, for textures: a disk's u axis, the middle meridian of a sphere; w: +1,
                     // or -1 where mirrored
  uint kind;         // QUADRIC_*
  uint shape;        // index into shapes
  uint pad0, pad1;
} Quadric;
LAYOUT_CHECK(Quadric, 64);

#define SHAPE_ONE_SIDED 1u   // opaque and black when met from behind
#define SHAPE_SMOOTH 2u      // has vertex normals
#define SHAPE_EMIT_FRONT 4u  // emits to the side of Ng
#define SHAPE_EMIT_BACK 8u   // emits to the other side
#define SHAPE_TEXTURED 16u   // its material has a texture, and its triangles have uvs
/// What all primitives of one shape share. Written by pack.
typedef struct Shape {
  uint material;     // index into materials
  uint flags;        // SHAPE_*
  uint first_prim;   // primitive id of the shape's first primitive
  uint first_light;  // light of that primitive (the others follow in order), or NONE
} Shape;
LAYOUT_CHECK(Shape, 16);

// Reference from a node to a child: bit 31 leaf, bits 30-28 kind, bits 27-26 blocks-1, bits 25-0
// index. Kinds leave room for instances and for leaves whose hits a filter may refuse.
#define REF_LEAF 0x80000000u
#define REF_KIND_SHIFT 28u
#define REF_KIND_MASK 7u
#define REF_COUNT_SHIFT 26u
#define REF_COUNT_MASK 3u
#define REF_INDEX_MASK 0x03ffffffu
#define REF_EMPTY 0xffffffffu  // slot without a child: its box is inverted, so it is never entered
#define LEAF_TRIANGLES 0u      // blocks of LEAF_WIDTH triangles from `index`
#define LEAF_QUADRICS 1u       // the quadric `index`
#define LEAF_NEEDLES 2u        // as LEAF_TRIANGLES, each several times as long as wide

// ---- materials and lights
// -------------------------------------------------------------------------

#define MATERIAL_DIFFUSE 0u
#define MATERIAL_PHONG 1u
#define MATERIAL_MIRROR 2u
#define MATERIAL_CONDUCTOR 3u  // smooth: delta
#define MATERIAL_ROUGH_CONDUCTOR 4u
#define MATERIAL_DIELECTRIC 5u  // smooth: delta
#define MATERIAL_ROUGH_DIELECTRIC 6u
#define MATERIAL_OREN_NAYAR 7u
#define MATERIAL_PLASTIC 8u  // smooth coat: a delta lobe over a diffuse one
#define MATERIAL_ROUGH_PLASTIC 9u
#define MATERIAL_THIN_DIELECTRIC 10u  // delta
#define MATERIAL_MIX 11u              // the sum of its parts

// What a material does with light; a mix does whatever one of its parts does.
#define LOBE_DELTA 1u     // single directions, which only sampling finds
#define LOBE_SPREAD 2u    // directions with a density: NEE and connections reach them
#define LOBE_TRANSMIT 4u  // light passes through
#define LOBE_NARROW 8u    // all of its spread lobes are narrower than ALPHA_GATHER
/// Written by pack; colours linear Rec.709.
typedef struct Material {
  uint kind;       // MATERIAL_*
  float alpha;     // GGX width, >= ALPHA_DELTA for rough kinds; Oren-Nayar: roughness
  float ior;       // dielectric: index inside over outside; plastic: index of the coat
  float survive;   // roulette: probability to go on after scattering here, local and so reversible,
                   // (0,1]
  F4 reflectance;  // diffuse, Oren-Nayar, mirror, plastic base, Phong diffuse part; w: Phong:
                   // probability of the diffuse lobe
  F4 eta_specular;  // conductor eta; Phong specular strength, w: Phong exponent; plastic x: share
                    // of diffuse light inside that the coat throws back
  F4 k;             // conductor k
  uint lobes;       // LOBE_*
  float weight;     // of a part: its share of the mix, and the probability to be sampled; else 1
  uint first_part;  // mix: its parts, none of them a mix, stand together
  uint part_count;
  uint texture;  // multiplies reflectance on SHAPE_TEXTURED shapes: index into textures, or NONE
  float untextured;  // albedo beside reflectance (Phong's glossy part): survives dark texels
  uint pad0, pad1;
} Material;
LAYOUT_CHECK(Material, 96);

// Texture.mode: how to go on outside [0, 1], and whether to filter.
#define TEXTURE_REPEAT 0u
#define TEXTURE_CLAMP 1u
#define TEXTURE_MIRROR 2u
#define TEXTURE_WRAP_MASK 3u
#define TEXTURE_NEAREST 4u  // no bilinear filter
/// An image; v = 0 is its bottom row. Written by pack.
typedef struct Texture {
  uint first;  // texel of its bottom left corner; rows follow upwards
  uint width, height;
  uint mode;        // TEXTURE_*
  F4 scale_offset;  // looked up at (u x + z, v y + w)
} Texture;
LAYOUT_CHECK(Texture, 32);

#define LIGHT_TRIANGLE 0u
#define LIGHT_SPHERE 1u
#define LIGHT_DISK 2u
#define LIGHT_POINT 3u
#define LIGHT_DIRECTIONAL 4u
#define LIGHT_ENVIRONMENT 5u
#define LIGHT_SPOT 6u
/// One light; an emitting mesh is one light per triangle. Written by pack.
typedef struct Light {
  uint kind;        // LIGHT_*
  uint prim;        // primitive id of an emitting surface
  float prob_pick;  // probability of this light among all; the same in every method
  uint alias;       // alias table: the light to take instead of this slot ...
  F4 value;     // radiance [W/(m^2 sr)], intensity [W/sr] or irradiance [W/m^2]; w: alias threshold
  F4 position;  // point, spot: position; directional: unit direction in which light travels;
                // w: spot: 1 - cos of half the angle within which intensity is full
  F4 axis;      // spot: unit direction of its middle; w: 1 - cos of half its whole angle
} Light;
LAYOUT_CHECK(Light, 64);

// ---- whole scene and launch
// -----------------------------------------------------------------------

/// Facts of the scene that every pass gets by value. Written by pack.
typedef struct SceneInfo {
  F4 bounds_reach;   // per axis the largest |coordinate| of any box: what traversal pads by
  F4 center_radius;  // bounding sphere of all shapes, world units
  uint root;         // child reference of the whole scene, or REF_EMPTY
  uint triangle_count;
  uint light_count;
  uint environment;  // index of the environment light, or NONE
  uint closed;       // 1: no ray should leave it
  uint pad0, pad1, pad2;
} SceneInfo;
LAYOUT_CHECK(SceneInfo, 64);

/// Pinhole camera as increments over pixels: direction(x, y) = corner + x dx + y dy, not
/// normalised, x and y in pixels from the top left. Written by pack.
typedef struct Camera {
  F4 origin;
  F4 corner, dx, dy;
  F4 forward;  // unit; w: distance of the image plane in pixels, [Georgiev12] D = W / (2
               // tan(fov/2))
} Camera;
LAYOUT_CHECK(Camera, 80);

#define MIS_BALANCE 0u
#define MIS_POWER 1u
#define MIS_MAX 2u
/// What one launch of an iteration is told. Written by render.
typedef struct Launch {
  uint width, height;            // of the whole picture, pixels
  uint tile_x, tile_y;           // first column and row of the pixels that this launch is about
  uint tile_width, tile_height;  // its extent; buffers of pixels hold the tile, row by row
  uint iteration;                // global pass number, from 0
  uint seed;                     // hashed user seed
  uint max_depth;                // segments; an emitter seen directly has 1
  uint mis;                      // MIS_*
  float splat_scale;             // fixed-point steps per unit of radiance, a power of two
  float layer_scale;             // the same of layers
  int film_lsb;                  // exponent of the film's step: sums count multiples of 2^film_lsb
  uint block_ends;               // 1: this iteration completes its block
  uint layer_set;                // layers that are kept apart (shared/layers.h)
  uint item_first;               // work-items of the pass that earlier launches have done
  uint window_x, window_y;       // the rendered part of the picture: tiles are parts of it
  uint window_width, window_height;   // pixels
  uint slice_first, slice_count;      // pixels of the tile that passes over slices are about
  uint light_paths;                   // of an iteration, for the whole picture
  uint path_first, path_count;        // light paths that this launch traces
  uint splat_first, splat_end;        // those of them that are splatted
  uint store_first, store_end;        // those whose vertices are stored
  uint light_capacity, eye_capacity;  // vertices that the buffers hold
  uint gather_first;  // pixel of the tile from which on contributions count; those before are known
  float radius;       // of merging, world units
  float merge_scale;  // 1 / (pi radius^2 light paths): from power to radiance
  float mis_vm;       // [Georgiev12 eq. 11] eta of merging over connecting: pi radius^2 light paths
  float grid_x, grid_y, grid_z;  // origin of the photon grid: amid the scene
  float cells_per_unit;          // of length, along an axis
  uint grid_bits;                // its table has 2^this places
  uint photon_count;             // light vertices, those that are in no cell, too
  uint digit;                    // of the sort, from 0
  float
      mis_deep;  // what merges after the first weigh of what their density says; 0: there are none
  uint record_path;      // light path of which all is recorded, or NONE
  uint record_capacity;  // events that the record holds
  uint pad0, pad1, pad2;
} Launch;
LAYOUT_CHECK(Launch, 192);

/// A vertex where a sub-path ends and others may connect. Written by light_trace and camera_trace.
typedef struct PathVertex {
  F4 p_offset;  // world units; w: Surface.offset
  F4 ng_u;      // geometric normal; w: texture coordinate u
  F4 ns_v;      // shading normal; w: v
  F4 wo_dVCM;   // unit, to the vertex before
  F4 beta_dVC;  // throughput up to here; of a light path: power [W]
  uint material;
  uint flags;   // SHAPE_*
  uint depth;   // segments from the sub-path's start
  uint before;  // slot of the stored vertex before, or NONE
} PathVertex;
LAYOUT_CHECK(PathVertex, 96);

#define COMPACT_MATERIAL_BITS 19u
#define COMPACT_MATERIALS 0x80000u  // as many as a CompactVertex can tell apart
/// The same in half the bytes, for short memory (transport/stored_vertex.h).
typedef struct CompactVertex {
  float x, y, z;    // world units
  uint material;    // low 19 bits; then SHAPE_* (5), exponent of Surface.offset, rounded up (8)
  uint ng, ns, wo;  // octahedral, 2 x 16 bits
  uint before;      // slot of the stored vertex before, or NONE
  uint beta;        // three mantissas of 8 bits and, on top, an exponent of 8
  uint dVCM;        // upper 24 bits of the float, rounded; then the low 8 bits of the depth
  uint dVC;         // the same; then its high 8 bits
  uint uv;          // texture coordinates as halfs
} CompactVertex;
LAYOUT_CHECK(CompactVertex, 48);

/// A light vertex as merging needs it, beside its position. Written by grid_ranges.
typedef struct Photon {
  F4 wi_dVCM;   // unit, to where it came from
  F4 beta_dVC;  // power [W]
  float ng_x, ng_y, ng_z;
  uint depth;  // segments from the light
} Photon;
LAYOUT_CHECK(Photon, 48);

#define FILM_SUM_WORDS 4
#define FILM_SQUARE_WORDS 6
/// Accumulators of one pixel: wide integers (shared/wide.h) per channel, so that sums neither stall
/// nor depend on how the passes were split. Written by film_add.
typedef struct FilmPixel {
  uint sum[3][FILM_SUM_WORDS];        // radiance of complete blocks, steps of 2^film_lsb
  uint block[3][FILM_SUM_WORDS];      // of the block under way
  uint square[3][FILM_SQUARE_WORDS];  // squares of complete blocks' totals, steps of
                                      // 2^(2 film_lsb + FILM_SQUARE_DROP)
  uint count[3];                      // iterations, rays (low word), rays (high word)
  float peak;                         // luminance of the brightest sample, or PEAK_DROPPED
  uint peak_pass;                     // its iteration; the first of them
  uint pad0;
} FilmPixel;
LAYOUT_CHECK(FilmPixel, 192);

// Kinds of events. A walk:
#define EVENT_START 0u    // from p along d; pdf: of the camera [1/sr], or EmitSample.pdf
#define EVENT_VERTEX 1u   // it has come to p; d: geometric normal
#define EVENT_SCATTER 2u  // it goes on along d; pdf [1/sr], survival included; 0: by a delta lobe
// Light of the sample:
#define EVENT_EMISSION 3u  // found by chance
#define EVENT_NEE 4u       // found by a light sample
#define EVENT_CONNECT 5u   // of a connection with the vertex p of light path `partner`
#define EVENT_MERGE 6u     // of a merge with the photon p, `partner`: its place in light_order
#define EVENT_SPLAT 7u     // of a light path's vertex p that the camera sees
/// What happens on a path that is replayed. Written by the passes that walk, connect and merge.
typedef struct PathEvent {
  uint kind;      // EVENT_*
  uint path;      // pixel of the whole picture, or number of the light path
  uint on_light;  // 1: a light path
  uint depth;     // segments of that path so far
  uint partner;   // see above, or NONE
  uint s, t;      // vertices drawn from either end; of a merge, its own from both
  uint material;  // of a vertex, or NONE
  F4 p;           // world units; light: w: weight
  F4 d;           // unit; w: pdf, of light: that of chance to look there
  F4 value;       // a walk: beta; light: unweighted radiance, w: light samples' pdf [1/sr]
  F4 brought;     // light: what the sample got of it; a vertex: x dVCM, y dVC
} PathEvent;
LAYOUT_CHECK(PathEvent, 96);

/// What the camera sees first. Written by aov.
typedef struct AovPixel {
  F4 position;   // of the pixel's centre, world units; w: depth along the camera's axis
  F4 normal;     // sum over iterations of unit shading normals; w unused
  F4 geometric;  // the same of geometric normals
  F4 albedo;     // sum over iterations; w unused
  U4 id;         // of the pixel's centre: x shape, y material, or NONE; z w unused
} AovPixel;
LAYOUT_CHECK(AovPixel, 80);

#endif
