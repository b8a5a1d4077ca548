#!/usr/bin/env python3
"""The command-line frame and `pellucid compare`: every exit code, results, and what idiff misses.

Usage: compare_test.py path/to/pellucid   (exit 0: all checks hold)
Needs idiff from the package openimageio-tools.
"""
import json
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile

PELLUCID = os.path.abspath(sys.argv[1])
failures = []


def run(*arguments, **options):
    """Runs pellucid in the scratch folder; returns (exit code, stdout, stderr)."""
    done = subprocess.run([options.pop("program", PELLUCID), *arguments], text=True, timeout=60,
                          stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE,
                          **options)
    return done.returncode, done.stdout, done.stderr


def check(condition, what, *details):
    if not condition:
        failures.append(what)
        print("FAILED:", what, *details, sep="\n  ")


def expect(code, arguments, *parts, **options):
    """The exit code is `code` and stderr has every part; nothing of ours ever crashes."""
    got, out, err = run(*arguments, **options)
    what = "pellucid " + " ".join(arguments)
    check(got == code, f"{what}: exit code {got}, not {code}", out, err)
    for part in parts:
        check(part in err, f"{what}: stderr lacks {part!r}", err)
    return out, err


def write_pfm(name, values, width=8, height=4):
    """Portable Float Map, which the image library reads: three floats per pixel."""
    with open(name, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (width, height))
        file.write(struct.pack("<%df" % len(values), *values))


def make_images():
    good = [0.25, 0.5, 1.0] * 32
    write_pfm("good.pfm", good)
    write_pfm("brighter.pfm", [1.1 * v for v in good])
    for name, value in (("nan.pfm", float("nan")), ("inf.pfm", float("inf"))):
        write_pfm(name, good[:40] + [value] + good[41:])
    write_pfm("smaller.pfm", good[:84], width=7)
    write_pfm("cut.pfm", good[:50])
    with open("text.exr", "w", encoding="ascii") as file:
        file.write("no picture at all")


def test_frame():
    out, _ = expect(0, ["--help"])
    check("compare" in out, "--help lists the commands", out)
    out, _ = expect(0, ["--version"])
    for word in ("pellucid ", "commit ", "build "):
        check(word in out, f"--version tells {word}", out)
    out, _ = expect(0, ["compare", "--help"])
    check("Example:\n  pellucid compare " in out, "help has an example", out)
    check("Usage: pellucid compare [" in out, "help has a usage line", out)
    expect(2, [], "missing", "--help")
    expect(2, ["compre", "a", "b"], "'compre'", "Did you mean 'compare'?")
    expect(2, ["--quiet", "compare", "a", "b"], "pellucid compare ... --quiet")


def test_usage():
    pair = ["compare", "good.pfm", "good.pfm"]
    expect(2, ["compare"], "A is required", "pellucid compare --help")
    expect(2, ["compare", "good.pfm"], "B is required")
    expect(2, ["compare", "--fail-abov", "relmse=1", "a", "b"], "Did you mean '--fail-above'?")
    expect(2, [*pair, "third.pfm"], "third.pfm")
    expect(2, [*pair, "--json"], "--json")
    expect(2, [*pair, "-q", "-v"], "--quiet excludes --verbose")
    expect(2, [*pair, "--fail-above", "remlse=1"], "'remlse'", "Did you mean 'relmse'?")
    expect(2, [*pair, "--fail-above", "ssim=1"], "'ssim'", "relmse")
    expect(2, [*pair, "--fail-above", "bias2=1"], "bias2", "--with")
    expect(2, [*pair, "--map", "flip"], "--map", "-o")
    expect(2, [*pair, "--map", "flop", "-o", "x.png"], "'flop'", "Did you mean 'flip'?")
    expect(2, [*pair, "--map", "z", "-o", "x.png"], "good.pfm", "--aov variance")
    expect(2, [*pair, "--ztest"], "good.pfm", "--aov variance")
    expect(2, [*pair, "--ztest-tile", "1%"], "--ztest-tile", "no effect")
    for value in ("0", "101%", "-1", "nan"):
        expect(2, [*pair, "--ztest", "--ztest-image=" + value], "--ztest-image")
    for value in ("0.5", "1001", "x"):
        expect(2, [*pair, "--ppd", value], "--ppd")
    for value in ("", "x", "nan", "-1", "1e-3x"):
        expect(2, [*pair, "--fail-above", "relmse=" + value], "--fail-above relmse")
    expect(2, [*pair, "--fail-above", "relmse"], "metric=value")


