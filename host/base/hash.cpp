// XXH3-128 in its canonical (big-endian) text form, as `xxhsum -H2` prints it.
#include "base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace pellucid {

Hasher::Hasher() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_.get());
}

void Hasher::Free::operator()(XXH3_state_s* state) const {
  XXH3_freeState(state);
}

Hasher& Hasher::add(const void* data, std::size_t bytes) {
  XXH3_128bits_update(state_.get(), data, bytes);
  return *this;
}

std::string Hasher::hex() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string hash_hex(const void* data, std::size_t bytes) {
  return Hasher().add(data, bytes).hex();
}
std::string hash_hex(std::string_view text) {
  return hash_hex(text.data(), text.size());
}

}  // namespace pellucid
