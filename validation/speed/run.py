#!/usr/bin/env python3
"""How fast caustics converge, against the baselines in the tree: `python3 validation/speed/run.py [--only SCENE] [--quick]`.

Runs `abbe bench` on the scenes below, over a mask where the caustic is and over the whole picture, for `auto`, the plain light
tracer `light` and the baseline `hero`, and writes report.md. Where a baseline takes long or cannot get there, one render of
up to 600 CPU seconds says how far it comes; --quick leaves those out. Takes about twenty minutes on two cores.
"""

import argparse
import json
import os
import struct
import subprocess
import zlib
from dataclasses import dataclass, field

from study import HERE, OUTPUT, REPLICATES, SCENES, Report, abbe, bench, reached, seconds_told, size_told

TARGET = 0.1


@dataclass
class Case:
    """A scene at a size, a region of the picture as a polygon in shares of its sides, and who takes part."""

    scene: str
    size: tuple
    region: str
    polygon: list | None
    variants: tuple
    seconds: int
    long: dict = field(default_factory=dict)  # what gets so many CPU seconds in one render instead of a benchmark


CASES = [
    Case("prism", (256, 160), "spectrum on the table", [(0.51, 0.36), (0.9, 0.55), (0.9, 0.78), (0.5, 0.37)],
         ("auto",), 20, {"light": 60, "hero": 200}),
    Case("prism", (256, 160), "whole picture", None, ("auto",), 20, {"light": 60}),
    Case("ball", (160, 105), "caustic on the table", [(0.42, 0.52), (0.62, 0.5), (0.72, 0.58), (0.62, 0.68), (0.42, 0.68)],
         ("auto",), 20, {"light": 20, "hero": 200}),
    Case("ball", (160, 105), "whole picture", None, ("auto",), 40, {"hero": 100}),
    Case("gem", (128, 96), "whole picture", None, ("auto", "hero"), 260),
    Case("prism-through-prism", (180, 90), "spectrum seen through the second prism", [(0.8, 0.4), (0.96, 0.4), (0.96, 0.51), (0.8, 0.51)],
         ("auto",), 90, {"hero": 600, "light": 60}),
]


def inside(polygon, x, y):
    """Whether a point lies in a polygon, by the even-odd rule."""
    odd = False
    for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1]):
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) / (y1 - y0) * (x1 - x0):
            odd = not odd
    return odd


def write_mask(path, size, polygon):
    """A grey PNG, white inside the polygon."""
    width, height = size
    rows = b"".join(
        b"\0" + bytes(255 * inside(polygon, (x + 0.5) / width, (y + 0.5) / height) for x in range(width))
        for y in range(height)
    )

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    content = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + content)


def measure(binary, case):
    """The report of one benchmark, where its files are, and the arguments that tell the region."""
    folder = OUTPUT / f"{case.scene}-{case.region.replace(' ', '-')}"
    mask = []
    if case.polygon:
        folder.mkdir(parents=True, exist_ok=True)
        write_mask(folder / "mask.png", case.size, case.polygon)
        mask = ["--mask", str(folder / "mask.png")]
    arguments = ["--vary", "integrator=" + ",".join(case.variants), "--target", TARGET, "--reference", "auto", *mask]
    scene = SCENES / f"{case.scene}.json"
    return bench(binary, scene, case.size, folder, *arguments, seconds=2 * case.seconds), folder, mask


def long_render(binary, case, integrator, budget, folder, mask):
    """CPU seconds and relMSE of one long render."""
    picture = folder / f"{integrator}.exr"
    scene = str(SCENES / f"{case.scene}.json")
    line = [binary, "render", scene, "-q", "--resolution", size_told(case.size, "x"), "--integrator", integrator, "--adaptive", "off"]
    line += ["--time", str(budget / os.cpu_count()), "-o", str(picture), "--json"]
    told = json.loads(subprocess.run(line, check=True, stdout=subprocess.PIPE, text=True).stdout)
    references = (folder / "references").glob(f"{case.scene}-*.exr")
    means = [path for path in references if not path.name.endswith(".variance.exr")]
    reference = max(means, key=lambda path: path.stat().st_mtime)
    line = [binary, "compare", str(picture), str(reference), *mask, "--json"]
    compared = json.loads(subprocess.run(line, check=True, stdout=subprocess.PIPE, text=True).stdout)
    return told["cpu_seconds"], compared["relmse"]


def cells(case, integrator, seconds, ratio, efficiency):
    return [case.scene, case.region, size_told(case.size), integrator, seconds, ratio, efficiency]


def ratio_told(variant, best):
    """How many times as long a variant takes as the best; at least so many where it does not get there."""
    found = reached(variant, TARGET)
    there = found["cpu_seconds"] is not None
    return f"{'' if there else '> '}{(found['cpu_seconds'] if there else found['not_reached_in']) / best:.3g} ×"


def rows(binary, case, quick):
    """Lines of the table."""
    told, folder, mask = measure(binary, case)
    first, *others = told["variants"]
    best = reached(first, TARGET)["cpu_seconds"]
    for variant in told["variants"]:
        ratio = ratio_told(variant, best) if best and variant in others else ""
        efficiency = f"{variant['efficiency']:.3g}" if variant["efficiency"] else "–"
        yield cells(case, variant["name"], seconds_told(variant, TARGET), ratio, efficiency)
    for integrator, budget in () if quick else case.long.items():
        seconds, error = long_render(binary, case, integrator, budget, folder, mask)
        text = f"relMSE {error:.3g} after {seconds:.0f}" if error < TARGET else f"not reached in {seconds:.0f}: relMSE {error:.3g}"
        # Light paths alone have the slope -1 wherever they can see all that counts, which is told by slopes.py.
        sees_all = integrator == "light" and "table" in case.region
        ratio = "?" if error < TARGET or not best else f"> {seconds / best:.3g} ×"
        if sees_all and best:
            ratio = f"{seconds * error / TARGET / best:.3g} ×, by slope −1"
        yield cells(case, integrator, text, ratio, f"{1 / (seconds * error):.3g}")


HEADS = ["scene", "where", "pixels", "integrator", f"CPU s to relMSE {TARGET}", "auto is faster by", "1/(relMSE·CPU s)"]
NOTES = f"""
* `auto`, and `hero` in gem: {REPLICATES} runs of each budget, ranges of 95 %. All other rows: one render of so many CPU seconds.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", metavar="SCENE", choices=sorted({case.scene for case in CASES}))
    parser.add_argument("--quick", action="store_true", help="without the long renders")
    args = parser.parse_args()
    binary, report = abbe(), Report("run.py", "Time to a caustic", HEADS)
    for case in CASES:
        if args.only in (None, case.scene):
            for row in rows(binary, case, args.quick):
                report.add(row)
    if args.only is None and not args.quick:
        report.write(binary, HERE / "report.md", NOTES)


if __name__ == "__main__":
    main()
