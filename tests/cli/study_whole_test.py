#!/usr/bin/env python3
"""study as users start it, with a reference of its own making: from the pilot to precisions. Slow.

Usage: study_whole_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import check, expect, read_bytes, read_json, run_tests

UNBIASED = {"path", "bdpt"}


def test_own_reference():
    expect(0, ["study", "cornell-box", "--size", "32x32", "--integrators", "path,bdpt,vcm", "--target", "10%",
               "--budget", "4m", "--out", "whole"])
    study = read_json("whole/study.json")
    reference, options = study["reference"], study["options"]
    check(study["complete"] and reference["trusted"], "two voices agree", reference)
    check(" and " in reference["source"] and reference["relmse"] > 0, "and are two", reference["source"])
    for one in options:
        name = f"{one['integrator']} {one['precision']} {one['radius_factor']}"
        if one["state"] != "main" or one["precision"] != "strict":
            continue
        check(len(one["runs"]) == 10 and len(one["runs"][0]["rungs"]) >= 5, f"{name}: ten runs", len(one["runs"]))
        seeds = {run["seed"] for run in one["runs"]}
        check(len(seeds) == 10 and min(seeds) >= 4000000, f"{name}: seeds of the study's own", seeds)
        check(len(one["tiles"]) == 16 and 0 <= one["tiles_within"] <= 1, f"{name}: tiles", len(one["tiles"]))
        check(all(rung["wall_seconds"] > 0 for run in one["runs"] for rung in run["rungs"]), f"{name}: wall clock")
        if one["integrator"] in UNBIASED:
            low, high = one["energy_ratio"]["low"], one["energy_ratio"]["high"]
            check(low < 1.01 and high > 0.99, f"{name}: its light is the reference's", (low, high))
    radii = {one["radius_factor"]: one["radius"] for one in options if one["integrator"] == "vcm"}
    if 0.5 in radii:  # it was not far dearer than the best
        check(abs(radii[0.5] / radii[1] - 0.5) < 1e-6 and abs(radii[2] / radii[1] - 2) < 1e-6, "radii", radii)
    best = options[study["recommended"]]
    check(best["kind"] in {"measured", "interpolated", "extrapolated"} and not best["flags"], "recommended", best["kind"])
    pairs = {(pair["integrator"], pair["precision"]) for pair in study["pairs"]}
    check({p for _, p in pairs} >= {"mad", "fast"}, "precisions of the quickest", pairs)
    for pair in study["pairs"]:
        check(abs(pair["bias2"]) < 0.01 * study["target"] ** 2, "rounding is no part of the error", pair)

    before = [read_bytes("whole/" + name) for name in ("table.md", "report.html")]
    expect(0, ["study", "--report", "whole/study.json"])
    check(before == [read_bytes("whole/" + name) for name in ("table.md", "report.html")], "the same bytes again")


run_tests(globals())
