#!/usr/bin/env python3
"""A study's report as browsers draw it: headless Chromium shows the page in both colour schemes.

Usage: report_page_test.py path/to/sample_report   (exit 0: all checks hold; 77: no Chromium here)
Needs the packages chromium and openimageio-tools.
"""
import collections
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

SAMPLE_REPORT = sys.argv[1]
# PATH, and where Debian and others put it.
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
# Methods of the sample study that have runs: those stand in the charts.
DRAWN = ("vcm", "bdpt", "path", "light", "sppm", "nee", "naive", "reference")
failures = []


def check(holds, what, detail=""):
    print(("ok: " if holds else "FAILED: ") + what, "" if holds else detail)
    if not holds:
        failures.append(what)


def chromium(folder, page, *options):
    """Standard error, where the browser tells what it refused."""
    done = subprocess.run(
        [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
         "--enable-logging=stderr", f"--user-data-dir={folder / 'profile'}", *options, page.as_uri()],
        capture_output=True, check=False, text=True, timeout=120)
    check(done.returncode == 0, "the browser ends well", done.stderr)
    return done.stderr


def colours(folder, page, width, height, *options):
    """Number of pixels of every colour, and what the browser refused."""
    picture, plain = folder / "page.png", folder / "page.ppm"
    told = chromium(folder, page, f"--screenshot={picture}", f"--window-size={width},{height}", *options)
    subprocess.run(["oiiotool", picture, "--ch", "R,G,B", "-o", plain], check=True)
    data = plain.read_bytes()
    head = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
    check(head and (int(head[1]), int(head[2])) == (width, height), "the screenshot has the window's size")
    return collections.Counter(pixel for pixel, in struct.iter_unpack("3s", data[head.end():])), told


def palette(block):
    """Colours that a rule of the style sheet defines."""
    return {name: bytes.fromhex(value) for name, value in re.findall(r"--([\w-]+):#([0-9a-f]{6});", block)}


def check_scheme(name, found, told, wanted):
    total = sum(found.values())
    ground = found[wanted["ground"]]
    check(0.5 * total < ground < 0.97 * total, f"{name}: the ground shows, and something on it", f"{ground} of {total}")
    check(len(found) > 100, f"{name}: letters and pictures have many colours", str(len(found)))
    check(found[wanted["ink"]] > 500, f"{name}: there is text", str(found[wanted["ink"]]))
    for method in DRAWN:
        # A mark beside a name has ten pixels at least that no edge touches, on narrow pages too.
        check(found[wanted[method]] >= 10, f"{name}: the colour of {method}", str(found[wanted[method]]))
    check("Refused to" not in told and "violates" not in told, f"{name}: nothing was refused", told)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        page = folder / "report.html"
        subprocess.run([SAMPLE_REPORT, page], check=True)
        text = page.read_text(encoding="utf-8")
        root = xml.etree.ElementTree.fromstring(text.split("\n", 1)[1])  # without the doctype
        check(root.tag == "html" and len(root.findall(".//svg")) > 3, "the page is XML")
        light, dark = (palette(block) for block in re.findall(r":root\{(.*?)\}", text))
        check_scheme("light", *colours(folder, page, 1200, 1100, "--blink-settings=preferredColorScheme=1"), light)
        check_scheme("dark, narrow", *colours(folder, page, 600, 1300, "--blink-settings=preferredColorScheme=0"), dark)
        paper = folder / "page.pdf"
        chromium(folder, page, f"--print-to-pdf={paper}")
        check(paper.exists() and paper.read_bytes()[:5] == b"%PDF-", "it prints")
    return 1 if failures else 0


if CHROMIUM is None:
    print("there is no Chromium here; the package is chromium")
    sys.exit(77)
sys.exit(main())
