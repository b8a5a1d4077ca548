#!/usr/bin/env python3
"""Writes the models of the scenes `hidden-light-room` (lamp.obj, sconce.obj), `keyhole`
(keyhole-wall.obj, keyhole-plate.obj) and `mixed-room` (lamp.obj and shade.obj). Front sides are
outwards; lengths are metres.

Usage: models.py [FOLDER]   (default: beside this script)
"""
import math
import pathlib
import sys


def write_obj(path, comment, vertices, faces):
    lines = [f"# {comment} Written by models.py."]
    lines += ["v " + " ".join(f"{x:.5g}" for x in v) for v in vertices]
    lines += ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    path.write_text("\n".join(lines) + "\n")


def lathe(profile, slices, first=0.0, turn=360.0):
    """Turns a profile of (radius, y) about the y axis; outside is to the right of its way."""
    whole = turn == 360.0
    columns = slices if whole else slices + 1
    vertices = []
    for i in range(columns):
        angle = math.radians(first + turn * i / slices)
        vertices += [(r * math.sin(angle), y, r * math.cos(angle)) for r, y in profile]
    n, faces = len(profile), []
    for i in range(slices):
        a, b = i * n, (i + 1) % columns * n
        for k in range(n - 1):
            quad = [a + k, b + k, b + k + 1, a + k + 1]
            # On the axis both columns meet in one point.
            if profile[k][0] == 0:
                quad.remove(b + k)
            if profile[k + 1][0] == 0:
                quad.remove(b + k + 1)
            faces.append(quad)
    return vertices, faces


def plate(width, height, center, z_back, z_front, hole):
    """A plate across the z axis with a hole, `hole(angle)` being its radius about `center` = (x, y)."""
    corners = [math.atan2(y, x) for x in (-width / 2, width / 2)
               for y in (-height / 2 - center[1], height / 2 - center[1])]
    circle = [math.pi * i / 36 for i in range(-35, 37)]
    angles = {round(angle, 9) for angle in corners + circle + SLOT}
    vertices, faces = [], []
    for angle in sorted(angles):
        c, s = math.cos(angle), math.sin(angle)
        to_side = width / 2 / abs(c) if abs(c) > 1e-9 else math.inf
        to_end = (math.copysign(height / 2, s) - center[1]) / s if abs(s) > 1e-9 else math.inf
        for radius in (hole(angle), min(to_side, to_end)):
            vertices += [(center[0] + radius * c, center[1] + radius * s, z)
                         for z in (z_back, z_front)]
    count = len(angles)
    for i in range(count):
        a, b = 4 * i, (i + 1) % count * 4  # of each: inner back, inner front, outer back, outer front
        faces += [(a + 1, a + 3, b + 3, b + 1), (a, b, b + 2, a + 2), (a, a + 1, b + 1, b),
                  (a + 2, b + 2, b + 3, a + 3)]
    return vertices, faces


# The keyhole: a round hole with a slot below it that widens a little downwards.
RADIUS, SLOT_TOP, SLOT_BOTTOM, SLOT_DEPTH = 0.09, 0.045, 0.07, 0.3
SLOT_JOIN = math.asin(SLOT_TOP / RADIUS)  # angles from straight down
SLOT_CORNER = math.atan2(SLOT_BOTTOM, SLOT_DEPTH)
SLOT = [-math.pi / 2 + side * a for side in (-1, 1) for a in (SLOT_JOIN, SLOT_CORNER)]


def keyhole(angle, grow=0.0):
    down = abs(angle + math.pi / 2)
    if down >= SLOT_JOIN - 1e-8:
        return RADIUS + grow
    if down <= SLOT_CORNER + 1e-8:
        return (SLOT_DEPTH + grow) / math.cos(down)
    join = (SLOT_TOP, RADIUS * math.cos(SLOT_JOIN))  # the slot's side: a line from the join
    side = (SLOT_BOTTOM - join[0], SLOT_DEPTH - join[1])
    s, c = math.sin(down), math.cos(down)
    return grow + (join[0] * side[1] - join[1] * side[0]) / (s * side[1] - c * side[0])


def main(folder):
    lamp = [(0.17, -0.01), (0.17, 0.02), (0.03, 0.045), (0.016, 0.08), (0.016, 1.40), (0.06, 1.43),
            (0.15, 1.76), (0.14, 1.76), (0.05, 1.445), (0, 1.44)]
    write_obj(folder / "lamp.obj", "A lamp that shines upwards only.", *lathe(lamp, 48))
    sconce = [(0.12, -0.16), (0.12, 0.16), (0.112, 0.16), (0.112, -0.16), (0.12, -0.16)]
    write_obj(folder / "sconce.obj", "Half a tube to stand before a wall at z = 0.",
              *lathe(sconce, 24, -93.0, 186.0))
    shade = [(0, 0.095), (0.026, 0.095), (0.115, -0.06), (0.12, -0.06), (0.03, 0.1), (0, 0.1)]
    write_obj(folder / "shade.obj", "A shade, open below, for a light at the origin.",
              *lathe(shade, 48))
    write_obj(folder / "keyhole-wall.obj", "A wall with a keyhole.",
              *plate(3.3, 2.5, (0, -0.1), -0.05, 0.05, keyhole))
    write_obj(folder / "keyhole-plate.obj", "A metal plate around the keyhole.",
              *plate(0.42, 0.8, (0, 0.1), 0.04, 0.06, lambda angle: keyhole(angle, 0.015)))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
