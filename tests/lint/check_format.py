#!/usr/bin/env python3
"""Host code, kernels and tests are formatted as .clang-format says.

Usage: check_format.py SOURCE_DIR
"""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(sys.argv[1])
files = sorted(p for folder in ("host", "kernels", "tests") for p in (ROOT / folder).rglob("*")
               if p.suffix in (".h", ".cpp", ".cl"))
done = subprocess.run(["clang-format-14", "--dry-run", "--Werror", *files], cwd=ROOT,
                      stderr=subprocess.PIPE, text=True)
print(done.stderr[:4000] or f"{len(files)} files formatted")
sys.exit(done.returncode)
