#!/usr/bin/env python3
"""Compares the films of two builds of abbe, bit by bit: for a change that must not change any picture.

    python3 validation/bits.py OLD_ABBE NEW_ABBE [--random N] [--only WORD]

Renders every scene of scenes/ and the scene of tests/assets that has every mechanism with every integrator, and N random
scenes (50 by default) that combine shapes, materials, lights and settings. Pictures are small; some take 40 samples a
pixel, so that the pilot runs too. Compared are the pixels of the EXR files, not their attributes, which hold seconds
and the version. Exits with 1 where a film or a message differs. Needs Python's standard library alone.
"""

import argparse
import hashlib
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
INTEGRATORS = ["auto", "path", "light", "merge", "hero"]


def pixels(exr: bytes) -> str:
    """A hash of everything after the header of an EXR file and its table of offsets."""
    at = 8
    data_window = None
    while exr[at] != 0:
        name_end = exr.index(b"\0", at)
        type_end = exr.index(b"\0", name_end + 1)
        size = int.from_bytes(exr[type_end + 1 : type_end + 5], "little")
        value = exr[type_end + 5 : type_end + 5 + size]
        if exr[at:name_end] == b"channels":
            data_window = hashlib.sha256(value)
        at = type_end + 5 + size
    # The table holds one absolute offset a block; the first points behind the table.
    first_block = int.from_bytes(exr[at + 1 : at + 9], "little")
    data_window.update(exr[first_block:])
    return data_window.hexdigest()[:16]


def render(abbe: str, scene: Path, options: list[str], folder: Path) -> str:
    """The hash of a film, or the message of a render that failed."""
    out = folder / "film.exr"
    out.unlink(missing_ok=True)
    run = subprocess.run([abbe, "render", str(scene), "-o", str(out), "-q", *options], capture_output=True, text=True)
    return pixels(out.read_bytes()) if run.returncode == 0 else f"exit {run.returncode}: {run.stderr.strip()}"


def materials(rng: random.Random) -> dict:
    glasses = ["N-BK7", "N-SF11", "SF11", "N-LAK8"]
    paint = {"wavelengths_nm": [400, 550, 700], "values": [round(rng.random(), 3) for _ in range(3)]}
    metal = {"type": "conductor", "metal": rng.choice(["Au", "Ag", "Cu", "Al"])}
    glass = {"type": "dielectric", "ior": {"glass": rng.choice(glasses)}}
    return {
        "paint": {"type": "diffuse", "reflectance": paint},
        "card": {"type": "diffuse", "reflectance": {"rgb": [0.7, 0.5, 0.3]}, "two_sided": rng.random() < 0.5},
        "mirror": {"type": "mirror", "reflectance": 0.9},
        "metal": metal,
        "satin": {**metal, "roughness": round(rng.uniform(0.05, 0.6), 3)},
        "glass": glass,
        "tinted": {**glass, "absorption_per_m": paint, "priority": rng.randint(-1, 1)},
        "frosted": {**glass, "roughness": round(rng.uniform(0.02, 0.4), 3)},
        "plain": {"type": "dielectric", "ior": round(rng.uniform(1.2, 2.2), 3)},
    }


def shape(rng: random.Random) -> dict:
    r = round(rng.uniform(0.2, 0.6), 3)
    return rng.choice(
        [
            {"type": "sphere", "center": [0, 0, 0], "radius": r},
            {"type": "disk", "center": [0, 0, 0], "normal": [0.2, 1, 0.3], "radius": r},
            {"type": "quad", "origin": [-r, 0, -r], "u": [2 * r, 0, 0], "v": [0, 0, 2 * r]},
            {"type": "prism", "apex_degrees": 60, "side": 2 * r, "length": 2 * r},
            {"type": "brilliant", "radius": r},
            {"type": "lens", "radii": [2 * r, rng.choice([None, 2 * r])], "thickness": r / 2, "diameter": 1.2 * r},
            {"type": "implicit", "surface": "torus", "major_radius": r, "minor_radius": r / 3},
            {"type": "implicit", "surface": "superquadric", "radii": [r, r, r], "exponent_y": 0.5, "exponent_xz": 1.4},
            {"type": "mesh", "file": str(ROOT / "tests/assets/tetrahedron.obj")},
        ]
    )


