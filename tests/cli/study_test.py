#!/usr/bin/env python3
"""study: its files, its verdicts, what it refuses, and how it ends early.

Usage: study_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import signal
import struct
import subprocess
import sys
import time

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import PELLUCID, check, expect, read_bytes, read_json, run_tests, write_text

# Two methods without paths from lights, whose kernels are quick to build, against a file.
SMALL = ["--size", "12x12", "--integrators", "path,nee", "--ref", "ref.exr", "--target", "20%"]
KINDS = {"measured", "interpolated", "extrapolated", "beyond", "never", "unknown"}


def make_reference():
    expect(0, ["cornell-box", "-q", "--size", "12x12", "--spp", "2048", "--seed", "77", "--aov",
               "variance", "-o", "ref.exr"])


def test_study():
    make_reference()
    out, _ = expect(0, ["study", "cornell-box", *SMALL, "--precision", "strict,mad", "--budget",
                        "40s", "--out", "here"])
    for name in ("here/study.json", "here/table.md", "here/report.html"):
        check(name in out, "told on stdout", name, out)
    study = read_json("here/study.json")
    check(study["schema"] == 1 and study["complete"], "whole", study["complete"])
    names = [(one["integrator"], one["precision"]) for one in study["options"]]
    check(names[:2] == [("nee", "strict"), ("path", "strict")], "options", names)
    # Whether there is time for pairs is the machine's doing; if so, both ends know of them.
    check({pair["precision"] for pair in study["pairs"]} == {p for _, p in names} - {"strict"},
          "precisions", names)
    for one in study["options"]:
        check(one["kind"] in KINDS, "kind", one["kind"])
        if one["precision"] == "strict" and one["state"] == "main":
            check(len(one["runs"]) >= 3 and len(one["runs"][0]["rungs"]) >= 5, "runs", names)
            check(0 < one["low"] <= one["seconds_to_target"] <= one["high"], "interval", one["low"])
    best = study["options"][study["recommended"]]
    check(f"{best['integrator']} {best['precision']} reaches 20 %" in study["recommendation"],
          "recommendation", study["recommendation"])

    before = [read_bytes("here/" + name) for name in ("table.md", "report.html")]
    expect(0, ["study", "--report", "here/study.json", "--out", "again"])
    after = [read_bytes("again/" + name) for name in ("table.md", "report.html")]
    check(before == after, "reports come back byte by byte")


def test_inconclusive():
    make_reference()
    out, _ = expect(1, ["study", "cornell-box", *SMALL, "--budget", "1s", "--out", "short"])
    check("Inconclusive" in out and "--budget" in out, "says why", out)
    check(read_json("short/study.json")["recommended"] == -1, "recommends nothing")


def test_unreachable():
    """`path` cannot see light that comes to a point through glass: never recommended."""
    scene = {"version": 1, "camera": {"origin": [0, 1, 4], "target": [0, 0, 0], "fov": 40},
             "film": {"width": 12, "height": 12},
             "materials": {"grey": {"type": "diffuse", "reflectance": 0.5},
                           "glass": {"type": "dielectric"}},
             "shapes": [{"type": "sphere", "material": "glass", "center": [0, 0, 0], "radius": 0.5},
                        {"type": "rectangle", "material": "grey", "corner": [-2, -1, -2],
                         "edges": [[0, 0, 4], [4, 0, 0]]}],
             "lights": [{"type": "point", "position": [0, 3, 0], "intensity": 10}]}
    write_text("ball.json", json.dumps(scene))
    expect(0, ["ball.json", "-q", "--spp", "256", "-i", "light", "--aov", "variance", "-o", "l.exr"])
    expect(1, ["study", "ball.json", "--integrators", "path", "--precision", "strict", "--ref",
               "l.exr", "--budget", "30s", "--out", "blind"])
    study = read_json("blind/study.json")
    one = study["options"][0]
    check(one["kind"] == "never" and one["seconds_to_target"] is None, "never", one["kind"])
    check(one["unreachable"] and study["recommended"] == -1, "and why", one["unreachable"])


def test_stop():
    make_reference()
    with open("stop.txt", "w", encoding="utf-8") as log:
        process = subprocess.Popen([PELLUCID, "study", "cornell-box", *SMALL, "--budget", "10m",
                                    "--out", "stopped"], stdout=subprocess.DEVNULL, stderr=log)
        time.sleep(8)
        process.send_signal(signal.SIGINT)
        code = process.wait(60)
    check(code == 75, "stopped with 75", code)
    study = read_json("stopped/study.json")
    check(study["complete"] is False, "partial")
    expect(1, ["study", "--report", "stopped/study.json", "--out", "stopped2"])


def make_plain():
    """A grey plane below a point light."""
    scene = {"version": 1, "camera": {"origin": [0, 1, 4], "target": [0, 0, 0], "fov": 40},
             "film": {"width": 12, "height": 12},
             "materials": {"grey": {"type": "diffuse", "reflectance": 0.5}},
             "shapes": [{"type": "rectangle", "material": "grey", "corner": [-2, -1, -2],
                         "edges": [[0, 0, 4], [4, 0, 0]]}],
             "lights": [{"type": "point", "position": [0, 3, 0], "intensity": 10}]}
    write_text("plain.json", json.dumps(scene))


def test_kill():
    """What was measured in whole rounds is on disk before the end."""
    make_reference()
    with open("kill.txt", "w", encoding="utf-8") as log:
        process = subprocess.Popen([PELLUCID, "study", "cornell-box", *SMALL, "--precision", "strict",
                                    "--budget", "40s", "--out", "killed"], stdout=subprocess.DEVNULL,
                                   stderr=log)
        end = time.monotonic() + 60
        while time.monotonic() < end and not (os.path.exists("killed/study.json")
                                              and os.path.getsize("killed/study.json")):
            time.sleep(0.05)
        process.kill()
        process.wait(60)
    study = read_json("killed/study.json")
    check(study["complete"] is False and study["scene"] == "cornell-box", "partial", study["complete"])
    check(any(one["runs"] for one in study["options"]), "with the runs of a round")


def test_reference_of_something_else():
    make_reference()
    ask = ["study", "cornell-box", "--size", "12x12", "--integrators", "path,nee", "--target", "20%", "--budget",
           "10s", "--out", "other"]
    shape = ["cornell-box", "-q", "--size", "12x12", "--spp", "64", "-o"]
    expect(0, [*shape, "deep.exr", "--max-depth", "3"])
    expect(3, [*ask, "--ref", "deep.exr"], "deep.exr", "max-depth 3", "unlimited")
    expect(0, [*shape, "box.exr", "--filter", "box"])
    expect(3, [*ask, "--ref", "box.exr"], "filter box")
    expect(0, [*shape, "same.exr", "--seed", "14000003"])
    expect(3, [*ask, "--ref", "same.exr", "--seed", "1"], "same.exr", "seed", "14000003")
    make_plain()
    expect(0, ["plain.json", "-q", "--spp", "64", "-D", "materials.grey.reflectance=0.6", "-o", "pale.exr"])
    expect(1, ["study", "plain.json", "--integrators", "path,nee", "--precision", "strict", "--target", "20%",
               "--budget", "10s", "--ref", "pale.exr", "--out", "other"])
    reference = read_json("other/study.json")["reference"]
    check("only if these differ in nothing" in reference["doubt"], "another scene is told", reference["doubt"])


def test_black():
    """No error is relative to nothing."""
    make_plain()
    away = ["plain.json", "-D", "camera.target=[0,9,9]"]
    expect(0, [*away, "-q", "--spp", "1", "-o", "black.exr"])
    expect(3, ["study", *away, "--integrators", "path,nee", "--budget", "60s", "--ref", "black.exr", "--out", "black"],
           "black.exr", "is black")


def test_refused_by_memory():
    """A method that does not fit leaves the study; the others go on."""
    make_reference()
    small = ["--size", "12x12", "--ref", "ref.exr", "--target", "20%", "--precision", "strict"]
    expect(0, ["study", "cornell-box", *small, "--integrators", "path,vcm", "--light-paths", "4000000", "--memory",
               "64M", "--budget", "30s", "--out", "narrow"])
    study = read_json("narrow/study.json")
    states = {one["integrator"]: (one["state"], one["reason"]) for one in study["options"]}
    check(states["path"][0] == "main", "path goes on", states)
    check(states["vcm"][0] == "refused" and "memory" in states["vcm"][1], "vcm does not fit", states)


def test_bad_input():
    make_reference()
    expect(2, ["study", "--report", "study.json", "--budget", "5s"], "--report", "--budget")
    expect(2, ["study", "cornell-box", "--integrators", "path", "--radius", "0.1"], "--radius has no effect")
    expect(2, ["study", "cornell-box", "--integrators", "path", "--light-paths", "9"], "--light-paths")
    expect(2, ["study", "cornell-box", "--integrators", "naive", "--mis", "power"], "--mis")
    expect(2, ["study", "cornell-box", "--radius", "-1"], "--radius")
    expect(2, ["study"], "SCENE", "--report")
    expect(2, ["study", "cornell-box", "--target", "0"], "--target")
    expect(2, ["study", "cornell-box", "--budget", "0.2s"], "--budget")
    expect(2, ["study", "cornell-box", "--integrators", "path,neee"], "'neee'", "nee")
    expect(2, ["study", "cornell-box", "--precision", "loose"], "'loose'")
    expect(3, ["study", "cornell-box", "--size", "8x8", "--ref", "ref.exr", "--budget", "20s",
               "--integrators", "path"], "12x12", "--size")
    expect(3, ["study", "cornell-box", "--ref", "none.exr", "--budget", "20s", "--integrators",
               "path", "--size", "12x12"], "none.exr")
    expect(5, ["study", "cornell-box", *SMALL, "--out", "/proc/none"], "--out")
    write_text("broken.json", '{"schema": 1, "scene": "x"}')
    expect(3, ["study", "--report", "broken.json"], "broken.json", "scene_hash")
    write_text("no.json", "{")
    expect(3, ["study", "--report", "no.json"], "no.json", "JSON")


def test_nan_reference():
    """A PFM of 12x12 with one NaN: refused, not scrubbed."""
    values = [0.5] * (12 * 12 * 3)
    values[77] = float("nan")
    with open("nan.pfm", "wb") as file:
        file.write(b"PF\n12 12\n-1.0\n" + struct.pack(f"<{len(values)}f", *values))
    expect(3, ["study", "cornell-box", "--size", "12x12", "--ref", "nan.pfm", "--integrators",
               "path", "--budget", "30s"], "nan.pfm", "no numbers")


run_tests(globals())
