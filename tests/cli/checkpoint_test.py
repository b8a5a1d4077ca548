#!/usr/bin/env python3
"""Checkpoints as users meet them: resume, merge, signals, kills, full disks, wrong files.

Usage: checkpoint_test.py path/to/pellucid   (exit 0: all checks hold)
"""
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
    for option, what in ((["--seed", "5"], "seed"), (["--size", "16x16"], "settings"),
                         (["-i", "nee"], "integrator"), (["--max-depth", "3"], "settings"),
                         (["--crop", "0,8,0,8"], "settings"), (["--mis", "power"], "settings")):
        expect(3, ["render", *SAME, "--spp", "8", "--checkpoint", "a.ckpt", "--resume", *option],
               "a.ckpt", what)
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
