#!/usr/bin/env python3
"""Renders the recipes of scenes/recipes/ as docs/scenes.md shows them.

    python3 docs/recipes.py [--abbe FILE] [--spp N] [RECIPE ...]

RECIPE is a name such as prism; all are rendered without one. Pictures go to docs/pictures/. Needs the built command
(cargo build --release) and nothing else. Fails where a picture is larger than 60 kB.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
RECIPES = HERE.parent / "scenes" / "recipes"
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", HERE.parent / "target"))
AREA = 46_000  # pixels of a picture
LARGEST = 60_000


def render(abbe: pathlib.Path, scene: pathlib.Path, spp: int | None) -> tuple[dict, pathlib.Path]:
    film = json.loads(scene.read_text())["film"]
    shrink = (AREA / (film["width"] * film["height"])) ** 0.5
    width, height = round(film["width"] * shrink), round(film["height"] * shrink)
    picture = HERE / "pictures" / f"{scene.stem}.png"
    command = [abbe, "render", scene, "-o", picture, "--resolution", f"{width}x{height}", "-q", "--json"]
    if spp:
        command += ["--spp", str(spp)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout), picture


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abbe", type=pathlib.Path, default=TARGET / "release" / "abbe", help="the command to render with")
    parser.add_argument("--spp", type=int, help="samples per pixel instead of the recipes' own")
    parser.add_argument("recipes", nargs="*", metavar="RECIPE")
    args = parser.parse_args()
    (HERE / "pictures").mkdir(exist_ok=True)
    scenes = [RECIPES / f"{name}.json" for name in args.recipes] or sorted(RECIPES.glob("*.json"))
    too_large = []
    print("| recipe | samples per pixel | wall s | CPU s | estimated relMSE | kB |")
    print("|---|---|---|---|---|---|")
    for scene in scenes:
        r, picture = render(args.abbe, scene, args.spp)
        size = picture.stat().st_size
        if size > LARGEST:
            too_large.append(picture.name)
        print(
            f"| {scene.stem} | {r['samples_per_pixel']} | {r['seconds']:.1f} | {r['cpu_seconds']:.1f} "
            f"| {r['estimated_relative_mse']:.1e} | {size / 1000:.0f} |",
            flush=True,
        )
    if too_large:
        sys.exit(f"larger than {LARGEST / 1000:.0f} kB: {', '.join(too_large)}")


if __name__ == "__main__":
    main()
