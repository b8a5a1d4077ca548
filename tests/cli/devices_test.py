#!/usr/bin/env python3
"""devices, info, kernels, help, version; and what starting the program costs.

Usage: devices_test.py path/to/pellucid   (exit 0: all checks hold)
Needs clang-15.
"""
import os
import re
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import PELLUCID, QUICK, SOURCE, check, document, expect, run, run_tests

COMMANDS = ("render", "devices", "info", "compare", "study", "bench", "merge", "kernels", "schema",
            "completion")
METHODS = ("naive", "nee", "path", "reference", "light", "bdpt", "sppm", "bpm",
           "vcm")


def test_devices():
    out, _ = expect(0, ["devices"])
    check(out.startswith("0:0  ") and "fp64" in out and "driver" in out, "devices as text", out)
    devices = document(["devices"])["devices"]
    keys = {"spec", "platform", "name", "vendor", "version", "driver", "cpu", "fp64",
            "int64_atomics", "memory_bytes", "max_buffer_bytes", "unusable"}
    check(devices and all(keys <= set(one) for one in devices), "keys of devices", devices)
    check(devices[0]["spec"] == "0:0" and devices[0]["unusable"] == "", "the first one", devices)
    check(devices[0]["memory_bytes"] >= devices[0]["max_buffer_bytes"] > 2**20, "memory", devices)
    for one in document(["devices", "--selftest"])["devices"]:
        if not one["unusable"]:
            check(one["selftest"]["passed"], "selftest", one)
            check(one["selftest"]["layout_differences"] == [], "layouts agree", one)
            math = one["selftest"]["math"]
            check(len(math) == 9 and all(0 <= m["worst"] <= m["bound"] for m in math), "arithmetic", math)
    out, _ = expect(0, ["devices", "--selftest"])
    check("selftest passed" in out, "selftest as text", out)


def test_info_of_scenes():
    out, _ = expect(0, ["info", "room.json"])
    for word in ("room", "32x16", "present", "absent", "BVH", "memory", "pt_mega", "naive"):
        check(word in out, f"info tells {word}", out)
    info = document(["info", "room.json"])
    check(info["features"]["spheres"] and not info["features"]["phong"], "features", info)
    check(set(info["integrators"]) == set(METHODS), "integrators", info)
    for name, method in info["integrators"].items():
        check(method["can_render"] is True and method["unreachable"] == [], name, method)
    check(info["memory_bytes"]["film"] == 192 * 32 * 16, "memory", info)
    check({"nodes", "leaves", "depth", "sah_cost"} <= set(info["bvh"]), "bvh", info)
    blind = document(["info", "four-balls-point"])["integrators"]["naive"]["unreachable"]
    check(blind and "light" in blind[0], "naive cannot find point lights", blind)
    expect(3, ["info", "none.json"], "'none.json'")


def test_info_of_images():
    expect(0, [*QUICK, "-o", "room.exr", "-o", "room.png"])
    info = document(["info", "room.exr"])
    check((info["width"], info["height"]) == (32, 16), "size", info)
    check(info["channels"] == ["R", "G", "B"] and info["metadata"]["samplesPerPixel"] == "4",
          "channels and metadata", info)
    out, _ = expect(0, ["info", "room.exr"])
    check("32x16" in out and "worldToCamera" in out, "as text", out)
    check(document(["info", "room.png"])["width"] == 32, "PNG")
    expect(3, ["info", "none.exr"], "none.exr", "No such file")


