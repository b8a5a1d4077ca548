// Names of the samplers, and the seed as kernels see it.
#include "render/sampler.h"

#include <algorithm>

#include "base/error.h"

namespace pellucid {

std::vector<std::string> sampler_names() {
  return {"sobol", "random"};
}

std::string sampler_name(Sampler sampler) {
  return sampler_names().at(static_cast<std::size_t>(sampler));
}

Sampler find_sampler(const std::string& name) {
  const std::vector<std::string> names = sampler_names();
  const auto found = std::find(names.begin(), names.end(), name);
  PELLUCID_CHECK(found != names.end(), "name of a sampler");
  return static_cast<Sampler>(found - names.begin());
}

uint hash_seed(std::uint64_t seed) {
  seed += 0x9e3779b97f4a7c15ull;
  seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9ull;
  seed = (seed ^ (seed >> 27)) * 0x94d049bb133111ebull;
  return static_cast<uint>((seed ^ (seed >> 31)) >> 32);
}

}  // namespace pellucid
