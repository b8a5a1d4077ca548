#!/usr/bin/env python3
"""`pellucid compare --ztest` on renders: what is equal, what is not, what cannot be told.

Usage: ztest_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import ROOM, check, expect, read_json, run, run_tests, write_text

# Seeds are fixed, so what is found here is found always. The room is dim but for its lamp, whose pixels
# have little noise: limits of 2 % and 50 % are reached with 256 samples in 512 pixels.
LIMITS = ["--ztest-image", "2%", "--ztest-tile", "50%"]


def render(name, seed, *options, scene="room.json"):
    expect(0, ["render", scene, "--quiet", "--aov", "variance", "--seed", str(seed), "-o", name,
               *(options or ("--spp", "256"))])


def test_verdicts():
    render("a.exr", 1)
    render("b.exr", 2, "--spp", "256", "-i", "nee")
    code, out, err = run("compare", "a.exr", "b.exr", "--ztest", *LIMITS, "--json", "z.json")
    check(code == 0 and "EQUAL" in out, "two methods of one scene are equal", out, err)
    found = read_json("z.json")["ztest"]
    check(found["verdict"] == "EQUAL" and abs(found["image_z"]) < found["image_threshold"]
          and abs(found["worst_tile_z"]) < found["threshold"], "JSON says so too", found)
    check(0 < found["detectable_image"] < 0.02 and 0 < found["detectable_tile"] < 0.5
          and found["tiles"] == found["tiles_judged"] == 2, "and how sure it is", found)
    out, _ = expect(1, ["compare", "a.exr", "b.exr", "--ztest", *LIMITS[2:], "--ztest-image", "0.01%"])
    check("INCONCLUSIVE" in out and "could hide" in out, "noise is no excuse", out)
    out, _ = expect(0, ["compare", "a.exr", "a.exr", "--ztest"])
    check("EQUAL: identical" in out, "the same bits need no statistics", out)
    brighter = json.loads(json.dumps(ROOM))
    brighter["lights"][0]["radiance"] = 0.21
    write_text("brighter.json", json.dumps(brighter))
    render("c.exr", 3, scene="brighter.json")
    out, _ = expect(1, ["compare", "c.exr", "b.exr", "--ztest", *LIMITS])
    check("DIFFERENT" in out, "a light 5 % brighter is seen", out)
    expect(0, ["compare", "c.exr", "b.exr", "--map", "z", "-o", "z.png"])


def test_dependent_pixels():
    """Splats and photons reach many pixels: one run says little, several say more."""
    render("b.exr", 2)
    names = [f"light{k}.exr" for k in range(12)]
    for k, name in enumerate(names):
        render(name, 10 + k, "--spp", "64", "-i", "bdpt")
    out, _ = expect(1, ["compare", names[0], "b.exr", "--ztest", *LIMITS])
    check("INCONCLUSIVE" in out and "--with" in out, "the remedy is named", out)
    # Twelve runs have eleven degrees of freedom: thresholds are high, and limits have to be.
    pair = ["compare", names[0], "b.exr", "--with", *names[1:], "--ztest", "--ztest-image", "10%",
            "--ztest-tile", "90%"]
    out, _ = expect(0, pair)
    check("EQUAL" in out and "of 12 runs" in out, "several runs are enough", out)


def test_what_is_needed():
    render("a.exr", 1)
    expect(0, ["render", "room.json", "--quiet", "--spp", "32", "-o", "silent.exr"])
    for pair in (["silent.exr", "a.exr"], ["a.exr", "silent.exr"]):
        expect(2, ["compare", *pair, "--ztest"], "silent.exr", "--aov variance")
    render("few.exr", 2, "--spp", "16")
    expect(3, ["compare", "few.exr", "a.exr", "--ztest"], "few.exr", "32 samples", "--sampler random")
    render("short.exr", 3, "--spp", "32")
    render("same.exr", 1, "--spp", "512")
    expect(3, ["compare", "a.exr", "short.exr", "--with", "same.exr"], "a.exr", "same.exr", "--seed")
    render("other.exr", 4, "--spp", "512")
    expect(3, ["compare", "a.exr", "short.exr", "--with", "other.exr", "--ztest"], "same length")


run_tests(dict(globals()))
