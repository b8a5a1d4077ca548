#!/usr/bin/env python3
"""Where the time of a render goes: phases in `render --stats` are the whole of it.

Usage: trace_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import signal
import subprocess
import time

import harness
from harness import PELLUCID, QUICK, check, document, expect, read_json

PHASES = ("start", "load", "device", "bvh", "kernels", "film", "aov", "render", "checkpoint", "write")
SECONDS = 4  # long beside starting and ending a process on a busy machine
SIZE = ["--size", "256x256"]  # so that films and pictures take some time, too


def check_parts(stats, what):
    seconds = stats["seconds"]
    parts = [seconds[name] for name in PHASES]
    check(set(seconds) == {*PHASES, "total"}, f"{what}: phases", seconds)
    # By construction, so that the bound is far below the 5 % that are promised.
    check(abs(sum(parts) / seconds["total"] - 1) < 1e-3, f"{what}: parts add up", seconds)
    check(min(parts) >= 0, f"{what}: no time is negative", seconds)
    inside = sum(row["seconds"] for row in stats["passes"])
    check(abs(inside + stats["outside_passes"] - seconds["render"]) < 1e-6, f"{what}: passes and the rest",
          stats["passes"], stats["outside_passes"], seconds)
    # The device's clock may differ by a little; on a CPU passes never run side by side.
    check(0 < inside < 1.02 * seconds["render"], f"{what}: passes are within the render", inside, seconds)


def timed(arguments, signals=()):
    """Statistics of a run, and its seconds by a clock outside; `signals`: seconds to wait, number."""
    start = time.monotonic()
    with subprocess.Popen([PELLUCID, *arguments, "--stats", "stats.json", "--quiet"],
                          stderr=subprocess.PIPE, text=True) as process:
        for wait, number in signals:
            time.sleep(wait)
            process.send_signal(number)
        err = process.communicate(timeout=120)[1]
    outside = time.monotonic() - start
    check(process.returncode == 0, f"{arguments}: exit code", process.returncode, err)
    stats = read_json("stats.json")
    check_parts(stats, " ".join(arguments))
    # Ending the process is in no figure: a tenth of a second where others keep the machine busy.
    total = stats["seconds"]["total"]
    check(abs(total - outside) < 0.05 * outside + 0.1, "the total agrees with the clock outside", total,
          outside, stats["seconds"])
    return stats


def test_everything_at_once():
    options = ["room.json", *SIZE, "-o", "all.exr", "--aov", "N,P,variance", "--checkpoint", "all.ckpt",
               "--every", "1s"]
    expect(0, [*options, "--passes", "0:1", "--quiet"])  # kernels are in the driver's cache from here on
    os.remove("all.ckpt")
    os.remove("all.exr")
    first = timed([*options, "--time", f"{SECONDS}s"], [(SECONDS / 2, signal.SIGUSR1)])
    check(all(first["seconds"][name] > 0 for name in PHASES), "every phase is met", first["seconds"])

    resumed = timed([*options, "--resume", "--time", f"{SECONDS}s"])
    check(resumed["seconds"]["render"] <= resumed["seconds"]["total"], "earlier runs are not in the parts",
          resumed["seconds"])
    check(resumed["render_seconds"] > 1.8 * SECONDS, "but in the seconds of the film",
          resumed["render_seconds"])


def test_small_and_tiled():
    check_parts(document([*QUICK, "-o", "a.exr"]), "a small render")
    tiled = timed(["room.json", *SIZE, "-o", "b.exr", "--time", f"{SECONDS}s", "--memory", "4M"])
    check(tiled["tiles"] > 1 and tiled["seconds"]["film"] > 0, "tiles are moved", tiled["tiles"], tiled["seconds"])


harness.run_tests(globals())
