#!/usr/bin/env python3
"""What --max-depth cuts off: told, never an error, and kept by images, checkpoints, --resume and merge.

Usage: cuts_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import check, document, expect, run_tests

TOLD = "--max-depth cut off throughput"
CAPPED = ["room.json", "--max-depth", "2", "--deterministic"]


def picture(name):
    return document(["info", name])["metadata"]


def test_told_where_paths_are_cut():
    _, err = expect(0, [*CAPPED, "--spp", "16", "--strict", "-o", "cut.exr", "--stats", "cut.json"], TOLD)
    stats = document([*CAPPED, "--spp", "16", "--strict", "-o", "cut.exr"])
    share = stats["depth_cut"]["camera"]
    check(list(stats["depth_cut"]) == ["camera"], "`path` walks from the camera alone", stats["depth_cut"])
    check(0 < share < 0.5, "walls reflect half", share)
    check(f"camera paths {share:.4g} in the mean" in err, "the end of the render has it", err)
    check(picture("cut.exr")["pellucid:depthCut"] == f"camera paths {share:.4g}", "the image has it")
    check("warning" not in err, "and warns of nothing", err)
    both = document([*CAPPED, "--spp", "16", "-i", "bdpt", "-o", "both.exr"])["depth_cut"]
    check(set(both) == {"camera", "light"} and both["light"] > 0, "light paths are cut, too", both)


def test_nothing_told_where_none_is():
    _, err = expect(0, ["room.json", "--spp", "4", "-o", "free.exr"])
    stats = document(["room.json", "--spp", "4", "-o", "free.exr"])
    check(stats["depth_cut"] == {} and TOLD not in err, "no cap, no share", stats["depth_cut"], err)
    check("pellucid:depthCut" not in picture("free.exr"), "nor in the image")
    _, err = expect(0, ["plane-sky", "--spp", "4", "--max-depth", "3", "-o", "sky.exr"])
    check(TOLD not in err, "paths that end by themselves", err)
    check(picture("sky.exr")["pellucid:depthCut"] == "camera paths 0", "which the image knows")


def test_closed_form():
    """Between walls of albedo 0.8, nine bounces leave 0.8^9; of 65536 paths that is known to 0.0013."""
    stats = document(["furnace", "-D", "materials.wall.reflectance=0.8", "--max-depth", "9", "--spp", "256",
                      "--size", "16x16", "--sampler", "random", "-o", "furnace.exr"])
    check(abs(stats["depth_cut"]["camera"] - 0.8 ** 9) < 4.5 * 0.0013, "0.8^9", stats["depth_cut"])


def test_resumed_and_merged():
    for method in ("path", "vcm"):
        same = [*CAPPED, "-i", method]
        whole = document([*same, "--spp", "41", "-o", "whole.exr"])["depth_cut"]
        check(all(share > 0 for share in whole.values()), "something is cut", whole)
        for spp in (7, 20, 41):
            resumed = document([*same, "--spp", str(spp), "--checkpoint", f"{method}.ckpt", "--resume",
                                "-o", "resumed.exr"])["depth_cut"]
        check(resumed == whole, f"{method}: resumed twice", resumed, whole)
        for i, passes in enumerate(("20:41", "0:20")):
            expect(0, [*same, "--passes", passes, "--checkpoint", f"{method}{i}.ckpt", "-o", "part.exr"])
        expect(0, ["merge", f"{method}0.ckpt", f"{method}1.ckpt", "-o", f"{method}all.ckpt", "-o", "merged.exr",
                   "--deterministic"])
        told = picture("whole.exr")["pellucid:depthCut"]
        for name in ("resumed.exr", "merged.exr"):
            check(picture(name)["pellucid:depthCut"] == told, f"{method}: {name} tells the same", picture(name))
        for name in (f"{method}.ckpt", f"{method}all.ckpt"):
            check(document(["info", name])["depth_cut"] == whole, f"{method}: {name} has the sums")
            out, _ = expect(0, ["info", name])
            check(f"cut off   {told}" in out, "and shows them", out)


run_tests(globals())
