#!/usr/bin/env python3
"""FLIP by an implementation of its own: plain two-dimensional sums in double, straight from the papers.

[Andersson20] FLIP: A Difference Evaluator for Alternating Images; [Andersson21] Visualizing Errors in
Rendered High Dynamic Range Images. Usage: flip_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import math
import random
import struct
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import check, document, run_tests

PPD = 3840 / 0.7 * 0.7 * math.pi / 180
WHITE = (0.950428545, 1.0, 1.088900371)  # D65 as published with the metric
XYZ = ((0.4123866, 0.3575915, 0.1804505), (0.2126368, 0.7151830, 0.0721802),
       (0.0193306, 0.1191972, 0.9503726))
RGB = ((3.241003275, -1.537398934, -0.498615861), (-0.969224334, 1.875930071, 0.041554224),
       (0.055639423, -0.204011202, 1.057148933))


def product(matrix, v):
    return [sum(m * x for m, x in zip(row, v)) for row in matrix]


def ycxcz(rgb):
    x, y, z = (v / w for v, w in zip(product(XYZ, rgb), WHITE))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def linear(opponent):
    y = (opponent[0] + 16) / 116
    xyz = (y + opponent[1] / 500, y, y - opponent[2] / 200)
    return [min(max(v, 0), 1) for v in product(RGB, [v * w for v, w in zip(xyz, WHITE)])]


def hunt_lab(rgb):
    def f(t):
        return t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29
    x, y, z = (f(v / w) for v, w in zip(product(XYZ, rgb), WHITE))
    lightness = 116 * y - 16
    return lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)


def hyab(a, b):
    return abs(a[0] - b[0]) + math.hypot(a[1] - b[1], a[2] - b[2])


def convolve(plane, kernel, radius):
    """kernel[(dx, dy)]; what is outside is like the border."""
    height, width = len(plane), len(plane[0])
    return [[sum(w * plane[min(max(y + dy, 0), height - 1)][min(max(x + dx, 0), width - 1)]
                 for (dx, dy), w in kernel.items()) for x in range(width)] for y in range(height)]


def square(radius):
    return [(x, y) for x in range(-radius, radius + 1) for y in range(-radius, radius + 1)]


def spatial_kernel(ppd, terms):
    radius = math.ceil(3 * math.sqrt(0.04 / (2 * math.pi ** 2)) * ppd)
    kernel = {(x, y): sum(a * math.sqrt(math.pi / b) * math.exp(-math.pi ** 2 * (x * x + y * y) / ppd ** 2 / b)
                          for a, b in terms) for x, y in square(radius)}
    total = sum(kernel.values())
    return {at: w / total for at, w in kernel.items()}, radius


def feature_kernel(ppd, points, swap):
    sigma = 0.5 * 0.082 * ppd
    radius = math.ceil(3 * sigma)
    kernel = {}
    for x, y in square(radius):
        along = y if swap else x
        gaussian = math.exp(-(x * x + y * y) / (2 * sigma * sigma))
        kernel[x, y] = ((along / sigma) ** 2 - 1 if points else -along) * gaussian
    above = sum(w for w in kernel.values() if w > 0)
    below = -sum(w for w in kernel.values() if w < 0)
    return {at: w / (above if w > 0 else below) for at, w in kernel.items()}, radius


def features(luminance, ppd, points):
    x = convolve(luminance, *feature_kernel(ppd, points, False))
    y = convolve(luminance, *feature_kernel(ppd, points, True))
    return [[math.hypot(v, w) for v, w in zip(*rows)] for rows in zip(x, y)]


def prepared(image, ppd):
    """Hunt-adjusted Lab after filtering, edges, points; of rows of linear colours in [0, 1]."""
    opponent = [[ycxcz(rgb) for rgb in row] for row in image]
    csf = ([(1, 0.0047)], [(1, 0.0053)], [(34.1, 0.04), (13.5, 0.025)])
    planes = [convolve([[v[c] for v in row] for row in opponent], *spatial_kernel(ppd, csf[c]))
              for c in range(3)]
    lab = [[hunt_lab(linear(v)) for v in zip(*rows)] for rows in zip(*planes)]
    luminance = [[(v[0] + 16) / 116 for v in row] for row in opponent]
    return lab, features(luminance, ppd, False), features(luminance, ppd, True)


def ldr_flip(image, reference, ppd):
    most = hyab(hunt_lab((0, 1, 0)), hunt_lab((0, 0, 1))) ** 0.7
    knee = 0.4 * most
    a, b = prepared(image, ppd), prepared(reference, ppd)
    result = []
    for y, row in enumerate(image):
        result.append([])
        for x in range(len(row)):
            colour = hyab(a[0][y][x], b[0][y][x]) ** 0.7
            colour = 0.95 / knee * colour if colour < knee else \
                0.95 + (colour - knee) / (most - knee) * 0.05
            feature = max(abs(a[i][y][x] - b[i][y][x]) for i in (1, 2))
            result[-1].append(colour ** (1 - (feature / math.sqrt(2)) ** 0.5))
    return result


def aces(x):
    top, bottom = 0.9036 * x * x + 0.018 * x, 0.8748 * x * x + 0.354 * x + 0.14
    return min(max(top / bottom, 0), 1)


def hdr_flip(image, reference, ppd):
    luminance = sorted(0.2126 * r + 0.7152 * g + 0.0722 * b for row in reference for r, g, b in row)
    middle = len(luminance) // 2
    median = (luminance[middle] + luminance[-1 - middle]) / 2
    low, high = 0.0, 100.0
    for _ in range(200):
        mid = (low + high) / 2
        low, high = (mid, high) if aces(mid) < 0.85 else (low, mid)
    start, stop = math.log2(low / luminance[-1]), math.log2(low / median)
    count = max(2, math.ceil(stop - start))
    maps = []
    for i in range(count):
        scale = 2 ** (start + (stop - start) * i / (count - 1))
        shot = [[[[aces(v * scale) for v in rgb] for rgb in row] for row in picture]
                for picture in (image, reference)]
        maps.append(ldr_flip(*shot, ppd))
    return [[max(values) for values in zip(*rows)] for rows in zip(*maps)], count


def mean(rows):
    return sum(map(sum, rows)) / sum(map(len, rows))


def write_pfm(name, rows):
    """Rows from the top; the format wants them from the bottom."""
    with open(name, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (len(rows[0]), len(rows)))
        for row in reversed(rows):
            file.write(struct.pack("<%df" % (3 * len(row)), *[v for rgb in row for v in rgb]))


def single(v):
    return struct.unpack("<f", struct.pack("<f", v))[0]


def pictures(width, height, brightest):
    """A coloured ramp with an edge, a dot and noise; and a version of it that is off in all of these."""
    rng = random.Random(width)
    reference, image = [], []
    for y in range(height):
        reference.append([])
        image.append([])
        for x in range(width):
            level = (x + 1) / width * (0.2 if y < height // 2 else 1)
            if (x, y) == (width // 3, height // 3):
                level = 1
            rgb = [single(brightest * level ** 2 * tint) for tint in (1, 0.6, 0.3)]
            reference[-1].append(rgb)
            off = 1.1 if x > width // 2 else 1 + 0.3 * (rng.random() - 0.5)
            image[-1].append([single(v * off * tint) for v, tint in zip(rgb, (1, 1, 0.9))])
    return image, reference


def test_ldr():
    image, reference = pictures(23, 14, 1.0)
    clipped = [[[min(v, 1) for v in rgb] for rgb in row] for row in image]
    write_pfm("a.pfm", image)
    write_pfm("b.pfm", reference)
    # Another distance makes other filters.
    for options, ppd in (([], PPD), (["--ppd", "30"], 30)):
        ours = document(["compare", "a.pfm", "b.pfm", *options])["flip"]
        theirs = mean(ldr_flip(clipped, reference, ppd))
        print(f"LDR, {ppd:.1f} ppd: {ours:.9f} against {theirs:.9f}")
        # Published constants have nine digits and matrices here seven; maps are stored as floats.
        check(abs(ours - theirs) < 1e-6, f"LDR-FLIP at {ppd} pixels per degree", ours, theirs)
        check(0.01 < theirs < 0.5, "the pictures differ", theirs)


def test_hdr():
    image, reference = pictures(13, 9, 20.0)
    write_pfm("a.pfm", image)
    write_pfm("b.pfm", reference)
    theirs, count = hdr_flip(image, reference, 25)
    ours = document(["compare", "a.pfm", "b.pfm", "--ppd", "25"])["hdr_flip"]
    print(f"HDR, {count} exposures: {ours:.9f} against {mean(theirs):.9f}")
    check(count > 2 and abs(ours - mean(theirs)) < 1e-6, "HDR-FLIP", count, ours, mean(theirs))


run_tests(dict(globals()))
