// Every tolerance and hard limit of the kernels, in ulps or relative, each with its reason.
#ifndef PELLUCID_SHARED_LIMITS_H
#define PELLUCID_SHARED_LIMITS_H

/// Half an ulp at 1 in float: the unit roundoff of all bounds below.
#define UNIT_ROUNDOFF 5.9604644775390625e-8f /* 2^-24 */

/// Error of a point rebuilt from barycentrics, in unit roundoffs of sum |b_i v_i|: 7 would do for
/// the three products and two sums [PBRT4 6.8.5]; 10 leaves room for weights that do not add up to
/// 1 and for rounding the offset point itself.
#define POINT_ERROR_ULPS 10.0f

/// Error of a distance interpolated within a triangle, in unit roundoffs of its extent: 1 ended all
/// re-hits of planes through the origin in the tests, 8 began to widen the gap that light leaks
/// through.
#define EXTENT_ERROR_ULPS 4.0f

/// How far rays start off surfaces in kernels/naive, which the benchmark compares with: the
/// constant in world units that many programs have. Rendering knows none.
#define NAIVE_EPSILON 1e-4f

/// Padding of boxes, in unit roundoffs of (|origin| + largest |coordinate|) over |d|: 4 for bound/d
/// and 6 for origin/d (3 for 1/d, and the roundings of product, sum and fma), 5 for the leaf's own
/// translation and shear; 16 rounds up.
#define BOX_PAD_ULPS 16.0f
/// Smallest |direction component| of a unit direction: below it 1/d would overflow against
/// coordinates.
#define DIRECTION_MIN 1e-18f

/// GGX below this width is packed as a delta: half-vector cosines lose it in float (numerics 12).
#define ALPHA_DELTA 1e-3f

/// Lobes below this width are followed, not gathered on: of the photons around a point too few come
/// from where such a lobe looks.
#define ALPHA_GATHER 0.1f

/// Nothing scatters at cosines below this: half vectors of two such directions, and f itself, would
/// leave the range of numbers. Light lost: at most the square of it.
#define COS_MIN 1e-12f

/// |ior - 1| below this is an index-matched surface: the half vector of a refraction would be 0/0.
#define IOR_MATCHED 1e-4f

/// A point this near a sphere (distance^2 over radius^2) sees almost a hemisphere: the sphere is
/// then sampled by area. Further in, 1 - sin^2 would keep fewer than 7 bits.
#define SPHERE_NEAR 1.00001f

/// Walks of lights at infinity start so many radii of the scene from its centre: far enough that
/// rounding puts nothing of the scene behind the start.
#define DISC_DISTANCE 1.001f

/// Least cosine of a sampled facet normal, so that its tangent stays finite in float.
#define FACET_COS_MIN 1e-7f

/// Hard limit on segments when no depth is asked for; reaching it is counted as path_stuck.
#define DEPTH_HARD_LIMIT 16384u

/// Survival of roulette in the `reference` method, the same at every surface.
#define REFERENCE_SURVIVE 0.9f

/// The photon sort: a stable radix sort of SORT_PASSES digits, without atomics, in which a
/// work-item sorts a block of its own.
#define SORT_DIGIT_BITS 11u
#define SORT_DIGITS 2048u
#define SORT_PASSES 2u
#define SORT_BLOCKS 16u

/// The photon grid has 2^this cells at least and at most: what the sort can tell apart, with NONE
/// for what is in no cell behind them all.
#define GRID_BITS_MIN 6u
#define GRID_BITS_MAX 21u

/// How far photons are looked for, over the radius: 1 + 2^-20. Rounding lets photons count that are
/// 4 roundoffs farther away than it, and may shorten this by one (transport/grid.h).
#define MERGE_REACH 1.00000095367431640625f

/// Least radius of merging, in unit roundoffs of the scene's largest coordinate: in smaller discs
/// the error of points themselves (POINT_ERROR_ULPS) would decide what is found. Numbers of cells
/// then stay below 2^20.
#define MERGE_RADIUS_ULPS 16.0f
/// Bounds of it in any unit of length: squares of the radius are normal numbers, and so are the
/// areas of 2^32 discs.
#define MERGE_RADIUS_MIN 1.08420217248550443e-19f /* 2^-63 */
#define MERGE_RADIUS_MAX 70368744177664.0f        /* 2^46 */

/// A merge after the first weighs this share of what its density says. The photons around a vertex
/// are met all at once, and where a walk comes upon a bright spot, rarely: they are no independent
/// samples, which weights take them for ([Jendersie18], [Grittmann21]). A path with a merge
/// after the first spread scattering from the camera has one there, too: nothing depends on others.
#define MERGE_DEEP_TRUST 0.05f

/// Photons merge where their surface faces the same way, within 60 degrees: others lie round a
/// corner or on the back of a thin wall.
#define MERGE_COS_MIN 0.5f

/// Most work-items of a group of vertex_scan and grid_scan.
#define SCAN_GROUP 256

/// Splats count steps of 2^-36 of what the lights' whole power gives a white surface at a distance
/// of the scene's radius (host/render/launch.cpp): dim ones keep 8 bits down to 2^-28 of it.
#define SPLAT_FRACTION_BITS 36
/// Largest splat or part of a layer, in steps: 2^26 times that power. Sums that leave a pixel's 64
/// bits are counted.
#define SPLAT_FIXED_MAX 4611686018427387904.0f /* 2^62 */

/// Throughput cut off by --max-depth counts steps of 2^-32 of what paths start with. The largest
/// share of one path, 2^12, is beyond what roulette makes of any: sums are for telling, no picture.
#define CUT_STEPS 4294967296.0f
#define CUT_SHARE_MAX 4096.0f

/// Layers count steps of 2^-44 of the brightest light, seen by the camera or lighting a surface,
/// and all passes add up in 64 bits: 2^20 passes of the brightest fit.
#define LAYER_FRACTION_BITS 44

/// Luminance of linear Rec.709.
#define LUMINANCE_R 0.2126f
#define LUMINANCE_G 0.7152f
#define LUMINANCE_B 0.0722f

/// FilmPixel.peak of a pixel of which a sample was dropped: finite, as fast modes want it.
#define PEAK_DROPPED 3.40282346638528859812e+38f

/// Film sums count steps of 2^-56 of the brightest light (Launch.film_lsb), to which samples are
/// rounded: they keep 24 bits down to 2^-32 of it, 8 bits down to 2^-48.
#define FILM_FRACTION_BITS 56
/// Largest sample in those steps: 2^36 times the brightest light, and 2^32 of them fit a sum of 128
/// bits.
#define FILM_SAMPLE_BITS 92
/// Squares are kept in steps of 2^28 squared steps, so that 2^28 blocks of the largest fit 192
/// bits.
#define FILM_SQUARE_DROP 28

/// Iterations per block: the squares that variances come from are those of a block's total. Sobol
/// points are independent from block to block only; random numbers are so in every iteration.
#define SOBOL_BLOCK 16u

/// Intervals of the table of pixel filter offsets (camera/filter.h).
#define FILTER_STEPS 1024u

/// Samples per pixel of the averaged AOVs: what a render has by default.
#define AOV_ITERATIONS 64u

#endif
