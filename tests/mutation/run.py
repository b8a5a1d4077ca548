#!/usr/bin/env python3
"""Mutation suite: plants each fault of faults/ in a copy of the kernels; the test that it names must turn red.

Usage: run.py KERNELS TEST_BINARY... [--only WORD]

A fault is a unified diff without line numbers, below lines that say what goes wrong in the world. It applies only
where what it replaces is found exactly once. The copy reaches tests as `--kernel-dir` would, through the
environment (tests/support/kernel_folder.h): the product knows no faults. Each test must first pass on a copy
without any. Red is an expectation that failed; a program that does not build, crashes or hangs proves nothing.
"""
import argparse
import os
import pathlib
import queue
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import time

FAULTS = pathlib.Path(__file__).resolve().parent / "faults"
SECONDS = 1800  # most that one test may take: it is a minute, unless many share the processor


class Fault:
    """Its name, the test `BINARY FILTER` that must see it, and what it replaces by what in which file."""

    def __init__(self, path):
        self.name = path.stem
        text = path.read_text()
        told = re.search(r"^# Test: (\S+) (\S+)$", text, re.M)
        if not told:
            sys.exit(f"{path}: no line '# Test: BINARY FILTER'")
        self.test = told.groups()
        self.hunks = []
        name = before = after = None
        for number, line in enumerate(text.splitlines(), 1):
            if line.startswith("#"):
                continue
            if line.startswith("--- "):
                name = line[4:]
            elif line == "@@":
                before, after = [], []
                self.hunks.append((name, before, after))
            elif self.hunks and line[:1] in (" ", "-", "+"):
                if line[0] != "+":
                    before.append(line[1:])
                if line[0] != "-":
                    after.append(line[1:])
            else:
                sys.exit(f"{path}:{number}: neither context nor a change: {line!r}")
        if not self.hunks:
            sys.exit(f"{path}: changes nothing")

    def plant(self, kernels):
        for name, before, after in self.hunks:
            file, old = kernels / name, "".join(line + "\n" for line in before)
            text = file.read_text()
            # Whole lines: what comes before the first starts a line, too.
            count = ("\n" + text).count("\n" + old)
            if count != 1:
                sys.exit(f"fault {self.name}: {name} has these lines {count} times, not once:\n{old}"
                         "The kernels have changed: plant the same fault in what they are now.")
            file.write_text(("\n" + text).replace("\n" + old, "\n" + "".join(line + "\n" for line in after))[1:])


def lines_of(process):
    """Lines of its output as they come; ends with None."""
    lines = queue.Queue()

    def read():
        for line in process.stdout:
            lines.put(line.rstrip("\n"))
        lines.put(None)
    threading.Thread(target=read, daemon=True).start()
    return lines


def verdict_of(process):
    """('red' | 'green' | 'broken', place or reason): the first failure decides, the rest is not awaited."""
    lines, end, place, tests, last = lines_of(process), time.monotonic() + SECONDS, None, 0, ""
    while True:
        try:
            line = lines.get(timeout=max(0.0, end - time.monotonic()))
        except queue.Empty:
            return "broken", f"no end after {SECONDS} s"
        if line is None:
            break
        if place == "unknown file":
            return "broken", line  # an exception: the next line says which
        failure = re.match(r"(unknown file|.*:\d+): Failure$", line)
        if failure:
            place = failure.group(1).split("/")[-1]
            if place != "unknown file":
                return "red", place
        passed = re.match(r"\[  PASSED  \] (\d+) test", line)
        tests = int(passed.group(1)) if passed else tests
        last = line or last
    code = process.wait()
    if code == 0 and tests:
        return "green", f"{tests} passed"
    return "broken", "no such test" if code == 0 else f"exit code {code}: {last}"


def run(binary, pattern, kernels):
    """Verdict, its reason, and seconds of processors: those on the clock say more about the neighbours."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = {**os.environ, "PELLUCID_TEST_KERNELS": str(kernels)}
    process = subprocess.Popen([binary, f"--gtest_filter={pattern}", "--gtest_color=no"], env=environment, text=True,
                               errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        verdict, reason = verdict_of(process)
    finally:
        process.kill()  # nothing more to be learnt
        process.wait()
    now = resource.getrusage(resource.RUSAGE_CHILDREN)
    return verdict, reason, now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kernels", type=pathlib.Path)
    parser.add_argument("binaries", nargs="+", type=pathlib.Path)
    parser.add_argument("--only", default="", help="faults with this in their names")
    options = parser.parse_args()
    binaries = {path.name: path for path in options.binaries}
    faults = [Fault(path) for path in sorted(FAULTS.glob("*.diff"))]
    faults = [fault for fault in faults if options.only in fault.name]
    if not faults:
        sys.exit("no fault has such a name")
    sound, seen, start = {}, 0, time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        for fault in faults:  # all of them before the first test, which takes a while
            fault.kernels = pathlib.Path(scratch) / fault.name
            shutil.copytree(options.kernels, fault.kernels)
            fault.plant(fault.kernels)
        plain = pathlib.Path(scratch) / "plain"
        shutil.copytree(options.kernels, plain)
        print("Seconds of processors: with the fault, and of the test without any, the first time it is named.")
        print(f"{'fault':<20} {'test':<62} verdict  seconds   sound  where")
        for fault in faults:
            binary, pattern = fault.test
            if binary not in binaries:
                sys.exit(f"fault {fault.name}: {binary} is not among the binaries given")
            before = ""
            if fault.test not in sound:
                sound[fault.test], reason, seconds = run(binaries[binary], pattern, plain)
                before = f"{seconds:.1f}"
                if sound[fault.test] != "green":
                    print(f"without any fault {binary} {pattern} is {sound[fault.test]}: {reason}")
            verdict, place, seconds = run(binaries[binary], pattern, fault.kernels)
            if sound[fault.test] != "green":
                verdict = "broken"
            seen += verdict == "red"
            print(f"{fault.name:<20} {pattern:<62} {verdict:<7}  {seconds:7.1f} {before:>7}  {place}", flush=True)
    print(f"{time.monotonic() - start:.0f} seconds on the clock")
    print(f"mutation score: {seen} of {len(faults)}")
    sys.exit(seen != len(faults))


if __name__ == "__main__":
    main()
