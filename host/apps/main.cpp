// The program: finds the command, parses its options, and turns every failure into an exit code.
#include <fmt/format.h>
#include <sys/stat.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <map>
#include <new>

#include "apps/command.h"
#include "apps/common.h"
#include "base/log.h"
#include "base/phase_clock.h"
#include "base/signals.h"
#include "base/text.h"
#include "base/version.h"

/// Every command: its name (setup_NAME lies in NAME.cpp) and one line for --help.
#define COMMANDS(X)                                                          \
  X(render, "render a scene to pictures")                                    \
  X(devices, "the OpenCL devices here and what they can do")                 \
  X(info, "what is in a scene, an image or a checkpoint")                    \
  X(compare, "error of image A against reference B, with gates for scripts") \
  X(study, "what accuracy costs in time, method by method")                  \
  X(bench, "speed of this device, beside Embree where present")              \
  X(merge, "checkpoints of disjoint passes to one picture")                  \
  X(kernels, "the specialised programs for a scene and method")              \
  X(schema, "the scene format as a JSON schema")                             \
  X(completion, "completion of command lines for a shell")

namespace pellucid {

#define X(name, summary) CommandRun setup_##name(CLI::App& app);
COMMANDS(X)
#undef X

namespace {

using Arguments = std::vector<std::string>;

struct Command {
  const char* name;
  const char* summary;
  CommandSetup setup;
};

const Command COMMAND_TABLE[] = {
#define X(name, summary) {#name, summary, setup_##name},
    COMMANDS(X)
#undef X
};

constexpr const char* DEFAULT_COMMAND = "render";  // `pellucid SCENE`

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : COMMAND_TABLE) names.push_back(command.name);
  return names;
}

bool is_command(const std::string& word) {
  const std::vector<std::string> names = command_names();
  return std::find(names.begin(), names.end(), word) != names.end();
}

bool is_top_level_option(const std::string& word) {
  return word == "--help" || word == "-h" || word == "--version";
}

/// Puts "render" in front where the command is left out. A word that is no file and looks like a
/// command is a typing error rather than a scene.
Arguments with_command(Arguments arguments) {
  if (arguments.empty()) throw UsageError("what shall be done? A scene or a command is missing.");
  const std::string& first = arguments.front();
  if (is_command(first) || is_top_level_option(first)) return arguments;
  const bool option = first.size() > 1 && first[0] == '-';
  const auto command = std::find_if(arguments.begin(), arguments.end(), is_command);
  if (option && command != arguments.end()) {
    throw UsageError(fmt::format("'{}' stands before the command: write 'pellucid {} ... {}'",
                                 first, *command, first));
  }
  struct stat info;
  const bool file = !option && stat(first.c_str(), &info) == 0;
  const std::string hint = option || file ? "" : did_you_mean(first, command_names());
  if (!hint.empty() || !is_command(DEFAULT_COMMAND)) {
    const char* what = option ? "option" : "command";
    throw UsageError(fmt::format("there is no {} '{}'; the commands are {}.{}", what, first,
                                 join(command_names()), hint));
  }
  arguments.insert(arguments.begin(), DEFAULT_COMMAND);
  return arguments;
}

/// The first word that looks like an option and is none of `app`.
std::string unknown_option(const CLI::App& app) {
  for (const std::string& word : app.remaining())
    if (word.size() > 1 && word[0] == '-') return word.substr(0, word.find('='));
  return "";
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// CLI11's message, or a better one where an unknown option is the cause of all that follows.
UsageError usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const std::string unknown = unknown_option(app);
  if (unknown.empty()) return UsageError(error.what());
  return UsageError(
      fmt::format("there is no option '{}'.{}", unknown, did_you_mean(unknown, option_names(app))));
}

/// An empty value is a script's unset variable, not a wish for the default.
void refuse_empty_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    option->check([](const std::string& text) {
      return text.empty() ? std::string("the value is empty") : std::string();
    });
}

struct Program {
  CLI::App app{"pellucid: a light-transport renderer whose methods run in OpenCL.", "pellucid"};
  std::map<const CLI::App*, CommandRun> runs;
  CommonOptions common;
  bool quiet = false, verbose = false;

  Program();
};

Program::Program() {
  app.set_version_flag("--version", fmt::format("pellucid {}\ncommit {}\nbuild  {}", version(),
                                                commit(), build_options()));
  app.footer(fmt::format(
      "{}'pellucid COMMAND --help' tells the options of a command.\n\nExample: pellucid "
      "cornell-box",
      is_command(DEFAULT_COMMAND) ? "'pellucid SCENE' means 'pellucid render SCENE'.\n" : ""));
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.require_subcommand(1);
  for (const Command& command : COMMAND_TABLE) {
    CLI::App& sub = *app.add_subcommand(command.name, command.summary);
    sub.group("Commands");
    runs[&sub] = command.setup(sub);
    sub.add_flag("-q,--quiet", quiet, "nothing on stderr but warnings and errors");
    sub.add_flag("-v,--verbose", verbose, "tell more on stderr")->excludes("--quiet");
    sub.add_option("--json", common.json, "results as JSON into FILE, or '-' for stdout")
        ->type_name("FILE");
    refuse_empty_values(sub);
  }
}

/// What the user typed as the command, for the hint after a usage error.
std::string chosen_command;

ExitCode run(Arguments arguments) {
  arguments = with_command(std::move(arguments));
  Program program;
  if (is_command(arguments.front())) chosen_command = arguments.front();
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    program.app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    // Help and version are "errors" of CLI11 with code 0; --help belongs to the chosen command.
    const bool chosen = !program.app.get_subcommands().empty();
    const CLI::App& app = chosen ? *program.app.get_subcommands().front() : program.app;
    if (dynamic_cast<const CLI::CallForHelp*>(&error)) {
      print_result(app.help(chosen ? "pellucid" : ""));
    } else if (dynamic_cast<const CLI::CallForVersion*>(&error)) {
      print_result(std::string(error.what()) + '\n');
    } else {
      throw usage_error(app, error);
    }
    return ExitCode::done;
  }
  if (program.quiet) set_log_level(LogLevel::quiet);
  if (program.verbose) set_log_level(LogLevel::verbose);
  return program.runs.at(program.app.get_subcommands().front())(program.common);
}

ExitCode report_fault(const std::string& what) {
  log_error("{}", what);
  log_error(
      "this is a fault of pellucid. Please report the command line, the lines above, the scene if "
      "you can, and: version {}, commit {}, build {}",
      version(), commit(), build_options());
  return ExitCode::internal;
}

ExitCode guarded_run(const Arguments& arguments) {
  try {
    return run(arguments);
  } catch (const UsageError& error) {
    const std::string message = error.what();
    const bool sentence = !message.empty() && (message.back() == '.' || message.back() == '?');
    log_error("{}{} See 'pellucid {}--help'.", message, sentence ? "" : ".",
              chosen_command.empty() ? "" : chosen_command + ' ');
    return error.code();
  } catch (const InternalError& error) {
    return report_fault(error.what());
  } catch (const Error& error) {
    log_error("{}", error.what());
    return error.code();
  } catch (const std::bad_alloc&) {
    return report_fault("the host's memory is exhausted");
  } catch (const std::exception& error) {
    return report_fault(fmt::format("unexpected: {}", error.what()));
  } catch (...) {
    return report_fault("unexpected: an exception without a message");
  }
}

}  // namespace
}  // namespace pellucid

int main(int argc, char** argv) {
  pellucid::process_clock();
  pellucid::prepare_process();
  return static_cast<int>(pellucid::guarded_run({argv + 1, argv + argc}));
}
