// The set of effects and wishes that a kernel is specialised for, expanded from the one list.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "shared/features.h"

namespace pellucid {

#define PELLUCID_FEATURE_ENUM(name, meaning) name,
enum Feature : unsigned { FEATURES(PELLUCID_FEATURE_ENUM) FEATURE_COUNT };
#undef PELLUCID_FEATURE_ENUM
static_assert(FEATURE_COUNT <= 64, "FeatureSet holds 64 features");

struct FeatureInfo {
  const char* name;
  const char* meaning;
};
/// Name and one-line meaning of every feature, in list order.
const std::vector<FeatureInfo>& feature_table();

class FeatureSet {
 public:
  FeatureSet() = default;
  FeatureSet(std::initializer_list<Feature> features) {
    for (Feature f : features) set(f);
  }
  void set(Feature f, bool on = true) {
    bits_ = on ? bits_ | (std::uint64_t{1} << f) : bits_ & ~(std::uint64_t{1} << f);
  }
  bool has(Feature f) const { return (bits_ >> f) & 1u; }
  FeatureSet operator|(FeatureSet o) const { return FeatureSet(bits_ | o.bits_); }
  bool operator==(FeatureSet o) const { return bits_ == o.bits_; }
  std::uint64_t bits() const { return bits_; }
  /// Names without prefix of the features present, e.g. "triangles diffuse".
  std::string describe() const;

 private:
  explicit FeatureSet(std::uint64_t bits) : bits_(bits) {}
  std::uint64_t bits_ = 0;
};

/// All scene effects (FEAT_*), none of the integrators' wishes.
FeatureSet all_scene_features();

/// The user's word for a feature: lower case, without its prefix ("FEAT_LIGHT_POINT":
/// "light_point").
std::string feature_word(Feature f);

/// Features that `--features auto|all|+x` asks for on top of what the scene needs. Throws
/// UsageError that lists the valid words.
FeatureSet parse_feature_request(const std::string& text);

}  // namespace pellucid
