#!/usr/bin/env python3
"""--dry-run, --threads, --exposure and --tonemap; info on images.

Usage: plan_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import subprocess
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import (PELLUCID, QUICK, SOURCE, check, document, expect, read_bytes, run, run_tests,
                     temporaries, write_text)


def test_dry_run():
    before = set(os.listdir("."))
    empty = dict(os.environ, POCL_CACHE_DIR=os.path.abspath("empty"))
    os.mkdir("empty")
    out, _ = expect(0, ["room.json", "--dry-run", "--spp", "9", "-i", "nee", "--seed", "3",
                        "-o", "a.exr", "-o", "b.png"], env=empty)
    for word in ("room", "nee", "9 spp", "32x16", "seed 3", "0:0", "spheres", "pt_mega", "film",
                 "a.exr", "b.png", " of at most "):
        check(word in out, f"the plan tells {word}", out)
    plan = document(["room.json", "--dry-run", "--time", "60s", "--max-depth", "5"])
    check((plan["time"], plan["spp"], plan["max_depth"]) == (60, None, 5), "budget", plan)
    check(plan["outputs"] == ["room.exr", "room.png"] and plan["dry_run"] is True, "outputs", plan)
    check(plan["features"]["spheres"] and not plan["features"]["mirror"], "features", plan)
    check(plan["kernels"] == ["pt_mega", "film_add"], "kernels", plan)
    check(plan["memory_total"] == sum(plan["memory_bytes"].values()), "memory", plan)
    check(plan["device_limits"]["memory_bytes"] > plan["memory_total"], "limits", plan)
    check(set(os.listdir(".")) - before <= {"pocl", "empty"}, "nothing is written", os.listdir("."))
    cached = [name for _, _, names in os.walk("empty") for name in names if name.endswith(".so")]
    check(not cached, "no kernel is built", cached)
    stats = document([*QUICK, "-o", "a.exr"])
    same = ("scene", "scene_hash", "integrator", "width", "height", "seed", "device", "driver",
            "features", "memory_bytes")
    real = document(["room.json", "--spp", "4", "--dry-run", "-o", "a.exr"])
    for key in same:
        check(real[key] == stats[key], f"the render agrees about {key}", real[key], stats[key])


def test_dry_run_fails_like_the_render():
    cases = ((2, ["--aov", "x"]), (2, ["-o", "x.doc"]), (2, ["-i", "magic"]), (2, ["--mis", "x"]),
             (3, ["-D", "camera.fov=-1"]), (3, ["--kernel-dir", "none"]),
             (4, ["--device", "voodoo"]), (4, ["--size", "16384x16384"]),
             (5, ["-o", "none/x.exr"]), (5, ["--stats", "none/x.json"]))
    for code, options in cases:
        _, dry = expect(code, ["room.json", "--dry-run", *options])
        _, real = expect(code, ["room.json", "--spp", "1", *options])
        check(dry == real, f"the same message for {options}", dry, real)
    check(not temporaries(), "nothing is left")


def test_threads():
    for count in (1, 2, 3):
        units = document(["info", "room.json", "--threads", str(count)])["device_limits"]
        check(units["compute_units"] == count, f"the driver keeps to {count}", units)
    expect(0, QUICK)  # builds the kernels, so that only work counts below
    # A single worker cannot use more processor time than passes, whatever else the machine does.
    usage = "import resource,subprocess,sys;subprocess.run(sys.argv[1:],check=True);" \
            "r=resource.getrusage(resource.RUSAGE_CHILDREN);print(r.ru_utime)"
    options = ["room.json", "--time", "3s", "-q", "--threads", "1", "-o", "t.exr", "--json", "t.json"]
    done = subprocess.run([sys.executable, "-c", usage, PELLUCID, *options], text=True,
                          capture_output=True, check=True, timeout=60)
    with open("t.json", encoding="utf-8") as file:
        total = json.load(file)["seconds"]["total"]
    user = float(done.stdout.split()[-1])
    check(user < 1.25 * total, "one thread's worth of time", user, total)
    images = []
    for count in ("1", "2"):
        expect(0, [*QUICK, "--threads", count, "--deterministic", "-o", f"t{count}.exr"])
        images.append(read_bytes(f"t{count}.exr"))
    check(images[0] == images[1], "the same bytes")
    for bad in ("0", "-1", "x", "1.5", "1025", ""):
        expect(2, ["room.json", "--threads", bad], "--threads")
    variables = dict(os.environ, POCL_MAX_PTHREAD_COUNT="3", POCL_CPU_MAX_CU_COUNT="3")
    out, _ = expect(0, ["info", "room.json", "--threads", "2", "--json", "-"], env=variables)
    check(json.loads(out)["device_limits"]["compute_units"] == 2, "the flag wins")
    _, _, err = run("bench", "--threads", "0")
    check("--threads" in err and "no option" not in err, "bench has it, too", err)


def pixel(*options):
    """The first pixel of a scene of one radiance as a display picture."""
    expect(0, ["flat.json", "--spp", "1", "-q", *options, "-o", "flat.ppm", "-o", "flat.exr"])
    return tuple(read_bytes("flat.ppm")[-3:])


def test_exposure_and_tonemap():
    write_text("flat.json", json.dumps({
        "version": 1, "camera": {"origin": [0, 0, 5], "target": [0, 0, 0]},
        "film": {"width": 4, "height": 4},
        "lights": [{"type": "environment", "radiance": [0.2, 1.5, 0.01]}]}))
    # 255 times the curve, rounded: sRGB(0.2) = 0.4845; 2^1 0.2 = 0.4; filmic(0.2) = 0.2968, and so on.
    for options, want in (([], (124, 255, 25)), (["--exposure", "1"], (170, 255, 39)),
                          (["--exposure", "-1.5"], (75, 193, 12)),
                          (["--exposure=-.5"], (105, 255, 20)),
                          (["--tonemap", "none"], (51, 255, 3)),
                          (["--tonemap", "none", "--exposure", "2"], (204, 255, 10)),
                          (["--tonemap", "filmic"], (149, 241, 12)),
                          (["--tonemap", "filmic", "--exposure", "2"], (225, 254, 49))):
        got = pixel(*options)
        check(all(abs(a - b) <= 1 for a, b in zip(got, want)), f"{options}: {got}, not {want}")
        expect(0, ["compare", "flat.exr", "plain.exr" if options else "flat.exr",
                   "--fail-above", "mse=0"])
        if not options:
            os.rename("flat.exr", "plain.exr")
    meta = document(["info", "flat.exr"])["metadata"]
    check(not any("filmic" in str(value) for value in meta.values()), "stored nowhere else", meta)
    check(meta["pellucid:sceneHash"] ==
          document(["info", "plain.exr"])["metadata"]["pellucid:sceneHash"], "the same scene")
    for bad in (["--exposure", "x"], ["--exposure", "1e9"], ["--exposure", "nan"],
                ["--tonemap", "film"]):
        expect(2, ["flat.json", *bad], bad[0])
    expect(2, ["flat.json", "--tonemap", "filmc"], "Did you mean 'filmic'?")


def test_linear_pictures_say_so():
    expect(0, ["flat.json", "--spp", "1", "-q", "--exposure", "-1", "-o", "a.png"])
    expect(0, ["flat.json", "--spp", "1", "-q", "--exposure", "-1", "--tonemap", "none",
               "-o", "b.png"])
    compared = document(["compare", "b.png", "a.png"])
    # Both mean 0.1, 0.75 and 0.005; 8 bits hold 0.005 but roughly.
    check(compared["rmse"] < 0.003, "readers undo the curve of the one, not of the other", compared)


def test_info_of_images():
    statistics = document(["info", "plain.exr"])["statistics"]
    check(set(statistics) == {"R", "G", "B"}, "channels", statistics)
    for name, value in (("R", 0.2), ("G", 1.5), ("B", 0.01)):
        one = statistics[name]
        for key in ("min", "mean", "max"):
            check(abs(one[key] - value) < 1e-6 * value, f"{key} of {name}", one)
        check(one["nonfinite"] == 0, "finite", one)
    out, _ = expect(0, ["info", "plain.exr"])
    for word in ("4x4", "min", "mean", "max", "non-finite", "samplesPerPixel"):
        check(word in out, f"info tells {word}", out)


def test_info_of_scenes():
    out, _ = expect(0, ["info", "cornell-box"])
    for word in ("measured Cornell box", "hash ", "cornell-box.mtl", "8 mesh", "4 diffuse",
                 "1 mesh (2 to choose from)", "largest buffer", "of at most", "128 spp"):
        check(word in out, f"info tells {word}", out)
    flat = {"type": "mesh", "material": "m", "file": "flat.obj"}
    write_text("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n")
    write_text("warns.json", json.dumps({
        "version": 1, "camera": {"origin": [0, 0, 5], "target": [0, 0, 0]},
        "materials": {"m": {"type": "mirror"}}, "shapes": [flat]}))
    info = document(["info", "warns.json"])
    check(len(info["warnings"]) == 2, "warnings", info["warnings"])
    check(info["material_kinds"] == {"mirror": 1} and info["light_kinds"] == {}, "kinds", info)
    check(sorted(os.path.basename(name) for name in info["files"]) == ["flat.obj", "warns.json"],
          "files", info["files"])
    gallery = document(["info", os.path.join(SOURCE, "scenes/gallery/gallery.json")])
    check(gallery["bvh"]["nodes"] > 1000 and gallery["device_limits"]["max_buffer_bytes"] > 0,
          "BVH and limits", gallery["bvh"])


run_tests(globals())
