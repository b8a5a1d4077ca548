#!/usr/bin/env python3
"""The table of bad input as a user meets it: options with odd values, damaged files of every kind.

Options come from --help, so a new one is under test from its first day. What goes wrong inside scenes
and models is tested without processes, and thus in the thousands, by tests/unit/bad_*_test.cpp.
Usage: bad_input_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import re
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import SOURCE, check, document, expect, read_bytes, run, run_tests, write_text

EVERYTHING = os.path.join(SOURCE, "tests", "support", "everything")
ODD = ["nan", "inf", "-inf", "-1", "0", "1e38", "1e400", "", "x", "1 ", "\u00e9", "%s%n"]
# A device that is not there ends a run with code 4 as soon as all of the command line is understood.
NO_DEVICE = ["--device", "voodoo"]
BASE = {
    "render": ["room.json", *NO_DEVICE],
    "info": ["room.json", *NO_DEVICE],
    "kernels": ["room.json", *NO_DEVICE],
    "bench": NO_DEVICE,
    "study": ["room.json", *NO_DEVICE],
    "compare": ["a.exr", "a.exr"],
    "devices": [],
    "merge": ["gone.exr", "-o", "out.exr"],
    "schema": [],
    "completion": ["bash"],
}
# Odd, but right. All others of ODD are usage errors, except where a name is wanted.
LEGAL = {"--seed": ["0"], "--time": ["0", "1e38"], "--every": ["0", "1e38"],
         "--fail-slower": ["0"], "--budget": ["1e38"], "--exposure": ["-1", "0"]}
NAMES = ("FILE", "DIR", "SPEC")
# Options that `path` has no use for, with a method that has: values are refused, not their presence.
METHOD = {"--light-paths": "sppm", "--radius": "sppm", "--radius-alpha": "bpm", "--merges": "vcm",
          "--vertices": "vcm"}


def options_of(command):
    """Pairs (option, type) of all options that take a value, as --help has them."""
    out, _ = expect(0, [command, "--help"])
    found = re.findall(r"^  (-\S+) ([A-Za-z][A-Za-z|:,-]*)", out.split("Options:")[1], re.MULTILINE)
    # -D has a test of its own (scene_test.py).
    return [(names.split(",")[-1], kind) for names, kind in found
            if names != "-D" and kind not in ("Print", "Excludes:", "Needs:")
            and (kind[-1].isupper() or "|" in kind or ":" in kind)]


def sound(code, err, what):
    """No run may end in a fault of pellucid's, a report of a sanitizer, or never."""
    check(code in (0, 1, 2, 3, 4, 5, 6, 75), f"{what}: exit code {code}", err)
    for word in ("fault of pellucid", "Sanitizer", "runtime error", "terminate called"):
        check(word not in err, f"{what}: {word}", err)
    check(code in (0, 1) or "error: " in err, f"{what}: says what is wrong", err)


def attempt(arguments, *codes, parts=(), **options):
    code, _, err = run(*arguments, **options)
    what = "pellucid " + " ".join(arguments)
    sound(code, err, what)
    check(code in codes, f"{what}: exit code {code}, not in {codes}", err)
    for part in parts:
        check(part in err, f"{what}: stderr lacks {part!r}", err)


def test_options():
    out, _ = expect(0, ["--help"])
    commands = re.findall(r"^  (\w+) ", out.split("Commands:")[1], re.MULTILINE)
    check(set(commands) <= set(BASE), "BASE tells how to run every command", commands)
    no_platform = dict(os.environ, OCL_ICD_VENDORS="/nonexistent")
    jobs = []
    for command in commands:
        for option, kind in options_of(command):
            base = [command, *BASE[command]]
            if option in METHOD and command == "render":
                base += ["-i", METHOD[option]]
            if option == "--device":
                base = base[:-2]
            for value in ODD:
                legal = value in LEGAL.get(option, ()) or (kind in NAMES and value != "")
                codes = (0, 2, 3, 4, 5) if legal else (2,)
                # Some messages name the short form.
                parts = () if legal else ["-o" if option == "--output" else option.lstrip("-")]
                # With "=", since a value that begins with "-" would be taken for an option.
                jobs.append(([*base, f"{option}={value}"], codes, parts))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for _ in pool.map(lambda job: attempt(job[0], *job[1], parts=job[2], env=no_platform), jobs):
            pass


