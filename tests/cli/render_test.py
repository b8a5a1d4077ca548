#!/usr/bin/env python3
"""`pellucid render`: outputs, every option, statistics and the evidence in the EXR.

Usage: render_test.py path/to/pellucid   (exit 0: all checks hold)
"""
import json
import os
import shutil
import sys
import time

sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
from harness import (HEIGHT, QUICK, ROOM, SOURCE, WIDTH, check, document, expect, read_bytes, read_json,
                     run_tests, same_pixels, write_text)

METHODS = ("naive", "nee", "path", "reference", "light", "bdpt", "sppm", "bpm",
           "vcm")


def stats_of(*options):
    return document(["room.json", "-o", "stats.exr", *options])


def close(a, b, tolerance):
    return abs(a - b) <= tolerance * abs(b)


def read_ppm(name):
    """Rows of pixels of three bytes."""
    magic, size, depth, data = read_bytes(name).split(b"\n", 3)
    width, height = map(int, size.split())
    check((magic, depth) == (b"P6", b"255"), "a binary PPM with 8 bits")
    return [[data[3 * (y * width + x):][:3] for x in range(width)] for y in range(height)]


def test_default_outputs():
    os.mkdir("defaults")
    out, err = expect(0, ["../room.json", "--spp", "4"], "4 spp of 32x16 by path", cwd="defaults")
    check(out == "room.exr\nroom.png\n", "stdout has the paths and nothing else", out)
    check(sorted(os.listdir("defaults")) == ["room.exr", "room.png"], "written into the cwd")
    check("\x1b" not in err and "\r" not in err, "no control characters outside terminals", err)
    check(read_bytes("defaults/room.exr")[:4] == b"\x76\x2f\x31\x01", "an EXR file")
    check(read_bytes("defaults/room.png")[:8] == b"\x89PNG\r\n\x1a\n", "a PNG file")
    out, _ = expect(0, ["render", "sphere-light", "--spp", "1", "--size", "16x16", "-q"],
                    cwd="defaults")
    check(out == "sphere-light.exr\nsphere-light.png\n", "shipped scenes by name", out)


def test_outputs():
    names = ["a.exr", "b.png", "c.PPM", "d.tif"]
    out, _ = expect(0, [*QUICK, *[word for name in names for word in ("-o", name)]])
    check(out.splitlines() == names, "each -o is told", out)
    check(not os.path.exists("room.exr"), "-o replaces the default outputs")
    expect(2, [*QUICK, "-o", "picture"], "'picture'", "suffix", "exr")
    expect(2, [*QUICK, "-o", "folder.exr/picture"], "suffix")
    expect(2, [*QUICK, "-o", "x.exp"], "Did you mean 'exr'?")
    expect(0, [*QUICK, "-o", "a.EXR"])
    check(same_pixels("a.exr", "a.EXR"), "suffixes have no case")
    expect(0, ["--spp", "1", "-q", "-o", "a.exr", "room.json"])


