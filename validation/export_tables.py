#!/usr/bin/env python3
"""Writes the colour tables of data/ from colour-science, digit for digit.

Run it with the interpreter that validation/run.py made:

    validation/.venv/bin/python validation/export_tables.py

The files are checked in; this script is their origin, and validation/subjects/tables.py compares every sample with the
package again.
"""

import os
import re
import shutil
import sys
import warnings
from importlib import metadata
from pathlib import Path

warnings.filterwarnings("ignore")

import colour  # noqa: E402

DATA = Path(__file__).resolve().parent.parent / "data"

# File name -> (name in colour-science, title, edition).
OBSERVERS = {
    "cie_1931_2deg": (
        "CIE 1931 2 Degree Standard Observer",
        "CIE 1931 2 degree standard observer, colour-matching functions",
        "CIE 015:2018",
    ),
    "cie_1964_10deg": (
        "CIE 1964 10 Degree Standard Observer",
        "CIE 1964 10 degree standard observer, colour-matching functions",
        "CIE 015:2018",
    ),
    "cie_2015_2deg": (
        "CIE 2015 2 Degree Standard Observer",
        "CIE 2015 2 degree observer, cone-fundamental-based colour-matching functions",
        "CIE 170-2:2015",
    ),
    "cie_2015_10deg": (
        "CIE 2015 10 Degree Standard Observer",
        "CIE 2015 10 degree observer, cone-fundamental-based colour-matching functions",
        "CIE 170-2:2015",
    ),
}

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

# File name -> (name in colour-science, title, edition). Columns have the patches' names as slugs.
CHECKERS = {
    "babelcolor_average": (
        "BabelColor Average",
        "ColorChecker Classic, average of 30 charts, copyright 2004-2012 Danny Pascale (www.babelcolor.com)",
        "2012, in colour-science by permission of BabelColor",
    ),
    "colorchecker_n_ohta": ("ColorChecker N Ohta", "ColorChecker Classic, measured by N. Ohta", "1997"),
    "iso_17321_1": ("ISO 17321-1", "ColorChecker Classic as in ISO 17321-1; the same samples as N. Ohta's", "2012"),
    "preferred_memory_colors": ("PMC", "Preferred memory colour chart by M. R. Luo", "2024"),
}

# File name -> (what it holds, edition, the dictionary of colour-science). Columns have the lamps' names as slugs.
LAMPS = {
    "pointer": ("lamps of M. R. Pointer's gamut data", "Pointer 1980, spreadsheet by RIT", "RIT"),
    "nist_traditional": ("traditional lamps of the NIST CQS simulation", "version 7.4, 2008", "NIST_TRADITIONAL"),
    "nist_led": ("LED lamps of the NIST CQS simulation", "version 7.4, 2008", "NIST_LED"),
    "nist_philips": ("Philips lamps of the NIST CQS simulation", "version 7.4, 2008", "NIST_PHILIPS"),
    "projectors": ("projection lamps: a xenon arc", "T. Borer 2017, private communication", "COMMON"),
}


def lamps(family):
    """The spectral distributions of a file of lamps, by their names in colour-science."""
    sds = colour.colorimetry.datasets.light_sources.sds
    return getattr(sds, "SDS_LIGHT_SOURCES_" + LAMPS[family][2])


def slug(name):
    """A name in lower case, with hyphens for whatever is not a letter, digit or point: how abbe names it."""
    return re.sub(r"[^a-z0-9.]+", "-", name.lower()).strip("-")


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


def write_named(folder, name, head, sds):
    """A file whose columns are named by slugs of the names in colour-science."""
    slugs = [slug(n) for n in sds]
    if len(set(slugs)) != len(slugs):
        sys.exit(f"two columns of {folder}/{name}.csv have the same name")
    write(DATA / folder / f"{name}.csv", head, slugs, [samples(sd) for sd in sds.values()])


def main():
    for name, (known_as, title, edition) in OBSERVERS.items():
        cmfs = colour.MSDS_CMFS[known_as]
        columns = [dict(zip(map(float, cmfs.wavelengths), map(float, cmfs.values[:, i]))) for i in range(3)]
        head = header(title, edition, "dimensionless")
        write(DATA / "observers" / f"{name}.csv", head, ["x_bar", "y_bar", "z_bar"], columns)
    for name, (title, edition, names) in ILLUMINANTS.items():
        write(
            DATA / "illuminants" / f"{name}.csv",
            header(title, edition, "relative spectral power"),
            names,
            [samples(colour.SDS_ILLUMINANTS[n]) for n in names],
        )
    components = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES
    write(
        DATA / "illuminants" / "daylight_components.csv",
        header("mean and first two eigenvectors of the CIE daylights", "CIE 15:2004", "relative spectral power"),
        ["S0", "S1", "S2"],
        [samples(components[n]) for n in ("S0", "S1", "S2")],
    )
    for name, (known_as, title, edition) in CHECKERS.items():
        write_named("reflectances", name, header(title, edition, "reflectance"), colour.SDS_COLOURCHECKERS[known_as])
    for name, (title, edition, _) in LAMPS.items():
        write_named("lamps", name, header(title, edition, "relative spectral power"), lamps(name))
    licence = [f for f in metadata.files("colour-science") if os.path.basename(str(f)) == "LICENSE"]
    if not licence:
        sys.exit("colour-science has no LICENSE file in its package")
    (DATA / "LICENSES").mkdir(exist_ok=True)
    shutil.copyfile(licence[0].locate(), DATA / "LICENSES" / "colour-science.txt")


if __name__ == "__main__":
    main()
