#!/usr/bin/env python3
"""Layers as users meet them: --aov length and tech, --aov-length, --atlas, with checkpoints and merge.

Usage: layers_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import os
import resource
import signal
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import (HEIGHT, QUICK, WIDTH, Terminal, check, document, expect, read_bytes, run_tests,
                     same_pixels)

SAME = ["room.json", "--quiet", "--deterministic", "--aov", "length,tech", "--aov-length", "3"]


def colours(*names):
    return [f"{name}.{channel}" for name in names for channel in "RGB"]


def strategies(*names):
    return colours(*[layer for name in names for layer in (name, name + ".unweighted")])


def means(name):
    statistics = document(["info", name])["statistics"]
    return {channel: one["mean"] for channel, one in statistics.items()}


def test_channels():
    expect(0, [*SAME, "--spp", "16", "-o", "layers.exr"])
    channels = document(["info", "layers.exr"])["channels"]
    # The room's method is `path`: s is 0 or 1.
    check(channels == ["R", "G", "B", *colours("length.1", "length.2", "length.3", "length.rest"),
                       *strategies("tech.s0t2", "tech.s0t3", "tech.s1t2", "tech.s0t4", "tech.s1t3"),
                       *colours("tech.rest")], "names of the contract", channels)
    mean = means("layers.exr")
    for prefix in ("length.", "tech."):
        total = sum(value for name, value in mean.items() if name.startswith(prefix)
                    and name.endswith(".G") and ".unweighted." not in name)
        check(abs(total - mean["G"]) < 1e-4 * mean["G"], f"{prefix} adds up", total, mean["G"])
    for name in colours("length.1", "length.2", "length.3", "length.rest"):
        check(mean[name] > 0, f"{name} has light", mean)
    expect(0, ["room.json", "--quiet", "--spp", "16", "-o", "plain.exr"])
    check(same_pixels("layers.exr", "plain.exr"), "layers change no colour")
    expect(0, [*QUICK, "--aov", "Z,length,variance", "-o", "order.exr"])
    channels = document(["info", "order.exr"])["channels"]
    check(channels == ["R", "G", "B", *colours("variance"),
                       *colours(*[f"length.{n}" for n in (1, 2, 3, 4, 5, "rest")]), "Z"],
          "five lengths unless told otherwise; order of --aov --help", channels)
    expect(0, [*QUICK, "-i", "naive", "--aov", "tech", "--aov-length", "2", "-o", "naive.exr"])
    check(document(["info", "naive.exr"])["channels"][3:] ==
          [*strategies("tech.s0t2", "tech.s0t3"), *colours("tech.rest")], "strategies of `naive`")


def test_both_ends():
    expect(0, ["room.json", "-q", "--spp", "8", "-i", "bdpt", "--aov", "tech,light-vertices",
               "--aov-length", "3", "-o", "both.exr"])
    names = ("tech.s0t2", "tech.s0t3", "tech.s1t2", "tech.s2t1", "tech.s0t4", "tech.s1t3",
             "tech.s2t2", "tech.s3t1")
    channels = document(["info", "both.exr"])["channels"]
    check(channels[3:] == [*strategies(*names), *colours("tech.rest"), "light.vertices"],
          "all of the pyramid", channels)
    mean = means("both.exr")
    for name in names:
        check(mean[name + ".G"] > 0, f"{name} brings something", mean)
    check(0.01 < mean["light.vertices"] < 10, "vertices per pixel and pass", mean)


def test_atlas():
    out, _ = expect(0, [*QUICK, "--atlas", "atlas.png", "-o", "a.exr"])
    check(out.split() == ["a.exr", "atlas.png"], "both are told", out)
    info = document(["info", "atlas.png"])
    # Two pyramids of two columns beside each other; five lengths and the rest below each other.
    check(info["width"] > 4 * WIDTH and info["height"] > 6 * HEIGHT, "a pyramid", info)
    check(max(info["statistics"][c]["max"] for c in "RGB") > 0.8, "something shows", info)
    check("tech.s1t2.R" in document(["info", "a.exr"])["channels"], "it implies --aov tech")
    expect(0, [*QUICK, "--atlas", "atlas.jpg", "--aov-length", "1", "-o", "a.png"])
    for bad in ("x", "x.exr", "x.doc"):
        expect(2, [*QUICK, "--atlas", bad, "-o", "a.png"], f"--atlas '{bad}'")
    expect(2, [*QUICK, "--atlas", "a.png", "-o", "./a.png"], "same file")
    expect(5, [*QUICK, "--atlas", "none/a.png"], "none/a.png")
    check(document([*QUICK, "--dry-run", "--atlas", "b.png"])["outputs"][-1] == "b.png", "planned")


def test_grid():
    """Photons, cells and radius: channels, the picture, and the same out of two halves."""
    grid = ["room.json", "-q", "--deterministic", "-i", "bpm", "--max-depth", "5",
            "--radius", "0.5"]
    expect(0, [*grid, "--spp", "6", "-o", "grid.exr", "--grid", "grid.png", "--atlas", "atlas.png"])
    channels = document(["info", "grid.exr"])["channels"]
    check(channels[-5:] == ["photons", "cells.photons", "cells.bucket", "cells.parity", "radius"],
          "--grid implies them", channels)
    mean = means("grid.exr")
    for name in channels[-5:]:
        check(mean[name] > 0, f"{name} shows something", mean)
    check(mean["cells.parity"] <= 2, "of pass 0 alone", mean)
    drawn = document(["info", "grid.png"])
    check(drawn["width"] > 5 * WIDTH and drawn["height"] > 15 * HEIGHT, "three pictures", drawn)
    halves = [*grid, "--aov", "photons,cells,radius,tech", "-o", "x.exr"]
    expect(0, [*halves, "--passes", "0:2", "--checkpoint", "a.ckpt"])
    expect(0, [*halves, "--passes", "2:6", "--checkpoint", "b.ckpt"])
    expect(0, ["merge", "b.ckpt", "a.ckpt", "-o", "halves.exr", "--grid", "halves.png", "--deterministic"])
    check(read_bytes("grid.exr") == read_bytes("halves.exr"), "merged is uninterrupted")
    check(read_bytes("grid.png") == read_bytes("halves.png"), "and so is the grid")
    for bad in ("a.ckpt", "halves.exr", "x.exr"):
        expect(2, ["merge", "a.ckpt", "b.ckpt", "-o", "halves.exr", "--grid", bad], "--grid")
    expect(0, [*grid, "--passes", "0:1", "--checkpoint", "gridless.ckpt", "-o", "x.exr"])
    expect(2, ["merge", "gridless.ckpt", "-o", "x.exr", "--grid", "x.png"], "--grid", "photons,cells,radius")


def test_usage():
    expect(2, [*QUICK, "--aov-length", "3"], "--aov-length", "--aov tech", "--atlas")
    expect(2, [*QUICK, "--aov-length", "3", "--aov", "Z"], "--aov-length")
    for bad in ("0", "31", "-1", "x", "1.5"):
        expect(2, [*QUICK, "--aov", "tech", "--aov-length", bad], "--aov-length")
    expect(2, [*QUICK, "--aov", "lenght"], "Did you mean 'length'?")
    expect(2, [*QUICK, "--aov", "light-vertices"], "'path' makes no light vertices",
           "light, bdpt")
    for method in ("path", "light", "bdpt"):
        for aov in ("photons", "cells", "radius"):
            expect(2, [*QUICK, "-i", method, "--aov", aov], f"--aov {aov}: '{method}'", "sppm", "vcm")
        expect(2, [*QUICK, "-i", method, "--grid", "g.png"], f"--grid: '{method}'", "sppm", "vcm")
    expect(2, [*QUICK, "-i", "vcm", "--grid", "g.exr"], "--grid 'g.exr'")
    expect(2, [*QUICK, "-i", "vcm", "--grid", "g.png", "--atlas", "./g.png"], "same file")


def test_memory():
    """24 bytes per layer and pixel; bands where the device has not room for all."""
    plan = document([*SAME, "--dry-run"])
    layers = 4 + 2 * 5 + 1
    check(plan["memory_bytes"]["layers"] == 24 * layers * WIDTH * HEIGHT, "planned", plan)
    check(plan["film_bytes"] == (192 + 24 * layers) * WIDTH * HEIGHT, "the host's share", plan)
    check(plan["features"]["layers"] is True, "a feature like any other", plan["features"])
    plain = document(["room.json", "--dry-run"])
    check("layers" not in plain["memory_bytes"] and not plain["features"]["layers"], "unless asked")
    fixed = sum(size for name, size in plan["memory_bytes"].items()
                if name not in ("layers", "film", "samples"))
    row = (192 + 16 + 24 * layers) * WIDTH
    expect(0, [*SAME, "--spp", "20", "-o", "whole.exr"])
    bands = document([*SAME, "--spp", "20", "--memory", str(fixed + 5 * row), "-o", "bands.exr"])
    check(bands["tiles"] == 4, "16 rows, 5 at a time", bands["tiles"])
    check(read_bytes("whole.exr") == read_bytes("bands.exr"), "the same to the last byte")


def test_checkpoints():
    expect(0, [*SAME, "--spp", "41", "-o", "whole.exr", "--atlas", "whole.png"])
    first = 0
    for i, last in enumerate((7, 20, 41)):
        expect(0, [*SAME, "--passes", f"{first}:{last}", "--checkpoint", f"{i}.ckpt", "-o", "x.exr"])
        first = last
    expect(0, ["merge", "1.ckpt", "0.ckpt", "2.ckpt", "-o", "merged.exr", "-o", "all.ckpt",
               "--atlas", "merged.png", "--deterministic"])
    check(read_bytes("whole.exr") == read_bytes("merged.exr"), "merged is uninterrupted")
    check(read_bytes("whole.png") == read_bytes("merged.png"), "and so is its atlas")
    expect(0, ["merge", "all.ckpt", "-o", "again.exr", "--deterministic"])
    check(read_bytes("whole.exr") == read_bytes("again.exr"), "through a merged checkpoint")
    expect(0, [*SAME, "--spp", "41", "--checkpoint", "1.ckpt", "--resume", "-o", "on.exr"])
    check(read_bytes("whole.exr") == read_bytes("on.exr"), "resumed")
    check(document(["info", "all.ckpt"])["identity"]["layers"] == "length tech to length 3, s to 1",
          "a checkpoint knows its layers")
    plain = ["room.json", "-q", "--deterministic"]
    expect(3, [*plain, "--spp", "50", "--checkpoint", "1.ckpt", "--resume"],
           "layers is length tech to length 3")
    expect(0, [*plain, "--passes", "41:42", "--checkpoint", "bare.ckpt", "-o", "x.exr"])
    expect(3, ["merge", "all.ckpt", "bare.ckpt", "-o", "x.exr"], "layers is")
    expect(2, ["merge", "bare.ckpt", "-o", "x.exr", "--atlas", "x.png"], "--atlas", "--aov tech")
    expect(2, ["merge", "bare.ckpt", "-o", "x.png", "--atlas", "x.png"], "overwrite")


def test_full_disk():
    """A picture that cannot be written takes no atlas with it."""
    going = Terminal("room.json", "--spp", "1000000000", "--aov-length", "9", "--aov", "length",
                     "--atlas", "kept.png", "-o", "lost.exr")
    going.wait_for("path on 0:0.* pass")
    going.signal(signal.SIGUSR1)
    going.wait_for("the image so far is written")
    sizes = [os.path.getsize(name) for name in ("kept.png", "lost.exr")]
    check(2 * sizes[0] < sizes[1], "there is room for a limit between the two", sizes)
    for name in ("kept.png", "lost.exr"):
        os.remove(name)
    resource.prlimit(going.process.pid, resource.RLIMIT_FSIZE, (sizes[1] // 2, sizes[1] // 2))
    going.signal(signal.SIGINT)
    check(going.end()[0] == 5 and "lost.exr" in going.text, "a full disk", going.text)
    check(os.path.exists("kept.png") and not os.path.exists("lost.exr"), "the atlas is kept",
          os.listdir("."))


run_tests(globals())
