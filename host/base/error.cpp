// The message of a broken invariant: what was expected, where, and why it matters.
#include "base/error.h"

#include <fmt/format.h>

namespace pellucid {

void check_failed(const char* expression, const char* file, int line, const std::string& why) {
  throw InternalError(fmt::format("{} ({} does not hold at {}:{})", why, expression, file, line));
}

}  // namespace pellucid
