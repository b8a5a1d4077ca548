// The table of renders whose value is known (numerics.md 3).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace pellucid::test {

using Methods = std::vector<std::string>;

/// One value of a scene. `constant`: every sample carries the same value, so that every pixel must
/// have it up to float rounding; elsewhere the verdict is statistical.
struct Target {
  Rgb expected;
  std::optional<unsigned> max_depth;
  Methods constant;
};

struct Case {
  std::string name;
  Scene scene;
  std::vector<Target> targets;
  Methods methods;  ///< those that can see the value without needing astronomically many samples
  Methods blind;    ///< those that must say they are blind, and give exactly black
  /// Relative error that is not noise. Default: rounding, and the picture's footprint, whose 3e-3
  /// squared changes the mean of a smooth function.
  double slack = 1e-5;
  int size = 48;  ///< pixels along a side; fewer where paths are long
  /// Where light is merged: the radius in all passes; 0: the default one, of a value that is all
  /// direct.
  double radius = 0;
};

const std::vector<std::string>& closed_form_names();
Case closed_form_case(const std::string& name);

}  // namespace pellucid::test
