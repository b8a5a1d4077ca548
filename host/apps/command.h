// How a command joins the program: one file with one function, one line in main.cpp's table, one in
// CMakeLists.txt. The file reads from top to bottom: options, what it does, declaration of options.
#pragma once

#include <functional>
#include <string>

#include "base/error.h"

namespace CLI {
class App;  // its header alone takes seconds to compile: for files that declare options
}

namespace pellucid {

/// What every command understands; filled when the command runs.
struct CommonOptions {
  std::string json;  ///< file or "-" (stdout) for machine-readable results; "" means none wanted
  /// Whether results are for people: with --json - stdout holds that one document and nothing else.
  bool wants_text() const { return json != "-"; }
};

/// Runs a command after parsing. Failures are thrown (base/error.h).
using CommandRun = std::function<ExitCode(const CommonOptions&)>;

/// Declares a command's own options and its footer (an example) on `app`; --help, --quiet,
/// --verbose and --json come by themselves. Called for every command on every start: it must be
/// cheap.
using CommandSetup = CommandRun (*)(CLI::App& app);

}  // namespace pellucid
