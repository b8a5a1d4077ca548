#!/usr/bin/env python3
"""No absolute epsilon hides in a kernel: numbers far from 1 have a name and a comment (numerics 10).

A float literal below 1/256 or above 256 in size must stand in a #define. Exceptions: coefficients
of series and steps of encodings, in functions that are held to double. Literals are counted, so that
a lint that finds none at all fails, too.

Usage: check_literals.py SOURCE_DIR
"""
import pathlib
import re
import sys

SMALL, LARGE = 1 / 256, 256
FLOAT = re.compile(r"(?<![\w.])(\d+\.\d*(?:[eE][+-]?\d+)?|\d+[eE][+-]?\d+|\.\d+(?:[eE][+-]?\d+)?|0x[\da-fA-F.]+p[+-]?\d+)f?\b")
EXCEPTIONS = {"core/math.h", "core/codes.h"}


def value_of(text):
    return float.fromhex(text) if text.startswith("0x") else float(text)


kernels = pathlib.Path(sys.argv[1]) / "kernels"
seen, bad = 0, []
for path in sorted([*kernels.rglob("*.h"), *kernels.rglob("*.cl")]):
    name = path.relative_to(kernels).as_posix()
    if name in EXCEPTIONS or name.startswith("naive/"):
        continue
    defining = False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        code = re.sub(r'//.*|/\*.*?\*/|"[^"]*"', "", line)
        defining = code.lstrip().startswith("#define") or (defining and previous.endswith("\\"))
        previous = code
        for match in FLOAT.finditer(code):
            seen += 1
            value = value_of(match.group(1))
            if value and not SMALL <= value <= LARGE and not defining:
                bad.append(f"{path}:{number}: {match.group(0)} has no name: {line.strip()}")
print("\n".join(bad) or f"{seen} float literals, those far from 1 named")
sys.exit(bool(bad) or seen < 100)
