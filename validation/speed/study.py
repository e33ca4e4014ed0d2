"""What the studies of this folder share: `abbe bench` on a scene, what its report says of a variant, and tables."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCENES = ROOT / "scenes"
OUTPUT = HERE / "output"
REPLICATES = 8

sys.path.insert(0, str(HERE.parent))
from binary import abbe_binary  # noqa: E402


def abbe():
    """The command to measure."""
    return str(abbe_binary())


def size_told(size, by="×"):
    return by.join(map(str, size))


def bench(binary, scene, size, folder, *arguments, seconds):
    """The report of `abbe bench` on a scene. Variants and reference get half of the seconds of wall time each."""
    folder.mkdir(parents=True, exist_ok=True)
    line = [binary, "bench", str(scene), "--resolution", size_told(size, "x"), "-o", str(folder), "-q"]
    line += ["--replicates", str(REPLICATES), "--time-limit", str(seconds / 2), *map(str, arguments)]
    subprocess.run(line, check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / "bench.json").read_text(encoding="utf-8"))["scenes"][0]


def reached(variant, target):
    """What is known of the time to a target."""
    [found] = [r for r in variant["time_to_target"] if r["relmse"] == target]
    return found


def seconds_told(variant, target):
    """CPU seconds to a target with their 95 % range, or how far the error came."""
    found = reached(variant, target)
    if found["cpu_seconds"] is None:
        return f"not reached in {found['not_reached_in']:.3g}: relMSE {variant['budgets'][-1]['relmse']:.3g}"
    if found.get("by_the_smallest_budget"):
        return f"< {found['cpu_seconds']:.3g}"
    high = f"{found['high_95']:.3g}" if found["high_95"] is not None else "?"
    low = f"{found['low_95']:.3g}" if found["low_95"] is not None else "?"
    return f"{found['cpu_seconds']:.3g} ({low}–{high})"


def line(cells):
    """A row of a Markdown table."""
    return "| " + " | ".join(cells) + " |\n"


class Report:
    """A page with one table, told line by line as it grows."""

    def __init__(self, script, title, heads):
        self.script, self.title, self.heads = script, title, heads
        self.rows, self.started, self.last = "", time.monotonic(), time.monotonic()

    def add(self, cells):
        now = time.monotonic()
        self.rows += line(cells)
        print(f"{now - self.last:.0f} s: {line(cells)}", end="", flush=True)
        self.last = now

    def write(self, binary, path, notes, more=""):
        version = subprocess.run([binary, "--version"], check=True, capture_output=True, text=True).stdout.strip()
        minutes = (time.monotonic() - self.started) / 60
        text = f"# {self.title}\n\nBy `python3 validation/speed/{self.script}` in {minutes:.0f} min, {version}, "
        text += f"{os.cpu_count()} processors{more}.\n\n"
        text += line(self.heads) + line(["---"] * len(self.heads)) + self.rows + notes
        path.write_text(text, encoding="utf-8")
