#!/usr/bin/env python3
"""Renders every scene of this folder as the README shows it and prints the table of figures of docs/speed.md.

    python3 scenes/pictures.py [--abbe FILE] [--spp N] [SCENE ...]

Pictures go to scenes/pictures/. Needs the built command (cargo build --release) and nothing else.
"""
import argparse
import json
import os
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", HERE.parent / "target"))
WIDTH = 480


def render(abbe: pathlib.Path, scene: pathlib.Path, spp: int | None) -> dict:
    film = json.loads(scene.read_text())["film"]
    height = round(film["height"] * WIDTH / film["width"])
    picture = HERE / "pictures" / f"{scene.stem}.png"
    command = [abbe, "render", scene, "-o", picture, "--resolution", f"{WIDTH}x{height}", "-q", "--json"]
    if spp:
        command += ["--spp", str(spp)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abbe", type=pathlib.Path, default=TARGET / "release" / "abbe", help="the command to render with")
    parser.add_argument("--spp", type=int)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    args = parser.parse_args()
    (HERE / "pictures").mkdir(exist_ok=True)
    print("| scene | samples per pixel | camera + light paths | rays per path | CPU µs per path | wall s | estimated relMSE |")
    print("|---|---|---|---|---|---|---|")
    for scene in args.scenes or sorted(HERE.glob("*.json")):
        r = render(args.abbe, scene, args.spp)
        paths = r["camera_paths"] + r["light_paths"]
        print(
            f"| {scene.stem} | {r['samples_per_pixel']} | {r['camera_paths'] / 1e6:.0f} M + {r['light_paths'] / 1e6:.0f} M "
            f"| {r['rays'] / paths:.1f} | {r['cpu_seconds'] / paths * 1e6:.2f} | {r['seconds']:.1f} "
            f"| {r['estimated_relative_mse']:.1e} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
