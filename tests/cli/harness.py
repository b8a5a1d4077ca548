"""What the tests of the command line share: runs, checks, a scene. First argument: pellucid."""
import json
import os
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import time

PELLUCID = os.path.abspath(sys.argv[1])
SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
WIDTH, HEIGHT = 32, 16
failures = []
processes = []  # with a terminal; none outlives its test

# Camera at +z looking at the origin; its field of view is 90 degrees wide, so the plane z = 0 shows
# x from -5 to 5 and y from -2.5 to 2.5. The lamp stands at (2.5, 1.25, 0): right, and up.
ROOM = {
    "version": 1,
    "camera": {"origin": [0, 0, 5], "target": [0, 0, 0], "fov": 90},
    "film": {"width": WIDTH, "height": HEIGHT},
    "materials": {"grey": {"type": "diffuse", "reflectance": 0.5}},
    "shapes": [
        {"type": "sphere", "material": "grey", "center": [2.5, 1.25, 0], "radius": 0.4,
         "emission": {"radiance": 5}},
        {"type": "sphere", "material": "grey", "center": [-1, 0, 0], "radius": 1},
        {"type": "rectangle", "material": "grey", "corner": [-8, -2, -8],
         "edges": [[0, 0, 16], [16, 0, 0]]}],
    "lights": [{"type": "environment", "radiance": 0.2}],
}
QUICK = ["room.json", "--spp", "4", "--quiet"]


def check(condition, what, *details):
    if not condition:
        failures.append(what)
        print("FAILED:", what, *[str(detail)[-3000:] for detail in details], sep="\n  ")


def run(*arguments, **options):
    """Runs pellucid in the scratch folder; returns (exit code, stdout, stderr)."""
    options = {"stdout": subprocess.PIPE, "timeout": 120, **options}
    try:
        done = subprocess.run([PELLUCID, *arguments], text=True, errors="replace",
                              stderr=subprocess.PIPE, check=False, **options)
    except subprocess.TimeoutExpired:
        return "none (it does not end)", "", ""
    return done.returncode, done.stdout, done.stderr


def expect(code, arguments, *parts, **options):
    """The exit code is `code` and stderr has every part; returns stdout and stderr."""
    got, out, err = run(*arguments, **options)
    what = "pellucid " + " ".join(arguments)
    check(got == code, f"{what}: exit code {got}, not {code}", out, err)
    for part in parts:
        check(part in err, f"{what}: stderr lacks {part!r}", err)
    return out, err


def document(arguments):
    """The one JSON document that --json - prints."""
    out, _ = expect(0, [*arguments, "--json", "-"])
    try:
        result = json.loads(out)
    except ValueError as error:
        check(False, f"{arguments}: stdout is one JSON document: {error}", out)
        return {}
    check(result.get("schema") == 1, f"{arguments}: schema 1")
    return result


def same_pixels(a, b):
    return run("compare", a, b, "--fail-above", "mse=0")[0] == 0


def read_bytes(name):
    with open(name, "rb") as file:
        return file.read()


def read_json(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def write_text(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def temporaries(folder="."):
    return [name for name in os.listdir(folder) if name.startswith(".pellucid")]


class Terminal:
    """pellucid with a pseudo terminal as stderr."""

    def __init__(self, *arguments, **variables):
        self.master, slave = pty.openpty()
        self.process = subprocess.Popen([PELLUCID, *arguments], stdout=subprocess.PIPE,
                                        stderr=slave, env=dict(os.environ, **variables))
        processes.append(self.process)
        os.close(slave)
        self.text = ""

    def read(self, seconds):
        """Takes in what comes within `seconds`; False once the other end is closed."""
        if not select.select([self.master], [], [], seconds)[0]:
            return True
        try:
            self.text += os.read(self.master, 65536).decode(errors="replace")
        except OSError:  # how Linux tells that the other end is closed
            return False
        return True

    def wait_for(self, pattern, seconds=30):
        end = time.monotonic() + seconds
        while not re.search(pattern, self.text) and time.monotonic() < end and self.read(0.1):
            pass
        check(re.search(pattern, self.text), f"{pattern!r} shows on the terminal", self.text)

    def signal(self, number):
        self.process.send_signal(number)

    def end(self, seconds=30):
        """Exit code and seconds until the process ended."""
        start = time.monotonic()
        while time.monotonic() < start + seconds and self.read(0.1):
            pass
        if self.process.poll() is None and time.monotonic() >= start + seconds:
            self.process.send_signal(signal.SIGKILL)
            check(False, f"ends within {seconds} s", self.text)
        self.process.stdout.close()
        code = self.process.wait()
        os.close(self.master)
        return code, time.monotonic() - start


def run_tests(tests):
    """Runs every test_* of a module in a scratch folder. Kernels are cached where the caller says, so that
    tests share them (the cache knows a program by its source and options), or in the scratch folder."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ.setdefault("POCL_CACHE_DIR", os.path.join(folder, "pocl"))
        for name in ("PELLUCID_DEVICE", "NO_COLOR", "LD_DEBUG"):
            os.environ.pop(name, None)
        write_text("room.json", json.dumps(ROOM))
        for name, test in tests.items():
            if name.startswith("test_"):
                start = time.monotonic()
                try:
                    test()
                except (KeyError, IndexError, ValueError, OSError) as error:
                    check(False, f"{name} runs to its end: {error!r}")
                for process in processes:
                    if process.poll() is None:
                        process.kill()
                        process.wait()
                print(f"{name}: {time.monotonic() - start:.1f} s")
        os.chdir("/")
    print(f"{len(failures)} checks failed" if failures else "all checks hold")
    sys.exit(1 if failures else 0)
