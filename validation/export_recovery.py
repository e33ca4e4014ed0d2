#!/usr/bin/env python3
"""Writes the published tables of RGB-to-spectrum methods of data/recovery/ from colour-science, digit for digit.

Run it with the interpreter that validation/run.py made:

    validation/.venv/bin/python validation/export_recovery.py

The prior of the method `natural` is learnt by learn_natural.py.
"""

import warnings
from importlib import metadata
from pathlib import Path

warnings.filterwarnings("ignore")

import numpy as np  # noqa: E402

import colour  # noqa: E402
from colour.recovery.datasets.otsu2018 import (  # noqa: E402
    BASIS_FUNCTIONS_OTSU2018,
    CLUSTER_MEANS_OTSU2018,
    SELECTOR_ARRAY_OTSU2018,
    SPECTRAL_SHAPE_OTSU2018,
)
from colour.recovery.datasets.smits1999 import DATA_SMITS1999  # noqa: E402

DATA = Path(__file__).resolve().parent.parent / "data" / "recovery"
SMITS_NAMES = ["white", "cyan", "magenta", "yellow", "red", "green", "blue"]


def header(title, edition, unit, script="export_recovery.py"):
    return (
        f"# {title}\n"
        f"# edition: {edition}\n"
        f"# source: PyPI colour-science {metadata.version('colour-science')}\n"
        "# licence: BSD-3-Clause, data/LICENSES/colour-science.txt\n"
        f"# unit: {unit}\n"
        f"# script: validation/{script}\n"
    )


def number(value):
    """Shortest text that reads back as the same double."""
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


def write(name, head, columns, rows):
    lines = [",".join(columns)] + [",".join(number(value) for value in row) for row in rows]
    DATA.mkdir(parents=True, exist_ok=True)
    (DATA / name).write_text(head + "\n".join(lines) + "\n", encoding="utf-8", newline="\n")
    print("data/recovery/" + name, len(rows), "rows")


def smits():
    values = np.array([list(DATA_SMITS1999[name].values()) for name in SMITS_NAMES]).T
    # Ten bins of equal width from 380 to 720 nm.
    starts = 380.0 + 34.0 * np.arange(10)
    head = header(
        "Smits, basis reflectances for the white E",
        "B. Smits, An RGB-to-spectrum conversion for reflectances, JGT 4(4), 1999",
        "start of each bin of 34 nm, the last ends at 720 nm; dimensionless",
    )
    write("smits.csv", head, ["wavelength_nm", *SMITS_NAMES], np.column_stack([starts, values]))


def mallett():
    basis = colour.recovery.MSDS_BASIS_FUNCTIONS_sRGB_MALLETT2019
    head = header(
        "Mallett and Yuksel, basis reflectances of the sRGB primaries under D65",
        "I. Mallett and C. Yuksel, Spectral primary decomposition for rendering with sRGB reflectance, EGSR 2019",
        "wavelength in nm; dimensionless",
    )
    write("mallett.csv", head, ["wavelength_nm", "red", "green", "blue"], np.column_stack([basis.wavelengths, basis.values]))


def otsu():
    wavelengths = SPECTRAL_SHAPE_OTSU2018.wavelengths
    cmfs = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(SPECTRAL_SHAPE_OTSU2018)
    d65 = colour.SDS_ILLUMINANTS["D65"].copy().align(SPECTRAL_SHAPE_OTSU2018)
    # XYZ is linear in the samples: that of a spectrum which is 1 at one wavelength is the weight of that wavelength.
    eye = np.eye(len(wavelengths))
    weights = [colour.sd_to_XYZ(colour.SpectralDistribution(one, wavelengths), cmfs, d65) / 100 for one in eye]
    columns, values = ["weight_x", "weight_y", "weight_z"], [np.array(weights)]
    for cluster, (mean, basis) in enumerate(zip(CLUSTER_MEANS_OTSU2018, BASIS_FUNCTIONS_OTSU2018)):
        columns += [f"mean_{cluster}", *(f"basis_{cluster}_{i}" for i in range(3))]
        values += [mean[:, None], basis.T]
    edition = "H. Otsu, M. Yamamoto, T. Hachisuka, Reproducing spectral reflectances from tristimulus colours, CGF 37(6), 2018"
    head = header(
        "Otsu et al.: XYZ weights of the wavelengths under D65 (ASTM E308 as colour-science has it), eight clusters",
        edition,
        "wavelength in nm; dimensionless",
    )
    write("otsu.csv", head, ["wavelength_nm", *columns], np.column_stack([wavelengths, *values]))
    head = header(
        "Otsu et al.: tree of the clusters. Chromaticity x (0) or y (1) at most or above a threshold leads to a cluster,"
        " or to the node of the negated number",
        edition,
        "dimensionless",
    )
    write("otsu_tree.csv", head, ["threshold", "axis", "at_most", "above"], SELECTOR_ARRAY_OTSU2018)


if __name__ == "__main__":
    smits()
    mallett()
    otsu()
