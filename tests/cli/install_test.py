#!/usr/bin/env python3
"""cmake --install into a scratch prefix: complete, independent of the source tree, and movable.

Usage: install_test.py path/to/pellucid CMAKE BUILD_FOLDER   (exit 0: all checks hold)
"""
import json
import os
import subprocess
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import SOURCE, check, read_bytes, run_tests

CMAKE, BUILD = sys.argv[2], os.path.abspath(sys.argv[3])
FILES = ("bin/pellucid", "lib/pellucid/libpellucid_image.so",
         "share/pellucid/scenes/gallery/cornell-box.json",
         "share/pellucid/scenes/gallery/cornell-box.mtl", "share/pellucid/scenes/README.md",
         "share/pellucid/scene.schema.json", "share/bash-completion/completions/pellucid",
         "share/zsh/site-functions/_pellucid", "share/fish/vendor_completions.d/pellucid.fish")


def call(prefix, *arguments, cwd="/", code=0, **variables):
    program = os.path.join(prefix, "bin/pellucid")
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False,
                          cwd=cwd, timeout=60, env=dict(os.environ, **variables))
    check(done.returncode == code, f"{arguments}: exit code {done.returncode}", done.stderr)
    return done.stdout


def check_prefix(prefix, scratch):
    for name in FILES:
        check(os.path.isfile(os.path.join(prefix, name)), f"{prefix} has {name}")
    info = json.loads(call(prefix, "info", "cornell-box", "--json", "-"))
    for file in info["files"]:
        check(os.path.realpath(file).startswith(prefix + "/"), "scenes are the installed ones", file)
        check(not os.path.realpath(file).startswith(SOURCE + "/"), "not those of the source", file)
    for cwd in (scratch, "/"):
        out = os.path.join(scratch, "box.png")
        call(prefix, "cornell-box", "--spp", "1", "--size", "8x8", "-q", "-o", out, cwd=cwd)
        check(read_bytes(out)[:4] == b"\x89PNG", "it renders, and finds the image library")
        os.remove(out)
    with open(os.path.join(prefix, "share/pellucid/scene.schema.json"), encoding="utf-8") as file:
        check(file.read() == call(prefix, "schema"), "the schema is this program's")
    with open(os.path.join(prefix, FILES[6]), encoding="utf-8") as file:
        check("complete -F _pellucid pellucid" in file.read(), "so is the completion")


def test_install():
    scratch = os.path.realpath(os.getcwd())
    prefix, moved = scratch + "/first", scratch + "/moved/to here"
    done = subprocess.run([CMAKE, "--install", BUILD, "--prefix", prefix], capture_output=True,
                          text=True, check=False, timeout=120)
    check(done.returncode == 0, "cmake --install", done.stdout, done.stderr)
    check_prefix(prefix, scratch)
    # The prefix alone is searched: what is taken away there is not found in the source tree.
    os.remove(prefix + "/share/pellucid/scenes/analytic/furnace.json")
    call(prefix, "info", "furnace", code=3)
    os.makedirs(os.path.dirname(moved))
    os.rename(prefix, moved)
    check_prefix(moved, scratch)
    call(moved, "info", "furnace", code=3)
    os.symlink(moved + "/bin/pellucid", scratch + "/linked")
    done = subprocess.run([scratch + "/linked", "info", "shell"], check=False, capture_output=True)
    check(done.returncode == 0, "started through a link", done.stderr)


run_tests(globals())
