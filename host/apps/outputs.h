// Pictures as files: which suffixes there are, whether the files can be written, and writing them.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"
#include "image/tonemap.h"

namespace CLI {
class App;
}

namespace pellucid {

/// Throws UsageError if a suffix names no type of picture that we write.
void check_picture_types(const std::vector<std::string>& names);

/// Throws UsageError if the suffix names no type of display picture; `option` is for the message.
void check_display_type(const std::string& option, const std::string& name);

/// Whether the suffix is one of a picture, written by us or only read.
bool is_picture_name(const std::string& name);

/// The curve by its name. Throws UsageError that lists the names.
ToneCurve parse_tone_curve(const std::string& option, const std::string& name);

/// --exposure and --tonemap.
struct DisplayFlags {
  std::string exposure, tonemap = "srgb";

  void declare(CLI::App& app);
  /// Throws UsageError.
  DisplayTransform transform() const;
};

/// Writes a linear image to every name; `display` acts where the type holds display values. One
/// that fails does not keep the others from being written; the first OutputError is thrown at the
/// end.
void write_pictures(const std::vector<std::string>& names, const Image& linear,
                    const DisplayTransform& display);

}  // namespace pellucid
