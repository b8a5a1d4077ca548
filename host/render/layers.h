// Layers of a picture on the host: which a method keeps, their sums, their channels, and the
// pictures drawn of them. Numbers are in kernels/shared/layers.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "render/integrator.h"
#include "shared/layers.h"

namespace pellucid {

/// One entry of --aov that is made of layers.
struct LayerInfo {
  std::string name;
  uint kind;                          ///< LAYERS_*
  std::string doc;                    ///< for --help
  std::optional<Feature> needs = {};  ///< of the method
  std::string without = {};           ///< what methods without it do
};
/// In the order in which channels are written.
const std::vector<LayerInfo>& layer_table();

/// The method with layers of these kinds kept; lengths up to `longest` have their own. Without
/// kinds: the method as it is.
Integrator with_layers(Integrator method, uint kinds, uint longest);

/// Bytes of a set of layers in one pixel, on the device and in the film.
std::size_t layer_bytes(uint set);

/// "none", or which kinds there are, up to what length and s.
std::string describe_layers(uint set);

/// Sums over all passes, exactly: they are the same for any split of passes and pixels.
class Layers {
 public:
  Layers() = default;  ///< none
  /// Black. `scale`: steps per unit of radiance, a power of two.
  Layers(uint set, float scale, std::size_t pixels);

  uint set = 0;
  float scale = 1;          ///< 1 without layers
  std::vector<uint> words;  ///< [pixels][layers][3 channels][2 words], low word first

  std::size_t words_per_pixel() const { return layer_count(set) * LAYER_WORDS; }
  /// Adds sums of the same set, scale and size.
  void merge(const Layers& other);
  bool operator==(const Layers& o) const {
    return set == o.set && scale == o.scale && words == o.words;
  }
};

/// What a layer adds up.
enum class LayerUnit {
  radiance,  ///< in steps of the picture's own
  count,
  radius,  ///< pixels, in steps of 1 / LAYER_RADIUS_STEPS
  first    ///< whole numbers of pass 0; all others are means over passes
};

/// Place of an EXR channel among the words of a pixel.
struct LayerChannel {
  std::string name;
  std::size_t word;  ///< the low one
  LayerUnit unit;
};
std::vector<LayerChannel> layer_channels(uint set);

/// Channels of means over so many passes.
std::vector<AovChannel> layer_images(const Layers& layers, std::uint64_t passes);

/// What the picture of the photon grid shows.
constexpr uint LAYERS_GRID = LAYERS_PHOTONS | LAYERS_CELLS | LAYERS_RADIUS;

/// The pyramid of strategies as a display picture, of layers that have LAYERS_TECH and pictures of
/// this size.
Image strategy_atlas(const Layers& layers, int width, int height, std::uint64_t passes);

/// The photon grid as a display picture, of layers that have all of LAYERS_GRID.
Image grid_picture(const Layers& layers, int width, int height, std::uint64_t passes);

}  // namespace pellucid
