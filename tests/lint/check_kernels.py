#!/usr/bin/env python3
"""Every pass compiles as OpenCL C 1.2 without warnings for 32- and 64-bit devices, for several sets of
features and widths. A second compiler beside the device's: it catches typos in flags, literals
without f, and anything only one driver accepts.

Usage: check_kernels.py SOURCE_DIR
"""
import itertools
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(sys.argv[1])
KERNELS = ROOT / "kernels"
FLAGS = re.findall(r"X\(((?:FEAT|INTG)_\w+),", (KERNELS / "shared/features.h").read_text())
EFFECTS = [f for f in FLAGS if f.startswith("FEAT_")]
METHODS = [[], ["INTG_NEE", "INTG_SOBOL"], ["INTG_NEE", "INTG_MIS", "INTG_SOBOL", "INTG_FILTER"],
           ["INTG_NEE", "INTG_MIS", "INTG_LAYERS"],
           ["INTG_NEE", "INTG_MIS", "INTG_RECORD"],
           ["INTG_SPLAT", "INTG_RECORD", "INTG_FILTER"],
           ["INTG_NEE", "INTG_MIS", "INTG_SPLAT", "INTG_CONNECT", "INTG_MERGE", "INTG_RECORD"],
           ["INTG_UNIFORM"], ["INTG_SPLAT", "INTG_LAYERS", "INTG_FILTER"],
           ["INTG_NEE", "INTG_MIS", "INTG_SPLAT", "INTG_CONNECT", "INTG_SOBOL", "INTG_FILTER"],
           ["INTG_NEE", "INTG_MIS", "INTG_SPLAT", "INTG_CONNECT", "INTG_COMPACT", "INTG_LAYERS"],
           ["INTG_NEE", "INTG_MIS", "INTG_MERGE", "INTG_SOBOL"], ["INTG_MERGE", "INTG_COMPACT"],
           ["INTG_NEE", "INTG_MIS", "INTG_SPLAT", "INTG_CONNECT", "INTG_MERGE", "INTG_COMPACT"],
           ["INTG_NEE", "INTG_MIS", "INTG_SPLAT", "INTG_CONNECT", "INTG_MERGE", "INTG_LAYERS"]]
# All but these: OpenCL mixes int and uint in every vector index and get_global_id; counts become
# floats of which 24 bits are meant; and of the functions of a header a build without an effect
# leaves parameters, or all, unused, which is what builds are for.
WARNINGS = ["-Wall", "-Wextra", "-Werror", "-Wdouble-promotion", "-Wundef", "-Wconversion",
            "-Wno-sign-conversion", "-Wno-implicit-int-float-conversion", "-Wno-unused-parameter",
            "-Wno-unused-function"]


def flags_of(path, seen):
    """Flags that a file or what it includes mentions: the others cannot change what is compiled."""
    if path in seen:
        return set()
    seen.add(path)
    text = path.read_text()
    found = set(FLAGS) & set(re.findall(r"\w+", text))
    for name in re.findall(r'#include "(.+)"', text):
        found |= flags_of(KERNELS / name, seen)
    return found


def compile_pass(name, triple, on, width, overlay=()):
    defines = [f"-D{f}={int(f in on)}" for f in FLAGS]
    defines += [f"-DSIMD_WIDTH={width}", "-DSIMD_BUILTINS=0", "-DFLOAT_CONTRACT=0",
                "-DFLOAT_REORDER=0", "-DBVH_STACK=64",
                f"-DDEV_INT64_ATOMICS={int(triple == 'spir64')}"]
    command = ["clang-15", "-x", "cl", "-cl-std=CL1.2", "-Xclang", "-finclude-default-header",
               "-fsyntax-only", "-target", triple, *(f"-I{KERNELS / folder}" for folder in overlay), f"-I{KERNELS}", *WARNINGS, *defines, str(name)]
    return subprocess.run(command, stderr=subprocess.PIPE, text=True)


sets = [set(EFFECTS), set(), {"FEAT_TRIANGLES", "FEAT_DIFFUSE", "FEAT_LIGHT_TRIANGLE"},
        {"FEAT_SPHERES", "FEAT_DIELECTRIC", "FEAT_LIGHT_ENVIRONMENT"},
        {"FEAT_DISKS", "FEAT_TEXTURE", "FEAT_DIFFUSE", "FEAT_LIGHT_POINT"}]
failed = count = 0
for path in sorted((KERNELS / "passes").glob("*.cl")):
    runs = [("spir64", effects, method, 16) for effects, method in itertools.product(sets, METHODS)]
    # 32-bit pointers and no 64-bit atomics, for every method.
    runs += [("spir", sets[0], method, 8) for method in METHODS]
    flags, seen_sets = flags_of(path, set()), set()
    for triple, effects, method, width in runs:
        key = (triple, width, frozenset(flags & (effects | set(method))))
        if key in seen_sets:
            continue
        seen_sets.add(key)
        count += 1
        done = compile_pass(path, triple, effects | set(method), width)
        if done.returncode:
            failed += 1
            print(f"{path.name} {triple} width {width} {method} {sorted(effects)}:\n{done.stderr[:2000]}")
# What the benchmark compares with (README.md): files of kernels/naive in place of those of geom.
for name, method in (("trace_closest", []), ("trace_any", []), ("pt_mega", METHODS[1]), ("pt_mega", METHODS[2])):
    count += 1
    done = compile_pass(KERNELS / "passes" / f"{name}.cl", "spir64", sets[2] | set(method), 16, ["naive"])
    if done.returncode:
        failed += 1
        print(f"{name}.cl with kernels/naive:\n{done.stderr[:2000]}")
print(f"{count} builds, {failed} failed")
sys.exit(bool(failed))
