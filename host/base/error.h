// Errors: thrown once where they are found, caught once in apps/main.cpp. Each carries the exit
// code that shared with users in the command-line contract.
#pragma once

#include <stdexcept>
#include <string>

namespace pellucid {

/// Exit codes of every command; scripts rely on them.
enum class ExitCode : int {
  done = 0,
  gate_failed = 1,  ///< a gate said no: images differ, non-finite pixels, benchmark slower
  usage = 2,        ///< the command line is wrong
  bad_input = 3,    ///< scene, image or asset cannot be read or is invalid
  device = 4,       ///< OpenCL device, kernel build or device memory
  output = 5,       ///< output cannot be written
  numeric = 6,      ///< non-finite pixels or nonzero counters under --strict
  internal = 70,    ///< a fault of ours
  stopped = 75,     ///< stopped early, what was rendered is saved
};

/// Base of all errors that pellucid reports to its user.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// The command line is wrong: names the option, what is accepted, and what was given.
struct UsageError : Error {
  explicit UsageError(const std::string& m) : Error(ExitCode::usage, m) {}
};
/// A scene, image or asset is missing or invalid. The message names file, place and remedy.
struct InputError : Error {
  explicit InputError(const std::string& m) : Error(ExitCode::bad_input, m) {}
};
/// OpenCL failed: names the call, the status and the device.
struct DeviceError : Error {
  explicit DeviceError(const std::string& m) : Error(ExitCode::device, m) {}
};
/// An output file cannot be written: names the file and the system's reason.
struct OutputError : Error {
  explicit OutputError(const std::string& m) : Error(ExitCode::output, m) {}
};
/// Non-finite values or nonzero device counters under --strict.
struct NumericError : Error {
  explicit NumericError(const std::string& m) : Error(ExitCode::numeric, m) {}
};
/// A broken invariant of ours.
struct InternalError : Error {
  explicit InternalError(const std::string& m) : Error(ExitCode::internal, m) {}
};

[[noreturn]] void check_failed(const char* expression, const char* file, int line,
                               const std::string& why);

/// Checks an invariant in every build; throws InternalError with the place.
#define PELLUCID_CHECK(expression, why)                                                \
  do {                                                                                 \
    if (!(expression)) ::pellucid::check_failed(#expression, __FILE__, __LINE__, why); \
  } while (false)

}  // namespace pellucid
