#!/usr/bin/env python3
"""The same image file, byte for byte, from one thread and from two.

Usage: threads_test.py path/to/pellucid   (exit 0: equal)
cli/plan_test.py sees that --threads does what it says.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "stability" / "everything.json"


def render(pellucid, method, threads, folder):
    name = pathlib.Path(folder) / f"{method}-{threads}.exr"
    subprocess.run([pellucid, "render", SCENE, "-i", method, "--size", "32x24", "--spp", "32",
                    "--threads", str(threads),
                    "--features", "all", "--aov", "variance,samples,length,tech", "--strict", "--deterministic",
                    "--quiet", "-o", name], check=True,
                   stdout=subprocess.DEVNULL, timeout=120)
    return name.read_bytes()


def main():
    pellucid = os.path.abspath(sys.argv[1])
    different = 0
    with tempfile.TemporaryDirectory() as folder:
        for method in ("naive", "nee", "path", "reference", "light", "bdpt", "sppm", "vcm"):
            images = [render(pellucid, method, threads, folder) for threads in (1, 2)]
            if images[0] != images[1]:
                different += 1
                print(f"FAILED: {method} gives another file with 2 threads than with 1")
    return 1 if different else 0


sys.exit(main())
