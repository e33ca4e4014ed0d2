#!/usr/bin/env python3
"""Whether error falls without end: `python3 validation/speed/slopes.py [--only SCENE]... [--seconds S]`.

Renders small pictures of many scenes with doubling budgets by `abbe bench` and compares them with a reference made by the
technique least like the one on test. Unbiased error falls by the slope -1 or steeper for ever; a mistake in either
technique would show as a floor. Writes slopes.md, in about twelve minutes on two cores.
"""

import argparse
import json
import math
import subprocess
from dataclasses import dataclass
from pathlib import Path

from study import HERE, OUTPUT, ROOT, SCENES, Report, abbe, bench, size_told

PEERS = ROOT / "validation" / "peers" / "scenes"
TARGET = 1e-5
# Renders of fewer samples plan nothing.
FROM_SPP, TO_SPP = 32, 1 << 24
# Steeper than this the last three budgets are still falling.
FALLING = -0.8
# Student's t for 95 %, by degrees of freedom.
T = [math.nan, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.16, 2.145, 2.131, 2.12]
# Share of a pixel's filter that matte surfaces must fill, nearly.
MATTE_SHARE = 0.9994


@dataclass
class Case:
    """A scene at a size, who is on test, what it is held against, and how long both together may take, seconds of wall time."""

    name: str
    scene: Path
    size: tuple
    integrator: str
    reference: str
    seconds: float
    # Only pixels that show matte surfaces directly: all that light paths see.
    matte: bool = False


# The smaller the picture, the sooner an error is reached. The costlier technique of two makes the reference.
CASES = [
    Case("cornell", SCENES / "cornell.json", (4, 4), "path", "light", 90),
    Case("gem of peers", PEERS / "gem.json", (4, 4), "path", "hero", 60),
    Case("flint", PEERS / "flint.json", (2, 2), "path", "hero", 100),
    Case("glass", PEERS / "glass.json", (8, 8), "auto", "path", 90, matte=True),
    Case("ball", SCENES / "ball.json", (12, 8), "light", "auto", 50, matte=True),
    Case("ball", SCENES / "ball.json", (12, 8), "auto", "auto", 80),
    Case("nested", SCENES / "nested.json", (3, 3), "path", "hero", 80),
    Case("implicit", SCENES / "implicit.json", (8, 4), "path", "hero", 40),
    Case("gem", SCENES / "gem.json", (8, 6), "path", "hero", 30),
    Case("prism", SCENES / "prism.json", (12, 8), "light", "auto", 40, matte=True),
    Case("prism", SCENES / "prism.json", (12, 8), "auto", "auto", 40),
    Case("rainbow", SCENES / "rainbow.json", (8, 5), "light", "auto", 30, matte=True),
    Case("achromat", SCENES / "achromat.json", (8, 4), "light", "auto", 30, matte=True),
]


def write_mask(binary, case, path):
    """A picture above 0.5 where nothing but matte surfaces is seen: these shine, by a little more, all else is black."""
    scene = json.loads(case.scene.read_text(encoding="utf-8"))
    matte = {name for name, material in scene["materials"].items() if material["type"] == "diffuse"}
    scene.pop("environment", None)
    scene.pop("lights", None)
    for thing in scene["objects"]:
        thing.pop("emission", None)
        if thing.setdefault("material", "black") in matte | {"black"}:
            thing["emission"] = {"illuminant": "D65", "scale": 0.5 / MATTE_SHARE}
            thing["emission_two_sided"] = True
    scene["materials"] = {name: {"type": "diffuse", "reflectance": 0} for name in {*scene["materials"], "black"}}
    # Beside the scene, for the files that it may name.
    copy = case.scene.with_name(f"{case.scene.stem}-matte.json")
    try:
        copy.write_text(json.dumps(scene), encoding="utf-8")
        line = [binary, "render", str(copy), "-q", "--resolution", size_told(case.size, "x"), "--integrator", "path"]
        subprocess.run([*line, "--spp", "1024", "--adaptive", "off", "-o", str(path)], check=True)
    finally:
        copy.unlink(missing_ok=True)


def measure(binary, case, seconds):
    """The report of `abbe bench`."""
    folder = OUTPUT / "slopes" / "-".join([case.name, case.integrator, case.reference] + ["matte"] * case.matte)
    folder.mkdir(parents=True, exist_ok=True)
    arguments = ["--vary", f"integrator={case.integrator}", "--reference", case.reference, "--target", TARGET]
    arguments += ["--from-spp", FROM_SPP, "--to-spp", TO_SPP]
    if case.matte:
        write_mask(binary, case, folder / "matte.exr")
        arguments += ["--mask", folder / "matte.exr"]
    return bench(binary, case.scene, case.size, folder, *arguments, seconds=seconds)


