#!/usr/bin/env python3
"""Every #include stays on its floor: a module sees only what the design lets it see.

Usage: check_floors.py SOURCE_DIR
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])

# Module -> modules it may include (besides itself).
HOST = {
    "base": set(),
    "image": {"base"},
    "explain": {"base", "image"},
    "bvh": {"base"},
    "cl": {"base"},
    "scene": {"base", "image", "shared"},
    "pack": {"base", "scene", "bvh", "shared", "geom"},
    "render": {"base", "image", "cl", "pack", "scene", "bvh", "shared"},
    "integrators": {"base", "pack", "render", "shared"},
    "bench": {"base", "cl", "pack", "render", "scene", "bvh", "shared"},
    "stability": {"base", "cl", "explain", "image", "integrators", "pack", "render", "scene", "shared"},
    "study": {"base", "cl", "image", "integrators", "pack", "render", "scene", "shared"},
    "apps": {"base", "bench", "stability", "study", "explain", "image", "bvh", "cl", "scene", "pack", "render", "integrators", "shared"},
}
_LOW = {"shared", "core", "geom"}
KERNELS = {
    "shared": set(),
    "core": {"shared"},
    "geom": {"shared", "core"},
    "naive": {"shared", "core", "geom"},
    "camera": _LOW,
    "bsdf": _LOW,
    "light": _LOW,
    "film": {"shared", "core"},
    "transport": _LOW | {"camera", "bsdf", "light", "film"},
    "passes": _LOW | {"camera", "bsdf", "light", "transport", "film"},
}
# Library header -> the only host modules that may include it.
LIBRARIES = {
    r"OpenImageIO/": {"image"},
    r"CL/(cl|opencl)": {"cl"},
    r"tiny_obj_loader": {"scene"},
    r"embree3/": {"bench"},
    r"glm/": {"bvh", "scene", "pack", "stability"},
}

errors = []
for side, table in (("host", HOST), ("kernels", KERNELS)):
    for path in sorted((ROOT / side).rglob("*")):
        if path.suffix not in (".h", ".cpp", ".cl"):
            continue
        module = path.relative_to(ROOT / side).parts[0]
        for number, line in enumerate(path.read_text().splitlines(), 1):
            found = re.match(r'\s*#\s*include\s+(["<])([^">]+)', line)
            if not found:
                continue
            place = f"{path.relative_to(ROOT)}:{number}"
            name = found.group(2)
            if found.group(1) == '"':
                target = name.split("/")[0]
                if "/" not in name or target not in table and target not in KERNELS:
                    errors.append(f'{place}: include "{name}" by its path below {side}/')
                elif target != module and target not in table[module]:
                    errors.append(f"{place}: {module} must not see {target}")
            elif side == "host":
                for pattern, modules in LIBRARIES.items():
                    if re.match(pattern, name) and module not in modules:
                        errors.append(f"{place}: <{name}> belongs to {sorted(modules)}")
print("\n".join(errors) or "all includes on their floors")
sys.exit(bool(errors))
