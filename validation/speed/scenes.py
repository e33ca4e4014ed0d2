#!/usr/bin/env python3
"""What every scene costs: `python3 validation/speed/scenes.py [--only SCENE]... [--seconds S]`.

Runs `abbe bench` on each of scenes/*.json at the size of a thumbnail, writes scenes.md and draws the plots of four scenes as
scenes/pictures/bench-*.svg. Takes about seven minutes on two cores. `abbe bench scenes/*.json` measures the same at
the full size, where the time buys fewer samples.
"""

import argparse
import json
import shutil
import time

from study import HERE, OUTPUT, REPLICATES, SCENES, Report, abbe, bench, seconds_told, size_told

PICTURES = SCENES / "pictures"
# All thumbnails have as many pixels as one of this size, in the shape of their scene.
WIDTH, HEIGHT = 160, 90
# Of wall time for all scenes together: references and benchmarks get half each.
SECONDS = 420
FROM_SPP = 8
COMMON_SPP = 64
TARGET = 0.01
PLOTTED = ("prism", "ball", "gem", "cornell")


def thumbnail(scene):
    """Width and height."""
    film = json.loads(scene.read_text(encoding="utf-8"))["film"]
    factor = (WIDTH * HEIGHT / (film["width"] * film["height"])) ** 0.5
    return round(film["width"] * factor), round(film["height"] * factor)


def measure(binary, scene, seconds):
    """The report of `abbe bench`."""
    folder = OUTPUT / "scenes" / scene.stem
    return bench(binary, scene, thumbnail(scene), folder, "--from-spp", FROM_SPP, "--target", TARGET / 4, seconds=seconds)


def common_budget(reports):
    """The largest budget up to COMMON_SPP that all have."""
    budgets = [{b["samples_per_pixel"] for b in report["variants"][0]["budgets"]} for report in reports]
    return max(spp for spp in set.intersection(*budgets) if spp <= COMMON_SPP)


def row(report, common):
    [variant] = report["variants"]
    reference, last = report["reference"], variant["budgets"][-1]
    pixels = report["width"] * report["height"]
    [shared] = [b for b in variant["budgets"] if b["samples_per_pixel"] == common]
    optional = lambda value, text: text.format(value) if value is not None else "–"
    error = variant["slope_standard_error"]
    slope = optional(variant["slope"], "{:+.2f}") + (f" ± {error:.2f}" if error is not None else "")
    known = "too good for the reference" if shared["reference_too_noisy"] else f"{shared['relmse']:.1e} ± {shared['standard_error']:.0e}"
    return [
        report["scene"], size_told((report["width"], report["height"])), f"{reference['integrator']}, {reference['relmse']:.0e}",
        f"{last['samples_per_pixel']}",
        optional(variant["cpu_seconds_per_sample"] and variant["cpu_seconds_per_sample"] / pixels * 1e6, "{:.2f}"), known,
        optional(variant["efficiency"], "{:.3g}"), slope, seconds_told(variant, TARGET),
        optional(last["rays_per_cpu_second"] and last["rays_per_cpu_second"] / 1e6, "{:.1f}"),
        optional(last["lane_occupancy"] and 100 * last["lane_occupancy"], "{:.0f} %"),
        optional(last["peak_memory_bytes"] and last["peak_memory_bytes"] / 2**20, "{:.0f}"),
    ]  # fmt: skip


NOTES = f"""
* relMSE: mean over pixels and X, Y, Z of (I − R)² / (R² + 0.01 m²), m the mean of R, of {REPLICATES} runs, less the reference's own;
  ± is a standard error, ranges are of 95 %. Where there is glass `auto` is held against itself with other seeds: an error
  that both have stays unseen here; slopes.md looks for these.
* A path is one sample of one pixel, with the light paths and photons that go with it. Its cost is the slope of CPU time over
  samples, without what does not grow with them.
* Efficiency at the largest budget that the reference can judge. Rays, lanes and memory are of the largest budget; rays are per
  second of one processor, lanes the mean share of the eight wavelengths that go along with a segment of a path.
"""


def heads(common):
    return [
        "scene", "pixels", "reference, its relMSE", "largest spp", "CPU µs a path", f"relMSE at {common} spp", "1/(relMSE·CPU s)", "slope",
        f"CPU s to relMSE {TARGET}", "Mrays/CPU s", "lanes in use", "peak MiB",
    ]  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    scenes = sorted(SCENES.glob("*.json"))
    parser.add_argument("--only", metavar="SCENE", action="append", choices=[scene.stem for scene in scenes])
    parser.add_argument("--seconds", type=float, help="for each scene, instead of an equal share of the whole time")
    args = parser.parse_args()
    binary = abbe()
    chosen = [scene for scene in scenes if not args.only or scene.stem in args.only]
    seconds = args.seconds or SECONDS / len(scenes)
    table, reports = Report("scenes.py", "All scenes", []), []
    for scene in chosen:
        reports.append(measure(binary, scene, seconds))
        print(f"{scene.stem}: {time.monotonic() - table.started:.0f} s", flush=True)
    common = common_budget(reports)
    table.heads = heads(common)
    for report in reports:
        table.add(row(report, common))
    if not args.only and not args.seconds:
        table.write(binary, HERE / "scenes.md", NOTES, more=f", `auto`, {seconds:.0f} s for each scene")
        for name in PLOTTED:
            shutil.copy(OUTPUT / "scenes" / name / f"{name}.svg", PICTURES / f"bench-{name}.svg")


if __name__ == "__main__":
    main()
