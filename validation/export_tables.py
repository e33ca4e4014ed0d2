#!/usr/bin/env python3
"""Writes the colour tables of data/ from colour-science, digit for digit.

Run it with the interpreter that validation/run.py made:

    validation/.venv/bin/python validation/export_tables.py

The files are checked in; this script is their origin, and validation/tables.py compares every sample with it again.
"""

import os
import shutil
import sys
import warnings
from importlib import metadata
from pathlib import Path

warnings.filterwarnings("ignore")

import colour  # noqa: E402

DATA = Path(__file__).resolve().parent.parent / "data"
OBSERVER = "CIE 1931 2 Degree Standard Observer"

# File name -> (what it holds, edition, names). The order here is the order of columns.
ILLUMINANTS = {
    "standard": (
        "CIE illuminants A, B, C, E, the daylights D and the indoor daylights ID",
        "CIE 15:2004 and CIE 015:2018; D60 is computed from the CIE daylight components",
        ["A", "B", "C", "D50", "D55", "D60", "D65", "D75", "E", "ID50", "ID65"],
    ),
    "fluorescent": (
        "CIE fluorescent lamps FL1 to FL12",
        "CIE 15:2004",
        [f"FL{i}" for i in range(1, 13)],
    ),
    "fluorescent_3": (
        "CIE fluorescent lamps FL3.1 to FL3.15",
        "CIE 15:2004",
        [f"FL3.{i}" for i in range(1, 16)],
    ),
    "high_pressure": (
        "CIE high pressure discharge lamps HP1 to HP5",
        "CIE 15:2004",
        [f"HP{i}" for i in range(1, 6)],
    ),
    "led": (
        "CIE typical LED lamps",
        "CIE 015:2018",
        ["LED-B1", "LED-B2", "LED-B3", "LED-B4", "LED-B5", "LED-BH1", "LED-RGB1", "LED-V1", "LED-V2"],
    ),
}


def header(title, edition, unit):
    return (
        f"# {title}\n"
        f"# edition: {edition}\n"
        f"# source: PyPI colour-science {metadata.version('colour-science')}\n"
        "# licence: BSD-3-Clause, data/LICENSES/colour-science.txt\n"
        f"# unit: wavelength in nm; {unit}\n"
        "# script: validation/export_tables.py\n"
    )


def number(value):
    """Shortest text that reads back as the same double."""
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


def write(path, head, names, columns):
    """One row a wavelength; an empty cell where a column has no sample."""
    wavelengths = sorted(set().union(*columns))
    rows = [",".join(["wavelength_nm", *names])]
    for wavelength in wavelengths:
        cells = [number(column[wavelength]) if wavelength in column else "" for column in columns]
        rows.append(",".join([number(wavelength), *cells]))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(head + "\n".join(rows) + "\n", encoding="utf-8", newline="\n")
    print(path.relative_to(DATA.parent), len(rows) - 1, "rows")


def samples(spectrum):
    return dict(zip(map(float, spectrum.wavelengths), map(float, spectrum.values)))


def main():
    cmfs = colour.MSDS_CMFS[OBSERVER]
    columns = [dict(zip(map(float, cmfs.wavelengths), map(float, cmfs.values[:, i]))) for i in range(3)]
    write(
        DATA / "observers" / "cie_1931_2deg.csv",
        header("CIE 1931 2 degree standard observer, colour-matching functions", "CIE 015:2018", "dimensionless"),
        ["x_bar", "y_bar", "z_bar"],
        columns,
    )
    for name, (title, edition, names) in ILLUMINANTS.items():
        write(
            DATA / "illuminants" / f"{name}.csv",
            header(title, edition, "relative spectral power"),
            names,
            [samples(colour.SDS_ILLUMINANTS[n]) for n in names],
        )
    licence = [f for f in metadata.files("colour-science") if os.path.basename(str(f)) == "LICENSE"]
    if not licence:
        sys.exit("colour-science has no LICENSE file in its package")
    (DATA / "LICENSES").mkdir(exist_ok=True)
    shutil.copyfile(licence[0].locate(), DATA / "LICENSES" / "colour-science.txt")


if __name__ == "__main__":
    main()
