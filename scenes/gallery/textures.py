#!/usr/bin/env python3
"""Draws the images of the scene `textures`: uv-grid.png, whose cells are labelled A1 (bottom left) to
H8, and planks.png, wooden planks that repeat without a seam; and of `pool`: tiles.png, four by four
tiles that do so too.

Usage: textures.py [FOLDER]   (default: beside this script)
"""
import pathlib
import random
import struct
import sys
import zlib

# 5 x 7 pixels per letter, one string of 0 to 31 in hexadecimal pairs per row from the top.
FONT = {"A": "0e11111f111111", "B": "1e11111e11111e", "C": "0e11101010110e", "D": "1e11111111111e",
        "E": "1f10101e10101f", "F": "1f10101e101010", "G": "0e11101711110f", "H": "1111111f111111",
        "1": "040c040404040e", "2": "0e11010204081f", "3": "1f02040201110e", "4": "02060a121f0202",
        "5": "1f101e0101110e", "6": "0608101e11110e", "7": "1f010204080808", "8": "0e11110e11110e"}


def write_png(path, rows):
    """Rows from the top, of (r, g, b) from 0 to 255."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    raw = b"".join(b"\0" + bytes(v for pixel in row for v in pixel) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"sRGB", b"\0") +
                     chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def uv_grid(cells=8, size=64):
    """Red grows with u, green with v; every other cell is light; a frame shows where it ends."""
    side = cells * size
    rows = []
    for y in range(side):
        row = []
        for x in range(side):
            column, line = x // size, cells - 1 - y // size
            light = (column + line) % 2
            colour = tuple(int(c * (1.0 if light else 0.7)) for c in
                           (70 + 180 * x / side, 70 + 180 * (side - y) / side, 200 - 120 * x / side))
            label = "ABCDEFGH"[column] + "12345678"[line]
            col, top = (x % size - 10) // 4, (y % size - 18) // 4
            if 0 <= col < 11 and col != 5 and 0 <= top < 7:
                bits = int(FONT[label[col // 6]][2 * top:2 * top + 2], 16)
                if bits >> (4 - col % 6) & 1:
                    colour = (20, 20, 30) if light else (245, 245, 235)
            if min(x, y, side - 1 - x, side - 1 - y) < 4:
                colour = (250, 250, 250)
            row.append(colour)
        rows.append(row)
    return rows


def planks(count=4, size=256):
    """Each plank has its own brown and its own streaks along x, and ends where another does not."""
    generator = random.Random(7)
    height = size // count
    rows = []
    for plank in range(count):
        shade = generator.uniform(0.75, 1.0)
        end = size * (2 * plank % count + plank // 2) // count
        streaks = [generator.uniform(0.86, 1.0) for _ in range(height)]
        for line in range(height):
            row = []
            for x in range(size):
                tone = shade * streaks[line] if line >= 2 and (x - end) % size >= 2 else 0.3
                row.append(tuple(int(c * tone) for c in (196, 140, 88)))
            rows.append(row)
    return rows


def tiles(count=4, size=32):
    """Grey, so that a material gives them their colour; no two of the same shade."""
    generator = random.Random(3)
    shades = [[generator.uniform(0.82, 1.0) for _ in range(count)] for _ in range(count)]
    rows = []
    for y in range(count * size):
        row = []
        for x in range(count * size):
            joint = min(x % size, y % size) < 2
            row.append((int(255 * (0.55 if joint else shades[y // size][x // size])),) * 3)
        rows.append(row)
    return rows


folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
write_png(folder / "uv-grid.png", uv_grid())
write_png(folder / "planks.png", planks())
write_png(folder / "tiles.png", tiles())
