// Replays: one sample of one pixel traced again, with everything written down that its paths did
// and brought. Random numbers are a function of seed, pass and path, so that it is the same sample.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cl/device.h"
#include "pack/pack.h"
#include "render/integrator.h"
#include "render/options.h"

namespace pellucid {

struct Replay {
  int x = 0, y = 0;  ///< pixel of the whole picture
  std::uint64_t pass = 0;
  std::array<double, 3> origin{};  ///< that positions are counted from, in coordinates of the file
  std::vector<PathEvent> eye;      ///< the walk from the camera, in order
  std::vector<PathEvent> brought;  ///< all light of the sample, brightest first
  std::vector<PathEvent> light;  ///< the light path that takes part in the brightest of it; or none
  std::array<float, 3> sum{};    ///< of what was brought, added up as the passes do
  std::array<double, 3> film{};  ///< the sample as the film has it: to its step
  float luminance = 0;           ///< of the sample, as the film has it

  /// Whether what was brought is the sample, bit for bit: in --float strict always so.
  bool adds_up() const;
};

/// Luminance as the film reckons it.
float luminance_of(const std::array<float, 3>& rgb);
/// Of what an event brought.
float luminance_of(const PathEvent& event);

/// Passes write down what they do.
Integrator with_record(Integrator method);

/// Traces pass `pass` of pixel (x, y) of the picture that `options` are about, all its light paths
/// included. Throws DeviceError.
Replay replay(const Device& device, const PackedScene& scene, const Integrator& method,
              const RenderOptions& options, int x, int y, std::uint64_t pass);

}  // namespace pellucid
