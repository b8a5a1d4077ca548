#!/usr/bin/env python3
"""`pellucid compare --explain` names faults that are planted in a Cornell box, and nothing where there is none.

The other picture keeps its layers by path length, or is stripped of them and of what it tells of itself, as if
from another program (stored as half floats, as those often are). Seeds differ, so that noise hides what it can.
Usage: explain_test.py path/to/pellucid   (exit 0: all checks hold)
Needs oiiotool from the package openimageio-tools.
"""
import json
import os
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import QUICK, SOURCE, check, document, expect, run_tests, write_text

LAYERS = ["--aov", "length", "--aov-length", "14"]
# Enough for light beyond 10 segments, 0.3 % of the energy, to show in the sum of all lengths.
MANY, SOME = "4096", "256"


def wall(material, corner, *edges):
    return {"type": "rectangle", "material": material, "corner": corner, "edges": list(edges)}


def block(size, centre, degrees):
    return {"type": "cube", "material": "white", "size": size,
            "transform": [{"rotate": {"axis": [0, 1, 0], "degrees": degrees}}, {"translate": centre}]}


def cornell(albedo=1.0, sides=1):
    """Cornell's box with its lamp hung 30 cm below the ceiling, so that its back has something to light."""
    colours = {"white": [0.8, 0.75, 0.7], "red": [0.6, 0.05, 0.05], "green": [0.1, 0.45, 0.1],
               "lamp": [0.78, 0.78, 0.78]}
    lamp = wall("lamp", [2.1, 5.2, 2.3], [1.3, 0, 0], [0, 0, 1.05])
    lamp["emission"] = {"radiance": [18.4, 11, 2.75], "sides": sides}
    return {
        "version": 1,
        "camera": {"origin": [2.78, 2.73, -8], "target": [2.78, 2.73, 0], "fov": 39.3},
        "film": {"width": 64, "height": 64},
        "materials": {name: {"type": "diffuse", "reflectance": [albedo * v for v in value]}
                      for name, value in colours.items()},
        "shapes": [
            wall("white", [0, 0, 0], [0, 0, 5.6], [5.6, 0, 0]),
            wall("white", [0, 5.5, 0], [5.6, 0, 0], [0, 0, 5.6]),
            wall("white", [0, 0, 5.6], [0, 5.5, 0], [5.6, 0, 0]),
            wall("red", [5.6, 0, 0], [0, 5.5, 0], [0, 0, 5.6]),
            wall("green", [0, 0, 0], [0, 0, 5.6], [0, 5.5, 0]),
            block([1.65, 1.65, 1.65], [1.85, 0.825, 1.7], 17),
            block([1.65, 3.3, 1.65], [3.7, 1.65, 3.5], -17),
            lamp]}


def render(name, scene, *options, seed="2", samples=SOME):
    expect(0, ["render", scene, "-q", *LAYERS, "--seed", seed, "--spp", samples, "-o", name, *options])


def strip(name, bare):
    done = subprocess.run(["oiiotool", name, "--ch", "R,G,B", "--eraseattrib", "pellucid:.*", "--eraseattrib",
                           "samplesPerPixel", "-d", "half", "-o", bare], capture_output=True, text=True, check=False)
    check(done.returncode == 0, f"oiiotool strips {name}", done.stdout, done.stderr)
    check(document(["info", bare])["channels"] == ["R", "G", "B"], "nothing is left of the layers")


def explain(a, b):
    return document(["compare", a, b, "--explain"])["explain"]


def clamping_kernels():
    """pellucid does not clamp, so the fault goes into a copy of its kernels: no more than 10 of any path."""
    shutil.copytree(os.path.join(SOURCE, "kernels"), "clamping")
    place = "clamping/transport/path.h"
    with open(place, encoding="utf-8") as file:
        text = file.read()
    gather = "  real3 brought = found.value * mis_counted(scene, found.weight);\n"
    check(text.count(gather) == 1, "the place to clamp is where it was", text)
    cut = ", ".join(f"r_min(found.value.{axis} * found.weight, REAL(10.0))" for axis in "xyz")
    write_text(place, text.replace(gather, f"  found.value = REAL3({cut});\n  found.weight = REAL(1.0);\n" + gather))


def judge(name, cause, figure=None, low=0.0, high=0.0):
    """The cause is named from layers and without them."""
    strip(name, "bare.exr")
    for other in (name, "bare.exr"):
        found = explain("a.exr", other)
        check(found["finding"] in ("cause", "several") and found["cause"] == cause,
              f"{name} as {other}: {cause} is named", json.dumps(found, indent=1))
        check(found["by_regression"] == (other == "bare.exr"), "layers are used where there are some", other)
        value = found["causes"][0]["figures"].get(figure)
        if figure and found["cause"] == cause:
            check(low <= value <= high, f"{name} as {other}: {figure} {value}", found["words"])


def test_planted_faults():
    for name, scene in (("box", cornell()), ("albedo", cornell(albedo=1.02)), ("sides", cornell(sides=2))):
        write_text(name + ".json", json.dumps(scene))
    render("a.exr", "box.json", seed="1", samples=MANY)
    render("albedo.exr", "albedo.json")
    judge("albedo.exr", "albedo", "per_bounce", 1.017, 1.023)
    render("cap.exr", "box.json", "--max-depth", "10", samples=MANY)
    judge("cap.exr", "depth-cap", "max_depth", 10, 10)
    render("sides.exr", "sides.json")
    judge("sides.exr", "sidedness", "distance_to_lights", 0, 0.5)
    clamping_kernels()
    render("clamp.exr", "box.json", "--kernel-dir", "clamping")
    judge("clamp.exr", "clamp", "clamp", 9, 10.5)
    render("tent.exr", "box.json", "--filter", "box")
    judge("tent.exr", "filter", "variance_pixels2", -0.2, -0.05)
    render("light.exr", "box.json", "-D", "shapes.7.emission.radiance=[19.32, 11.55, 2.8875]")
    judge("light.exr", "exposure", "factor", 1.04, 1.06)


