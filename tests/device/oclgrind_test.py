#!/usr/bin/env python3
"""Every pass once on a tiny image under Oclgrind: no access out of bounds, no data race.

Usage: oclgrind_test.py path/to/pellucid path/to/device_tests
Oclgrind simulates a device without SIMD builtins, so the portable code is what runs here.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

PELLUCID, DEVICE_TESTS = map(os.path.abspath, sys.argv[1:3])
EVERYTHING = str(pathlib.Path(__file__).parents[2] / "scenes/stability/everything.json")
# Method and scene: together they hold every pass and most lobes and lights.
RUNS = [("path", "gallery"), ("nee", "four-balls-sun"), ("reference", "four-balls-background"),
        ("naive", "cornell-box"), ("light", "cornell-box"), ("bdpt", "four-balls-background"),
        ("bdpt", "textures", "--vertices", "compact", "--aov", "length,tech,light-vertices"),
        ("sppm", "four-balls-ceiling", "--aov", "tech,photons,cells,radius"), ("vcm", "textures", "--vertices", "compact"),
        ("sppm", "cornell-box", "--radius", "40", "--radius-alpha", "0.6"), ("bpm", "cornell-box", "--radius", "40"),
        ("path", "materials", "--aov", "Z,P,N,albedo,id.material")]
# What no render runs, by the test of the device that does.
PROBES = {"probe_layout": "DeviceTest.LayoutsAgree", "probe_math": "DeviceTest.ArithmeticIsExactEnough",
          "trace_closest trace_any": "DeviceTest.ListsOfRaysAreTraced", "probe_grid": "GridTest.FewPhotons",
          "probe_frame probe_walk": "DeviceTest.FramesAndWalks", "probe_splat": "SplatTest.WhatCannotBeAddedIsCounted", "probe_layers": "LayersTest.WhatIsOutsideTheTileIsLeftOut"}
failures = []
passes = {name for names in PROBES for name in names.split()}


def check(what, command):
    done = subprocess.run(["oclgrind", "--data-races", "--max-errors", "5", *command],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=dict(os.environ, PELLUCID_DEVICE=""))
    if done.returncode or any(word in done.stdout for word in ("Invalid", "data race", "error:")):
        failures.append(what)
        print(f"{what}: exit {done.returncode}\n{done.stdout[:4000]}")


with tempfile.TemporaryDirectory() as folder:
    for method, scene, *options in RUNS:
        check(f"{method} {scene}",
              [PELLUCID, "render", scene, "-i", method, "--spp", "1", "--size", "8x8", "--max-depth", "5",
               "--device", "Oclgrind", "--strict", "-o", f"{folder}/{scene}.exr", "--stats", f"{folder}/stats.json",
               *options])
        stats = json.loads(pathlib.Path(folder, "stats.json").read_text())
        passes |= {one["name"] for one in stats["passes"]} | ({"aov"} if "albedo" in "".join(options) else set())
    # Code for effects that the scene lacks must not run astray; a scene without light has no light to pick.
    dark = pathlib.Path(folder, "dark.json")
    dark.write_text(json.dumps({
        "version": 1, "camera": {"origin": [0, 0, 3], "target": [0, 0, 0]},
        "materials": {"m": {"type": "diffuse"}},
        "shapes": [{"type": "sphere", "material": "m"}]}))
    for scene in (str(dark), EVERYTHING):
        check(f"all features {scene}",
              [PELLUCID, "render", scene, "--features", "all", "--spp", "1", "--size", "8x8",
               "--max-depth", "4", "--device", "Oclgrind", "-o", f"{folder}/all.exr"])
check("replay", [PELLUCID, "render", "four-balls-ceiling", "-i", "vcm", "--size", "8x8", "--max-depth", "5",
                 "--device", "Oclgrind", "--replay", "3,4,0"])
for names, test in PROBES.items():
    check(names, [DEVICE_TESTS, f"--gtest_filter={test}"])
kernels = {path.stem for path in pathlib.Path(__file__).parents[2].joinpath("kernels/passes").glob("*.cl")}
if passes != kernels:
    failures.append("every pass")
    print(f"passes that no run has, or that there are not: {sorted(passes ^ kernels)}")
print(f"{len(RUNS) + 3 + len(PROBES)} runs, {len(failures)} with findings")
sys.exit(bool(failures))
