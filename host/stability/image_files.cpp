// Pictures in files (numerics 36): values from 1e-8 to 1e8 come back bit for bit from EXR, and a
// known grey survives the chain to 8 bits and back.
//
// EXR is written in 32-bit floats, whatever is in it; the sRGB curve is applied once, in one place
// (image/tonemap.cpp). This case asks nothing of the device.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/image.h"
#include "image/tonemap.h"
#include "stability/measurements.h"
#include "stability/temporary_file.h"

namespace pellucid::stability {
namespace {

Image ramp(int n, double (*value)(double t)) {
  Image image;
  image.width = n, image.height = 1;
  image.channels = {"R", "G", "B"};
  for (int x = 0; x < n; ++x)
    for (int c = 0; c < 3; ++c) image.data.push_back(float(value(double(x) / (n - 1))));
  return image;
}

}  // namespace

void files_keep_values(const Lab& lab, Findings& findings) {
  const Image wide = ramp(int(lab.count(4096)), [](double t) { return std::pow(10, 16 * t - 8); });
  const TemporaryFile exr(".exr"), png(".png");
  write_image(exr.path, wide);
  const Image back = read_image(exr.path);
  findings.require("as many values in EXR as were written", back.data.size() == wide.data.size());
  std::uint64_t differing = 0;
  for (std::size_t i = 0; i < std::min(wide.data.size(), back.data.size()); ++i)
    differing += std::memcmp(&wide.data[i], &back.data[i], sizeof(float)) != 0;
  findings.none("values from 1e-8 to 1e8 that EXR changes", differing);

  const Image grey = ramp(256, [](double t) { return t; });
  write_image(png.path, to_display(grey));
  const Image shown = read_image(png.path, true);
  double worst = 0;
  for (std::size_t i = 0; i < std::min(grey.data.size(), shown.data.size()); ++i)
    worst = std::max(
        worst, std::abs(double(srgb_encode(shown.data[i])) - double(srgb_encode(grey.data[i]))));
  findings.at_most("grey through PNG and back, in steps of 1/255", 255 * worst, 1);
}

}  // namespace pellucid::stability
