// completion: what shells need to complete command lines, made from the tables of options.
#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/scene_input.h"
#include "base/log.h"
#include "base/text.h"

namespace pellucid {
namespace {

using Words = std::vector<std::string>;

enum class Value { none, file, folder, choice, other };

struct OptionWords {
  Words names;  ///< "-i", "--integrator"
  std::string description;
  Value value = Value::none;
  Words choices;
};

struct CommandWords {
  std::string name, summary;
  std::vector<OptionWords> options;
  Words choices;        ///< of the arguments that are no options
  bool files = false;   ///< these may be files ...
  bool scenes = false;  ///< ... or shipped scenes
};

/// "srgb|filmic|none" as words; LIST and the like stand for something else.
Words split_choices(const std::string& type) {
  Words words;
  for (std::size_t start = 0; start <= type.size();) {
    const std::size_t end = std::min(type.find('|', start), type.size());
    const std::string word = type.substr(start, end - start);
    const bool stands_for =
        word.size() > 1 &&
        std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c); });
    if (!stands_for) words.push_back(word);
    start = end + 1;
  }
  return words;
}

/// The first clause, for a line beside the option.
std::string brief(const std::string& description) {
  std::string text = description.substr(0, description.find_first_of(";(:"));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return fit_line(text, 70);
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  words.description = brief(option.get_description());
  if (option.get_items_expected_max() == 0) return words;  // a flag
  std::string type = option.get_type_name();
  type = type.substr(0, type.find(':'));  // the rest tells of checks
  if (type.find('|') != std::string::npos) words.choices = split_choices(type);
  words.value = !words.choices.empty() ? Value::choice
                : type == "FILE"       ? Value::file
                : type == "DIR"        ? Value::folder
                                       : Value::other;
  return words;
}

CommandWords words_of(const CLI::App& command) {
  CommandWords words;
  words.name = command.get_name();
  words.summary = command.get_description();
  for (const CLI::Option* option : command.get_options()) {
    OptionWords one = words_of(*option);
    if (!one.names.empty()) {
      words.options.push_back(std::move(one));
      continue;
    }
    const std::string argument = option->get_name(true);
    words.choices.insert(words.choices.end(), one.choices.begin(), one.choices.end());
    words.files = one.choices.empty();
    words.scenes |= argument == "SCENE" || argument == "FILE";
  }
  return words;
}

std::vector<CommandWords> all_commands(const CLI::App& program) {
  std::vector<CommandWords> all;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    all.push_back(words_of(*command));
  return all;
}

/// In single quotes of a POSIX shell, zsh or fish.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

Words names_of(const std::vector<CommandWords>& commands) {
  Words names;
  for (const CommandWords& command : commands) names.push_back(command.name);
  return names;
}

Words option_names(const CommandWords& command) {
  Words names;
  for (const OptionWords& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// ---- bash ------------------------------------------------------------------------------------

std::string bash_values(const CommandWords& command) {
  std::string text;
  for (const OptionWords& option : command.options) {
    if (option.value == Value::none) continue;
    Words patterns;
    for (const std::string& name : option.names)
      patterns.push_back(fmt::format("'{} {}'", command.name, name));
    const std::string action = option.value == Value::choice
                                   ? fmt::format("_pellucid_words '{}'", join(option.choices, " "))
                               : option.value == Value::file   ? "_pellucid_files -f"
                               : option.value == Value::folder ? "_pellucid_files -d"
                                                               : ":";
    text += fmt::format("    {}) {}; return ;;\n", join(patterns, "|"), action);
  }
  return text;
}

std::string bash_script(const std::vector<CommandWords>& commands, const Words& scenes) {
  std::string values, options, arguments;
  for (const CommandWords& command : commands) {
    values += bash_values(command);
    options += fmt::format("      {}) _pellucid_words '{}' ;;\n", command.name,
                           join(option_names(command), " "));
    const std::string words = command.scenes ? "$scenes" : join(command.choices, " ");
    arguments += fmt::format("    {}) _pellucid_words \"{}\"{} ;;\n", command.name, words,
                             command.files ? "; _pellucid_files -f" : "");
  }
  return fmt::format(
      R"(# bash completion for pellucid; made by 'pellucid completion bash'.
_pellucid_words() {{
  local word
  while read -r word; do COMPREPLY+=("$word"); done < <(compgen -W "$1" -- "$cur")
}}
_pellucid_files() {{
  local word
  compopt -o filenames 2>/dev/null
  while read -r word; do COMPREPLY+=("$word"); done < <(compgen "$1" -- "$cur")
}}
_pellucid() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} command=render
  local commands='{}'
  local scenes='{}'
  COMPREPLY=()
  # --option=value arrives as three words.
  if [[ $cur == = ]]; then
    cur=
  elif [[ $prev == = ]]; then
    prev=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  if ((COMP_CWORD == 1)) && [[ $cur != -* ]]; then
    _pellucid_words "$commands $scenes"
    _pellucid_files -f
    return
  fi
  ((COMP_CWORD > 1)) && [[ " $commands " == *" ${{COMP_WORDS[1]}} "* ]] && command=${{COMP_WORDS[1]}}
  case "$command $prev" in
{}  esac
  if [[ $cur == -* ]]; then
    case $command in
{}    esac
    ((COMP_CWORD == 1)) && _pellucid_words '--version'
    return
  fi
  case $command in
{}  esac
}}
complete -F _pellucid pellucid
)",
      join(names_of(commands), " "), join(scenes, " "), values, options, arguments);
}