def test_kernels():
    clang = shutil.which("clang-15")
    check(clang, "clang-15 is installed")
    for scene, method in (("room.json", "path"), ("gallery", "reference")):
        folder = f"dump/{method}"
        out, _ = expect(0, ["kernels", scene, "-i", method, "--dump", folder])
        check("pt_mega" in out and folder in out, "kernels as text", out)
        names = sorted(os.listdir(folder))
        check(names == ["film_add.cl", "film_add.options", "pt_mega.cl", "pt_mega.options"],
              "files of the dump", names)
        for name in ("pt_mega", "film_add"):
            with open(f"{folder}/{name}.options", encoding="utf-8") as file:
                options = file.read().split()
            check("-cl-std=CL1.2" in options, "options", options)
            # PoCL gives the target; the features of the CPU decide on nothing but speed.
            done = subprocess.run(
                [clang, "-x", "cl", *options, "-Xclang", "-finclude-default-header",
                 "-fsyntax-only", f"{folder}/{name}.cl"], capture_output=True, text=True,
                check=False, timeout=60)
            check(done.returncode == 0, f"{folder}/{name}.cl compiles", done.stderr)
    kernels = document(["kernels", "room.json"])
    check([one["name"] for one in kernels["kernels"]] == ["pt_mega", "film_add"], "JSON", kernels)
    check("#define FEAT_SPHERES 1" in kernels["prelude"], "prelude", kernels["prelude"])
    expect(2, ["kernels", "room.json", "--features", "+x"], "'+x'")
    expect(2, ["kernels", "room.json", "-i", "magic"], "'magic'")
    expect(5, ["kernels", "room.json", "--dump", "/proc/none"], "/proc/none")


def options_of(text):
    """Options that a help text declares, not those it mentions."""
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE)


def test_help():
    out, _ = expect(0, ["--help"])
    check("Example: pellucid " in out, "the program has an example", out)
    check(set(re.findall(r"^  (\w+)  ", out, re.MULTILINE)) == set(COMMANDS), "commands", out)
    for command in COMMANDS:
        text, err = expect(0, [command, "--help"])
        check(re.search(r"Example:\s+pellucid " + command, text), f"{command} has an example", text)
        check(err == "", f"help of {command} writes to stdout alone", err)
        check(not re.search(r"stub|todo|not (yet )?implemented|reserved", text, re.I),
              f"{command} has no stubs", text)
        options = options_of(text)
        check({"--help", "--quiet", "--verbose", "--json"} <= set(options), "common", options)
        for option in options:
            _, _, err = run(command, option, "--no-such-option")  # which keeps it from running
            check(f"no option '{option}'" not in err, f"{command} {option} exists", err)
        mentioned = set(re.findall(r"(?<![\w-])--[a-z][\w-]*", text))
        check(mentioned <= set(options), f"{command} mentions unknown options",
              mentioned - set(options))
        expect(2, [command, "--no-such-option"], "there is no option '--no-such-option'")


def test_version():
    out, _ = expect(0, ["--version"])
    check(re.match(r"pellucid \d+\.\d+\.\d+\ncommit \S+\nbuild  .+\n$", out), "--version", out)


def test_cost_of_starting():
    loud = dict(os.environ, LD_DEBUG="files")
    for arguments in (["--help"], ["--version"], ["render", "--help"], ["devices"]):
        _, _, err = run(*arguments, env=loud)
        check("libOpenCL" in err, "the linker tells what it loads")
        for library in ("libOpenImageIO", "libpellucid_image", "libOpenEXR"):
            check(library not in err, f"{arguments} loads {library}")
        seconds = []
        for _ in range(5):
            start = time.monotonic()
            expect(0, arguments)
            seconds.append(time.monotonic() - start)
        limit = 1.0 if arguments == ["devices"] else 0.2
        check(min(seconds) < limit, f"{arguments} starts in {limit} s", seconds)


def test_any_folder():
    os.makedirs("far/away")
    expect(0, ["cornell-box", "--spp", "1", "--size", "8x8", "-q"], cwd="far/away")
    check(os.path.exists("far/away/cornell-box.exr"), "written where it was started")
    expect(0, ["info", os.path.join(SOURCE, "scenes/gallery/gallery.json")], cwd="/")
    os.symlink(PELLUCID, "linked")
    done = subprocess.run(["./linked", *QUICK], capture_output=True, check=False, timeout=60)
    check(done.returncode == 0, "started through a link it finds its parts", done.stderr)


run_tests(globals())
