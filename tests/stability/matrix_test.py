#!/usr/bin/env python3
"""Float modes x devices x work-groups x threads: every pair of values in some cell of one table.

Usage: matrix_test.py path/to/pellucid pocl|oclgrind|rusticl   (exit 0: all cells hold; 77: no such device here)
Within a device and a mode the picture has the same bits whatever groups and threads. `strict` has the same bits
on all devices, too: kernels use no arithmetic that OpenCL leaves open. `mad` and `fast` have the energy of
`strict` by the same random numbers. In `fast` the compiler may reorder sums, and does so otherwise for other
groups (PoCL: `bdpt` and `vcm` in groups of 1): there each group has its bits with any number of threads. A cell
that a device cannot have is refused, and by what words stands here.
"""
import itertools
import json
import os
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
# pylint: disable=wrong-import-position
from harness import PELLUCID, SOURCE, check, read_bytes, run, run_tests, same_pixels

DEVICE = sys.argv[2]
EVERYTHING = os.path.join(SOURCE, "scenes", "stability", "everything.json")
MANY = os.cpu_count() or 2
FACTORS = {"device": ("pocl", "oclgrind", "rusticl"), "mode": ("strict", "mad", "fast"),
           "group": (1, 8, 64, 256), "threads": (1, "n")}
# Devices that are simulated or take long to compile have fewer cells, still all pairs with what they are.
TABLE = [("pocl", mode, group, threads)
         for (i, mode), (k, group) in itertools.product(enumerate(FACTORS["mode"]), enumerate(FACTORS["group"]))
         for threads in (FACTORS["threads"] if mode == "fast" else FACTORS["threads"][(i + k) % 2:][:1])] + [
    ("oclgrind", "strict", 1, 1), ("oclgrind", "strict", 256, "n"), ("oclgrind", "mad", 8, "n"),
    ("oclgrind", "mad", 64, 1), ("oclgrind", "fast", 64, "n"), ("oclgrind", "fast", 1, 1),
    ("rusticl", "strict", 1, 1), ("rusticl", "strict", 8, "n"), ("rusticl", "mad", 8, 1), ("rusticl", "mad", 64, "n"),
    ("rusticl", "fast", 1, "n"), ("rusticl", "fast", 256, 1)]
# llvmpipe splits a group among lanes of its own and allows 32 work-items for kernels of this size.
UNSUPPORTED = {("rusticl", group): f"a work-group of {group} is more than the 32" for group in (64, 256)}
# Some ten times the worst seen (4e-7 and 8e-7, `light` and fast on PoCL). A product and a sum rounded once sends no
# path here another way, which would be 6e-5 of all.
ENERGY = 4e-6  # of means
PIXELS = 8e-6  # mean over them


def render(cell, method, scene, name):
    device, mode, group, threads = cell
    command = ["render", scene, "-i", method, "--size", "32x16", "--spp", "32", "--seed", "7", "--float", mode,
               "--work-group", str(group), "--threads", str(MANY if threads == "n" else threads),
               "--deterministic", "--strict", "--aov", "variance", "-q", "-o", name]
    if device == "oclgrind":
        done = subprocess.run(["oclgrind", PELLUCID, *command, "--device", "Oclgrind"], text=True, check=False,
                              capture_output=True, timeout=600)
        return done.returncode, done.stderr
    environment = dict(os.environ)
    environment.pop("RUSTICL_ENABLE", None)
    if device == "rusticl":
        environment["RUSTICL_ENABLE"] = "llvmpipe"
    spec = {"pocl": "0:0", "rusticl": "llvmpipe"}[device]
    code, _, err = run(*command, "--device", spec, env=environment, timeout=600)
    return code, err


def differences(a, b):
    """The largest relative difference of a channel's mean, and the mean one of pixels."""
    _, out, _ = run("compare", a, b, "--json", "-")
    found = json.loads(out)
    return abs(found["worst_channel_energy"] - 1), found["smape"]


def check_cells(method, scene):
    reference = "reference.exr"
    check(render(("pocl", "strict", 64, "n"), method, scene, reference)[0] == 0, f"the reference by {method}")
    first = {}
    for cell in TABLE:
        device, mode, group, threads = cell
        if device != DEVICE:
            continue
        what = f"{method} on {scene}: {cell}"
        refused = UNSUPPORTED.get((device, group))
        name = f"{mode}-{group}-{threads}.exr"
        alike = (mode, group) if mode == "fast" else mode
        code, err = render(cell, method, scene, name)
        if refused:
            check(code == 4 and refused in err, f"{what} is refused", code, err)
            continue
        check(code == 0, what, code, err)
        if code:
            continue
        if alike not in first:
            first[alike] = name
            if mode == "strict":
                check(same_pixels(name, reference), f"{what} has the bits of PoCL")
            else:
                energy, pixels = differences(name, reference)
                print(f"{what}: energy off by {energy:.2g}, pixels by {pixels:.2g}")
                check(energy <= ENERGY, f"{what} has the energy of strict", energy)
                check(pixels <= PIXELS, f"{what} has the pixels of strict", pixels)
        check(read_bytes(name) == read_bytes(first[alike]), f"{what} has the bits of the cells that are like it")


def test_every_pair_is_in_the_table():
    for (i, (a, of_a)), (k, (b, of_b)) in itertools.combinations(enumerate(FACTORS.items()), 2):
        for x, y in itertools.product(of_a, of_b):
            check(any(cell[i] == x and cell[k] == y for cell in TABLE), f"{a} {x} with {b} {y}")


def test_cells():
    methods = ("path", "light", "bdpt", "vcm") if os.environ.get("PELLUCID_TIER") == "full" else ("path",)
    for method in methods:
        check_cells(method, EVERYTHING if DEVICE == "pocl" else "cornell-box")


def present():
    if DEVICE == "oclgrind":
        return True
    done = subprocess.run([PELLUCID, "devices", "--json", "-"], capture_output=True, check=False, timeout=60,
                          env=dict(os.environ, RUSTICL_ENABLE="llvmpipe"))
    devices = json.loads(done.stdout)["devices"] if done.returncode == 0 else []
    return DEVICE == "pocl" or any(device["platform"] == "rusticl" for device in devices)


if not present():
    print("there is no Rusticl with llvmpipe here; the package is mesa-opencl-icd")
    sys.exit(77)
run_tests(dict(globals()))
