#!/usr/bin/env python3
"""Times two builds of abbe in interleaved pairs: for a change that must not make rendering slower.

    python3 validation/speed/pairs.py OLD_ABBE NEW_ABBE [--pairs N] [--only SCENE] [-o FILE.md]

Each pair renders a scene once with each build, in turns of who is first, with the same settings. Reported are the median
over pairs of the ratio of CPU seconds, new over old, with a 95 % range by bootstrap, and whether both builds traced
the same number of rays. Run it on an idle machine. Needs Python's standard library alone.
"""

import argparse
import json
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MESH = "mesh"
# Scene, resolution and samples that take about a second on one thread. On two, threads of one process share caches and
# ranges are wider.
RUNS = [
    ("cornell", "144x144", 32),
    ("gem", "112x84", 32),
    ("prism", "176x176", 24),
    ("ball", "144x96", 32),
    ("nested", "57x38", 32),
    (MESH, "144x108", 24),
]


def mesh_scene(folder: Path) -> Path:
    """The scene of the 300 k mesh, with its mesh beside it."""
    scene = ROOT / "validation/peers/scenes/mesh.json"
    text = json.loads(scene.read_text())
    [mesh] = [o["shape"] for o in text["objects"] if o["shape"]["type"] == "mesh"]
    file = folder / "mesh.ply"
    subprocess.run([sys.executable, str(ROOT / "validation/peers/mesh.py"), str(file)], check=True)
    mesh["file"] = str(file)
    copy = folder / "mesh.json"
    copy.write_text(json.dumps(text))
    return copy


def run(abbe: str, scene: Path, size: str, spp: int, seed: int, folder: Path) -> tuple[float, int]:
    """CPU seconds of rendering, and rays."""
    line = [abbe, "render", str(scene), "-o", str(folder / "film.exr"), "-q", "--json"]
    line += ["--resolution", size, "--spp", str(spp), "--seed", str(seed), "--threads", "1"]
    told = json.loads(subprocess.run(line, check=True, capture_output=True, text=True).stdout)
    return told["cpu_seconds"], told["rays"]


def median_range(ratios: list[float]) -> tuple[float, float, float]:
    """The median with its 95 % range by 4000 resamplings."""
    rng = random.Random(1)
    medians = sorted(statistics.median(rng.choices(ratios, k=len(ratios))) for _ in range(4000))
    return statistics.median(ratios), medians[100], medians[-101]


def study(old: str, new: str, scene: Path, size: str, spp: int, pairs: int, folder: Path) -> str:
    ratios, seconds, same_rays = [], [], True
    for abbe in (old, new):
        run(abbe, scene, size, spp, 0, folder)
    for pair in range(pairs):
        builds = [("old", old), ("new", new)]
        if pair % 2 == 1:
            builds.reverse()
        told = {name: run(abbe, scene, size, spp, pair, folder) for name, abbe in builds}
        ratios.append(told["new"][0] / told["old"][0])
        seconds.append(told["old"][0])
        same_rays &= told["new"][1] == told["old"][1]
    middle, low, high = median_range(ratios)
    rays = "same" if same_rays else "differ"
    return (
        f"| {scene.stem} | {size} × {spp} | {statistics.median(seconds):.2f} "
        f"| {middle:.3f} ({low:.3f}–{high:.3f}) | {rays} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--pairs", type=int, default=21, metavar="N")
    parser.add_argument("--only", metavar="SCENE")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.md")
    arguments = parser.parse_args()
    table = ["| scene | size × spp | CPU s, old | new / old, median (95 %) | rays |", "|---|---|---|---|---|"]
    print("\n".join(table), flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name, size, spp in RUNS:
            if arguments.only not in (None, name):
                continue
            scene = mesh_scene(folder) if name == MESH else ROOT / f"scenes/{name}.json"
            row = study(arguments.old, arguments.new, scene, size, spp, arguments.pairs, folder)
            table.append(row)
            print(row, flush=True)
    if arguments.output:
        arguments.output.write_text("\n".join(table) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
