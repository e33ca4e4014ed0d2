#!/usr/bin/env python3
"""Renders the recipes of scenes/recipes/ as docs/scenes.md shows them.

    python3 docs/recipes.py [--abbe FILE] [--spp N] [RECIPE ...]

RECIPE is a name such as prism; all are rendered without one. Pictures go to docs/pictures/. Needs the built command
(cargo build --release) and nothing else. A picture that is larger than 60 kB is rendered again with fewer pixels.
"""
import argparse
import json
import os
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
RECIPES = HERE.parent / "scenes" / "recipes"
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", HERE.parent / "target"))
AREA = 46_000  # pixels of a picture
LARGEST = 60_000


def render(abbe: pathlib.Path, scene: pathlib.Path, spp: int | None, area: float) -> tuple[dict, pathlib.Path]:
    film = json.loads(scene.read_text())["film"]
    shrink = (area / (film["width"] * film["height"])) ** 0.5
    width, height = round(film["width"] * shrink), round(film["height"] * shrink)
    picture = HERE / "pictures" / f"{scene.stem}.png"
    command = [abbe, "render", scene, "-o", picture, "--resolution", f"{width}x{height}", "-q", "--json"]
    if spp:
        command += ["--spp", str(spp)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout), picture


def render_small(abbe: pathlib.Path, scene: pathlib.Path, spp: int | None) -> tuple[dict, int]:
    """Renders a picture, smaller if the file is too large."""
    area = AREA
    while True:
        report, picture = render(abbe, scene, spp, area)
        size = picture.stat().st_size
        if size <= LARGEST:
            return report, size
        area *= 0.95 * LARGEST / size


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abbe", type=pathlib.Path, default=TARGET / "release" / "abbe", help="the command to render with")
    parser.add_argument("--spp", type=int, help="samples per pixel instead of the recipes' own")
    parser.add_argument("recipes", nargs="*", metavar="RECIPE")
    args = parser.parse_args()
    (HERE / "pictures").mkdir(exist_ok=True)
    scenes = [RECIPES / f"{name}.json" for name in args.recipes] or sorted(RECIPES.glob("*.json"))
    print("| recipe | samples per pixel | wall s | CPU s | estimated relMSE | kB |")
    print("|---|---|---|---|---|---|")
    for scene in scenes:
        r, size = render_small(args.abbe, scene, args.spp)
        print(
            f"| {scene.stem} | {r['samples_per_pixel']} | {r['seconds']:.1f} | {r['cpu_seconds']:.1f} "
            f"| {r['estimated_relative_mse']:.1e} | {size / 1000:.0f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
