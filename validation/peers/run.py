#!/usr/bin/env python3
"""abbe against other renderers: `python3 validation/peers/run.py --all`, or `SCENE.json... [-- BENCH ARGUMENTS]`.

--all     whether the pictures agree and what each costs, on all scenes: report.md
--check   only whether they agree; exit code 1 if they do not
--only N  of these, one scene
SCENE     any scene against Mitsuba, with its filter replaced by the box

Installs Mitsuba 3 and raysect into validation/peers/.venv once. What is measured goes to validation/peers/output/.
"""

import argparse
import json
import math
import os
import shlex
import shutil
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from binary import abbe_binary  # noqa: E402

ROOT = HERE.parent.parent
OUTPUT = HERE / "output"
ENVIRONMENT = HERE / ".venv"
PYTHON = ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
VARIANT = os.environ.get("ABBE_MITSUBA_VARIANT", "llvm_ad_spectral")
NM_D = "587.5618"
MESH = HERE / "cache" / "wrinkled.ply"

# Block means of the two renderers' pictures may differ by this share.
TOLERANCE = 0.005
# What the peers' pictures are multiplied by: Mitsuba divides by 106.7502594 where ∫ȳ dλ is 106.8568952.
SCALES = {"mitsuba": 106.7502594 / 106.8568952, "raysect": 1.0}
# Independent runs of each that are compared.
CHECK_RUNS = 4
REPLICATES = 8
# Student's t for a 95 % range of the mean of eight.
T_OF_REPLICATES = 2.365


@dataclass
class Case:
    """A scene, the renderer to compare with, and how many samples per pixel."""

    name: str
    scene: Path
    peer: str
    check_spp: tuple  # of each run: abbe's, the peer's
    spp: tuple  # smallest and largest budget
    reference_spp: int
    size: int | None = None  # of the picture, instead of the scene's
    blocks: int = 4
    vary: str | None = None
    reference: str = "path"
    peer_share: int = 1  # the peer takes one sample where abbe takes so many: budgets of about the same time


SCENES = HERE / "scenes"
CASES = [
    Case("cornell", ROOT / "scenes" / "cornell.json", "mitsuba", (512, 1024), (32, 128), 400, size=128),
    Case("glass", SCENES / "glass.json", "mitsuba", (512, 8192), (32, 128), 512, vary="integrator=auto,path", reference="auto"),
    Case("gem", SCENES / "gem.json", "mitsuba", (512, 1024), (32, 128), 512),
    Case("mesh", SCENES / "mesh.json", "mitsuba", (256, 512), (32, 128), 400),
    Case("flint", SCENES / "flint.json", "raysect", (8192, 256), (1024, 4096), 8192, blocks=2, peer_share=128),
]


def ensure_environment():
    stamp, wanted = ENVIRONMENT / "requirements.txt", HERE / "requirements.txt"
    if PYTHON.exists() and stamp.exists() and stamp.read_text() == wanted.read_text():
        return
    subprocess.run([sys.executable, "-m", "venv", "--clear", str(ENVIRONMENT)], check=True)
    subprocess.run([str(PYTHON), "-m", "pip", "install", "--quiet", "-r", str(wanted)], check=True)
    shutil.copy(wanted, stamp)


class Boxed:
    """A scene with the box filter, which is the one that all have, and of another size if wanted; a copy beside the
    original if that is another, for the files it names."""

    def __init__(self, scene, size=None):
        self.content = json.loads(scene.read_text(encoding="utf-8"))
        film = self.content.setdefault("film", {})
        before = json.dumps(film)
        film["filter"] = {"type": "box"}
        if size:
            film["width"] = film["height"] = size
        self.temporary = json.dumps(film) != before
        self.path = scene.with_name(f"{scene.stem}-box.json") if self.temporary else scene

    def __enter__(self):
        if self.temporary:
            self.path.write_text(json.dumps(self.content), encoding="utf-8")
        return self.path

    def __exit__(self, *_):
        if self.temporary:
            self.path.unlink()


def peer_command(binary, peer, scene, folder):
    """What renders a scene with another program, without samples, seed and output."""
    if peer == "raysect":
        return [str(PYTHON), str(HERE / "render_raysect.py"), str(scene)], ""
    xml = folder / "scene.xml"
    # Glass gets one index: Mitsuba has no dispersion.
    subprocess.run(
        [binary, "scene", "export", "-q", "--format", "mitsuba", "--at", NM_D, str(scene), "-o", str(xml)], check=True
    )
    return [str(PYTHON), str(HERE / "render_mitsuba.py"), str(xml), "--variant", VARIANT], " --threads {threads}"


def against(peer, command, more, share=1):
    spp = "{spp}" if share == 1 else f"$(({{spp}} / {share}))"
    return f"{peer}={shlex.join(command)} --spp {spp} --seed {{seed}} --out {{out}}{more}"