def test_arguments():
    for command in ("render", "info", "kernels"):
        for value in ODD:
            attempt([command, value], 2, 3)
        attempt([command, "x" * 5000], 3)
        attempt([command, "\udcff\udcfe.json"], 3)
        attempt([command], 2)
    attempt(["compare", "nan", "inf"], 3, parts=["nan"])


def good_scene(folder):
    shutil.copytree(EVERYTHING, folder)
    attempt(["info", folder + "/everything.json", *NO_DEVICE], 4)


def damages(data):
    """Pairs (what, bytes): the file cut at 20 places, emptied, and filled with something else."""
    yield from ((f"cut at {i}/20", data[:len(data) * i // 20]) for i in range(20))
    yield "a zero byte", b"\0"
    yield "garbage", bytes(i * i * 31 % 251 for i in range(4096))
    yield "another encoding", data.decode("latin-1").encode("utf-16")


def test_damaged_scenes():
    good_scene("good")
    for name in ("everything.json", "everything.obj", "everything.mtl"):
        data = read_bytes("good/" + name)
        for what, damaged in damages(data):
            with open("good/" + name, "wb") as file:
                file.write(damaged)
            # Text models may be cut between two lines; then the scene lacks nothing it asks for.
            may_be_good = name != "everything.json" and what.startswith("cut")
            attempt(["info", "good/everything.json", *NO_DEVICE], 3, *([4] if may_be_good else []),
                    parts=[] if may_be_good else [name])
        with open("good/" + name, "wb") as file:
            file.write(data)


def special_files(suffix):
    """Names of things that are no regular files, each with words of its message."""
    os.mkdir("folder" + suffix)
    os.symlink("loop" + suffix, "loop" + suffix)
    os.symlink("nowhere", "dangling" + suffix)
    os.mkfifo("pipe" + suffix)
    os.symlink("/dev/zero", "zero" + suffix)
    write_text("empty" + suffix, "")
    write_text("secret" + suffix, "{}")
    os.chmod("secret" + suffix, 0)
    yield "folder", "folder" if suffix in (".json", ".obj") else "directory"
    yield "loop", "symbolic links"
    yield "dangling", ""
    yield "pipe", "a pipe"
    yield "zero", "a device"
    yield "empty", ""
    if os.getuid() != 0:
        yield "secret", "Permission denied"


def test_special_files():
    for suffix in (".json", ".exr", ".obj"):
        for name, words in special_files(suffix):
            name += suffix
            if suffix == ".obj":
                scene = {"version": 1, "camera": {"origin": [0, 0, 5], "target": [0, 0, 0]},
                         "shapes": [{"type": "mesh", "file": name}]}
                write_text("names.json", json.dumps(scene))
                attempt(["info", "names.json"], 3, parts=[name, words, "names.json:1:"])
            else:
                attempt(["info", name], 3, parts=[name, words])
                attempt(["render", name], 3, parts=[name])
            if suffix == ".exr":
                attempt(["compare", name, name], 3, parts=[name, words])


def test_baselines():
    cell = {"triangles": 1000, "kind": "primary", "mrays_per_s": 1.5}
    text = json.dumps({"rays": [cell]})
    write_text("baseline.json", text)
    attempt(["bench", "--baseline", "baseline.json", *NO_DEVICE], 4)
    odd = [1, "x", None, [], {}, True]
    wrong = [{"rays": value} for value in (*odd, [1], ["x"], [None], [[]], [{}])]
    wrong += [{"rays": [dict(cell, **{key: value})]} for key in cell for value in odd
              if type(value) not in (int, type(cell[key]))]
    wrong += [{"rays": [dict(cell, mrays_per_s=value)]} for value in (0, -1)]
    wrong += [{"rays": [{k: v for k, v in cell.items() if k != key}]} for key in cell]
    texts = [json.dumps(value) for value in (*odd, *wrong)]
    texts += [text[:len(text) * i // 20] for i in range(20)]
    texts += ["[" * 100000, text.replace("1.5", "NaN"), text.replace("1.5", "1e400")]
    for bad in texts:
        write_text("baseline.json", bad)
        attempt(["bench", "--baseline", "baseline.json", *NO_DEVICE], 3,
                parts=["baseline.json", "bench --only rays --json"])
    for name, what in (("gone.json", "No such file"), (".", "directory"), ("/dev/zero", "a device")):
        attempt(["bench", "--baseline", name, *NO_DEVICE], 3, parts=[name, what])


def test_render_baselines():
    command = ["bench", "--only", "render", "--scene", "room.json", "--baseline", "baseline.json", *NO_DEVICE]
    cell = {"scene": "room", "integrator": "path", "samples_per_s_best": 1.5, "relmse_runs": [0.5, 0.25]}
    score = {"name": "render-2/path", "score": 1.5, "low": 1.25}
    device = {"device": "d", "driver": "e", "methods": [cell], "scores": [score]}
    whole = {"workload": "render-2", "scenes": {"room": document(["info", "room.json"])["hash"]},
             "devices": [device]}
    write_text("baseline.json", json.dumps(whole))
    attempt(command, 4)
    odd = [1, "x", None, [], {}, [1]]
    wrong = [dict(whole, **{key: value}) for key in whole for value in odd]
    for part, make in ((device, lambda d: [d]), (cell, lambda c: [dict(device, methods=[c])]),
                       (score, lambda s: [dict(device, scores=[s])])):
        changed = [{k: v for k, v in part.items() if k != key} for key in part]
        changed += [dict(part, **{key: value}) for key in part for value in (None, {}, [{}])]
        wrong += [dict(whole, devices=make(entry)) for entry in changed]
    for value in wrong:
        write_text("baseline.json", json.dumps(value))
        attempt(command, 3, parts=["baseline.json", "bench --only render --json"])


def test_pictures():
    """Damage inside pictures is for the unit tests; here: what each command makes of it."""
    golden = os.path.join(SOURCE, "tests", "golden", "cornell-box.exr")
    for suffix in ("EXR", "png", "hdr", "tif", "jpg", "bmp", "tga", "ppm", "webp"):
        name = "whole." + suffix
        attempt(["compare", golden, golden, "-o", name], 0)
        attempt(["info", name], 0)
        with open("cut." + suffix, "wb") as file:
            data = read_bytes(name)
            file.write(data[:len(data) // 2])
        attempt(["info", "cut." + suffix], 3, parts=["cut." + suffix])
    attempt(["compare", "cut.png", golden], 3, parts=["cut.png"])
    attempt(["compare", golden, golden, "--explain"], 2, parts=["--explain", golden, "--aov length"])
    attempt(["compare", golden, "whole.png", "--explain"], 2, parts=["whole.png"])
    attempt(["compare", golden, "cut.png"], 3, parts=["cut.png"])
    for name in ("diff", "diff.doc", "diff."):
        attempt(["compare", golden, golden, "-o", name], 2, parts=["suffix" if name == "diff" else name])
    attempt(["compare", "gone.exr", golden, "-o", "none/diff.png"], 5, parts=["none/diff.png"])


def test_kernel_folders():
    whole = os.path.join(SOURCE, "kernels")
    for name in ("gone", "room.json", "empty"):
        if name == "empty":
            os.mkdir(name)
        for command in ("kernels", "render"):
            attempt([command, "room.json", "--kernel-dir", name], 3, parts=[name + "/passes/pt_mega.cl"])
    shutil.copytree(whole, "mine")
    place = "mine/passes/pt_mega.cl"
    source = read_bytes(place)
    for what, damaged in damages(source):
        with open(place, "wb") as file:
            file.write(damaged)
        if what.startswith("cut at") and int(what[7:-3]) % 4 != 0:  # each costs a compiler's start
            continue
        attempt(["room.json", "--kernel-dir", "mine", "--size", "8x8", "--spp", "1"], 3, 4,
                parts=["pt_mega"])
    os.remove(place)
    os.symlink("/dev/zero", place)
    attempt(["room.json", "--kernel-dir", "mine"], 3, parts=[place, "a device"])


run_tests(dict(globals()))
