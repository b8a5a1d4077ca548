// Feature names and the --features option.
#include "pack/features.h"

#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "base/text.h"

namespace pellucid {

const std::vector<FeatureInfo>& feature_table() {
#define PELLUCID_FEATURE_ROW(name, meaning) {#name, meaning},
  static const std::vector<FeatureInfo> table{FEATURES(PELLUCID_FEATURE_ROW)};
#undef PELLUCID_FEATURE_ROW
  return table;
}

std::string feature_word(Feature f) {
  std::string word = feature_table()[f].name;
  word = word.substr(word.find('_') + 1);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return word;
}

std::string FeatureSet::describe() const {
  std::string text;
  for (unsigned f = 0; f < FEATURE_COUNT; ++f)
    if (has(static_cast<Feature>(f)))
      text += (text.empty() ? "" : " ") + feature_word(static_cast<Feature>(f));
  return text;
}

FeatureSet all_scene_features() {
  FeatureSet all;
  for (unsigned f = 0; f < FEATURE_COUNT; ++f)
    if (std::string(feature_table()[f].name).rfind("FEAT_", 0) == 0)
      all.set(static_cast<Feature>(f));
  return all;
}

FeatureSet parse_feature_request(const std::string& text) {
  if (text.empty() || text == "auto") return {};
  if (text == "all") return all_scene_features();
  FeatureSet request;
  size_t start = 0;
  while (start <= text.size()) {
    const size_t end = std::min(text.find(',', start), text.size());
    std::string word = text.substr(start, end - start);
    start = end + 1;
    const bool plus = !word.empty() && word[0] == '+';
    if (plus) word = word.substr(1);
    bool found = false;
    std::vector<std::string> words;
    for (unsigned f = 0; f < FEATURE_COUNT; ++f) {
      const Feature feature = static_cast<Feature>(f);
      if (!all_scene_features().has(feature)) continue;
      words.push_back(feature_word(feature));
      if (plus && words.back() == word) request.set(feature), found = true;
    }
    if (!found) {
      std::string valid;
      for (const std::string& w : words) valid += " +" + w;
      throw UsageError("--features: '" + text + "' is none of auto, all, or a list of:" + valid +
                       (plus ? did_you_mean(word, words) : ""));
    }
  }
  return request;
}

}  // namespace pellucid