// ---- zsh -------------------------------------------------------------------------------------

/// Within [...] of a specification for _arguments, which has meanings of its own for some signs.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) result += (std::strchr("[]:\\", c) ? "\\" : "") + std::string(1, c);
  return result;
}

std::string zsh_option(const OptionWords& option, const std::string& name) {
  const std::string value = option.value == Value::none ? ""
                            : option.value == Value::choice
                                ? ":value:(" + join(option.choices, " ") + ")"
                            : option.value == Value::file   ? ":file:_files"
                            : option.value == Value::folder ? ":folder:_files -/"
                                                            : ":value: ";
  return quoted("*" + name + "[" + zsh_text(option.description) + "]" + value);
}

std::string zsh_script(const std::vector<CommandWords>& commands, const Words& scenes) {
  std::string summaries, cases;
  for (const CommandWords& command : commands) {
    summaries += "    " + quoted(command.name + ":" + command.summary) + "\n";
    cases += "    " + command.name + ")\n      _arguments -s \\\n";
    for (const OptionWords& option : command.options)
      for (const std::string& name : option.names)
        cases += "        " + zsh_option(option, name) + " \\\n";
    const std::string argument = command.scenes  ? "_pellucid_scenes"
                                 : command.files ? "_files"
                                                 : "(" + join(command.choices, " ") + ")";
    cases += "        " + quoted("*:argument:" + argument) + "\n      ;;\n";
  }
  return fmt::format(R"(#compdef pellucid
# zsh completion for pellucid; made by 'pellucid completion zsh'.
_pellucid_scenes() {{
  compadd {}
  _files
}}
_pellucid() {{
  local -a commands
  commands=(
{}  )
  local command=render
  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then
    _describe command commands
    _pellucid_scenes
    return
  fi
  if (( ${{commands[(I)$words[2]:*]}} )); then
    command=$words[2]
    shift words
    (( CURRENT-- ))
  fi
  case $command in
{}  esac
}}
_pellucid "$@"
)",
                     join(scenes, " "), summaries, cases);
}

// ---- fish ------------------------------------------------------------------------------------

std::string fish_option(const OptionWords& option, const std::string& condition) {
  std::string line = "complete -c pellucid -n " + quoted(condition);
  for (const std::string& name : option.names)
    line += name[1] == '-' ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.value == Value::choice) line += " -x -a " + quoted(join(option.choices, " "));
  if (option.value == Value::file) line += " -r -F";
  if (option.value == Value::folder) line += " -x -a '(__fish_complete_directories)'";
  if (option.value == Value::other) line += " -x";
  return line + " -d " + quoted(option.description) + "\n";
}

std::string fish_script(const std::vector<CommandWords>& commands, const Words& scenes) {
  std::string text = "# fish completion for pellucid; made by 'pellucid completion fish'.\n";
  for (const CommandWords& command : commands) {
    Words others = names_of(commands);
    others.erase(std::remove(others.begin(), others.end(), command.name), others.end());
    // Without a command it is render.
    const std::string condition = command.name == "render"
                                      ? "not __fish_seen_subcommand_from " + join(others, " ")
                                      : "__fish_seen_subcommand_from " + command.name;
    text += fmt::format("complete -c pellucid -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        quoted(command.summary));
    for (const OptionWords& option : command.options) text += fish_option(option, condition);
    const Words arguments = command.scenes ? scenes : command.choices;
    if (!arguments.empty())
      text += fmt::format("complete -c pellucid -n {}{} -a {}\n", quoted(condition),
                          command.files ? "" : " -f", quoted(join(arguments, " ")));
  }
  return text;
}

ExitCode run_completion(const CLI::App& program, const std::string& shell,
                        const CommonOptions& common) {
  const std::vector<CommandWords> commands = all_commands(program);
  const Words scenes = shipped_scenes();
  const std::string script = shell == "bash"   ? bash_script(commands, scenes)
                             : shell == "zsh"  ? zsh_script(commands, scenes)
                             : shell == "fish" ? fish_script(commands, scenes)
                                               : "";
  if (script.empty())
    throw UsageError(fmt::format("there is no completion for '{}'; there is for bash, zsh, fish.{}",
                                 shell, did_you_mean(shell, {"bash", "zsh", "fish"})));
  if (common.wants_text()) print_result(script);
  write_json(common.json, {{"shell", shell}, {"script", script}});
  return ExitCode::done;
}

}  // namespace

CommandRun setup_completion(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  app.add_option("SHELL", *shell, "which shell the script is for")
      ->type_name("bash|zsh|fish")
      ->required();
  app.footer(
      "Example: pellucid completion bash > ~/.local/share/bash-completion/completions/pellucid");
  return [shell, program = app.get_parent()](const CommonOptions& common) {
    return run_completion(*program, *shell, common);
  };
}

}  // namespace pellucid
