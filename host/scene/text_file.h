// Reading text files with clear errors, and user text in messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace pellucid {

/// The file's entry in Scene::files.
SourceFile source_file(const std::string& path, const std::string& text);

/// Whether there is such a regular file and it is not too large: throws InputError, which says what
/// the file was to be (`role`, such as "texture") and names near files in the same folder. Returns
/// its size.
std::uintmax_t check_file(const std::string& path, const std::string& role, std::size_t max_bytes);

/// The whole file as bytes, without a leading UTF-8 byte order mark. Checked as by check_file().
std::string read_text_file(const std::string& path, const std::string& role, std::size_t max_bytes);

/// `"a", "b" or "c"`; of very many, the first ones.
std::string list_choices(const std::vector<std::string>& choices);

/// A piece of user text safe to print: control characters become '?', long text is cut.
std::string printable(const std::string& text, std::size_t max_length = 60);

}  // namespace pellucid