def test_size_and_direction():
    expect(0, [*QUICK, "-o", "room.ppm"])
    rows = read_ppm("room.ppm")
    check((len(rows[0]), len(rows)) == (WIDTH, HEIGHT), "size of the scene")
    check(rows[HEIGHT // 4][3 * WIDTH // 4] == b"\xff\xff\xff", "the lamp is up and right", rows)
    check(max(rows[HEIGHT // 4][WIDTH // 4]) < 200, "and not left", rows)
    expect(0, [*QUICK, "--size", "7x5", "-o", "small.ppm"])
    rows = read_ppm("small.ppm")
    check((len(rows[0]), len(rows)) == (7, 5), "--size")


def test_budget():
    check(stats_of("--spp", "3")["spp"] == 3, "--spp")
    start = time.monotonic()
    stats = stats_of("--time", "1s")
    seconds = time.monotonic() - start
    check(1 <= seconds < 8 and stats["spp"] > 10 and stats["complete"], "--time", seconds, stats)
    check(stats_of("--time", "1h", "--spp", "2")["spp"] == 2, "the first budget reached counts")
    check(stats_of("--time", "0")["spp"] == 1, "no time at all still makes an image")


def test_seed():
    for name, *seed in (("0.exr",), ("0b.exr", "--seed", "0"), ("1.exr", "--seed", "1"),
                        ("1b.exr", "--seed", "1"), ("max.exr", "--seed", str(2**64 - 1))):
        expect(0, [*QUICK, "--deterministic", "-o", name, *seed])
    check(read_bytes("0.exr") == read_bytes("0b.exr"), "the default seed is 0")
    check(read_bytes("1.exr") == read_bytes("1b.exr"), "same seed, same bytes")
    check(not same_pixels("0.exr", "1.exr"), "another seed, another image")
    check(not same_pixels("0.exr", "max.exr"), "seeds have 64 bits")


def test_methods():
    stats = {name: stats_of("-i", name, "--spp", "256") for name in METHODS}
    for name in METHODS:
        check(stats[name]["integrator"] == name, f"{name} is what ran")
        check(close(stats[name]["mean"], stats["path"]["mean"], 0.05), f"{name} agrees",
              stats[name]["mean"], stats["path"]["mean"])
    expect(2, [*QUICK, "-i", "pth"], "'pth'", "naive", "reference", "Did you mean 'path'?")
    depths = [stats_of("--max-depth", str(depth), "--spp", "256")["mean"] for depth in (1, 2, 3)]
    check(depths[0] < depths[1] < depths[2] < stats["path"]["mean"], "--max-depth", depths)


def test_mis():
    for rule in ("balance", "power", "max"):
        expect(0, [*QUICK, "--mis", rule, "-o", rule + ".exr"])
    check(not same_pixels("balance.exr", "power.exr"), "power differs")
    check(not same_pixels("power.exr", "max.exr"), "max differs")
    expect(0, [*QUICK, "-i", "bdpt", "-o", "bdpt.exr"])
    expect(0, [*QUICK, "-i", "bdpt", "--mis", "power", "-o", "bdpt-power.exr"])
    check(not same_pixels("bdpt.exr", "bdpt-power.exr"), "power differs in bdpt")
    expect(2, [*QUICK, "-i", "bdpt", "--mis", "max"], "--mis max", "path")
    for method in ("naive", "nee", "reference", "light"):
        expect(0, [*QUICK, "-i", method, "--mis", "balance"])
        for rule in ("power", "max"):
            expect(2, [*QUICK, "-i", method, "--mis", rule], "--mis", method)
    expect(2, [*QUICK, "--mis", "powr"], "Did you mean 'power'?")


def test_sub_paths():
    """Light paths and the vertices of sub-paths."""
    stats = {n: stats_of("-i", "light", "--spp", "256", "--light-paths", str(n)) for n in (64, 4096)}
    for n, s in stats.items():
        check(close(s["mean"], stats_of("--spp", "256")["mean"], 0.05), f"{n} light paths", s)
    check(stats[4096]["rays"] > 4 * stats[64]["rays"], "more paths, more rays", stats)
    full, compact = (stats_of("-i", "bdpt", "--vertices", kind) for kind in ("full", "compact"))
    for side in ("light_vertices", "eye_vertices"):
        check(2 * compact["memory_bytes"][side] == full["memory_bytes"][side], "half the bytes", side)
    check(close(compact["mean"], full["mean"], 0.002), "compact is close", compact, full)
    names = [p["name"] for p in full["passes"]]
    check(names == ["light_trace", "camera_trace", "vertex_scan", "vertex_order", "connect",
                    "film_add"], "passes of bdpt", names)
    expect(2, [*QUICK, "--light-paths", "64"], "--light-paths", "'path'")
    expect(2, [*QUICK, "-i", "light", "--light-paths", "0"], "--light-paths")
    expect(2, [*QUICK, "-i", "light", "--vertices", "compact"], "--vertices", "'light'")
    tiled = ["textures", "--size", "16x12", "--spp", "1", "-i", "bdpt", "--vertices", "compact"]
    expect(0, [*tiled, "-o", "tiled.exr"])
    expect(3, [*tiled, "-D", "materials.grid along.texture.scale=[400, 400]", "-o", "tiled.exr"],
           "texture coordinates", "--vertices full")
    expect(2, [*QUICK, "-i", "bdpt", "--vertices", "small"], "--vertices", "full, compact")


def test_merging():
    """Radius, which vertices merge, and what is refused."""
    stats = {r: stats_of("-i", "sppm", "--spp", "64", "--radius", r) for r in ("0.02", "0.2")}
    check(stats["0.02"]["mean"] != stats["0.2"]["mean"], "--radius has an effect", stats)
    one, two = (stats_of("-i", "sppm", "--spp", "64", "--radius-alpha", a) for a in ("0.5", "1"))
    check(one["mean"] != two["mean"], "--radius-alpha has an effect", one, two)
    few, many = (stats_of("-i", "sppm", "--spp", "64", "--light-paths", n) for n in ("64", "2048"))
    check(close(few["mean"], many["mean"], 0.1) and many["rays"] > 2 * few["rays"],
          "--light-paths of sppm", few, many)
    every, first = (stats_of("-i", "vcm", "--spp", "64", "--merges", m) for m in ("all", "first"))
    check(every["mean"] != first["mean"] and close(every["mean"], first["mean"], 0.05), "--merges",
          every, first)
    names = [p["name"] for p in every["passes"]]
    check(names == ["light_trace", "vertex_scan", "vertex_order", "grid_keys", "grid_count",
                    "grid_scan", "grid_scatter", "grid_ranges", "camera_trace", "connect", "merge",
                    "film_add"], "passes of vcm", names)
    for bad in ("0", "-1", "nan", "inf", "1e99", "wide"):
        expect(2, [*QUICK, "-i", "sppm", "--radius=" + bad], "--radius", bad)
    for bad in ("0", "-1", "nan", "1.5", "x"):
        expect(2, [*QUICK, "-i", "sppm", "--radius-alpha=" + bad], "--radius-alpha", bad)
    for option, value in (("--radius", "1"), ("--radius-alpha", "0.7"), ("--merges", "first")):
        expect(2, [*QUICK, option, value], option, "'path'")
    expect(2, [*QUICK, "-i", "sppm", "--merges", "first"], "--merges", "'sppm'")
    expect(2, [*QUICK, "-i", "vcm", "--merges", "none"], "--merges", "all, first")
    expect(2, [*QUICK, "-i", "vcm", "--mis", "max"], "--mis max", "path")


def test_merging_of_nothing():
    """No light, nothing that holds photons, and more photons than fit, by every method that merges."""
    dark = json.loads(json.dumps(ROOM))
    del dark["lights"], dark["shapes"][0]["emission"]
    write_text("dark.json", json.dumps(dark))
    grey_is = ("room.json", "--dry-run", "-D")
    for method in ("sppm", "bpm", "vcm"):
        expect(0, ["dark.json", "--dry-run", "-i", method], "the scene has no light")
        expect(3, ["dark.json", "-i", method, "-o", "never.exr", "--strict"], "the scene has no light",
               "--strict")
        plan, _ = expect(0, [*grey_is, 'materials.grey={"type": "mirror"}', "-i", method])
        check(f"'{method}' merges nothing here" in plan and "none holds photons" in plan, "mirrors", plan)
        for alpha, holds in ((0.09, method != "sppm"), (0.11, True)):
            gloss = f'materials.grey={{"type": "conductor", "eta": 0.2, "k": 3, "alpha": {alpha}}}'
            plan, _ = expect(0, [*grey_is, gloss, "-i", method])
            check(("merges nothing here" in plan) != holds, f"gloss of {alpha} in {method}", plan)
        many = [*QUICK, "-i", method, "-o", "never.exr", "--light-paths"]
        expect(4, [*many, "1000000", "--memory", "64M"], "--memory allows 64.0 MiB",
               "all light paths at once", "fewer --light-paths", "--vertices compact")
        expect(4, [*many, "4294967294"], "buffer", "fewer --light-paths")
        expect(2, [*many, "4294967295"], "--light-paths", "4294967295")
        expect(2, [*many, "64", "--radius", "1e-9"], "--radius", "1e-09", "only from")
    check(not os.path.exists("never.exr"), "nothing is written after an error")
    expect(2, [*QUICK, "-i", "bpm", "--mis", "max"], "--mis max", "'bpm'")
    expect(0, ["dark.json", "--spp", "2", "-i", "vcm", "-o", "dark.exr"])
    statistics = document(["info", "dark.exr"])["statistics"]
    check(all(one["max"] == 0 for one in statistics.values()), "no light, no picture", statistics)


def test_aov():
    expect(0, [*QUICK, "--aov", "variance,samples", "-o", "aov.exr", "-o", "aov.png"])
    channels = document(["info", "aov.exr"])["channels"]
    check(channels == ["R", "G", "B", "variance.R", "variance.G", "variance.B", "samples"],
          "channels of --aov", channels)
    everything = ["Z", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "Ng.X", "Ng.Y", "Ng.Z", "albedo.R",
                  "albedo.G", "albedo.B", "id.object", "id.material"]
    expect(0, [*QUICK, "--aov", "id.material,Z,P,N,Ng,albedo,id.object,samples", "-o", "all.exr"])
    channels = document(["info", "all.exr"])["channels"]
    check(channels == ["R", "G", "B", "samples", *everything], "names of the contract", channels)
    check(same_pixels("aov.exr", "all.exr"), "AOVs change no colour")
    expect(0, ["room.json", "--spp", "8", "-q", "--aov", "Z", "--aov", "N", "-o", "two.exr"])
    channels = document(["info", "two.exr"])["channels"]
    check(channels == ["R", "G", "B", "Z", "N.X", "N.Y", "N.Z"], "--aov twice", channels)
    expect(2, [*QUICK, "--aov", "albdo"], "'albdo'", "Did you mean 'albedo'?", "id.object")
    expect(2, [*QUICK, "--aov", "varience"], "'varience'", "Did you mean 'variance'?")
    expect(2, [*QUICK, "--aov", "variance,nothing"], "'nothing'")


def test_sampler_and_filter():
    def settings(name):
        return document(["info", name])["metadata"]["pellucid:settings"]

    for sampler in ("sobol", "random"):
        expect(0, [*QUICK, "--sampler", sampler, "-o", sampler + ".exr"])
        check("filter gaussian sampler " + sampler in settings(sampler + ".exr"), "evidence of",
              sampler)
    filters = ("box", "tent", "gaussian", "blackman-harris")
    for name in filters:
        expect(0, [*QUICK, "--filter", name, "-o", name + ".exr"])
        check(f"filter {name} sampler sobol" in settings(name + ".exr"), "evidence of", name)
    for i, one in enumerate(filters):
        for other in filters[:i]:
            check(not same_pixels(one + ".exr", other + ".exr"), f"{one} is not {other}")
    expect(0, [*QUICK, "-o", "default.exr"])
    check(same_pixels("default.exr", "gaussian.exr"), "gaussian is the default filter")
    check(same_pixels("default.exr", "sobol.exr"), "sobol is the default sampler")
    check(not same_pixels("sobol.exr", "random.exr"), "random differs")

    scene = {**ROOM, "film": {**ROOM["film"], "filter": "tent"}}
    write_text("tents.json", json.dumps(scene))
    expect(0, ["tents.json", "--spp", "4", "-q", "-o", "scene.exr"])
    check(same_pixels("scene.exr", "tent.exr"), "the scene's filter")
    expect(0, ["tents.json", "--spp", "4", "-q", "--filter", "box", "-o", "flag.exr"])
    check(same_pixels("flag.exr", "box.exr"), "the flag wins over the scene")
    scene["film"]["filter"] = "tents"
    write_text("tents.json", json.dumps(scene))
    expect(3, ["tents.json"], "film.filter", "Did you mean 'tent'?")
    expect(2, [*QUICK, "--filter", "gausian"], "--filter", "Did you mean 'gaussian'?")
    expect(2, [*QUICK, "--sampler", "sobl"], "--sampler", "Did you mean 'sobol'?")
    out, _ = expect(0, ["render", "--help"])
    for word in (*filters, "sobol", "random", "id.material", "albedo"):
        check(word in out, f"--help tells of {word}")


def test_float_modes():
    """Modes round differently, so pictures differ, by hardly anything; strict is the default."""
    expect(0, [*QUICK, "-o", "default.exr"])
    means = {}
    for mode in ("strict", "mad", "fast"):
        means[mode] = stats_of(*QUICK[1:], "--float", mode, "-o", mode + ".exr")["mean"]
        check(document(["info", mode + ".exr"])["metadata"]["pellucid:floatMode"] == mode, mode)
        check(same_pixels("default.exr", mode + ".exr") == (mode == "strict"), "pixels by", mode)
    check(close(means["mad"], means["strict"], 1e-3), "mad is close", means)
    check(close(means["fast"], means["strict"], 1e-3), "fast is close", means)
    expect(0, [*QUICK, "--checkpoint", "strict.ckpt"])
    expect(3, [*QUICK, "--float", "mad", "--checkpoint", "strict.ckpt", "--resume"],
           "float is not given in the one and mad in the other")
    expect(2, [*QUICK, "--float", "fat"], "--float", "Did you mean 'fast'?")


def test_features():
    for name, features in (("auto", "auto"), ("all", "all"), ("more", "+phong,+disks")):
        stats = stats_of("--features", features, "-o", name + ".exr")
        on = {key for key, value in stats["features"].items() if value}
        check({"spheres", "triangles", "diffuse", "light_environment"} <= on, "what it needs", on)
        check(("phong" in on) == (name != "auto"), f"phong with {features}", on)
        check(("mirror" in on) == (name == "all"), f"mirror with {features}", on)
    check(same_pixels("auto.exr", "all.exr"), "code that is not needed changes nothing")
    check(same_pixels("auto.exr", "more.exr"), "nor does some of it")
    expect(2, [*QUICK, "--features", "+phng"], "'+phng'", "+phong", "Did you mean 'phong'?")
    expect(2, [*QUICK, "--features", "phong"], "'phong'", "+phong")


def test_work_group():
    for size in (1, 8, 64):
        expect(0, [*QUICK, "--deterministic", "--work-group", str(size), "-o", f"g{size}.exr"])
    check(read_bytes("g1.exr") == read_bytes("g8.exr") == read_bytes("g64.exr"), "the same bytes")


def test_kernel_dir():
    kernels = os.path.join(SOURCE, "kernels")
    expect(0, [*QUICK, "--deterministic", "-o", "inside.exr"])
    expect(0, [*QUICK, "--deterministic", "--kernel-dir", kernels, "-o", "outside.exr"])
    check(read_bytes("inside.exr") == read_bytes("outside.exr"), "the same kernels")
    expect(3, [*QUICK, "--kernel-dir", "none"], "none/passes/pt_mega.cl", "No such file")
    shutil.copytree(kernels, "broken")
    path = "broken/passes/film_add.cl"
    text = read_bytes(path).decode()
    lines = text[:text.index("F4 sample =")].count("\n") + 1
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace("F4 sample =", "F4 sample = nonsense +"))
    _, err = expect(4, [*QUICK, "--kernel-dir", "broken"], "'film_add' does not build",
                    f"passes/film_add.cl:{lines}:", "nonsense", "-cl-std=CL1.2")
    check("#line" not in err, "the log has no more than the log", err)
    os.remove("broken/core/math.h")
    expect(3, [*QUICK, "--kernel-dir", "broken"], "broken/core/math.h", ".h:")


KEYS = {"schema", "integrator", "spp", "paths", "rays", "seconds", "passes", "features",
        "counters", "memory_bytes", "error_estimate", "device", "driver"}


def test_stats():
    stats = document(["room.json", "--time", "2s", "--stats", "stats.json", "-o", "stats.exr"])
    check(KEYS <= set(stats), "keys of the contract", KEYS - set(stats))
    check(read_json("stats.json") == stats, "--stats FILE is the same document")
    seconds = stats["seconds"]
    check({"load", "bvh", "kernels", "render", "write"} < set(seconds), "phases", seconds)
    phases = [value for name, value in seconds.items() if name != "total"]
    # All but the microseconds between two looks at the clock.
    check(abs(sum(phases) - seconds["total"]) < 1e-3, "seconds add up", seconds)
    check(stats["paths"] == stats["spp"] * WIDTH * HEIGHT, "paths", stats)
    check(stats["rays"] > stats["paths"], "rays", stats)
    names = [one["name"] for one in stats["passes"]]
    check(names == ["pt_mega", "film_add"], "passes", names)
    for one in stats["passes"]:
        check(one["launches"] == stats["spp"] and one["seconds"] > 0, "launches", one)
    busy = sum(one["seconds"] for one in stats["passes"])
    check(0.5 * seconds["render"] < busy <= seconds["render"], "passes fill the render", busy)
    check(all(count == 0 for count in stats["counters"].values()), "counters", stats["counters"])
    check({"nonfinite", "negative", "stack_overflow"} <= set(stats["counters"]), "counter names")
    check(stats["memory_bytes"]["film"] == 192 * WIDTH * HEIGHT, "memory", stats["memory_bytes"])
    check(0 < stats["error_estimate"]["relmse"] < 0.1, "error", stats["error_estimate"])
    check("confidence" in stats["error_estimate"], "error_estimate has confidence")
    check(all(isinstance(on, bool) for on in stats["features"].values()), "features are booleans")
    check(stats["complete"] is True and stats["outputs"] == ["stats.exr"], "extensions", stats)


def project(point, matrix):
    """Row vector times matrix, divided by w."""
    row = [*point, 1.0]
    x, y, z, w = (sum(row[i] * matrix[4 * i + j] for i in range(4)) for j in range(4))
    return [x / w, y / w, z / w]


def test_evidence():
    expect(0, [*QUICK, "--seed", "9", "--sampler", "random", "-o", "full.exr"])
    expect(0, [*QUICK, "--seed", "9", "--sampler", "random", "--deterministic", "-o", "bare.exr"])
    full = document(["info", "full.exr"])["metadata"]
    bare = document(["info", "bare.exr"])["metadata"]
    ours = ["samplesPerPixel", "worldToCamera", "worldToNDC"] + [
        "pellucid:" + word for word in ("version", "sceneHash", "settings", "seed", "passes",
                                        "features", "floatMode", "counters", "relmseEstimate",
                                        "integrator", "unreachable")]
    of_host = ["renderTimeSeconds", "pellucid:device", "pellucid:driver"]
    for key in ours + of_host:
        check(key in full, f"evidence has {key}", full)
    check(set(full) - set(bare) == set(of_host), "--deterministic leaves out",
          set(full) ^ set(bare))
    check(full["samplesPerPixel"] == "4" and full["pellucid:seed"] == "9", "values", full)
    check(full["pellucid:counters"] == "all zero", "counters", full)
    to_camera = [float(word) for word in full["worldToCamera"].split()]
    to_ndc = [float(word) for word in full["worldToNDC"].split()]
    lamp = (2.5, 1.25, 0)
    for matrix, want, what in ((to_camera, (2.5, 1.25, -5), "camera"), (to_ndc, (0.5, 0.5), "NDC")):
        got = project(lamp, matrix)
        check(all(abs(a - b) < 1e-5 for a, b in zip(got, want)), f"world to {what}", got)
    check(all(abs(value) < 1e-5 for value in project((0, 0, 0), to_ndc)[:2]), "the middle")


run_tests(globals())
