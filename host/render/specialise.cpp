// Preludes: one text per set of features, width and device facts.
#include "render/specialise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace pellucid {

int simd_width_for(const DeviceInfo& device) {
  // PoCL reports the widest unit of the CPU: 16 with AVX-512, 8 with AVX, 4 with SSE or NEON.
  if (device.native_float_width >= 16) return 16;
  return device.native_float_width >= 8 ? 8 : 4;
}

void check_compact(const PackedScene& scene) {
  if (scene.materials.size() > COMPACT_MATERIALS)
    throw InputError(
        fmt::format("--vertices compact holds {} materials, and the scene has {}; use "
                    "--vertices full",
                    COMPACT_MATERIALS, scene.materials.size()));
  if (!scene.features.has(FEAT_TEXTURE)) return;
  float largest = 1.0f;  // of spheres and disks
  for (float uv : scene.uvs) largest = std::max(largest, std::abs(uv));
  int exponent = 0;
  std::frexp(std::nextafter(largest, 0.0f), &exponent);
  const double off = std::ldexp(0.5, exponent - 11);  // by the rounding of halfs just below it
  for (const ::Texture& t : scene.textures) {
    const double across = std::max(std::abs(t.scale_offset.x) * double(t.width),
                                   std::abs(t.scale_offset.y) * double(t.height));
    if (off * across > 1)
      throw InputError(fmt::format(
          "--vertices compact keeps texture coordinates as halfs: at {:.3g} they are off by {:.3g} "
          "texels of a texture of {}x{}; use --vertices full",
          largest, off * across, t.width, t.height));
  }
}

std::string prelude_of(const Specialisation& s) {
  std::string text;
  const auto define = [&](const char* name, unsigned value) {
    text += fmt::format("#define {} {}\n", name, value);
  };
  for (unsigned f = 0; f < FEATURE_COUNT; ++f)
    define(feature_table()[f].name, s.features.has(static_cast<Feature>(f)));
  constexpr uint step = 64;  // all but very large scenes share a program
  define("BVH_STACK", std::max(step, (s.stack_bound + step - 1) / step * step));
  define("SIMD_WIDTH", static_cast<unsigned>(s.simd_width));
  define("SIMD_BUILTINS", s.simd_builtins);
  define("DEV_INT64_ATOMICS", s.int64_atomics);
  define("FLOAT_CONTRACT", s.float_mode != FloatMode::strict);
  define("FLOAT_REORDER", s.float_mode == FloatMode::fast);
  if (s.int64_atomics) text += "#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable\n";
  return text;
}

std::string options_of(const Specialisation& s) {
  std::string options = "-cl-std=CL1.2 -cl-kernel-arg-info";
  if (s.rounded_division && s.float_mode != FloatMode::fast)
    options += " -cl-fp32-correctly-rounded-divide-sqrt";
  return options + float_mode_options(s.float_mode);
}

}  // namespace pellucid