def random_scene(seed: int) -> dict:
    rng = random.Random(seed)
    number = lambda low, high: round(rng.uniform(low, high), 3)
    made = materials(rng)
    objects = [
        {"shape": {"type": "quad", "origin": [-4, -1, 4], "u": [8, 0, 0], "v": [0, 0, -8]}, "material": "paint"}
    ]
    for _ in range(rng.randint(2, 6)):
        turn = {"rotate_degrees": number(0, 360), "axis": [1, number(-1, 1), number(-1, 1)]}
        move = {"translate": [number(-1.5, 1.5), number(-0.6, 1), number(-1.5, 1.5)]}
        thing = {"shape": shape(rng), "material": rng.choice(list(made)), "transform": [turn, move]}
        if thing["shape"]["type"] in ("quad", "disk") and made[thing["material"]]["type"] == "dielectric":
            thing["material"] = "card"
        if rng.random() < 0.15:
            thing["material"] = "paint"
            thing["emission"] = {"blackbody_kelvin": 3000, "scale": 3}
        objects.append(thing)
    lamp = {"type": "sphere", "center": [number(-2, 2), 3, number(-1, 2)], "radius": number(0.05, 0.4)}
    objects.append({"shape": lamp, "emission": {"illuminant": "D65", "scale": 20}})
    lights = rng.sample(
        [
            {"type": "point", "position": [1, 2.5, 2], "intensity": 2},
            {"type": "spot", "position": [-1, 3, 2], "direction": [0.3, -1, -0.6], "intensity": {"rgb": [9, 8, 7]},
             "inner_degrees": 10, "outer_degrees": 30},
            {"type": "directional", "direction": [0.2, -1, -0.3], "irradiance": 1, "angular_diameter_degrees": 0.53},
            {"type": "beam", "origin": [-3, 0, 0], "direction": [1, 0, 0], "radius": 0.05,
             "power": {"line_nm": 589.3, "fwhm_nm": 2}},
        ],
        rng.randint(0, 3),
    )
    film = {"width": 24, "height": 18, "filter": {"type": rng.choice(["box", "gaussian", "blackman-harris"])}}
    return {
        "camera": {"type": "perspective", "from": [number(-1, 1), number(0.3, 1.5), 5], "to": [0, 0, 0],
                   "fov_degrees": number(25, 60), "aperture_radius": rng.choice([0, 0.05])},
        "film": film,
        "render": {"samples_per_pixel": rng.choice([3, 8, 40]), "max_depth": rng.choice([3, 12, 64]), "seed": seed,
                   "integrator": rng.choice(INTEGRATORS + ["auto"] * 3)},
        "materials": made,
        "objects": objects,
        "lights": lights,
        **({"environment": {"radiance": {"illuminant": "D65", "scale": 0.1}}} if rng.random() < 0.5 else {}),
    }  # fmt: skip


def cases(folder: Path, randoms: int):
    """Names, scene files and options of all renders."""
    scenes = sorted((ROOT / "scenes").glob("*.json")) + [ROOT / "tests/assets/everything.json"]
    for scene in scenes:
        for integrator in INTEGRATORS:
            spp = "40" if integrator in ("auto", "merge") else "6"
            options = ["--integrator", integrator, "--resolution", "36x27", "--spp", spp]
            yield f"{scene.stem} {integrator}", scene, options
    for seed in range(randoms):
        scene = folder / f"random-{seed}.json"
        scene.write_text(json.dumps(random_scene(seed)))
        yield f"random {seed}", scene, []


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--random", type=int, default=50, metavar="N", help="random scenes (50)")
    parser.add_argument("--only", default="", metavar="WORD", help="cases whose name holds this word")
    arguments = parser.parse_args()
    differing = failed = count = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name, scene, options in cases(folder, arguments.random):
            if arguments.only not in name:
                continue
            old, new = (render(abbe, scene, options, folder) for abbe in (arguments.old, arguments.new))
            count += 1
            failed += old.startswith("exit")
            if old != new:
                differing += 1
                print(f"{name}: {old} became {new}")
    print(f"{count} films, {failed} of them refused by the old build, {differing} differ")
    return 1 if differing or failed == count else 0


if __name__ == "__main__":
    sys.exit(main())
