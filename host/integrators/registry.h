// The table of integrators. A new one is a file here and a line in registry.cpp.
#pragma once

#include <vector>

#include "render/integrator.h"

namespace pellucid {

const std::vector<Integrator>& integrators();

/// Throws UsageError that lists the names.
const Integrator& find_integrator(const std::string& name);

/// The method taken when neither flag nor scene names one.
inline const char* default_integrator() {
  return "path";
}

/// path.cpp: naive, nee, path, reference.
std::vector<Integrator> path_integrators();
/// bidir.cpp: light, bdpt.
std::vector<Integrator> bidirectional_integrators();
/// merging.cpp: sppm, vcm.
std::vector<Integrator> merging_integrators();

}  // namespace pellucid
