// All integrators by name.
#include "integrators/registry.h"

#include "base/error.h"
#include "base/text.h"

namespace pellucid {

const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> table = [] {
    std::vector<Integrator> all = path_integrators();
    for (const Integrator& i : bidirectional_integrators()) all.push_back(i);
    for (const Integrator& i : merging_integrators()) all.push_back(i);
    return all;
  }();
  return table;
}

const Integrator& find_integrator(const std::string& name) {
  std::vector<std::string> names;
  for (const Integrator& i : integrators()) {
    if (i.name == name) return i;
    names.push_back(i.name);
  }
  throw UsageError("there is no integrator '" + name + "'; there are " + join(names) + "." +
                   did_you_mean(name, names));
}

}  // namespace pellucid