def folder_of(case):
    folder = OUTPUT / case.name
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def check(binary, case):
    """Renders some runs with both and compares their block means."""
    folder = folder_of(case)
    with Boxed(case.scene, case.size) as scene:
        command, _ = peer_command(binary, case.peer, scene, folder)
        pictures = {"abbe": [], case.peer: []}
        for seed in range(1, CHECK_RUNS + 1):
            for name, program, spp in (
                ("abbe", [binary, "render", str(scene), "-q"], case.check_spp[0]),
                (case.peer, command, case.check_spp[1]),
            ):
                out = str(folder / f"{name}-{seed}.exr")
                flag = "-o" if name == "abbe" else "--out"
                line = [*program, "--spp", str(spp), "--seed", str(seed), flag, out]
                subprocess.run(line, check=True, stdout=subprocess.DEVNULL)
                pictures[name].append(out)
    line = [str(PYTHON), str(HERE / "agreement.py"), "--blocks", str(case.blocks)]
    line += ["--scale", str(SCALES[case.peer]), "--reference", *pictures["abbe"], "--test", *pictures[case.peer]]
    found = json.loads(subprocess.run(line, check=True, capture_output=True, text=True).stdout)
    found["agrees"] = abs(found["worst"]) <= TOLERANCE
    (folder / "agreement.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    print(f"{case.name}: {case.peer} − abbe: {told(found)}", flush=True)
    return found


def told(found):
    verdict = "agree" if found["agrees"] else "DISAGREE"
    return (
        f"{verdict}: {100 * found['worst']:+.2f} ± {100 * found['worst_standard_error']:.2f} % in {found['worst_channel']}"
        f" at worst of {found['blocks']}×{found['blocks']} blocks, {100 * found['mean'][1]:+.2f} % in mean Y"
    )


def bench(binary, case):
    """`abbe bench`, both in turns; its report."""
    folder = folder_of(case)
    with Boxed(case.scene, case.size) as scene:
        command, more = peer_command(binary, case.peer, scene, folder)
        line = [binary, "bench", str(scene), "--against", against(case.peer, command, more, case.peer_share), "-o", str(folder)]
        line += ["--from-spp", str(case.spp[0]), "--to-spp", str(case.spp[1]), "--replicates", str(REPLICATES)]
        line += ["--reference-spp", str(case.reference_spp), "--reference", case.reference, "--target", "1e-9"]
        line += ["--time-limit", "100000", *(["--vary", case.vary] if case.vary else [])]
        subprocess.run(line, check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / "bench.json").read_text(encoding="utf-8"))["scenes"][0]


@dataclass
class Figures:
    """What is known of one renderer on one scene, with one value for each replicate where there is a list."""

    relmse: list
    cpu_per_spp: list
    fixed: float
    peak: float | None


def figures(variant, own_relmse):
    """Errors at the largest budget, and the cost of a sample between the smallest and the largest."""
    first, last = variant["budgets"][0], variant["budgets"][-1]
    step = last["samples_per_pixel"] - first["samples_per_pixel"]
    pairs = list(zip(first["runs"], last["runs"]))
    per_spp = [(b["cpu_seconds"] - a["cpu_seconds"]) / step for a, b in pairs]
    fixed = [a["cpu_seconds"] - first["samples_per_pixel"] * slope for (a, _), slope in zip(pairs, per_spp)]
    relmse = [run["relmse_raw"] - own_relmse for run in last["runs"]]
    return Figures(relmse, per_spp, max(statistics.mean(fixed), 0.0), last["peak_memory_bytes"])


def ratio(ours, theirs):
    """How many times more efficient the first is, 1 / (relMSE · marginal CPU seconds), with a 95 % range; `None` where the
    clock, or the reference, is too coarse to tell."""
    if min(ours.relmse + ours.cpu_per_spp + theirs.relmse + theirs.cpu_per_spp) <= 0:
        return None
    logs = [
        math.log((m * d) / (n * c))
        for n, c, m, d in zip(ours.relmse, ours.cpu_per_spp, theirs.relmse, theirs.cpu_per_spp)
    ]
    mean, spread = statistics.mean(logs), T_OF_REPLICATES * statistics.stdev(logs) / math.sqrt(len(logs))
    return tuple(math.exp(v) for v in (mean, mean - spread, mean + spread))


HEADS = [
    "scene", "abbe's integrator", "peer", "pixels, spp",
    "relMSE: abbe", "peer",
    "CPU µs a path: abbe", "peer",
    "efficiency: abbe", "peer", "ratio (95 %)",
    "fixed CPU s: abbe", "peer", "peak MiB: abbe", "peer", "block means, peer − abbe",
]  # fmt: skip


