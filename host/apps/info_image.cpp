// info on images.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/info_parts.h"
#include "image/image.h"
#include "image/metrics.h"

namespace pellucid {
namespace {

std::string meta_text(const MetaValue& value) {
  if (const int* i = std::get_if<int>(&value)) return std::to_string(*i);
  if (const float* f = std::get_if<float>(&value)) return fmt::format("{}", *f);
  if (const std::string* s = std::get_if<std::string>(&value)) return *s;
  return fmt::format("{}", fmt::join(std::get<std::vector<float>>(value), " "));
}

}  // namespace

ExitCode image_info(const std::string& path, const CommonOptions& common) {
  const Image image = read_image(path);
  std::string text = fmt::format("{}: {}x{}, {} channels\n", path, image.width, image.height,
                                 image.channels.size());
  nlohmann::json metadata = nlohmann::json::object(), statistics = nlohmann::json::object();
  text += fmt::format("  {:<24} {:>12} {:>12} {:>12} {:>11}\n", "channel", "min", "mean", "max",
                      "non-finite");
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    const std::string& name = image.channels[c];
    const ChannelStatistics s = channel_statistics(image, c);
    text += fmt::format("  {:<24} {:>12.6g} {:>12.6g} {:>12.6g} {:>11}\n", name, s.min, s.mean,
                        s.max, s.nonfinite);
    statistics[name] = {
        {"min", s.min}, {"mean", s.mean}, {"max", s.max}, {"nonfinite", s.nonfinite}};
  }
  for (const auto& [name, value] : image.metadata) {
    text += fmt::format("  {:<24} {}\n", name, meta_text(value));
    metadata[name] = meta_text(value);
  }
  if (common.wants_text()) print_result(text);
  write_json(common.json, {{"file", path},
                           {"width", image.width},
                           {"height", image.height},
                           {"channels", image.channels},
                           {"statistics", statistics},
                           {"metadata", metadata}});
  return ExitCode::done;
}

}  // namespace pellucid
