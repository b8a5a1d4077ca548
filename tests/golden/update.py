#!/usr/bin/env python3
"""Renders the goldens of goldens.txt anew and prints how far they are from the old ones.

Usage: update.py --pellucid BIN [--only SCENE]   (exit 0: all written; 1: the tree is dirty)
A golden says which code made it, so the git tree must be clean (new goldens excepted).
"""
import argparse
import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def entries():
    for line in (HERE / "goldens.txt").read_text().splitlines():
        words = line.split("#")[0].split()
        if words:
            yield words


def dirty_files():
    out = subprocess.run(["git", "-C", HERE, "status", "--porcelain"], check=True,
                         stdout=subprocess.PIPE, text=True).stdout
    return [line for line in out.splitlines() if not line.endswith(".exr")]


def error_against(pellucid, new, old):
    """Energy ratio and relMSE of the new golden against the old one, or why there is none."""
    if not old.exists():
        return "new"
    done = subprocess.run([pellucid, "compare", new, old, "--json", "-"], stdout=subprocess.PIPE,
                          text=True)
    if done.returncode != 0:
        return "cannot be compared with the old one"
    result = json.loads(done.stdout)
    return f"energy x {result['energy_ratio']:.5f}, relMSE {result['relmse']:.3g} to the old one"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pellucid", required=True, type=pathlib.Path)
    parser.add_argument("--only", help="one scene")
    options = parser.parse_args()
    dirty = dirty_files()
    if dirty:
        print("The git tree is dirty; commit first, so that a golden's commit tells its code:",
              *dirty[:10], sep="\n", file=sys.stderr)
        return 1
    pellucid = options.pellucid.resolve()
    for scene, method, size, spp in entries():
        if options.only not in (None, scene):
            continue
        golden, fresh = HERE / f"{scene}.exr", HERE / f"{scene}.new.exr"
        subprocess.run([pellucid, "render", scene, "-i", method, "--size", size, "--spp", spp,
                        "--seed", "1", "--sampler", "random", "--filter", "box", "--aov", "variance,samples", "--strict", "--deterministic",
                        "--quiet", "-o", fresh], check=True, stdout=subprocess.DEVNULL)
        print(f"{scene}: {method}, {spp} spp, {error_against(pellucid, fresh, golden)}", flush=True)
        fresh.replace(golden)
    return 0


sys.exit(main())