def test_gates():
    pair = ["compare", "brighter.pfm", "good.pfm"]
    out, _ = expect(0, pair)
    names = ("nonfinite", "mse", "rmse", "relmse", "trimmed_relmse", "smape", "flip", "hdr_flip",
             "p95_tile_relmse", "worst_tile_relmse", "tiles_within_1pct", "energy_ratio",
             "worst_channel_energy", "firefly_index")
    for name in names:
        check(f"\n{name} " in "\n" + out, f"the table has {name}", out)
    expect(0, [*pair, "--fail-above", "relmse=2%", "--fail-above", "energy_ratio=0.11"])
    for gate in ("mse=1e-3", "rmse=0.06", "relmse=0.9%", "smape=0.09", "p95_tile_relmse=0.009",
                 "energy_ratio=0.09", "trimmed_relmse=0.9%", "flip=0.01", "hdr_flip=0.01",
                 "worst_tile_relmse=0.9%", "tiles_within_1pct=99%", "worst_channel_energy=9%",
                 "firefly_index=0.99"):
        out, _ = expect(1, [*pair, "--fail-above", "mse=9", "--fail-above", gate])
        check(out.count("FAILS") == 1 and out.count("holds") == 1, f"{gate} is shown", out)
    # Energy may be missing as well as in excess.
    expect(1, ["compare", "good.pfm", "brighter.pfm", "--fail-above", "energy_ratio=0.09"])
    expect(0, ["compare", "good.pfm", "good.pfm", "--fail-above", "relmse=0"])


def test_json():
    out, _ = expect(1, ["compare", "brighter.pfm", "good.pfm", "--json", "-", "--fail-above",
                        "relmse=1e-9"])
    document = json.loads(out)
    check(document["schema"] == 1 and document["nonfinite"] == 0, "JSON has a schema", out)
    check(abs(document["energy_ratio"] - 1.1) < 1e-6, "JSON has the ratio", out)
    check(abs(document["mse"] - 0.01 * (0.0625 + 0.25 + 1) / 3) < 1e-8, "JSON has the MSE", out)
    for name in ("trimmed_relmse", "flip", "hdr_flip", "worst_tile_relmse", "firefly_index"):
        check(0 < document[name] <= 1, f"JSON has {name}", out)
    check(document["worst_tile"] == {"x0": 0, "x1": 8, "y0": 0, "y1": 4}, "and where it is", out)
    check(document["tiles_within_1pct"] == 0, "no tile is near", out)
    check(all(abs(ratio - 1.1) < 1e-6 for ratio in document["energy_ratio_by_channel"])
          and len(document["energy_ratio_by_channel"]) == 3, "energy by channel", out)
    check("ztest" not in document and "variance" not in document, "nothing that was not asked", out)
    check(document["gates"] == [{"metric": "relmse", "limit": 1e-9, "holds": False}], "gates", out)
    out, _ = expect(1, ["compare", "nan.pfm", "good.pfm", "--json", "nan.json"])
    check("FAILS" in out, "the table goes to stdout beside a JSON file", out)
    with open("nan.json", encoding="utf-8") as file:
        document = json.load(file, parse_constant=lambda name: check(False, "JSON has " + name))
    check(document["nonfinite"] == 1 and document["relmse"] is None, "NaN is null", document)


def test_failures():
    good = "good.pfm"
    expect(3, ["compare", "none.exr", good], "none.exr", "No such file")
    expect(3, ["compare", good, "."], "'.'", "Is a directory")
    expect(3, ["compare", "text.exr", good], "text.exr")
    expect(3, ["compare", "cut.pfm", good], "cut.pfm")
    expect(3, ["compare", "smaller.pfm", good], "smaller.pfm", good, "7x4 against 8x4")
    expect(5, ["compare", good, good, "-o", "no/diff.png"], "no/diff.png", "No such file")
    expect(2, ["compare", good, good, "-o", "diff.nonsense"], "diff.nonsense")
    expect(5, ["compare", good, good, "--json", "no/x.json"], "no/x.json", "No such file")
    with open("/dev/full", "w", encoding="ascii") as full:
        expect(5, ["compare", good, good], "standard output", "No space left", stdout=full)
    check(not [name for name in os.listdir(".") if name.startswith(".pellucid")],
          "no temporary files are left", os.listdir("."))


def test_diff_picture():
    out, _ = expect(1, ["compare", "nan.pfm", "good.pfm", "-o", "diff.png"])
    check(out.endswith("diff.png\n"), "the path is a result", out)
    with open("diff.png", "rb") as file:
        check(file.read(8) == b"\x89PNG\r\n\x1a\n", "diff.png is a PNG")
    expect(0, ["compare", "diff.png", "diff.png", "--fail-above", "mse=0"])
    for name in ("relative", "flip", "hdr-flip", "signed"):
        expect(0, ["compare", "brighter.pfm", "good.pfm", "--map", name, "-o", name + ".png"])
        expect(0, ["compare", "brighter.pfm", "good.pfm", "--map", name, "-o", name + ".exr"])
    out, _ = expect(0, ["info", "signed.png", "--json", "-"])
    means = [json.loads(out)["statistics"][channel]["mean"] for channel in "RGB"]
    check(means[0] > means[1] > means[2], "too bright is red", means)