def rows(case, found, report):
    own = report["reference"]["relmse"] or 0.0
    pixels = report["width"] * report["height"]
    variants = {v["name"]: v for v in report["variants"]}
    theirs = figures(variants.pop(case.peer), own)
    spp = report["variants"][0]["budgets"][-1]["samples_per_pixel"]
    for name, variant in variants.items():
        ours = figures(variant, own)
        found_ratio = ratio(ours, theirs)
        told_ratio = "**{:.3g}** ({:.3g}–{:.3g})".format(*found_ratio) if found_ratio else "too short to tell"
        mean = statistics.mean
        efficiency = lambda f: 1 / (mean(f.relmse) * mean(f.cpu_per_spp) * spp)
        micro = lambda f, share=1: mean(f.cpu_per_spp) * share / pixels * 1e6
        mebi = lambda f: f"{f.peak / 2**20:.0f}" if f.peak else "–"
        yield [
            case.name, "auto" if name == "abbe" else name, case.peer, f"{report['width']}×{report['height']}, {spp}" + (f" and {spp // case.peer_share}" if case.peer_share > 1 else ""),
            f"{mean(ours.relmse):.2e}", f"{mean(theirs.relmse):.2e}",
            f"{micro(ours):.2f}", f"{micro(theirs, case.peer_share):.2f}",
            f"{efficiency(ours):.3g}", f"{efficiency(theirs):.3g}", told_ratio,
            f"{ours.fixed + report['compile_seconds']:.2f}", f"{theirs.fixed:.2f}", mebi(ours), mebi(theirs),
            told(found) if found else "not checked",
        ]  # fmt: skip


def report_of(table, version, seconds):
    line = lambda cells: "| " + " | ".join(cells) + " |\n"
    text = "# abbe against other renderers\n\n"
    text += f"Written by `python3 validation/peers/run.py --all` in {seconds / 60:.0f} min, {version}, "
    text += f"{os.cpu_count()} processors, Mitsuba {VARIANT}.\n\n"
    text += line(HEADS) + line(["---"] * len(HEADS)) + "".join(line(row) for row in table)
    text += f"""
* relMSE: mean over pixels and X, Y, Z of (I − R)² / (R² + 0.01 m²), m the mean of R, of {REPLICATES} runs, less the reference's own.
* A path is one sample of one pixel. Its cost is the slope of the CPU time over the samples, which leaves out what does not
  grow with them: start, reading and compiling the scene, a pilot. That is "fixed".
* Efficiency is 1 / (relMSE · CPU seconds of the samples). The ratio is the geometric mean over {REPLICATES} pairs of runs taken in
  turns, with the 95 % range of that mean.
* raysect traces a ray for each of 16 bands: a path of its is 16.
* Block means are X, Y and Z; tolerance {100 * TOLERANCE} %. Mitsuba divides by 106.7503 where ∫ȳ dλ is 106.8569, so all its
  pictures are 0.10 % bright; that is taken off before.
"""
    return text


def compare_all(binary, cases, benchmark):
    started = time.monotonic()
    if any(case.name == "mesh" for case in cases) and not MESH.exists():
        subprocess.run([sys.executable, str(HERE / "mesh.py"), str(MESH)], check=True)
    found = {case.name: check(binary, case) for case in cases}
    if benchmark:
        table = [row for case in cases for row in rows(case, found[case.name], bench(binary, case))]
        version = subprocess.run([binary, "--version"], check=True, capture_output=True, text=True).stdout.strip()
        report = report_of(table, version, time.monotonic() - started)
        print(report)
        if len(cases) == len(CASES):
            (HERE / "report.md").write_text(report, encoding="utf-8")
    sys.exit(0 if all(f["agrees"] for f in found.values()) else 1)


def main():
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=Path, help="scenes to bench against Mitsuba")
    parser.add_argument("--all", action="store_true", help="agreement and efficiency on all scenes")
    parser.add_argument("--check", action="store_true", help="agreement on all scenes")
    parser.add_argument("--only", choices=[case.name for case in CASES], action="append", help="of these scenes")
    wanted, more = parser.parse_args(sys.argv[1:split]), sys.argv[split + 1 :]
    if not (wanted.scenes or wanted.all or wanted.check):
        parser.error("expected --all, --check or scenes")
    ensure_environment()
    binary = str(abbe_binary())
    if wanted.all or wanted.check:
        cases = [case for case in CASES if not wanted.only or case.name in wanted.only]
        compare_all(binary, cases, wanted.all)
    for path in wanted.scenes:
        path = path.resolve()
        folder = OUTPUT / path.stem
        folder.mkdir(parents=True, exist_ok=True)
        with Boxed(path) as scene:
            command, threads = peer_command(binary, "mitsuba", scene, folder)
            line = [binary, "bench", str(scene), "--against", against("mitsuba", command, threads), "-o", str(folder)]
            subprocess.run([*line, *more], check=True)


if __name__ == "__main__":
    main()
