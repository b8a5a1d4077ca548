#!/usr/bin/env python3
"""What a scene argument can be, and what -D changes: models, overrides, their errors, the hash.

Usage: scene_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import struct
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import (QUICK, ROOM, SOURCE, check, document, expect, read_bytes, run_tests, same_pixels,
                     write_text)

# A box around the origin with two different sides, so that views differ.
VERTICES = [(x, y, z) for z in (-1, 1) for y in (-0.5, 0.5) for x in (-2, 2)]
FACES = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]


def obj(scale=1.0):
    return ("".join("v %r %r %r\n" % tuple(scale * c for c in v) for v in VERTICES) +
            "".join("f %d %d %d %d\n" % tuple(i + 1 for i in f) for f in FACES))


def ply(order):
    name = {"<": "binary_little_endian", ">": "binary_big_endian", "": "ascii"}[order]
    head = (f"ply\nformat {name} 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
            "property float z\nproperty uchar red\nelement face 6\n"
            "property list uchar uint vertex_indices\nend_header\n").encode()
    if not order:
        lines = ["%r %r %r 9" % v for v in VERTICES] + ["4 %d %d %d %d" % f for f in FACES]
        return head + "\n".join(lines).encode() + b"\n"
    return (head + b"".join(struct.pack(order + "3fB", *v, 9) for v in VERTICES) +
            b"".join(struct.pack(order + "B4I", 4, *f) for f in FACES))


def write_models():
    write_text("box.obj", obj())
    for order, name in (("", "ascii"), ("<", "little"), (">", "big")):
        with open(name + ".ply", "wb") as file:
            file.write(ply(order))


def mean_and_edge(name):
    """Mean of the picture, and whether its outermost pixels are all background."""
    magic, size, _, data = read_bytes(name).split(b"\n", 3)
    check(magic == b"P6", "a PPM")
    width, height = map(int, size.split())
    at = lambda x, y: data[3 * (y * width + x)]
    edge = [at(x, y) for x in range(width) for y in (0, height - 1)]
    edge += [at(x, y) for y in range(height) for x in (0, width - 1)]
    return sum(data) / len(data), set(edge)


def test_models_render():
    write_models()
    size = ["--spp", "16", "--size", "48x48", "--deterministic"]
    for name in ("box.obj", "ascii.ply", "little.ply", "big.ply"):
        out, err = expect(0, [name, *size, "-o", name + ".exr", "-o", name + ".ppm"],
                          "camera at [", "directional light of irradiance")
        check(out == f"{name}.exr\n{name}.ppm\n", "stdout has the paths alone", out)
        check(err.count("\n") == 3, "one line each, and the result", err)
        check(same_pixels("box.obj.exr", name + ".exr"), f"{name} is the same model")
        mean, edge = mean_and_edge(name + ".ppm")
        check(100 < mean < 160, f"{name} is well exposed", mean)
        check(edge == {137}, f"{name} lies within the picture", edge)
    expect(0, ["render", "box.obj", "--spp", "1", "-q"])
    check(os.path.exists("box.exr") and os.path.exists("box.png"), "named after the model")


def test_any_scale_and_aspect():
    for scale in (1e-9, 1e9):
        write_text("scaled.obj", obj(scale))
        expect(0, ["scaled.obj", "--spp", "16", "--size", "48x48", "-q", "-o", "scaled.ppm"])
        mean, edge = mean_and_edge("scaled.ppm")
        reference, _ = mean_and_edge("box.obj.ppm")
        # Only rounding differs; a few pixels of the outline may fall to the other side.
        check(abs(mean - reference) < 2 and edge == {137}, f"scale {scale}", mean, reference, edge)
    for size in ("96x24", "24x96"):
        expect(0, ["box.obj", "--spp", "4", "--size", size, "--filter", "box", "-q", "-o", "aspect.ppm"])
        check(mean_and_edge("aspect.ppm")[1] == {137}, f"all visible at {size}")


def test_info_and_kernels_of_models():
    info = document(["info", "little.ply"])
    check(info["triangles"] == 12 and info["name"] == "little", "info of a model", info)
    check(info["light_kinds"] == {"directional": 1, "environment": 1}, "its lights", info)
    check(len(info["notes"]) == 2 and not info["warnings"], "its notes", info["notes"])
    expect(0, ["kernels", "box.obj"])
    box = document(["info", os.path.join(SOURCE, "scenes/gallery/cornell-box.obj")])
    check(box["light_kinds"] == {"mesh": 1}, "a model with a lamp gets no other light", box)
    check(len(box["notes"]) == 1, "and only the camera is told", box["notes"])


def test_broken_models():
    write_text("cut.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n")
    expect(3, ["cut.obj"], "cut.obj:3:", "vertex 3")
    with open("cut.ply", "wb") as file:
        file.write(ply("<")[:-2])
    expect(3, ["cut.ply"], "cut.ply: byte ", "ends too early")
    write_text("bad.ply", ply("").decode().replace("4 0 4 6 2", "4 0 4 6 8"))
    expect(3, ["bad.ply"], "bad.ply:19:", "8 is no vertex index (0 to 7)")
    expect(3, ["none.ply"], "none.ply")
    expect(3, ["model.stl"], "model.stl")


def test_overrides():
    for option, key, value in (("film.width=20", "width", 20), ("/film/width=20", "width", 20),
                               ("integrator.spp=7", "spp", 7), ("integrator.name=nee", "integrator",
                                                                "nee"),
                               ("description=hello", "description", "hello"),
                               ("shapes=[]", "shapes", 0)):
        info = document(["info", "room.json", "-D", option])
        check(info[key] == value, f"-D {option}", info[key])
        check(info["overrides"] == [option], "told", info["overrides"])
    info = document(["info", "box.obj", "-D", "film.width=20", "-D", "film.height=10",
                     "-D", "materials.grey={\"type\": \"conductor\", \"metal\": \"gold\"}",
                     "-D", "lights.0={\"type\": \"environment\", \"radiance\": 1}"])
    check((info["width"], info["height"]) == (20, 10), "film of a bare model", info)
    check(info["material_kinds"] == {"conductor": 1}, "material of a bare model", info)
    check(info["light_kinds"] == {"environment": 1}, "light of a bare model", info)
    expect(0, [*QUICK, "-D", "shapes.0.emission.radiance=0.5", "-o", "dim.exr"])
    expect(0, [*QUICK, "-o", "lit.exr"])
    check(not same_pixels("dim.exr", "lit.exr"), "an override changes the picture")
    expect(0, ["kernels", "room.json", "-D", "materials.grey.type=mirror",
               "-D", "materials.grey.reflectance=1"])
    out, _ = expect(0, [*QUICK, "-D", "film.width=20", "--size", "8x6", "-o", "s.exr", "--json", "-"])
    check(json.loads(out)["width"] == 8, "--size wins", out)


def test_errors_name_the_option():
    cases = {
        "camera.fov=1000": ["-D camera.fov=1000: camera.fov: 1000 is out of range"],
        "camera.fov=wide": ["a number is needed here, not a text"],
        "camra.fov=3": ["unknown key \"camra\"", "Did you mean 'camera'?"],
        "film.widht=3": ["Did you mean 'width'?"],
        "shapes.0.material=gray": ["there is no material \"gray\"", "Did you mean 'grey'?"],
        "shapes.7.radius=1": ["no item \"7\""],
        "version.x=1": ["called \"x\""],
        "materials.gray.reflectance=1": ["needs the key \"type\"", "Did you mean 'grey'?"],
    }
    for option, parts in cases.items():
        for command in ("render", "info", "kernels"):
            _, err = expect(3, [command, "room.json", "-D", option], "-D " + option, *parts)
            check("room.json:" not in err, "no line of the file is blamed", err)
    for option in ("camera.fov", "=3", "a..b=1", ""):
        expect(2, ["room.json", "-D", option], "-D")
    expect(2, ["info", "lit.exr", "-D", "a=1"], "-D changes scenes")


def test_hash():
    plain = document(["info", "room.json"])["hash"]
    check(plain == document(["info", "room.json"])["hash"], "the hash is a function of the scene")
    changed = document(["info", "room.json", "-D", "camera.fov=90"])["hash"]
    other = document(["info", "room.json", "-D", "camera.fov=91"])["hash"]
    check(len({plain, changed, other}) == 3, "-D is part of it", plain, changed, other)
    write_text("spaced.json", json.dumps(ROOM) + "\n")
    check(document(["info", "spaced.json"])["hash"] != plain, "so is every byte of the file")
    expect(0, [*QUICK, "-D", "camera.fov=90", "-o", "hashed.exr"])
    evidence = document(["info", "hashed.exr"])["metadata"]["pellucid:sceneHash"]
    check(evidence == changed, "the EXR has it", evidence)
    size = [document(["--dry-run", "room.json", "--size", s])["scene_hash"] for s in ("8x8", "9x9")]
    check(size == [plain, plain], "--size is no change of the scene", size)
    box = document(["info", "box.obj"])["hash"]
    write_text("box.obj", obj() + "# more\n")
    check(document(["info", "box.obj"])["hash"] != box, "models count")


def test_far_scenes():
    """A scene a million units away is the one at the origin, but for where its picture says it is."""
    def moved(x):
        room = json.loads(json.dumps(ROOM))
        for place in (room["camera"]["origin"], room["camera"]["target"], room["shapes"][0]["center"],
                      room["shapes"][1]["center"], room["shapes"][2]["corner"]):
            place[0] += x
        write_text(f"room{x:.0f}.json", json.dumps(room))
        _, err = expect(0, [f"room{x:.0f}.json", "--spp", "16", "-o", f"room{x:.0f}.exr"])
        check(("its coordinates are counted from 1000000 0 0" in err) == (x > 0) and "warning" not in err, f"told at {x}", err)
        return document(["info", f"room{x:.0f}.exr"])["metadata"]["worldToCamera"].split()

    near, far = moved(0), moved(1e6)
    check(abs(float(far[12]) + 1e6) < 1 and far[:12] == near[:12], "where the camera is", near, far)
    # 1e6 is a whole multiple of 32, twice its size.
    check(same_pixels("room1000000.exr", "room0.exr"), "the same bits")


run_tests(globals())
