#!/usr/bin/env python3
"""`render --error`: where it ends, what it reports, and that it changes nothing else.

Usage: error_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import math
import signal
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import (Terminal, check, document, expect, read_bytes, run, run_tests)

METHODS = ("naive", "nee", "path", "reference", "light", "bdpt", "sppm", "bpm", "vcm")
SAME = ["room.json", "--deterministic", "--aov", "variance,samples"]


def estimate_of(*options):
    stats = document(["room.json", "-q", "-o", "e.exr", *options])
    return stats, stats["error_estimate"]


def power_of_two(n):
    return n & (n - 1) == 0


def test_every_method_ends_by_it():
    for method in METHODS:
        target = "20%" if method in ("naive", "reference") else "6%"
        stats, estimate = estimate_of("-i", method, "--error", target, "--spp", "16384")
        spp = stats["spp"]
        check(power_of_two(spp) and 64 <= spp < 16384, f"{method}: at a power of two", spp)
        check(estimate["reached"] is True and estimate["confidence"] == 0.95, "reached", estimate)
        check(estimate["target"] == float(target[:-1]) / 100, "target", estimate)
        check(0 < estimate["relmse"] < estimate["relmse_upper"] <= estimate["target"]**2,
              f"{method}: expected < bound <= target", estimate)
        looks = [look["spp"] for look in estimate["looks"]]
        check(looks == [64 << i for i in range(len(looks))] and looks[-1] == spp, "looks", looks)
        check(4 <= estimate["groups"] <= 16, "groups", estimate)
        for look in estimate["looks"][:-1]:
            upper = look["relmse_upper"]  # null: too little is known for any bound
            check(upper is None or upper > estimate["target"]**2, "it was not below before", estimate)
        merges = method in ("sppm", "bpm", "vcm")
        said = " ".join(estimate["unknown"])
        check(("radius" in said) == merges and "no pass has met" in said, "what it cannot know", said)
    stats, estimate = estimate_of("--error", "0.06", "--sampler", "random")
    check(power_of_two(stats["spp"]) and estimate["reached"], "independent numbers", estimate)


def test_the_picture_is_that_of_as_many_passes():
    for method in ("path", "bdpt", "vcm"):
        for more in ([], ["--crop", "5,21,3,14"], ["--sampler", "random"]):
            common = [*SAME, "-q", "-i", method, *more]
            out, _ = expect(0, [*common, "--error", "8%", "-o", "error.exr", "--json", "-"])
            spp = json.loads(out)["spp"]
            expect(0, [*common, "--spp", str(spp), "-o", "spp.exr"])
            check(run("compare", "error.exr", "spp.exr", "--fail-above", "mse=0")[0] == 0,
                  f"{method} {more}: the bits of --spp {spp}")
    expect(0, [*SAME, "-q", "--error", "8%", "-o", "one.exr"])
    expect(0, [*SAME, "-q", "--error", "8%", "-o", "two.exr", "--work-group", "8"])
    check(read_bytes("one.exr") == read_bytes("two.exr"), "and always the same bytes")


def test_evidence():
    _, estimate = estimate_of("--error", "8%")
    facts = document(["info", "e.exr"])["metadata"]
    check(math.isclose(float(facts["pellucid:relmseUpper"]), estimate["relmse_upper"], rel_tol=1e-5),
          "relmseUpper", facts)
    check(math.isclose(float(facts["pellucid:relmseConfidence"]), 0.95, rel_tol=1e-5), "confidence",
          facts)
    stats = document(["room.json", "-q", "--spp", "64", "-o", "plain.exr"])
    check(stats["error_estimate"]["confidence"] is None, "no claim without --error", stats)
    check(set(stats["error_estimate"]) == {"relmse", "confidence"}, "nor more keys", stats)
    check("pellucid:relmseUpper" not in document(["info", "plain.exr"])["metadata"], "nor evidence")


def test_budgets_that_end_first():
    for options, spp in ((["--spp", "100"], 100), (["--passes", "32:132"], 100), (["--spp", "8"], 8)):
        out, err = expect(1, ["room.json", "--error", "0.1%", "-o", "short.exr", *options, "--json", "-"],
                          "error:", "0.1 %", "not reached")
        stats = json.loads(out)
        check(stats["spp"] == spp and stats["complete"] is True, "the image is whole", stats)
        check(stats["error_estimate"]["reached"] is False, "not reached", stats)
        check(("below" in err) == (spp >= 64), "what is known is told", err)
        check(document(["info", "short.exr"])["metadata"]["samplesPerPixel"] == str(spp), "and written")
    expect(1, ["room.json", "--error", "1e-9", "--time", "1s", "-o", "short.exr"], "not reached")
    # Between two looks, the end is one.
    _, estimate = estimate_of("--error", "8%", "--spp", "1000")
    wanted = [look for look in estimate["looks"] if look["relmse_upper"] <= 0.0064]
    check(len(wanted) == 1, "the first look that says so ends it", estimate)
    _, estimate = estimate_of("--error", "50%", "--spp", "80")
    check(estimate["reached"] and estimate["looks"][-1]["spp"] == 64, "at 64, before 80", estimate)


def test_black_is_no_evidence():
    _, err = expect(1, ["room.json", "-D", "shapes.0.emission.radiance=0", "-D",
                        "lights.0.radiance=0", "--error", "50%", "--spp", "128", "-o", "black.exr"])
    check("black" in err, "says so", err)


def test_resume():
    common = [*SAME, "--checkpoint", "r.ckpt", "--resume"]
    expect(0, [*common, "--spp", "200", "-o", "r.exr"])
    out, _ = expect(0, [*common, "-q", "--error", "3%", "-o", "r.exr", "--json", "-"])
    stats = json.loads(out)
    check(power_of_two(stats["spp"]) and stats["spp"] >= 512, "looks of the whole film", stats)
    check(stats["error_estimate"]["reached"], "reached", stats)
    expect(0, [*SAME, "-q", "--spp", str(stats["spp"]), "-o", "whole.exr"])
    check(run("compare", "r.exr", "whole.exr", "--fail-above", "mse=0")[0] == 0, "the same bits")
    out, err = expect(0, [*common, "--error", "3%", "-o", "r.exr", "--json", "-"], "an earlier render found")
    check(json.loads(out)["spp"] == stats["spp"], "what is reached stays so", err)
    check(run("compare", "r.exr", "whole.exr", "--fail-above", "mse=0")[0] == 0, "the same bits")
    out, _ = expect(0, [*common, "-q", "--error", "2.9%", "-o", "r.exr", "--json", "-"])
    check(json.loads(out)["spp"] >= stats["spp"], "for less, it goes on", out)
    expect(0, [*SAME, "-q", "--passes", "8192:8193", "--checkpoint", "more.ckpt", "-o", "x.exr"])
    expect(0, ["merge", "r.ckpt", "more.ckpt", "-o", "merged.exr"])
    check("pellucid:relmseUpper" not in document(["info", "merged.exr"])["metadata"], "of no other film")


def test_signals():
    going = Terminal("room.json", "--error", "1e-6", "-o", "stop.exr", "--stats", "stop.json")
    going.wait_for(r"path on 0:0.* pass .*wanted 0\.0001 %")
    going.signal(signal.SIGINT)
    check(going.end()[0] == 75, "a stopped render is no failed one", going.text)


def test_dry_run_and_help():
    out, _ = expect(0, ["room.json", "--dry-run", "--error", "1%"])
    check("error below 1 %" in out, "the plan tells it", out)
    check(document(["room.json", "--dry-run", "--error", "1%", "--spp", "9"])["error"] == 0.01, "as JSON")
    check(document(["room.json", "--dry-run"])["error"] is None, "or none")
    out, _ = expect(0, ["render", "--help"])
    check("--error FRACTION" in out, "--help")


def test_bad_values():
    for value in ("nan", "inf", "0", "0%", "-1", "-1%", "abc", "1%%", "5", "200%", "1 %"):
        for more in ([], ["--passes", "0:9"], ["--time", "1s"]):
            _, err = expect(2, ["room.json", f"--error={value}", *more], "--error")
            check("1%" in err, "says what it takes", err)


run_tests(globals())
