#!/usr/bin/env python3
"""The JSON schema: every shipped scene is valid by it, and what the parser refuses, it refuses.

Usage: schema_test.py path/to/pellucid   (exit 0: all checks hold)
Needs python3-jsonschema.
"""
import copy
import json
import pathlib
import re
import sys

import jsonschema

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import ROOM, SOURCE, check, document, expect, run_tests, write_text

# A comment, or a string that may look like one and stays.
COMMENT = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)

# Every type of every family, with keys of every kind.
FULL = {
    **copy.deepcopy(ROOM),
    "$schema": "scene.schema.json",
    "description": "a bit of everything",
    "integrator": {"name": "path", "spp": 4, "maxDepth": 9},
    "materials": {
        "grey": {"type": "diffuse", "reflectance": {"srgb": [0.5, 0.5, 0.5]}},
        "mirror": {"type": "mirror", "reflectance": 1},
        "glass": {"type": "dielectric", "ior": 1.3, "alpha": 0.1},
        "gold": {"type": "conductor", "metal": "gold", "roughness": 0.2},
        "metal": {"type": "conductor", "eta": [1, 2, 3], "k": 4},
        "phong": {"type": "phong", "exponent": 9}},
    "shapes": [
        {"type": "disk", "material": "grey", "radius": 2, "flip": True, "sides": 1},
        {"type": "cube", "material": "gold", "size": [1, 2, 3], "transform": [
            {"translate": [0, 0, 1]}, {"scale": 2}, {"rotate": {"axis": [0, 1, 0], "degrees": 9}},
            {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]},
        {"type": "rectangle", "material": "grey", "center": [0, 0, 0], "size": [1, 1]},
        {"type": "rectangle", "material": "grey", "corner": [0, 0, 0],
         "edges": [[1, 0, 0], [0, 1, 0]]},
        {"type": "torus-knot", "material": "grey", "triangles": 1000, "p": 2, "q": 5},
        {"type": "height-field", "material": "grey", "triangles": 1000, "size": [1, 2]},
        {"type": "wave-surface", "material": "grey", "triangles": 1000, "waves": 3},
        {"type": "displaced-sphere", "material": "grey", "triangles": 1000, "seed": 4294967295}],
    "lights": [{"type": "point", "position": [0, 1, 0], "power": 3},
               {"type": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1]},
               {"type": "environment", "radiance": 0.5}],
}

# Path to a value of FULL, and what to put there; None removes it.
BROKEN = [
    (["camera"], None), (["version"], None), (["version"], 2), (["version"], "1"),
    (["camera", "fov"], 0), (["camera", "fov"], 180), (["camera", "fov"], "wide"),
    (["camera", "fovv"], 3), (["flim"], {}), (["film"], []), (["film", "width"], -5),
    (["film", "width"], 3.5), (["film", "width"], 32769), (["camera", "origin"], [0, 0]),
    (["camera", "origin"], [0, 0, "0"]), (["camera", "fovAxis"], "z"), (["description"], ""),
    (["description"], 5), (["integrator", "spp"], 0), (["integrator", "maxDepth"], 2**21),
    (["materials"], []), (["materials", "x"], {}), (["materials", "x"], {"type": "difuse"}),
    (["materials", "x"], 3), (["materials", ""], {"type": "diffuse"}),
    (["materials", "grey", "reflectance"], 1.5), (["materials", "grey", "reflectance"], [1, 2]),
    (["materials", "grey", "reflectance"], {"srgb": [0, 0, 2]}),
    (["materials", "grey", "reflectance"], {"rgb": [0, 0, 1]}),
    (["materials", "grey", "ior"], 1.5), (["materials", "gold", "metal"], "goald"),
    (["materials", "glass", "ior"], 100), (["shapes"], {}), (["shapes", 0], []),
    (["shapes", 0, "type"], "disc"), (["shapes", 0, "type"], None), (["shapes", 0, "radius"], -1),
    (["shapes", 0, "flip"], 1), (["shapes", 0, "sides"], 3), (["shapes", 0, "edges"], []),
    (["shapes", 1, "size"], [1, 2]), (["shapes", 1, "transform"], {}),
    (["shapes", 1, "transform", 0, "translate"], 3), (["shapes", 1, "transform", 0, "move"], 3),
    (["shapes", 1, "transform", 2, "rotate", "axis"], None),
    (["shapes", 1, "transform", 3, "matrix"], [1, 0, 0]), (["shapes", 2, "size"], [1]),
    (["shapes", 3, "edges"], [[1, 0, 0]]), (["shapes", 4, "triangles"], 10),
    (["shapes", 4, "triangles"], None), (["shapes", 7, "seed"], -1),
    (["shapes", 0, "emission"], {}), (["shapes", 0, "emission"], {"radiance": -1}),
    (["lights", 0, "position"], None), (["lights", 0, "radiance"], 1), (["lights", 2], None),
    (["lights", 1, "irradiance"], -1), (["lights", 2, "type"], "sky"), (["$schema"], 5),
]


def without_comments(text):
    return COMMENT.sub(lambda m: m.group() if m.group().startswith('"') else " ", text)


def broken(path, value):
    scene = copy.deepcopy(FULL)
    place = scene
    for key in path[:-1]:
        place = place[key]
    if value is not None:
        place[path[-1]] = value
    elif path == ["lights", 2]:
        place[2] = None  # null is no light
    else:
        del place[path[-1]]
    return scene


def validator():
    out, _ = expect(0, ["schema"])
    schema = json.loads(out)
    jsonschema.Draft202012Validator.check_schema(schema)
    check(document(["schema"])["scene_schema"] == schema, "--json has the same")
    return jsonschema.Draft202012Validator(schema)


def test_shipped_scenes_are_valid():
    judge = validator()
    files = [*pathlib.Path(SOURCE, "scenes").rglob("*.json"),
             *pathlib.Path(SOURCE, "tests/render/scenes").glob("*.json")]
    check(len(files) > 20, "there are scenes", files)
    for file in files:
        errors = list(judge.iter_errors(json.loads(without_comments(file.read_text("utf-8")))))
        check(not errors, f"{file} is valid", errors)


def test_parser_and_schema_agree():
    judge = validator()
    write_text("full.json", json.dumps(FULL))
    expect(0, ["info", "full.json"])
    check(judge.is_valid(FULL), "a bit of everything", list(judge.iter_errors(FULL)))
    for path, value in BROKEN:
        scene = broken(path, value)
        write_text("broken.json", json.dumps(scene))
        expect(3, ["info", "broken.json"], "broken.json")
        check(not judge.is_valid(scene), f"the schema refuses {path} = {value}")


def test_every_key_is_described():
    definitions = validator().schema["$defs"]
    check({"scene", "camera", "material", "shape", "light"} <= set(definitions), "definitions")
    for name, definition in definitions.items():
        for key, rule in definition.get("properties", {}).items():
            if "enum" in rule and key == "type":
                continue  # a family: each type describes itself
            check(rule.get("description"), f"{name}.{key} is described", rule)


run_tests(globals())
