#!/usr/bin/env python3
"""Checkpoints as users meet them: resume, merge, signals, kills, full disks, wrong files.

Usage: checkpoint_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import resource
import signal
import sys
import time

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import (Terminal, check, document, expect, read_bytes, read_json, run, run_tests,
                     temporaries, write_text)

SAME = ["room.json", "--quiet", "--deterministic", "--aov", "variance,samples"]
FOREVER = ["room.json", "--spp", "1000000000", "--size", "64x32"]
SAMPLERS = ("random", "sobol")


def same_files(a, b):
    return read_bytes(a) == read_bytes(b)


def render(name, *arguments, code=0):
    return expect(code, ["render", *SAME, "-o", name + ".exr", *arguments])


def test_resumed_and_merged_is_uninterrupted():
    """Splits at any pass, within blocks or not; the files are the same to the last byte."""
    for sampler in SAMPLERS:
        common = ["--sampler", sampler]
        render("whole", "--spp", "41", *common)
        first = 0
        for i, last in enumerate((7, 20, 32, 41)):
            render("part", "--passes", f"{first}:{last}", "--checkpoint", f"{sampler}{i}.ckpt", *common)
            first = last
        parts = [f"{sampler}{i}.ckpt" for i in (2, 0, 3, 1)]
        expect(0, ["merge", *parts, "-o", "merged.exr", "-o", "merged.png", "-o", f"{sampler}.ckpt",
                   "--aov", "variance,samples", "--deterministic"], "passes 0:41")
        check(same_files("whole.exr", "merged.exr"), f"{sampler}: merged is uninterrupted")
        expect(0, ["merge", f"{sampler}.ckpt", "-o", "again.exr", "--aov", "variance,samples",
                   "--deterministic"])
        check(same_files("whole.exr", "again.exr"), f"{sampler}: also through a merged checkpoint")
        for spp in (5, 19, 41):
            render("resumed", "--spp", str(spp), "--checkpoint", f"r{sampler}.ckpt", "--resume",
                   *common)
        check(same_files("whole.exr", "resumed.exr"), f"{sampler}: resumed twice")
        before = read_bytes("resumed.exr")
        render("resumed", "--spp", "41", "--checkpoint", f"r{sampler}.ckpt", "--resume", *common)
        check(before == read_bytes("resumed.exr"), "nothing left to do")


def test_stopped_and_resumed():
    render("whole", "--spp", "300", "--size", "64x32")
    for number in (signal.SIGINT, signal.SIGTERM):
        name = f"stop{int(number)}"
        going = Terminal(*FOREVER, "-o", name + ".exr", "--checkpoint", name + ".ckpt")
        going.wait_for("path on 0:0.* pass")
        going.signal(number)
        check(going.end()[0] == 75, "stopped", going.text)
        facts = document(["info", name + ".ckpt"])
        check(facts["passes"].startswith("0:") and facts["spp"] > 0, "kept", facts)
        out, err = expect(0, ["merge", name + ".ckpt", "-o", "x.exr"])
        check(run("compare", "x.exr", name + ".exr", "--fail-above", "mse=0")[0] == 0,
              "the picture is the checkpoint's", out, err)


def test_kill_loses_the_last_interval_at_most():
    """kill -9 at any time leaves a whole file; resumed it gives the uninterrupted picture."""
    kept = []
    for wait in (0.1, 0.4, 0.9):
        going = Terminal(*FOREVER, "-o", "k.exr", "--checkpoint", "k.ckpt", "--every", "100ms",
                         "--resume")
        going.wait_for("path on 0:0.* pass")
        time.sleep(wait)
        going.signal(signal.SIGKILL)
        check(going.end()[0] == -signal.SIGKILL, "killed")
        kept.append(document(["info", "k.ckpt"])["spp"] if os.path.exists("k.ckpt") else 0)
    check(kept == sorted(kept) and kept[-1] > 0, "passes only ever grow", kept)
    spp = str(kept[-1] + 10)
    render("killed", "--spp", spp, "--size", "64x32", "--checkpoint", "k.ckpt", "--resume")
    render("unkilled", "--spp", spp, "--size", "64x32")
    check(same_files("killed.exr", "unkilled.exr"), "nothing shows of three kills")


def test_sigusr1_writes_both():
    going = Terminal(*FOREVER, "-o", "usr1.exr", "--checkpoint", "usr1.ckpt")
    going.wait_for("path on 0:0.* pass")
    going.signal(signal.SIGUSR1)
    going.wait_for("the image so far is written")
    check(document(["info", "usr1.ckpt"])["spp"] > 0, "the checkpoint, too")
    check(going.process.poll() is None, "and it goes on")
    going.signal(signal.SIGINT)
    check(going.end()[0] == 75, "until it is stopped")


def test_full_disk():
    going = Terminal(*FOREVER, "-o", "full.png", "--checkpoint", "full.ckpt", "--every", "100ms")
    going.wait_for("path on 0:0.* pass")
    while not os.path.exists("full.ckpt") and going.process.poll() is None:
        going.read(0.05)
    resource.prlimit(going.process.pid, resource.RLIMIT_FSIZE, (20000, 20000))
    going.wait_for("warning:.*full.ckpt.*the render goes on")
    passes = document(["info", "full.ckpt"])["spp"]
    check(passes > 0, "the old checkpoint is whole")
    going.signal(signal.SIGINT)
    check(going.end()[0] == 5, "a full disk at the end", going.text)
    check(document(["info", "full.ckpt"])["spp"] == passes and not temporaries(), "still whole")
    check(document(["info", "full.png"])["width"] == 64, "what fits is written")


def test_unwritable():
    expect(5, ["room.json", "--spp", "1", "--checkpoint", "no/such/folder/x.ckpt"],
           "no/such/folder/x.ckpt")
    os.mkdir("folder.ckpt")
    expect(5, ["room.json", "--spp", "1", "--checkpoint", "folder.ckpt", "--resume"], "folder.ckpt")


def test_wrong_files():
    render("a", "--spp", "4", "--checkpoint", "a.ckpt")
    old = read_bytes("a.ckpt")
    expect(2, ["render", *SAME, "--spp", "8", "--checkpoint", "a.ckpt"], "a.ckpt", "--resume")
    expect(2, ["render", *SAME, "--spp", "8", "--resume"], "--checkpoint")
    for option, what in ((["--seed", "5"], "seed is 0 in the one and 5 in the other"),
                         (["--size", "16x16"], "size is 32x16 in the one and 16x16 in the other"),
                         (["-i", "nee"], "integrator is path in the one and nee in the other"),
                         (["--max-depth", "3"], "max-depth is unlimited in the one and 3 in the other"),
                         (["--crop", "0,8,0,8"], "crop is 0,32,0,16 in the one and 0,8,0,8 in"),
                         (["--mis", "power"], "mis is balance in the one and power in the other")):
        expect(3, ["render", *SAME, "--spp", "8", "--checkpoint", "a.ckpt", "--resume", *option],
               "a.ckpt", what, "repeat its options", "--checkpoint")
    room = read_json("room.json")
    room["camera"]["fov"] = 80
    write_text("other.json", str(room).replace("'", '"'))
    expect(3, ["render", "other.json", "--checkpoint", "a.ckpt", "--resume", "-o", "never.exr"],
           "a.ckpt", "scene")
    check(read_bytes("a.ckpt") == old, "a refused checkpoint is not touched")
    render("b", "--passes", "2:6", "--checkpoint", "b.ckpt")
    expect(3, ["merge", "a.ckpt", "b.ckpt", "-o", "never.exr"], "a.ckpt", "b.ckpt", "share passes")
    expect(3, ["merge", "a.ckpt", "a.ckpt", "-o", "never.exr"], "share passes")
    render("c", "--passes", "6:8", "--seed", "1", "--checkpoint", "c.ckpt")
    expect(3, ["merge", "a.ckpt", "c.ckpt", "-o", "never.exr"], "a.ckpt", "c.ckpt", "seed")
    expect(3, ["merge", "a.exr", "-o", "never.exr"], "a.exr")
    expect(3, ["merge", "none.ckpt", "-o", "never.exr"], "none.ckpt")
    expect(2, ["merge", "a.ckpt"], "--output")
    expect(2, ["merge", "a.ckpt", "-o", "x.gif"], "x.gif")
    expect(5, ["merge", "a.ckpt", "-o", "no/x.exr"], "no/x.exr")
    render("d", "--passes", "9:12", "--checkpoint", "d.ckpt")
    expect(0, ["merge", "a.ckpt", "d.ckpt", "-o", "gap.exr"], "passes 4:9 are missing")
    check(not os.path.exists("never.exr"), "nothing is written after an error")


def test_options_of_merging():
    """Each is told by name, with both values; what agrees is not."""
    given = {"--radius": "0.1", "--radius-alpha": "0.8", "--light-paths": "300", "--merges": "first"}
    vcm = ["room.json", "-q", "--deterministic", "-i", "vcm", "-o", "vcm.exr"]

    def words(**changed):
        options = {**given, **{"--" + name.replace("_", "-"): value for name, value in changed.items()}}
        return [word for option, value in options.items() if value for word in (option, value)]

    expect(0, [*vcm, *words(), "--passes", "0:2", "--checkpoint", "vcm.ckpt"])
    old = read_bytes("vcm.ckpt")
    for i, (name, value, told) in enumerate((("radius", "0.2", "0.2"), ("radius", "", "not given"),
                                             ("radius_alpha", "0.7", "0.7"),
                                             ("light_paths", "301", "301"),
                                             ("light_paths", "", "not given"),
                                             ("merges", "all", "not given"))):
        option = "--" + name.replace("_", "-")
        differs = f"{option[2:]} is {given[option]} in the one and {told} in the other"
        _, err = expect(3, [*vcm, *words(**{name: value}), "--spp", "4", "--checkpoint", "vcm.ckpt",
                            "--resume"], "'vcm.ckpt'", ": " + differs + ";")
        check(err.count("in the one") == 1, "and nothing else differs", err)
        other = f"other{i}.ckpt"
        expect(0, [*vcm, *words(**{name: value}), "--passes", "2:4", "--checkpoint", other])
        expect(3, ["merge", "vcm.ckpt", other, "-o", "never.exr"], "'vcm.ckpt'", other, differs)
        expect(3, ["merge", other, "vcm.ckpt", "-o", "never.exr"],
               f"{option[2:]} is {told} in the one and {given[option]} in the other")
    expect(3, [*vcm, *words(radius="0.2", merges="all", vertices="compact"), "--spp", "4", "--checkpoint",
               "vcm.ckpt", "--resume"], "radius is 0.1 in the one", "merges is first in the one",
           "vertices is not given in the one and compact in the other")
    check(read_bytes("vcm.ckpt") == old and not os.path.exists("never.exr"), "nothing is touched")
    expect(0, [*vcm, *words(), "--spp", "4", "--checkpoint", "vcm.ckpt", "--resume"])


def test_light_vertices_that_do_not_fit():
    """Known only once a pass has traced them: what a checkpoint has is not lost."""
    write_text("white.json", json.dumps({
        "version": 1, "film": {"width": 4, "height": 4},
        "camera": {"origin": [0, 0, 0.5], "target": [0, 0, 0], "fov": 90},
        "materials": {"white": {"type": "diffuse", "reflectance": 0.98}},
        "shapes": [{"type": "sphere", "material": "white", "center": [0, 0, 0], "radius": 1}],
        "lights": [{"type": "point", "position": [0, 0.5, 0], "intensity": 1}]}))
    every = ["white.json", "-q", "--deterministic", "-i", "vcm"]
    vcm = [*every, "--light-paths", "64"]
    remedies = ("--memory", "--vertices compact", "--light-paths", "light paths are merged all at once")
    # Paths of some 50 vertices each, planned to have 4: refused in the first pass.
    expect(4, [*every, "--spp", "1", "--light-paths", "20000", "--memory", "64M", "-o", "never.exr"], *remedies)
    check(not os.path.exists("never.exr"), "nothing is written")
    # Room for the first pass with 2 % to spare, where the number of vertices varies by 12 %.
    sizes = document([*vcm, "--spp", "1", "-o", "one.exr"])["memory_bytes"]
    capacity, spare = sizes["light_order"] // 4, 1.25  # one number for each; as plan_slices.cpp has it
    per_vertex = sum(sizes[name] // capacity for name in (
        "light_vertices", "light_order", "photon_positions", "photons", "grid_pairs", "grid_sorted"))
    check(per_vertex == 180, "bytes of a light vertex, as README says", sizes)
    memory = sum(sizes.values()) - int(per_vertex * capacity * (1 - 1.02 / spare))
    tight = [*vcm, "--spp", "64", "--memory", str(memory), "--checkpoint", "tight.ckpt", "--every", "0",
             "-o", "tight.exr"]
    expect(4, tight, *remedies)
    kept = document(["info", "tight.ckpt"])["spp"]
    check(0 < kept < 64, "what was done is kept", kept)
    expect(4, [*tight, "--resume"], *remedies)
    expect(0, [*vcm, "--spp", "64", "--checkpoint", "tight.ckpt", "--resume", "-o", "tight.exr"])
    expect(0, [*vcm, "--spp", "64", "-o", "roomy.exr"])
    check(same_files("tight.exr", "roomy.exr"), "with more memory it goes on as if nothing had been")


def test_nothing_overwrites_anything():
    text = read_bytes("room.json")
    for arguments in (["--checkpoint", "same.exr", "-o", "same.exr"],
                      ["--stats", "same.exr", "-o", "same.exr"],
                      ["--checkpoint", "./room.exr"],  # a default name
                      ["-o", "x.exr", "--stats", "room.json"],
                      ["-o", "x.exr", "--checkpoint", os.path.abspath("room.json"), "--resume"]):
        expect(2, ["room.json", "--spp", "1", *arguments], "same file" if "room.json" not in
               arguments[-1] and "--resume" not in arguments else "a file of the scene")
    check(read_bytes("room.json") == text and not os.path.exists("same.exr"), "nothing is touched")
    render("in", "--spp", "2", "--checkpoint", "in.ckpt")
    expect(2, ["merge", "in.ckpt", "-o", "./in.ckpt"], "overwrite")


def test_channels_stay_with_a_checkpoint():
    """Whichever order files are merged in, and whether --aov is said again or not."""
    aovs = ["room.json", "-q", "--deterministic", "--aov", "Z,albedo"]
    plain = ["room.json", "-q", "--deterministic"]
    expect(0, [*aovs, "--spp", "6", "-o", "all.exr"])
    expect(0, [*aovs, "--passes", "0:4", "--checkpoint", "with.ckpt", "-o", "x.exr"])
    expect(0, [*plain, "--passes", "4:6", "--checkpoint", "bare.ckpt", "-o", "x.exr"])
    for files in (["with.ckpt", "bare.ckpt"], ["bare.ckpt", "with.ckpt"]):
        expect(0, ["merge", *files, "-o", "both.exr", "--deterministic"])
        check(document(["info", "both.exr"])["channels"] == ["R", "G", "B", "Z", "albedo.R", "albedo.G",
                                                             "albedo.B"], "channels of both")
        check(same_files("both.exr", "all.exr"), "merged is uninterrupted", files)
    expect(0, [*plain, "--spp", "6", "--checkpoint", "with.ckpt", "--resume", "-o", "on.exr"])
    check(same_files("on.exr", "all.exr"), "resumed without --aov keeps them")
    check(document(["info", "with.ckpt"])["aovs"] == ["Z", "albedo.R", "albedo.G", "albedo.B"], "kept")


def test_damaged():
    render("a", "--spp", "4", "--checkpoint", "whole.ckpt")
    whole = read_bytes("whole.ckpt")
    for i in range(20):
        with open("cut.ckpt", "wb") as file:
            file.write(whole[:len(whole) * i // 20])
        expect(3, ["merge", "cut.ckpt", "-o", "x.exr"], "cut.ckpt")


def test_passes_and_sizes_are_checked():
    for passes in ("", "4", "4:4", "5:4", "a:b", "-1:3", "0:99999999999", "0:4,8:12", "1e3:2e3"):
        expect(2, ["render", *SAME, "--passes", passes])
    expect(2, ["render", *SAME, "--passes", "0:9", "--spp", "8"], "--passes 0:9")
    for crop in ("1,2,3", "0,0,0,5", "5,4,0,1", "0,33,0,16", "-1,4,0,4", "a,b,c,d", "0,1,0,1,2"):
        expect(2, ["render", *SAME, "--crop", crop], "--crop")
    for memory in ("0", "-1", "nan", "inf", "2X", "1e38", "G"):
        expect(2, ["render", *SAME, "--memory", memory], "--memory")
    expect(4, ["render", *SAME, "--spp", "1", "--memory", "1K"], "--memory allows")
    expect(2, ["render", *SAME, "--every", "5s"], "--checkpoint")
    expect(2, ["render", *SAME, "--checkpoint", "x.ckpt", "--every", "soon"], "--every")


run_tests(globals())
