// Identity of scenes, kernels and checkpoints: XXH3 with 128 bits. Not for security.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace pellucid {

/// Hash of data that arrives in pieces; how it is cut into pieces does not matter.
class Hasher {
 public:
  Hasher();
  Hasher& add(const void* data, std::size_t bytes);
  Hasher& add(std::string_view text) { return add(text.data(), text.size()); }
  std::string hex() const;  ///< 32 lower-case digits of everything added so far

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

/// 32 lower-case hexadecimal digits.
std::string hash_hex(const void* data, std::size_t bytes);
std::string hash_hex(std::string_view text);

}  // namespace pellucid
