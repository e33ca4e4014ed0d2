#!/usr/bin/env python3
"""All methods side by side, with the time that each takes: writes validation/recovery.md, in about a minute.

    validation/.venv/bin/python validation/recovery_peers.py

It also writes recovery_peers.json, the spectra that the slow methods of colour-science give to the 24 patches of the
ColorChecker, which subjects/recovery.py compares with. Our times are those of `cargo bench --bench color`.
"""

import json
import os
import sys
import time
import warnings
from importlib import metadata
from pathlib import Path

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")
warnings.filterwarnings("ignore")
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import numpy as np  # noqa: E402

import colour  # noqa: E402
import reflectances  # noqa: E402
from reflectances import WEIGHTS, to_knots, weights  # noqa: E402

LAMPS = ["D65", "D50", "A", "FL2", "FL11", "LED-B3", "LED-RGB1", "HP1"]
OURS = ["natural", "smoothest", "jakob-hanika", "mallett", "smits", "smits-linear", "otsu", "meng"]


def smits(xyz):
    return colour.recovery.RGB_to_sd_Smits1999(srgb(xyz))


def mallett(xyz):
    return colour.recovery.RGB_to_sd_Mallett2019(srgb(xyz))


def srgb(xyz):
    """Methods for RGB know sRGB alone: other colours are cut off."""
    return np.clip(np.linalg.inv(reflectances.XYZ_FROM_SRGB) @ xyz, 0.0, 1.0)


FAST = {"Smits": smits, "Mallett": mallett, "Otsu": colour.recovery.XYZ_to_sd_Otsu2018}
SLOW = {"jakob-hanika": colour.recovery.XYZ_to_sd_Jakob2019, "meng": colour.recovery.XYZ_to_sd_Meng2015}


def recovered(method, measured):
    """Reflectances of the patches' colours under D65 at the knots."""
    return np.array([to_knots(sd.wavelengths, sd.values) for sd in map(method, measured @ WEIGHTS)])


def fast_methods(measured):
    return {name: recovered(method, measured) for name, method in FAST.items()}


def table_row(name, found, measured, milliseconds):
    rmse = np.sqrt(((found - measured)[:, 40:341] ** 2).mean())
    cells = [name, f"{rmse:.4f}"]
    for lamp in LAMPS:
        difference = reflectances.differences(found @ weights(lamp), measured @ weights(lamp), lamp)
        cells.append(f"{difference.mean():.2f} / {difference.max():.1f}")
    return cells + [milliseconds]


def ours(measured):
    """Spectra of the methods by name; those made for sRGB get what is cut off to it, the others all of Rec. 2020."""
    import run

    limited = {"mallett", "smits", "smits-linear"}
    srgb_colors = [srgb(xyz).tolist() for xyz in measured @ WEIGHTS]
    wide = (measured @ WEIGHTS @ np.linalg.inv(reflectances.xyz_from_rgb("ITU-R BT.2020")).T).tolist()
    found = {}
    for name in OURS:
        space, colors = ("srgb", srgb_colors) if name in limited else ("rec2020", wide)
        found[name] = np.array(run.evaluate("upsampled", [[name, space, c] for c in colors]))
    return found


def main():
    measured = reflectances.checker()
    theirs = []
    spectra = {}
    for name, method in {**FAST, **SLOW}.items():
        method(measured[0] @ WEIGHTS)
        start = time.perf_counter()
        found = recovered(method, measured)
        milliseconds = 1e3 * (time.perf_counter() - start) / len(measured)
        theirs.append(table_row(f"{name}, colour-science", found, measured, f"{milliseconds:.3g}"))
        print(name, f"{milliseconds:.3g} ms a colour", flush=True)
        if name in SLOW:
            spectra[name] = np.round(found, 7).tolist()
    (HERE / "recovery_peers.json").write_text(json.dumps({"spectra": spectra}) + "\n", encoding="utf-8")
    rows = [table_row(f"**{name}**", found, measured, "") for name, found in ours(measured).items()] + theirs
    head = ["method", "rmse", *LAMPS, "ms a colour"]
    lines = ["| " + " | ".join(cells) + " |" for cells in [head, ["---"] * len(head), *rows]]
    text = (
        "# RGB to spectrum, method by method\n\n"
        f"Written by `validation/.venv/bin/python validation/recovery_peers.py` with colour-science {metadata.version('colour-science')}.\n"
        "The colour under D65 of each of the 24 patches of the ColorChecker N Ohta is upsampled and looked at under other lamps:\n"
        "spectral rmse over 400-700 nm, CIEDE2000 mean / largest. Ours are in bold; their times are in README.md.\n\n"
    )
    (HERE / "recovery.md").write_text(text + "\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
