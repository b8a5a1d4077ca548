#!/usr/bin/env python3
"""The black box as users meet it: --fireflies names samples, --replay traces them again.

Usage: replay_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import HEIGHT, QUICK, WIDTH, check, document, expect, run_tests

SAME = ["room.json", "--quiet", "--seed", "5"]


def test_fireflies():
    for method in ("path", "light", "vcm"):
        out, _ = expect(0, [*SAME, "--spp", "8", "-i", method, "--fireflies", "3", "-o", "f.exr",
                            "--json", "f.json"])
        rows = [line for line in out.splitlines() if line.startswith("|")]
        check("f.exr" in out and len(rows) == 5, "a table of three below the picture's name", out)
        with open("f.json", encoding="utf-8") as file:
            flies = json.load(file)["fireflies"]
        check(len(flies) == 3, "three in the document", flies)
        for fly in flies:
            check(fly["replay"] in out, "named as --replay takes it", out)
            check(fly["adds_up"] and fly["brought"] and fly["eye_path"], "whole", fly)
            check(abs(sum(part["share"] for part in fly["brought"]) - 1) < 1e-4, "shares", fly)
            again = document([*SAME, "-i", method, "--replay", fly["replay"]])
            for key in ("sample", "luminance", "brought", "eye_path", "light_path", "adds_up"):
                check(again[key] == fly[key], f"{method}: --replay finds the same {key}", again)
            check(again["integrator"] == method and again["seed"] == 5, "what it is of", again)


def test_checkpoints_remember():
    """Half of the passes from a checkpoint: the same list."""
    more = ["--spp", "8", "--fireflies", "3", "-o", "f.exr"]
    whole, _ = expect(0, [*SAME, *more])
    expect(0, [*SAME, "--passes", "0:4", "--checkpoint", "half.exr", "-o", "h.exr"])
    halves, _ = expect(0, [*SAME, *more, "--checkpoint", "half.exr", "--resume"])
    check(whole == halves, "as if in one go", whole, halves)


def test_replay_text():
    out, _ = expect(0, [*SAME, "-i", "bdpt", "--replay", "10,10,2"])
    for part in ("pixel 10,10 in pass 2", "bit for bit", "eye path", "(camera)", "dVCM"):
        check(part in out, f"says {part}", out)
    # Another pass is another sample, and the crop of a render has the samples of the whole.
    check(out != expect(0, [*SAME, "-i", "bdpt", "--replay", "10,10,3"])[0], "another pass")
    check(out == expect(0, [*SAME, "-i", "bdpt", "--crop", "8,12,8,12", "--replay", "10,10,2"])[0],
          "a crop")


def test_refusals():
    for place in ("1,2", "1,2,3,4", "-1,2,3", "a,2,3", "1,2,4294967296", f"{WIDTH},0,0",
                  f"0,{HEIGHT},0"):
        _, err = expect(2, ["room.json", f"--replay={place}"])
        check("--replay" in err, f"names the option for {place}", err)
    for more in (["-o", "a.exr"], ["--stats", "s.json"], ["--fireflies", "2"], ["--aov", "Z"],
                 ["--checkpoint", "c.exr"], ["--atlas", "a.png"], ["--dry-run"]):
        _, err = expect(2, ["room.json", "--replay", "1,2,3", *more])
        check("--replay renders no picture" in err, f"{more} has no effect", err)
    expect(2, [*QUICK, "--fireflies", "0"])
    expect(2, [*QUICK, "--fireflies", "1001"])


run_tests(globals())
