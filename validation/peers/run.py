#!/usr/bin/env python3
"""Times abbe against Mitsuba 3 on the same scenes: `python3 validation/peers/run.py SCENE.json... [-- BENCH ARGUMENTS]`.

Installs Mitsuba into validation/peers/.venv once. Each scene is copied with a box filter, which is the one filter both
have, exported by `abbe scene export`, and benchmarked by `abbe bench`. Results go to bench/.
"""

import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ENVIRONMENT = HERE / ".venv"
PYTHON = ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
VARIANT = os.environ.get("ABBE_MITSUBA_VARIANT", "llvm_ad_spectral")
NM_D = "587.5618"


def ensure_environment():
    stamp, wanted = ENVIRONMENT / "requirements.txt", HERE / "requirements.txt"
    if PYTHON.exists() and stamp.exists() and stamp.read_text() == wanted.read_text():
        return
    subprocess.run([sys.executable, "-m", "venv", "--clear", str(ENVIRONMENT)], check=True)
    subprocess.run([str(PYTHON), "-m", "pip", "install", "--quiet", "-r", str(wanted)], check=True)
    shutil.copy(wanted, stamp)


def abbe():
    binary = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "release" / "abbe"
    subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=ROOT, check=True)
    return str(binary)


def exported(binary, scene, folder):
    """The scene with a box filter beside the original, for the files it names, and its translation."""
    content = json.loads(scene.read_text(encoding="utf-8"))
    content.setdefault("film", {})["filter"] = {"type": "box"}
    boxed = scene.with_name(f"{scene.stem}-box.json")
    boxed.write_text(json.dumps(content), encoding="utf-8")
    xml = folder / f"{scene.stem}.xml"
    # Glass gets one index: Mitsuba has no dispersion. abbe renders it with dispersion all the same, which is more work.
    subprocess.run([binary, "scene", "export", "--format", "mitsuba", "--at", NM_D, str(boxed), "-o", str(xml)], check=True)
    return boxed, xml


def main():
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    scenes, more = [Path(name).resolve() for name in sys.argv[1:split]], sys.argv[split + 1 :]
    if not scenes:
        sys.exit(__doc__.split("\n")[0])
    ensure_environment()
    binary = abbe()
    with tempfile.TemporaryDirectory() as folder:
        for scene in scenes:
            boxed, xml = exported(binary, scene, Path(folder))
            render = [str(PYTHON), str(HERE / "render_mitsuba.py"), str(xml), "--variant", VARIANT]
            command = shlex.join(render) + " --spp {spp} --seed {seed} --threads {threads} --out {out}"
            try:
                output = ["-o", str(Path("bench") / scene.stem)]
                subprocess.run([binary, "bench", str(boxed), "--against", f"mitsuba={command}", *output, *more], check=True)
            finally:
                boxed.unlink()


if __name__ == "__main__":
    main()
