"""The built programs that the subjects ask."""

import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROFILE = os.environ.get("ABBE_VALIDATION_PROFILE", "release")  # "dev" compiles faster


def target_folder():
    # Cargo reads the variable relative to where it is started, which is always ROOT here.
    return ROOT / os.environ.get("CARGO_TARGET_DIR", "target")


def abbe_binary():
    """The command, brought up to date first; or the file that ABBE names."""
    if "ABBE" in os.environ:
        return Path(os.environ["ABBE"]).resolve()  # "./abbe" would be looked for on the PATH
    subprocess.run(["cargo", "build", "--profile", PROFILE, "--quiet", "--bin", "abbe"], cwd=ROOT, check=True)
    return target_folder() / ("debug" if PROFILE == "dev" else PROFILE) / ("abbe.exe" if os.name == "nt" else "abbe")
