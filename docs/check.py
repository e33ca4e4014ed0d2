#!/usr/bin/env python3
"""Checks every recipe and every JSON block of the documentation with `abbe scene check`.

    python3 docs/check.py [--abbe FILE]

A block marked `json` is a whole scene. One marked `json fragment` is a part of a scene: camera and film are added if missing.
Paths in blocks start at scenes/recipes/. Exits with 1 if anything is refused.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECIPES = ROOT / "scenes" / "recipes"
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
BASE = {"camera": {"type": "perspective", "from": [0, 1, 5], "to": [0, 0, 0]}, "film": {"width": 8, "height": 8}}


def check(abbe: pathlib.Path, text: str, name: str) -> bool:
    done = subprocess.run([abbe, "scene", "check", "-q", "-"], input=text, text=True, capture_output=True, cwd=RECIPES)
    if done.returncode != 0:
        print(f"{name}: {done.stderr.strip()}")
    return done.returncode == 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abbe", type=pathlib.Path, default=TARGET / "release" / "abbe", help="the command to check with")
    abbe = parser.parse_args().abbe.resolve()
    scenes = [(str(path.relative_to(ROOT)), path.read_text()) for path in sorted(RECIPES.glob("*.json"))]
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        text = page.read_text()
        for block in re.finditer(r"^```json( fragment)?\n(.*?)^```", text, re.M | re.S):
            line = text[: block.start()].count("\n") + 1
            content = block[2] if not block[1] else json.dumps(BASE | json.loads(block[2]))
            scenes.append((f"{page.relative_to(ROOT)}:{line}", content))
    results = [check(abbe, text, name) for name, text in scenes]
    print(f"{sum(results)} of {len(results)} scenes and blocks are right")
    sys.exit(not all(results))


if __name__ == "__main__":
    main()
