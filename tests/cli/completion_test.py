#!/usr/bin/env python3
"""Completion of command lines, asked of real shells: bash always, zsh and fish where they are.

Usage: completion_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import os
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import check, document, expect, run, run_tests, write_text

# Calls the completion as readline would, at the end of the words given.
ASK = """
source completion.bash || exit 1
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMP_LINE="$*"; COMP_POINT=${#COMP_LINE}
function=$(complete -p pellucid | sed 's/.*-F \\([^ ]*\\) .*/\\1/')
$function pellucid "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"
((${#COMPREPLY[@]})) && printf '%s\\n' "${COMPREPLY[@]}"
exit 0
"""


def complete(*words):
    done = subprocess.run(["bash", "--norc", "-c", ASK, "bash", "pellucid", *words], text=True,
                          capture_output=True, check=False, timeout=20)
    check(done.returncode == 0 and done.stderr == "", f"bash completes {words}", done.stderr)
    return done.stdout.splitlines()


def options_of(command):
    out, _ = expect(0, [command, "--help"])
    return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", out, re.MULTILINE))


def test_bash():
    with open("completion.bash", "w", encoding="utf-8") as file:
        file.write(expect(0, ["completion", "bash"])[0])
    out, _ = expect(0, ["--help"])
    commands = re.findall(r"^  (\w+)  ", out, re.MULTILINE)
    check(set(commands) <= set(complete("")), "all commands come first", complete(""))
    check(complete("ren") == ["render"], "a command", complete("ren"))
    check("cornell-box" in complete("cornell"), "a shipped scene without a command")
    for command in commands:
        found = set(complete(command, "--"))
        check(found == options_of(command), f"options of {command}",
              found ^ options_of(command))
    check(complete("render", "room.json", "--tone") == ["--tonemap"], "an option")
    check(complete("cornell-box", "--tone") == ["--tonemap"], "render is the default command")
    for command in ("render", "kernels"):
        for name in ("-i", "--integrator"):
            methods = complete(command, "box", name, "")
            known = list(document(["info", "room.json"])["integrators"])
            check(sorted(methods) == sorted(known), "methods", methods, known)
    check(complete("render", "--tonemap", "") == ["srgb", "filmic", "none"], "choices")
    check(complete("render", "--tonemap", "=", "f") == ["filmic"], "after =")
    check(complete("render", "--tonemap", "=") == ["srgb", "filmic", "none"], "right after =")
    check(complete("render", "--mis", "p") == ["power"], "choices by their beginning")
    aovs = complete("render", "--aov", "")
    check({"variance", "samples", "length", "tech", "light-vertices", "photons", "cells",
           "radius", "Z", "Ng", "id.object"} <= set(aovs),
          "AOVs", aovs)
    check(complete("render", "--aov", "le") == ["length"], "an AOV by its beginning")
    check(complete("kernels", "x", "--features", "") == ["auto", "all"], "LIST is no word to type")
    check(complete("render", "--spp", "") == [], "nothing to propose for numbers")
    check(complete("completion", "z") == ["zsh"], "shells")


def test_bash_completes_files():
    os.mkdir("models")
    for name in ("my model.obj", "models/a.ply"):
        write_text(name, "")
    check("my model.obj" in complete("render", "my"), "a file with a blank", complete("render", "my"))
    check(complete("compare", "models/a") == ["models/a.ply"], "files")
    check(complete("render", "x", "-o", "models/a") == ["models/a.ply"], "files after an option")
    check(complete("kernels", "x", "--dump", "mod") == ["models"], "folders after an option")
    check("cornell-box" in complete("info", "corn"), "scenes")
    check("cornell-box" not in complete("compare", "corn"), "compare takes no scenes")


def test_other_shells():
    """Syntax alone, and only where the shell is installed; what they must hold is checked anyway."""
    methods = list(document(["info", "room.json"])["integrators"])
    for shell in ("zsh", "fish"):
        name = "completion." + shell
        with open(name, "w", encoding="utf-8") as file:
            file.write(expect(0, ["completion", shell])[0])
        with open(name, encoding="utf-8") as file:
            text = file.read()
        for word in ("cornell-box", "tonemap", "srgb filmic none", "render"):
            check(word in text, f"{name} has {word}", text)
        offered = re.search(r"integrator.*?((?:\b(?:" + "|".join(methods) + r")\b ?){" + str(len(methods)) + "})",
                            text, re.DOTALL)
        check(offered and sorted(offered.group(1).split()) == sorted(methods), f"{name} has methods", text)
        if shutil.which(shell):
            done = subprocess.run([shell, "-n", name], capture_output=True, text=True, check=False)
            check(done.returncode == 0, f"{name} is {shell}", done.stderr)
        else:
            print(f"{shell} is not installed: its syntax is not checked")


def test_errors():
    expect(2, ["completion"], "SHELL is required")
    expect(2, ["completion", "csh"], "'csh'", "bash, zsh, fish")
    check(run("completion", "bsh")[2].count("Did you mean 'bash'?") == 1, "near names")
    check("_pellucid" in document(["completion", "bash"])["script"], "JSON")


run_tests(globals())
