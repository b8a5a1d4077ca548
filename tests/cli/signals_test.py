#!/usr/bin/env python3
"""Signals, and what shows while a render runs: progress lines, NO_COLOR, --quiet.

Usage: signals_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import re
import resource
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import (PELLUCID, QUICK, ROOM, Terminal, check, document, expect, read_bytes,
                     read_json, run_tests, temporaries, write_text)

FOREVER = ["room.json", "--spp", "1000000000"]
WIPE = "\r\x1b[2K"


def image(name):
    """Metadata of an image that must be whole."""
    compared = document(["compare", name, name])
    check(compared["nonfinite"] == 0, f"{name} is finite")
    return document(["info", name])["metadata"]


def test_plain_progress():
    """Starts first, ends last: needs more than 10 s."""
    with open("plain.txt", "w", encoding="utf-8") as file:
        test_plain_progress.process = subprocess.Popen(
            [PELLUCID, "room.json", "--time", "11s", "-o", "plain.exr"],
            stdout=subprocess.DEVNULL, stderr=file)


def test_stop():
    for number in (signal.SIGINT, signal.SIGTERM):
        name = f"stop{int(number)}"
        render = Terminal(*FOREVER, "-o", name + ".exr", "--stats", name + ".json")
        render.wait_for("path on 0:0.* pass")
        render.signal(number)
        code, seconds = render.end()
        check(code == 75 and seconds < 5, "stopped with 75", code, seconds, render.text)
        check("stopped early" in render.text, "and says so", render.text)
        stats = read_json(name + ".json")
        check(stats["complete"] is False and 0 < stats["spp"] < 10**9, "statistics", stats)
        metadata = image(name + ".exr")
        check(metadata["samplesPerPixel"] == str(stats["spp"]), "evidence", metadata)


def test_second_signal():
    """One pass of this takes minutes: the first signal cannot be obeyed soon, the second is."""
    white = {"type": "diffuse", "reflectance": 0.9999}
    shell = {"type": "sphere", "material": "grey", "radius": 100, "emission": {"radiance": 1,
                                                                               "sides": 2}}
    write_text("long.json", json.dumps({**ROOM, "materials": {"grey": white}, "shapes": [shell],
                                        "lights": []}))
    render = Terminal("long.json", "--size", "512x512", "--spp", "9", "-i", "naive")
    render.wait_for("naive on 0:0")
    render.signal(signal.SIGINT)
    time.sleep(0.5)
    check(render.process.poll() is None, "one signal waits for the pass", render.text)
    render.signal(signal.SIGINT)
    code, seconds = render.end()
    check(code == 130 and seconds < 2, "the second one quits at once", code, seconds)
    check(not os.path.exists("long.exr"), "and writes nothing")


def test_stop_in_aovs():
    """Their pass takes 20 s of one core at this size; the render is not reached."""
    expect(0, ["room.json", "--spp", "1", "--aov", "N", "-o", "small.exr"])  # builds the kernels
    render = Terminal("room.json", "--spp", "1", "--size", "2048x2048", "--aov", "N",
                      "--threads", "1", "-o", "aovs.exr", "--checkpoint", "aovs.ckpt")
    render.wait_for("rendering AOVs [1-9]\\.")
    render.signal(signal.SIGINT)
    code, seconds = render.end()
    check(code == 75 and seconds < 5, "stopped with 75", code, seconds, render.text)
    check("before the first pass: nothing is written" in render.text, "and says so", render.text)
    check(not os.path.exists("aovs.exr") and not os.path.exists("aovs.ckpt"), "nothing is there")


def test_image_so_far():
    render = Terminal(*FOREVER, "-o", "sofar.exr")
    render.wait_for("path on 0:0.* pass")
    render.signal(signal.SIGUSR1)
    render.wait_for("the image so far is written")
    first = image("sofar.exr")
    check(float(first["renderTimeSeconds"]) > 0, "with its time", first)
    check(first["pellucid:counters"] == "all zero", "and counters", first)
    check(render.process.poll() is None, "the render goes on")
    render.signal(signal.SIGTERM)
    check(render.end()[0] == 75, "until it is stopped")
    last = image("sofar.exr")
    check(int(last["samplesPerPixel"]) > int(first["samplesPerPixel"]), "it went on", first, last)


def test_image_so_far_cannot_be_written():
    os.mkdir("gone")
    render = Terminal(*FOREVER, "-o", "gone/x.exr")
    render.wait_for("path on 0:0.* pass")
    os.rmdir("gone")
    render.signal(signal.SIGUSR1)
    render.wait_for("warning:.*gone/x.exr.*the render goes on", 20)
    os.mkdir("gone")
    render.signal(signal.SIGINT)
    check(render.end()[0] == 75 and os.path.exists("gone/x.exr"), "and nothing was lost")


def test_full_disk():
    """The limit comes when the render runs: drivers write files, too."""
    write_text("full.exr", "old")
    names = ("full.exr", "full.bmp", "full.png")
    render = Terminal(*FOREVER, "--size", "128x128", "--aov", "variance",
                      *[word for name in names for word in ("-o", name)])
    render.wait_for("path on 0:0.* pass")
    resource.prlimit(render.process.pid, resource.RLIMIT_FSIZE, (40000, 40000))
    render.signal(signal.SIGINT)
    check(render.end()[0] == 5, "a full disk", render.text)
    check(re.search("error:.*'full.exr'", render.text), "names the file", render.text)
    check(read_bytes("full.exr") == b"old", "the old file is intact")
    check(not os.path.exists("full.bmp") and not temporaries(), "nothing is left", os.listdir("."))
    check(document(["info", "full.png"])["width"] == 128, "the picture that fits is written")


def test_kill():
    for wait in (0.0, 0.005, 0.02):
        name = f"killed{wait}.exr"
        render = Terminal(*FOREVER, "--size", "512x512", "-o", name)
        render.wait_for("path on 0:0.* pass")
        check(not os.path.exists(name), "no file before its time")
        render.signal(signal.SIGUSR1)
        time.sleep(wait)
        render.signal(signal.SIGKILL)
        check(render.end()[0] == -signal.SIGKILL, "killed")
        if os.path.exists(name):
            image(name)


def test_progress_on_a_terminal():
    for variables in ({"TERM": "xterm"}, {"TERM": "xterm", "NO_COLOR": "1"}):
        render = Terminal("room.json", "--time", "2s", "-o", "bar.exr", **variables)
        code, _ = render.end()
        text = render.text
        check(code == 0, "exit code", code, text)
        lines = [part for part in text.split(WIPE) if "path on 0:0" in part]
        check(4 <= len(lines) <= 10, "redrawn at most four times a second", text)
        check(all("\n" not in line for line in lines), "on one line", text)
        last = lines[-1]
        check(re.search(r"path on 0:0 \d\.\d+ s +\d+ %  pass \d+  \d+\.\d+ Mrays/s", last),
              "name, clock, percent, speed", last)
        check(WIPE in text[text.rindex("path on 0:0"):], "it vanishes at the end", text)
        check("\n" == text[-1], "the last line is whole", text)
    for no_color, coloured in (("", True), ("1", False)):
        failed = Terminal("none.json", TERM="xterm", NO_COLOR=no_color)
        failed.end()
        check(("\x1b[1;31m" in failed.text) == coloured, f"NO_COLOR={no_color!r}", failed.text)
    dumb = Terminal(*QUICK[:3], TERM="dumb")
    dumb.end()
    check("\x1b" not in dumb.text, "nothing special on a dumb terminal", dumb.text)


def test_quiet():
    silent = Terminal("room.json", "--time", "1s", "-q", "-o", "bar.exr")
    check(silent.end()[0] == 0 and silent.text == "", "--quiet is silent", silent.text)
    _, err = expect(0, QUICK)
    check(err == "", "and so outside of terminals", err)
    _, err = expect(0, [*QUICK[:3], "-v"])
    check("\x1b" not in err and "path" in err, "-v tells at least as much", err)


def test_z_plain_progress_ends():
    code = test_plain_progress.process.wait(timeout=60)
    with open("plain.txt", encoding="utf-8") as file:
        text = file.read()
    check(code == 0 and "\x1b" not in text and "\r" not in text, "plain lines are plain", text)
    lines = [line for line in text.split("\n") if not line.startswith("building")]  # on a busy machine
    check(text.count("path on 0:0 ") == 1 and len(lines) == 3, "one line in 10 s", text)


run_tests(globals())
