// From features and device facts to the exact text and options that a kernel is built from.
#pragma once

#include <string>

#include "cl/device.h"
#include "cl/sources.h"
#include "pack/pack.h"
#include "render/float_mode.h"

namespace pellucid {

/// Everything that a program is specialised for.
struct Specialisation {
  FeatureSet features;
  int simd_width = 8;
  uint stack_bound = 0;       ///< entries needed; rounded up so that similar scenes share programs
  bool simd_builtins = true;  ///< x86 compare-to-mask instructions where the compiler has them
  bool int64_atomics = false;
  bool rounded_division = false;  ///< the device can be asked for it
  FloatMode float_mode = FloatMode::strict;
};

/// Node width for a device: its native float vector, within what the layout offers.
int simd_width_for(const DeviceInfo& device);

/// Throws InputError where path vertices in half the bytes cannot hold what the scene has.
void check_compact(const PackedScene& scene);

/// The -D prelude as source text: every flag always defined, in list order.
std::string prelude_of(const Specialisation& s);
/// Options for the device compiler.
std::string options_of(const Specialisation& s);

}  // namespace pellucid
