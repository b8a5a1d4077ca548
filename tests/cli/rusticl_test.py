#!/usr/bin/env python3
"""A second OpenCL implementation: Mesa's Rusticl on llvmpipe, which has no fp64, no 64-bit atomics.

Usage: rusticl_test.py path/to/pellucid   (exit 0: all checks hold; 77: there is no Rusticl here)
Needs the package mesa-opencl-icd. Kernels take half a minute each to build, so there are few.
"""
import json
import os
import subprocess
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import PELLUCID, check, expect, run_tests, same_pixels

RUSTICL = dict(os.environ, RUSTICL_ENABLE="llvmpipe")
POCL = {name: value for name, value in os.environ.items() if name != "RUSTICL_ENABLE"}
SLOW = {"env": RUSTICL, "timeout": 300}


def rusticl_devices():
    done = subprocess.run([PELLUCID, "devices", "--json", "-"], env=RUSTICL, capture_output=True,
                          check=False, timeout=60)
    devices = json.loads(done.stdout)["devices"] if done.returncode == 0 else []
    return [device for device in devices if device["platform"] == "rusticl"]


def test_selftest():
    out, _ = expect(0, ["devices", "--selftest"], **SLOW)
    place = out.find("llvmpipe")
    check("selftest passed: layouts agree" in out[place:], "the selftest on llvmpipe", out)


def test_pictures_agree():
    """The kernels use no arithmetic that OpenCL leaves open here, so the bits are the same."""
    for scene, method in (("furnace", "path"), ("sphere-light", "naive")):
        options = [scene, "-q", "--size", "16x16", "--spp", "16", "-i", method]
        expect(0, [*options, "-o", "rusticl.exr", "--device", "llvmpipe"], **SLOW)
        expect(0, [*options, "-o", "pocl.exr"], env=POCL)
        check(same_pixels("rusticl.exr", "pocl.exr"), f"{scene} by {method}: the same bits")


if not rusticl_devices():
    print("there is no Rusticl with llvmpipe here; the package is mesa-opencl-icd")
    sys.exit(77)
run_tests(dict(globals()))
