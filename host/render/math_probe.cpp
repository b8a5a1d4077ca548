// Arguments, exact values in double, and the distance between.
#include "render/math_probe.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

#include "cl/sources.h"
#include "render/specialise.h"
#include "shared/layout.h"
#include "shared/probe.h"

namespace pellucid {
namespace {

/// x, y: of both signs, 10^-6 to 10^6, so that no result leaves the range of normal numbers;
/// z: a multiple of 2^-24 in [0, 1), every end of it too; w: an exponent, 10^-5 to 10^4.
std::vector<F4> make_arguments(std::size_t argument_count) {
  std::mt19937_64 engine(1);
  const auto unit = [&] { return double(engine() >> 11) * 0x1p-53; };
  const auto magnitude = [&](double low, double high) {
    return std::pow(10.0, low + (high - low) * unit());
  };
  std::vector<F4> arguments(argument_count);
  for (F4& a : arguments) {
    a.x = float(magnitude(-6, 6) * (unit() < 0.5 ? -1 : 1));
    a.y = float(magnitude(-6, 6) * (unit() < 0.5 ? -1 : 1));
    a.z = float(double(engine() >> 40) * 0x1p-24);
    a.w = float(magnitude(-5, 4));
  }
  const float ends[] = {0.0f, 0x1p-24f, 0.125f, 0.25f, 0.5f, 0.75f, 1.0f - 0x1p-24f};
  for (std::size_t i = 0; i < std::size(ends) && i < argument_count; ++i) arguments[i].z = ends[i];
  return arguments;
}

constexpr double two_pi = 6.283185307179586477;

// Named as in passes/probe_math.cl.
double exact_divide(const F4& a) {
  return double(a.x) / double(a.y);
}
double exact_sqrt(const F4& a) {
  return std::sqrt(std::abs(double(a.x)));
}
double exact_fma(const F4& a) {
  const double product = double(a.x) * double(a.y);  // 48 bits: exact
  return product - double(float(product));
}
double exact_floor(const F4& a) {
  return std::floor(double(a.x));
}
double exact_sin(const F4& a) {
  return std::sin(two_pi * double(a.z));
}
double exact_cos(const F4& a) {
  return std::cos(two_pi * double(a.z));
}
double exact_atan2(const F4& a) {
  return std::atan2(double(a.z - 0.5f), double(a.x - a.y)) / two_pi;
}
double exact_pow(const F4& a) {
  return std::pow(double(a.z), double(a.w));
}
double exact_acos(const F4& a) {
  return std::acos(double(a.z));
}

enum class Unit { ULPS, ROUNDOFFS };

/// Distance of `found` in `unit`; 0 where both are below the normal numbers, of which nothing is
/// claimed.
double error_of(float found, double exact, Unit unit) {
  const double smallest = double(std::numeric_limits<float>::min());
  const double off = std::abs(double(found) - exact);
  if (unit == Unit::ROUNDOFFS) return off / 0x1p-24;
  if (std::abs(exact) < smallest && std::abs(found) < 2 * smallest) return 0;
  const int exponent = std::max(std::ilogb(exact), -126);
  return off / std::ldexp(1.0, exponent - 23);
}

struct Probe {
  const char* function;
  Unit unit;
  double bound, loose;
  double (*exact)(const F4&);
};

#define PELLUCID_PROBE(name, unit, bound, loose, meaning) \
  {meaning, Unit::unit, bound, loose, exact_##name},
const Probe probes[] = {MATH_PROBES(PELLUCID_PROBE)};
#undef PELLUCID_PROBE

MathError judge(const Probe& probe, const std::vector<F4>& arguments, const float* found,
                bool loose) {
  MathError error;
  error.function = probe.function;
  error.unit = probe.unit == Unit::ULPS ? "ulps" : "roundoffs";
  error.bound = loose ? probe.loose : probe.bound;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const double off = error_of(found[i], probe.exact(arguments[i]), probe.unit);
    if (!(off <= error.worst)) error.worst = off;
    if (std::isnan(off)) break;
  }
  return error;
}

}  // namespace

std::vector<MathError> probe_math(Device& device, FloatMode mode, std::size_t argument_count) {
  Specialisation special;
  special.rounded_division = device.info().rounded_division;
  special.float_mode = mode;
  const std::string source = KernelFiles().expand("passes/probe_math.cl", prelude_of(special));
  Kernel kernel = device.build("probe_math", source, options_of(special));
  const std::vector<F4> arguments = make_arguments(argument_count);
  std::vector<float> found(std::size(probes) * arguments.size());
  const Buffer in =
      device.create_buffer("arguments", arguments.size() * sizeof(F4), arguments.data());
  const Buffer out = device.create_buffer("found", found.size() * sizeof(float));
  const auto count = uint(arguments.size());
  kernel.set_buffer(0, in);
  kernel.set_buffer(1, out);
  kernel.set_bytes(2, &count, sizeof count);
  device.launch(kernel, count, std::min<std::size_t>(64, kernel.max_group()), nullptr);
  device.finish();
  device.read(out, found.data(), found.size() * sizeof(float));
  const bool loose = mode == FloatMode::fast || !special.rounded_division;
  std::vector<MathError> errors;
  for (std::size_t i = 0; i < std::size(probes); ++i)
    errors.push_back(judge(probes[i], arguments, &found[i * arguments.size()], loose));
  return errors;
}

}  // namespace pellucid