def test_several_runs():
    """Runs 1 +- 0.1 by pixel about good.pfm, whose truth is known: variance 0.01 v^2, bias as given."""
    rng = random.Random(3)
    good = [0.25, 0.5, 1.0] * 32
    for k in range(8):
        write_pfm(f"run{k}.pfm", [v * (1 + 0.1 * rng.gauss(0, 1)) for v in good])
        write_pfm(f"off{k}.pfm", [v * (1.2 + 0.1 * rng.gauss(0, 1)) for v in good])
    others = ["--with", *(f"run{k}.pfm" for k in range(1, 8))]
    out, _ = expect(0, ["compare", "run0.pfm", "good.pfm", *others, "--json", "-"])
    document = json.loads(out)
    check(document["runs"] == 8 and len(document["with"]) == 7, "all are named", document)
    # 96 values x 7 degrees: s^2 is known to sqrt(2/672) = 5.5 %; three of these.
    check(abs(document["relvariance"] / 0.01 - 1) < 0.17, "the variance of one run", document)
    check(abs(document["relbias2"]) < 1e-3 < document["relvariance"], "no bias", document)
    check(document["relbias2"] < document["relbias2_upper90"] < 4e-3, "bounded", document)
    low, high = document["relvariance_interval90"]
    check(low < document["relvariance"] < high, "within its interval", document)
    check(not document["reference_variance_subtracted"], "good.pfm tells none", document)
    others = [word for k in range(1, 8) for word in ("--with", f"off{k}.pfm")]
    pair = ["compare", "off0.pfm", "good.pfm", *others]
    out, _ = expect(1, [*pair, "--fail-above", "relbias2=0.03"])
    check("FAILS" in out and "taken as exact" in out and "of 8 runs" in out, "bias shows", out)
    expect(0, [*pair, "--fail-above", "relbias2=0.045", "--fail-above", "relbias2_upper90=0.05",
               "--fail-above", "relvariance=0.013", "--fail-above", "bias2=1",
               "--fail-above", "variance=1", "--fail-above", "bias2_upper90=1"])
    expect(1, ["compare", "run0.pfm", "good.pfm", "--with", "nan.pfm"])
    expect(3, ["compare", "run0.pfm", "good.pfm", "--with", "run0.pfm"], "run0.pfm", "same samples")
    expect(3, ["compare", "run0.pfm", "good.pfm", "--with", "good.pfm"], "same samples")
    expect(3, ["compare", "run0.pfm", "good.pfm", "--with", "smaller.pfm"], "smaller.pfm", "sizes")
    expect(3, ["compare", "run0.pfm", "good.pfm", "--with", "none.pfm"], "none.pfm")


def test_not_finite():
    """idiff 2.4 lets a NaN pass, since NaN is not greater than any threshold; we do not."""
    for bad in ("nan.pfm", "inf.pfm"):
        for pair in ([bad, "good.pfm"], ["good.pfm", bad], [bad, bad]):
            expect(1, ["compare", *pair])
            expect(1, ["compare", *pair, "--fail-above", "energy_ratio=1e9"])
    out, _ = expect(1, ["compare", "nan.pfm", "good.pfm", "--ztest"])
    check("INCONCLUSIVE: pixels are not finite" in out, "no statistics of NaN", out)
    idiff = shutil.which("idiff")
    check(idiff, "idiff is installed (package openimageio-tools)")
    if not idiff:
        return
    done = subprocess.run([idiff, "-fail", "0", "nan.pfm", "good.pfm"], capture_output=True,
                          text=True, timeout=60)
    check(done.returncode == 0 and "PASS" in done.stdout,
          "idiff passes a NaN; if it no longer does, drop this check", done.stdout, done.stderr)


def test_cost_of_starting():
    """Help must not load the image library, and its absence must be explained."""
    loud = dict(os.environ, LD_DEBUG="files")
    cases = ((["compare", "--help"], False), (["compare", "good.pfm", "good.pfm"], True))
    for arguments, wanted in cases:
        _, _, err = run(*arguments, env=loud)
        loaded = "libOpenImageIO" in err
        check(loaded == wanted, f"{arguments}: image library loaded: {loaded}")
    os.mkdir("bin")
    shutil.copy(PELLUCID, "bin")
    expect(3, ["compare", "good.pfm", "good.pfm"], "image library is missing", "cmake --install",
           program=os.path.abspath("bin/pellucid"))


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        make_images()
        for name, test in list(globals().items()):
            if name.startswith("test_"):
                test()
        os.chdir("/")
    print(f"{len(failures)} checks failed" if failures else "all checks hold")
    sys.exit(1 if failures else 0)


main()
