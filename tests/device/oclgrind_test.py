#!/usr/bin/env python3
"""Every pass once on a tiny image under Oclgrind: no access out of bounds, no data race.

Usage: oclgrind_test.py path/to/pellucid
Oclgrind simulates a device without SIMD builtins, so the portable code is what runs here.
"""
import os
import subprocess
import sys
import tempfile

PELLUCID = os.path.abspath(sys.argv[1])
# Method and scene: together they hold every pass and most lobes and lights.
RUNS = [("path", "gallery"), ("nee", "four-balls-sun"), ("reference", "four-balls-background"),
        ("naive", "cornell-box")]
failed = 0
with tempfile.TemporaryDirectory() as folder:
    for method, scene in RUNS:
        command = ["oclgrind", "--data-races", "--max-errors", "5", PELLUCID, "render", scene, "-i", method,
                   "--spp", "1", "--size", "8x8", "--max-depth", "5", "--device", "Oclgrind", "--strict",
                   "-o", f"{folder}/{scene}.exr"]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              env=dict(os.environ, PELLUCID_DEVICE=""))
        bad = done.returncode != 0 or any(word in done.stdout for word in
                                          ("Invalid", "race", "Uninitialized", "error"))
        if bad:
            failed += 1
            print(f"{method} {scene}: exit {done.returncode}\n{done.stdout[:4000]}")
print(f"{len(RUNS)} renders, {failed} with findings")
sys.exit(bool(failed))
