// Noise of two pictures of one scene, from nothing but their pixels.
#pragma once

#include "explain/layered.h"

namespace pellucid::explain {

/// Variances of sums over cells.
struct Noise {
  Sums known, other;
};

/// Noise is what neighbouring pixels do not have in common once the one picture, times the ratio of
/// the cell, is taken off the other. So it is right for pictures of the same random numbers and of
/// any program, layer by layer, and what the pictures show is not taken for it. Where a filter or
/// light paths spread noise over neighbours, cells differ by more than pixels say: then the median
/// of the second differences of cells tells how much more.
Noise noise_of(const Grid& grid, const Part& known, const Part& other);

/// Mean squares of the steps between neighbouring pixels: noise, and what cells show.
Sums roughness(const Grid& grid, const Part& part);

}  // namespace pellucid::explain
