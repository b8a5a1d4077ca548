#!/usr/bin/env python3
"""Files stay under 400 lines and functions under 60, and every file says at its head what it is.

Usage: check_size.py SOURCE_DIR
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(sys.argv[1])
MOST_FILE, MOST_FUNCTION = 400, 60

errors = []
names = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard"],
                       check=True, stdout=subprocess.PIPE, text=True).stdout.split()
for name in names:
    path = ROOT / name
    if path.suffix not in (".h", ".cpp", ".cl", ".py", ".cmake", ".sh") or not path.exists():
        continue
    lines = path.read_text().splitlines()
    if len(lines) > MOST_FILE:
        errors.append(f"{name}: {len(lines)} lines, more than {MOST_FILE}")
    head = [line for line in lines[:3] if not line.startswith("#!")]
    if not head or not re.match(r'(//|#|""")\s*\S', head[0]):
        errors.append(f"{name}:1: the head does not say what the file is")
    if path.suffix not in (".h", ".cpp", ".cl"):
        continue
    start = None
    for number, line in enumerate(lines, 1):
        # A function's body opens on a line that ends in "{" and belongs to no type, namespace or table.
        if start is None and line.endswith("{") and ")" in line and not line.startswith("#"):
            indent = len(line) - len(line.lstrip())
            if indent <= 2 and not re.match(r"\s*(struct|class|enum|namespace|if|for|while|switch)\b", line):
                start, depth_indent = number, indent
        elif start is not None and line.startswith(" " * depth_indent + "}"):
            if number - start > MOST_FUNCTION:
                errors.append(f"{name}:{start}: a function of {number - start} lines, more than {MOST_FUNCTION}")
            start = None
print("\n".join(errors) or "all files and functions within size")
sys.exit(bool(errors))
