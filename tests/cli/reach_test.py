#!/usr/bin/env python3
"""What a method cannot see, as info, --dry-run, render, its statistics and its pictures tell it.

Usage: reach_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import sys

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import SOURCE, check, document, expect, read_json, run_tests, write_text

# Of point lights, where there are spread and delta surfaces; and of emitters, by chance alone. What
# merges sees all there is.
UNSEEN = {"naive": "anything lit by ", "reference": "anything lit by ",
          "nee": "(L S+ D ... E)", "path": "(L S+ D ... E)", "light": "(L ... D S+ E)",
          "bdpt": "(L S+ D S+ E)", "sppm": None, "bpm": None, "vcm": None}
EMITTER = {"type": "sphere", "material": "grey", "center": [1, 2, 0], "radius": 0.2,
           "emission": {"radiance": 5}}
POINT = {"type": "point", "position": [1, 2, 0], "intensity": 3}


def scene(name, lights=(), shapes=(), ball="glass"):
    """A ball over a floor; the glass is there whether or not anything is made of it."""
    write_text(name + ".json", json.dumps({
        "version": 1, "camera": {"origin": [0, 1, 5], "target": [0, 0, 0]},
        "film": {"width": 16, "height": 8},
        "materials": {"grey": {"type": "diffuse", "reflectance": 0.5},
                      "glass": {"type": "dielectric", "ior": 1.5}},
        "shapes": [{"type": "rectangle", "material": "grey", "corner": [-8, -1, -8],
                    "edges": [[0, 0, 16], [16, 0, 0]]},
                   {"type": "sphere", "material": ball, "center": [0, 0, 0], "radius": 0.7},
                   *shapes], "lights": list(lights)}))
    return name + ".json"


def methods_of(*arguments):
    return document(["info", *arguments])["integrators"]


def test_info():
    name = scene("point", [POINT])
    methods = methods_of(name)
    check(set(methods) <= set(UNSEEN), "methods that this test knows", methods)
    text, _ = expect(0, ["info", name])
    for method, facts in methods.items():
        what = facts["unreachable"]
        check(facts["by_chance"] == [], f"{method}: chance finds no point", facts)
        if UNSEEN[method] is None:
            check(what == [], f"{method} sees all", facts)
            continue
        check(len(what) == 1 and UNSEEN[method] in what[0] and "point lights" in what[0],
              f"{method} names the class", facts)
        check(f"            cannot see {what[0]}\n" in text, f"{method} as text", text)
    for depth, blind in ((1, ()), (2, ("naive", "reference")),
                         (3, ("naive", "reference", "nee", "path", "light"))):
        for method, facts in methods_of(name, "-D", f"integrator.maxDepth={depth}").items():
            check(bool(facts["unreachable"]) == (method in blind), f"{method}, depth {depth}", facts)


def test_no_false_alarms():
    scenes = (scene("sky", [{"type": "environment", "radiance": 1}]),
              scene("black", [{**POINT, "intensity": 0}]), scene("dark"))
    for name in scenes:
        for method, facts in methods_of(name).items():
            expected = method == "light" and name == "sky.json"
            check(bool(facts["unreachable"]) == expected, f"{method} in {name}", facts)
            check(facts["by_chance"] == [], f"{method} in {name}: no small light", facts)
    for method, facts in methods_of(scene("plain", [POINT], ball="grey")).items():
        blind = method in ("naive", "reference")
        check(bool(facts["unreachable"]) == blind, f"{method}: nothing is made of the glass", facts)


def test_by_chance():
    for method, facts in methods_of(scene("emitter", shapes=[EMITTER])).items():
        if UNSEEN[method] is None:
            check(facts["by_chance"] == facts["unreachable"] == [], f"{method} sees all", facts)
            continue
        key, other = ("by_chance", "unreachable")[::-1 if method == "light" else 1]
        check(len(facts[key]) == 1 and UNSEEN[method] in facts[key][0] and
              "emitting surfaces" in facts[key][0] and facts[other] == [], method, facts)


def test_shipped_scenes():
    """Of what the scenes for merging were made to show, other methods find less or nothing."""
    for name, key in (("pool", "unreachable"), ("mirror-caustic", "unreachable"),
                      ("glass-lamp", "by_chance"), ("mixed-room", "by_chance")):
        methods = methods_of(os.path.join(SOURCE, f"scenes/gallery/{name}.json"))
        for method, facts in methods.items():
            light = method == "light"  # its camera meets no lamp by chance
            blind = facts["unreachable" if light else key]
            check(bool(blind) == (UNSEEN[method] is not None), f"{method} in {name}", facts)


def test_render():
    name = scene("point", [POINT])
    for depth in (2, 9):
        for method, facts in methods_of(name, "-D", f"integrator.maxDepth={depth}").items():
            what = facts["unreachable"]
            options = [name, "-i", method, "--spp", "1", "--max-depth", str(depth)]
            _, err = expect(0, [*options, "--strict", "-o", "a.exr", "--stats", "a.json"])
            blind = f"pellucid: '{method}' cannot see "
            check(err.count(blind) == len(what), f"{method} says it once", err)
            for one in what:
                check(blind + one + "; " in err and " can" in err.split(one)[1],
                      f"{method} names the class and who can see it", err)
            check("warning" not in err, "that is no warning", err)
            check(read_json("a.json")["unreachable"] == what, f"{method}: statistics")
            metadata = document(["info", "a.exr"])["metadata"]
            check(metadata["pellucid:unreachable"] == ("; ".join(what) or "nothing"),
                  f"{method}: evidence", metadata)
            if method in ("naive", "reference"):
                check(read_json("a.json")["mean"] == 0, f"{method} is black, as it says")
            plan = document([*options, "--dry-run"])
            check(plan["unreachable"] == what and plan["by_chance"] == facts["by_chance"],
                  f"{method}: the plan", plan)
    out, _ = expect(0, [name, "-i", "naive", "--dry-run"])
    check("  unseen    'naive' cannot see anything lit by point lights; " in out, "plan as text", out)
    out, _ = expect(0, [scene("emitter", shapes=[EMITTER]), "-i", "naive", "--dry-run"])
    check("  by chance anything lit by emitting surfaces" in out, "chance in the plan", out)
    _, err = expect(0, [name, "-i", "naive", "--spp", "1", "--quiet"])
    check(err == "", "--quiet is silent", err)


def test_a_checkpoint_knows():
    name = scene("point", [POINT])
    expect(0, [name, "-i", "naive", "--passes", "0:1", "--checkpoint", "a.ckpt", "-q"])
    expect(0, ["merge", "a.ckpt", "-o", "merged.exr"])
    metadata = document(["info", "merged.exr"])["metadata"]
    check(metadata["pellucid:unreachable"] == "anything lit by point lights", "evidence", metadata)


run_tests(globals())
