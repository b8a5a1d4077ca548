#!/usr/bin/env python3
"""Every error of the command line: exit code, a message that helps, and nothing left behind.

Usage: errors_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import (PELLUCID, QUICK, ROOM, SOURCE, check, document, expect, read_bytes, read_json,
                     run_tests, temporaries, write_text)

FOREVER = ["room.json", "--spp", "1000000000"]


def quick_expect(*arguments, **options):
    """An error that has to come before any rendering."""
    start = time.monotonic()
    expect(*arguments, **options)
    check(time.monotonic() - start < 10, f"{arguments} fails at once")


def test_scene_files():
    expect(3, ["none.json"], "'none.json'")
    expect(3, ["cornel-box"], "Did you mean 'cornell-box'?", "gallery")
    expect(3, ["."], "'.'", "folder")
    write_text("empty.json", "")
    expect(3, ["empty.json"], "empty.json:1:1:")
    write_text("broken.json", '{"version": 1,\n  "camera" {}}')
    expect(3, ["broken.json"], "broken.json:2:12:", "  \"camera\" {}}", "^")
    if os.getuid() != 0:
        write_text("secret.json", json.dumps(ROOM))
        os.chmod("secret.json", 0)
        expect(3, ["secret.json"], "secret.json", "Permission denied")


def test_scene_values():
    text = json.dumps(ROOM)
    cases = [
        ('"fov": 90', '"fov": 1e999', "1e999"),
        ('"fov": 90', '"fov": NaN', "bad.json:1:"),
        ('"fov": 90', '"fov": 1000', "fov"),
        ('"width": 32', '"width": -5', "film.width: -5 is out of range", "32768"),
        ('"width": 32', '"width": 3.5', "width"),
        ('"width": 32', '"width": "wide"', "width"),
        ('"film"', '"flim"', '"flim"', "Did you mean 'film'?"),
        ('"radius": 0.4', '"radius": -1', "radius"),
        ('"radius": 0.4', '"radias": 1', '"radias"', "Did you mean 'radius'?"),
        ('"type": "sphere"', '"type": "spere"', "spere", "sphere"),
        ('"material": "grey"', '"material": "gray"', "gray", "grey"),
        ('"version": 1', '"version": 2', "version"),
        ('{"type": "sphere"', '{"type": "mesh", "file": "gone.obj"}, {"type": "sphere"',
         "gone.obj", "does not exist"),
        ('"lights"', '"integrator": {"name": "magic"}, "lights"', "magic", "path"),
    ]
    for old, new, *parts in cases:
        check(old in text, f"{old} is in the scene")
        write_text("bad.json", text.replace(old, new, 1))
        expect(3, ["bad.json", "--spp", "1"], "bad.json", *parts)


def test_usage():
    expect(2, ["room.json", "--sppp", "4"], "'--sppp'", "Did you mean '--spp'?")
    expect(2, ["room.json", "--denoise"], "there is no option '--denoise'")
    expect(2, ["room.json", "other.json"], "other.json")
    expect(2, ["render"], "SCENE is required")
    bad = {
        "--spp": ["0", "-1", "x", "1e3", "1.5", "", "4294967296"],
        "--time": ["", "x", "-1s", "5 s", "5q", "nan", "inf"],
        "--seed": ["-1", "x", "1.5", "99999999999999999999"],
        "--size": ["", "64", "64x", "x64", "0x0", "-5x5", "5x-5", "70000x1", "1e2x5", "5x5x5"],
        "--max-depth": ["0", "-3", "x", "4294967295"],
        "--work-group": ["0", "-1", "x", "100000"],
        "--mis": ["", "maxx"],
        "--integrator": ["magic"],
        "--features": ["x", "+x", "+phong,,", "+phong,x"],
        "--aov": ["x"],
        "-o": ["", "x", "x.", "x.doc"],
    }
    for option, values in bad.items():
        for value in values:
            quick_expect(2, [*FOREVER[:1], *([] if option == "--spp" else FOREVER[1:]), "-q",
                             option, value], option.strip("-")[:4])
        expect(2, ["room.json", option], option)
    for more in ([], ["--dry-run"]):
        expect(2, ["room.json", "-i", "sppm", "--radius", "1e-9", *more], "--radius 1e-09", "only from", "ask for")


def test_memory():
    """The film stays with the host, 192 bytes per pixel; the device gets bands of it."""
    largest = 48 << 30
    if os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGESIZE") < largest:
        for size in ("16384x16384", "8192x32768"):
            start = time.monotonic()
            expect(4, ["gallery", "--size", size], "48.0 GiB", "--crop")
            check(time.monotonic() - start < 5, "refused before any long work")
    start = time.monotonic()
    expect(4, ["gallery", "--memory", "20M"], "device memory", "--memory allows 20")
    check(time.monotonic() - start < 20, "refused before kernels are built")


def test_devices():
    nothing = dict(os.environ, OCL_ICD_VENDORS="/nonexistent")
    for arguments in (["room.json"], ["devices"], ["info", "room.json"], ["kernels", "room.json"]):
        expect(4, arguments, "no OpenCL platform", "pocl-opencl-icd", env=nothing)
    expect(4, [*FOREVER, "--device", "voodoo"], "'voodoo'", "\n  0:0  ")
    expect(4, [*FOREVER, "--device", "9:9"], "'9:9'", "\n  0:0  ")
    variable = dict(os.environ, PELLUCID_DEVICE="voodoo")
    expect(4, FOREVER, "'voodoo'", env=variable)
    expect(4, ["info", "room.json"], "'voodoo'", env=variable)
    expect(0, [*QUICK, "--device", "0:0"], env=variable)
    expect(0, QUICK, env=dict(os.environ, PELLUCID_DEVICE=""))
    expect(0, [*QUICK, "--device", "PTHREAD"])  # part of a name, in any case
    small = dict(os.environ, POCL_MAX_WORK_GROUP_SIZE="32")
    expect(4, [*FOREVER, "--work-group", "64"], "work-group of 64", "32", env=small)
    expect(0, QUICK, env=small)  # the default fits itself to the device


def test_outputs_that_cannot_be_written():
    """Found out before the render: nothing is rendered for the bin."""
    os.mkdir("folder.exr")
    quick_expect(5, [*FOREVER, "-o", "none/x.exr"], "none/x.exr", "No such file")
    quick_expect(5, [*FOREVER, "-o", "good.exr", "-o", "none/x.png"], "none/x.png")
    quick_expect(5, [*FOREVER, "-o", "folder.exr"], "folder.exr", "Is a directory")
    quick_expect(5, [*FOREVER, "--stats", "none/s.json"], "none/s.json")
    quick_expect(5, [*FOREVER, "--json", "none/s.json"], "none/s.json")
    quick_expect(5, [*FOREVER, "-o", "/proc/x.exr"], "/proc/x.exr")
    if os.getuid() != 0:
        os.mkdir("locked", 0o500)
        quick_expect(5, [*FOREVER, "-o", "locked/x.exr"], "locked/x.exr", "Permission denied")
    check(not os.path.exists("good.exr") and not temporaries(), "nothing is left", os.listdir("."))


def test_standard_output():
    with open("/dev/full", "w", encoding="ascii") as full:
        for arguments in (QUICK, [*QUICK, "--json", "-"], ["devices"], ["--help"], ["--version"],
                          ["info", "room.json"], ["kernels", "room.json"]):
            expect(5, arguments, "standard output", "No space left", stdout=full)
    expect(5, QUICK, "standard output", stdout=None, preexec_fn=lambda: os.close(1))
    reader, writer = os.pipe()
    os.close(reader)
    expect(5, QUICK, "standard output", "Broken pipe", stdout=writer)
    os.close(writer)
    check(os.path.exists("room.exr"), "the pictures are there nevertheless")


def plant(name, text):
    """Kernels of their own folder that make every sample of pixel 5 into `text`."""
    shutil.copytree(os.path.join(SOURCE, "kernels"), name)
    path = name + "/passes/pt_mega.cl"
    source = read_bytes(path).decode()
    place = "  samples[pixel] ="
    check(source.count(place) == 1, f"{path} has one place for the fault")
    write_text(path, source.replace(place, f"  if (pixel == 5u) radiance.x = {text};\n{place}"))


def test_strict():
    for name, text in (("nonfinite", "as_float(0x7fc00000u)"), ("negative", "-1.0f")):
        plant(name, text)
        options = [*QUICK, "--kernel-dir", name, "-o", name + ".exr", "--stats", name + ".json"]
        expect(0, options, "warning: device counters: 4 " + name)
        _, err = expect(6, [*options, "--strict"], "error: --strict: 4 " + name)
        stats = read_json(name + ".json")
        check(stats["counters"][name] == 4, "the statistics count them", stats["counters"])
        counters = document(["info", name + ".exr"])["metadata"]["pellucid:counters"]
        check(counters.startswith("4 " + name), "the EXR counts them", counters, err)
        compared = document(["compare", name + ".exr", name + ".exr"])
        check(compared["nonfinite"] == 0, "the picture is finite", compared)
    expect(0, [*QUICK, "--strict"])


def test_weights_are_weighed():
    """A weight above 1 in the walks of `path`, which mix two ways to find light."""
    shutil.copytree(os.path.join(SOURCE, "kernels"), "heavy")
    source = read_bytes("heavy/transport/mis.h").decode()
    place = "return (a >= b ? REAL(1.0) : r) / (REAL(1.0) + r);"
    check(source.count(place) == 1, "mis.h has one place for the fault")
    write_text("heavy/transport/mis.h", source.replace(place, "return REAL(1.0) + r;"))
    lit = [*QUICK, "-i", "path", "-o", "heavy.exr"]
    expect(0, [*lit, "--strict"])
    expect(6, [*lit, "--strict", "--kernel-dir", "heavy"], "weight_outside")


def test_closed_scenes():
    """Rays that leave a scene which says that it is closed are counted, on walks of both kinds."""
    wall = {"type": "sphere", "material": "grey", "center": [0, 0, 0], "radius": 10}
    closed = {**ROOM, "closed": True, "shapes": [*ROOM["shapes"], wall],
              "lights": [{"type": "point", "position": [0, 3, 0], "intensity": 1}]}
    for shapes, says, leaves in ((closed["shapes"], True, False), (ROOM["shapes"], True, True),
                                 (ROOM["shapes"], False, False)):
        write_text("closed.json", json.dumps({**closed, "closed": says, "shapes": shapes}))
        for method in ("path", "light"):
            _, err = expect(0, ["closed.json", *QUICK[1:], "-i", method, "--strict", "--stats", "closed-stats.json"])
            counted = read_json("closed-stats.json")["counters"]["escaped"]
            check((counted > 0) == leaves and ("escaped" in err) == leaves, "rays that leave", counted, err)


def test_strict_warnings():
    flat = {"type": "mesh", "material": "grey", "file": "flat.obj"}
    write_text("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n")
    write_text("warns.json", json.dumps({**ROOM, "shapes": [*ROOM["shapes"], flat]}))
    expect(0, ["warns.json", *QUICK[1:]], "warning: ")
    expect(3, ["warns.json", *FOREVER[1:], "--strict"], "warning: ", "--strict")


def test_no_image_library():
    os.mkdir("bin")
    shutil.copy(PELLUCID, "bin")
    done = subprocess.run(["bin/pellucid", *FOREVER], capture_output=True, check=False, timeout=40)
    check(done.returncode == 3 and b"image library is missing" in done.stderr,
          "a missing image library shows before the render", done.stderr)


run_tests(globals())
