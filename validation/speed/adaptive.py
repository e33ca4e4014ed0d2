#!/usr/bin/env python3
"""What adaptive sampling is worth: `python3 validation/speed/adaptive.py [--only SCENE]... [--seconds S]`.

CPU time to a relMSE of 1 %, and of 0.1 % where that is reached, with it and without it, by `abbe bench --vary adaptive=on,off` on small pictures, both taking
turns. Writes adaptive.md, in about ten minutes on two cores.
"""

import argparse
import math
from dataclasses import dataclass

from study import HERE, OUTPUT, REPLICATES, SCENES, Report, abbe, bench, reached, seconds_told, size_told

TARGET, LOWER = 0.01, 0.001
FROM_SPP, TO_SPP = 8, 1 << 20


@dataclass
class Case:
    """A scene at a size, what its reference is made with, and seconds of wall time: half of them for the reference."""

    scene: str
    size: tuple
    reference: str
    seconds: float


CASES = [
    Case("prism", (192, 120), "auto", 120),
    Case("gem", (64, 48), "auto", 320),
    Case("cornell", (96, 96), "light", 200),
]


def measure(binary, case, seconds):
    """The report of `abbe bench`."""
    arguments = ["--vary", "adaptive=on,off", "--reference", case.reference, "--target", LOWER]
    arguments += ["--from-spp", FROM_SPP, "--to-spp", TO_SPP]
    folder = OUTPUT / "adaptive" / case.scene
    return bench(binary, SCENES / f"{case.scene}.json", case.size, folder, *arguments, seconds=seconds)


def ratio_told(on, off, target):
    """How many times less time it takes with adaptive sampling, with a 95 % range from those of both."""
    a, b = reached(on, target), reached(off, target)
    bounded = lambda r: r["cpu_seconds"] is not None and not r.get("by_the_smallest_budget")
    if not (bounded(a) and bounded(b)):
        if bounded(a) and b["cpu_seconds"] is None:
            return f"> {b['not_reached_in'] / a['cpu_seconds']:.3g}"
        if bounded(b) and a["cpu_seconds"] is None:
            return f"< {b['cpu_seconds'] / a['not_reached_in']:.3g}"
        return "–"
    best = b["cpu_seconds"] / a["cpu_seconds"]
    if not (a["low_95"] and b["low_95"] and a["high_95"] and b["high_95"]):
        return f"{best:.3g}"
    # Half widths of the logarithms, the two times being independent but for the seeds.
    low = math.hypot(math.log(a["high_95"] / a["cpu_seconds"]), math.log(b["cpu_seconds"] / b["low_95"]))
    high = math.hypot(math.log(a["cpu_seconds"] / a["low_95"]), math.log(b["high_95"] / b["cpu_seconds"]))
    return f"{best:.3g} ({best * math.exp(-low):.3g}–{best * math.exp(high):.3g})"


def equal_budget(on, off):
    """relMSE of both at the largest budget that both have, where the reference can judge it."""
    errors = lambda v: {b["samples_per_pixel"]: b for b in v["budgets"] if b["relmse"] > 0 and not b["reference_too_noisy"]}
    a, b = errors(on), errors(off)
    common = max(a.keys() & b.keys(), default=None)
    if common is None:
        return "–"
    cells = [f"{x[common]['relmse']:.2e} ± {x[common]['standard_error']:.0e}" for x in (a, b)]
    return f"{common} spp: {cells[0]} and {cells[1]}"


def row(case, report):
    variants = {v["name"].split()[-1]: v for v in report["variants"]}
    on, off = variants["on"], variants["off"]
    reference = report["reference"]
    return [
        case.scene, size_told(case.size), f"{reference['integrator']}, relMSE {reference['relmse']:.1e}",
        seconds_told(on, TARGET), seconds_told(off, TARGET), ratio_told(on, off, TARGET), ratio_told(on, off, LOWER), equal_budget(on, off),
    ]  # fmt: skip


HEADS = [
    "scene", "pixels", "reference and its own error", f"CPU s to relMSE {TARGET}: on", "off", "off ÷ on (95 %)", f"off ÷ on to {LOWER}",
    "relMSE at the same budget: on and off",
]  # fmt: skip

NOTES = f"""
* relMSE of {REPLICATES} runs of each budget, less the reference's own; ranges are of 95 %, ± is a standard error. A time is where the
  mean error crosses the target, between budgets that double from {FROM_SPP} samples per pixel.
* Adaptive sampling is on or off with the same number of samples in all; `auto` renders either.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", metavar="SCENE", action="append", choices=[case.scene for case in CASES])
    parser.add_argument("--seconds", type=float, help="for each case, instead of its own")
    args = parser.parse_args()
    binary, report = abbe(), Report("adaptive.py", "Adaptive sampling", HEADS)
    for case in CASES:
        if not args.only or case.scene in args.only:
            report.add(row(case, measure(binary, case, args.seconds or case.seconds)))
    if not args.only and not args.seconds:
        report.write(binary, HERE / "adaptive.md", NOTES)


if __name__ == "__main__":
    main()
