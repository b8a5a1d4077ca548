#!/usr/bin/env python3
"""Every pass once on a tiny image under Oclgrind: no access out of bounds, no data race.

Usage: oclgrind_test.py path/to/pellucid path/to/device_tests
Oclgrind simulates a device without SIMD builtins, so the portable code is what runs here.
"""
import os
import subprocess
import sys
import tempfile

PELLUCID, DEVICE_TESTS = map(os.path.abspath, sys.argv[1:3])
# Method and scene: together they hold every pass and most lobes and lights.
RUNS = [("path", "gallery"), ("nee", "four-balls-sun"), ("reference", "four-balls-background"),
        ("naive", "cornell-box")]
failures = []


def check(what, command):
    done = subprocess.run(["oclgrind", "--data-races", "--max-errors", "5", *command],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=dict(os.environ, PELLUCID_DEVICE=""))
    if done.returncode or any(word in done.stdout for word in ("Invalid", "data race", "error:")):
        failures.append(what)
        print(f"{what}: exit {done.returncode}\n{done.stdout[:4000]}")


with tempfile.TemporaryDirectory() as folder:
    for method, scene in RUNS:
        check(f"{method} {scene}",
              [PELLUCID, "render", scene, "-i", method, "--spp", "1", "--size", "8x8", "--max-depth", "5",
               "--device", "Oclgrind", "--strict", "-o", f"{folder}/{scene}.exr"])
# No method splats yet: the splat film goes through its own test (probe_splat, film_add).
check("splats", [DEVICE_TESTS, "--gtest_filter=SplatTest.WhatCannotBeAddedIsCounted"])
print(f"{len(RUNS) + 1} runs, {len(failures)} with findings")
sys.exit(bool(failures))