def floor_seen(budgets):
    """The slope of the last three budgets and a word on it."""
    if len(budgets) < 3:
        return "too few budgets"
    first, last = budgets[-3], budgets[-1]
    steps = math.log(last["samples_per_pixel"] / first["samples_per_pixel"])
    slope = math.log(last["relmse"] / first["relmse"]) / steps
    error = math.hypot(*(b["standard_error"] / b["relmse"] for b in (first, last))) / steps
    if slope <= FALLING:
        verdict = "no"
    else:
        # A floor stays in the mean of the runs; rare bright samples, which also keep errors up, are their spread.
        floor = slope - 1.96 * error > FALLING and last["systematic_relmse"] > 0.5 * last["relmse"]
        verdict = "yes" if floor else "not told from noise"
    return f"{verdict} ({slope:+.2f} ± {1.96 * error:.2f})"


def row(case, report):
    variant, reference = report["variants"][0], report["reference"]
    # What the reference is too noisy to judge is left out.
    judged = [b for b in variant["budgets"] if not b["reference_too_noisy"] and b["relmse"] > 0]
    made = f"{case.reference}, relMSE {reference['relmse']:.1e}"
    if case.reference == case.integrator:
        made = f"{case.reference} with other seeds, relMSE {reference['relmse']:.1e}"
    cells = [case.name, "matte, seen directly" if case.matte else "whole picture", size_told(case.size)]
    cells += [case.integrator, made]
    if not judged:
        return [*cells, "–", "reference too noisy", "no", "–", "–", "–"]
    last = judged[-1]
    error = f"{last['relmse']:.1e} ± {last['standard_error']:.0e}"
    slope = "–"
    if len(judged) > 2:
        spread = T[min(len(judged) - 2, len(T) - 1)] * variant["slope_standard_error"]
        slope = f"{variant['slope']:+.2f} ± {spread:.2f}"
    there = "yes" if last["relmse"] <= TARGET else "no"
    systematic = f"{last['systematic_relmse']:+.0e}"
    return [*cells, f"{last['samples_per_pixel']}", error, there, slope, floor_seen(judged), systematic]


HEADS = [
    "scene", "where", "pixels", "integrator", "reference and its own error", "largest budget, spp", "relMSE there", "1e-5 reached",
    "slope (95 %)", "floor seen? (slope of the last three, 95 %)", "left in the mean of the runs",
]  # fmt: skip

NOTES = f"""
* relMSE: mean over pixels and X, Y, Z of (I − R)² / (R² + 0.01 m²), m the mean of R, of eight runs, less the reference's own;
  ± is a standard error. Budgets whose error is not twice the reference's own are left out.
* The slope is of log relMSE over log samples per pixel, from {FROM_SPP} samples to the largest budget.
* Floor seen: "no" if the last three budgets fall by {FALLING} or steeper; "yes" if their 95 % range does not go beyond
  that and most of the error is left in the mean of the runs; else "not told from noise".
* Left in the mean of the runs: the relMSE of the mean of all eight runs of the largest budget, less what their spread and the
  reference's own error explain. About 0, of either sign, without bias; what there is of a bias is in it whole.
* "Matte, seen directly": the pixels in which nothing else is seen. Light paths find all of these, and in another way.
* Where the reference is what is on test with other seeds, an error that both have stays unseen: nothing but `auto` and
  `merge`, which share their code, sees lights without extent through glass.
* Camera paths find the caustics of `ball` and `prism` too seldom, or never, to be a reference for them.
* `hero` is camera paths too, but carries one wavelength on where glass parts them: it tells of mistakes in that alone.
* `auto` merges photons where a caustic is seen through glass; its blur, three pixels at first, shrinks with the samples. In
  pictures this small that is much, so nothing is held against it where it merges, but itself.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", metavar="SCENE", action="append", choices=sorted({case.name for case in CASES}))
    parser.add_argument("--seconds", type=float, help="for each case, instead of its own")
    args = parser.parse_args()
    binary, report = abbe(), Report("slopes.py", "How error falls", HEADS)
    for case in CASES:
        if not args.only or case.name in args.only:
            report.add(row(case, measure(binary, case, args.seconds or case.seconds)))
    if not args.only and not args.seconds:
        report.write(binary, HERE / "slopes.md", NOTES)


if __name__ == "__main__":
    main()