def test_no_fault():
    for seed in ("2", "3"):
        render("null.exr", "box.json", seed=seed)
        strip("null.exr", "bare.exr")
        for other in ("null.exr", "bare.exr"):
            found = explain("a.exr", other)
            check(found["finding"] == "none" and found["cause"] is None, f"seed {seed} as {other}: no difference",
                  json.dumps(found, indent=1))
            check(0 < found["detectable"] < 0.02, "and what would have shown", found["detectable"])
    found = explain("a.exr", "a.exr")
    check(found["finding"] == "none", "a picture is itself", found)


def test_what_is_told():
    out, _ = expect(0, ["compare", "a.exr", "cap.exr", "--explain"])
    for part in ("B has no light from paths of more than 10 segments", "a depth cap",
                 "Next: render A with --max-depth 10", "15 and longer", "depth-cap",
                 "'cap.exr' was rendered with --max-depth 10"):
        check(part in " ".join(out.split()), f"text tells {part!r}", out)
    # Whichever has layers is the one that is known.
    strip("a.exr", "bare.exr")
    found = explain("bare.exr", "sides.exr")
    check((found["known"], found["other"], found["by_regression"]) == ("B", "A", True), "B is known", found)
    check(found["cause"] == "sidedness" and "B has light straight from a lamp" in found["words"], "the other way", found)
    lengths = {row["name"]: row for row in explain("a.exr", "albedo.exr")["lengths"]}
    for length in (1, 2, 3, 4):
        row = lengths[str(length)]
        for ratio, error in zip(row["ratio"], row["error"]):
            # Five standard errors; those of the shortest lengths are told to no less than a thousandth.
            check(abs(ratio - 1.02 ** (length - 1)) < 5 * error + 1e-3, f"length {length}: {ratio}", row)
    gated = document(["compare", "a.exr", "a.exr", "--explain", "--fail-above", "mse=0"])
    check(gated["gates"][0]["holds"] and gated["explain"]["finding"] == "none", "gates are as ever", gated)


def test_strategies():
    both = [*QUICK, "--aov", "length,tech"]
    for seed, name in (("1", "s1.exr"), ("2", "s2.exr")):
        expect(0, ["render", *both, "--seed", seed, "-o", name])
    found = explain("s1.exr", "s2.exr")
    names = [row["name"] for row in found["strategies"]]
    check(names[:3] == ["tech.s0t2", "tech.s0t3", "tech.s1t2"] and "tech.rest" in names, "strategies", names)
    out, _ = expect(0, ["compare", "s1.exr", "s2.exr", "--explain"])
    check("tech.s1t2" in out and "unweighted" not in out, "weighted ones add up", out)
    expect(0, ["render", *QUICK, "-i", "bdpt", "--aov", "length", "-o", "bdpt.exr"])
    out, _ = expect(0, ["compare", "s1.exr", "bdpt.exr", "--explain"])
    check("depend on each other" in out and "settings that differ" in " ".join(out.split()), "notes", out)


def test_usage():
    expect(0, ["render", *QUICK, "-o", "plain.exr"])
    expect(2, ["compare", "plain.exr", "plain.exr", "--explain"], "--explain", "plain.exr", "--aov length")
    subprocess.run(["oiiotool", "s1.exr", "--mulc", "1.5,1,1" + ",1" * 60, "-o", "odd.exr"], check=False,
                   capture_output=True)
    expect(3, ["compare", "odd.exr", "plain.exr", "--explain"], "--explain", "odd.exr", "add up")
    found = explain("s1.exr", "odd.exr")
    check(found["by_regression"] and any("left aside" in note for note in found["notes"]), "told", found["notes"])
    subprocess.run(["oiiotool", "s1.exr", "--sattrib", "pellucid:settings", "max-depth 9" + "9" * 30, "-o", "odd.exr"],
                   check=False, capture_output=True)
    check(any("--max-depth 999" in note for note in explain("s2.exr", "odd.exr")["notes"]), "odd settings")
    subprocess.run(["oiiotool", "s1.exr", "--crop", "12x12+4+2", "--fullpixels", "-o", "small.exr"], check=False,
                   capture_output=True)
    expect(3, ["compare", "small.exr", "small.exr", "--explain"], "small.exr", "12x12", "16x16")
    subprocess.run(["oiiotool", "plain.exr", "--ch", "G", "-o", "grey.exr"], check=False, capture_output=True)
    expect(3, ["compare", "grey.exr", "grey.exr", "--explain"], "grey.exr", "R, G and B")
    expect(3, ["compare", "s1.exr", "a.exr", "--explain"], "sizes differ")
    subprocess.run(["oiiotool", "s1.exr", "--mulc", "inf", "-o", "inf.exr"], check=False, capture_output=True)
    out, _ = expect(1, ["compare", "inf.exr", "s1.exr", "--explain"])
    check("explain" not in out and "FAILS" in out, "nothing is explained of what is not finite", out)


run_tests(globals())
