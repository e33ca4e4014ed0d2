"""Every sample stored in data/ equals colour-science's, bit for bit, and none is missing."""

import csv
from pathlib import Path

import colour
import numpy as np
from comparison import Comparison, row
from export_tables import CHECKERS, ILLUMINANTS, LAMPS, OBSERVERS, lamps, slug

DATA = Path(__file__).resolve().parent.parent.parent / "data"
COMPONENTS = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES

# The library's names of observers and charts, and colour-science's.
OBSERVER_NAMES = dict(zip(["1931-2", "1964-10", "2015-2", "2015-10"], [known for known, _, _ in OBSERVERS.values()]))
CHECKER_NAMES = dict(
    zip(["babelcolor-average", "colorchecker-n-ohta", "iso-17321-1", "pmc"], [known for known, _, _ in CHECKERS.values()])
)


def samples(sd):
    """Pairs of wavelength and value."""
    return np.stack([sd.wavelengths, sd.values], axis=1)


def all_lamps():
    """Every measured lamp by the library's name."""
    return {slug(name): sd for family in LAMPS for name, sd in lamps(family).items()}


def patches():
    """Every patch by the library's names of chart and patch."""
    charts = {chart: colour.SDS_COLOURCHECKERS[known] for chart, known in CHECKER_NAMES.items()}
    return {(chart, slug(name)): sd for chart, sds in charts.items() for name, sd in sds.items()}


def illuminant_names():
    return [name for _, _, names in ILLUMINANTS.values() for name in names]


def comparisons():
    cmfs = [colour.MSDS_CMFS[known] for known in OBSERVER_NAMES.values()]
    observers = [np.column_stack([c.wavelengths, c.values]) for c in cmfs]
    illuminants = illuminant_names()
    measured, charts = all_lamps(), patches()
    return [
        Comparison("observers in the library", "observer_table", list(OBSERVER_NAMES), observers, 0.0, frozen_cases=2),
        Comparison(
            "illuminants in the library",
            "illuminant_table",
            illuminants,
            [samples(colour.SDS_ILLUMINANTS[name]) for name in illuminants],
            0.0,
            frozen_cases=5,
        ),
        Comparison(
            "lamps in the library", "lamp_table", list(measured), [samples(sd) for sd in measured.values()], 0.0, frozen_cases=5
        ),
        Comparison(
            "patches in the library",
            "patch_table",
            [list(key) for key in charts],
            [samples(sd) for sd in charts.values()],
            0.0,
            frozen_cases=5,
        ),
    ]


def read(path):
    """Columns of a table of data/ as {name: {wavelength: value}}."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    names = rows[0][1:]
    columns = {name: {} for name in names}
    for cells in rows[1:]:
        for name, cell in zip(names, cells[1:]):
            if cell:
                columns[name][float(cells[0])] = float(cell)
    return columns


def differing(path, expected):
    """How many samples and columns of a file differ, are missing or are too many, of how many."""
    stored = read(DATA / path)
    wrong, cases = len(stored.keys() ^ expected.keys()), 0
    for name, (wavelengths, values) in expected.items():
        have, want = stored.get(name, {}), dict(zip(map(float, wavelengths), map(float, values)))
        keys = have.keys() | want.keys()
        wrong, cases = wrong + sum(have.get(key) != want.get(key) for key in keys), cases + len(keys)
    return wrong, cases


def files():
    """Every file of data/ that comes from colour-science, with what it has to hold."""
    for name, (known_as, _, _) in OBSERVERS.items():
        cmfs = colour.MSDS_CMFS[known_as]
        axes = {axis: (cmfs.wavelengths, cmfs.values[:, i]) for i, axis in enumerate(["x_bar", "y_bar", "z_bar"])}
        yield f"observers/{name}.csv", axes
    pair = lambda sd: (sd.wavelengths, sd.values)  # noqa: E731
    for name, (_, _, names) in ILLUMINANTS.items():
        yield f"illuminants/{name}.csv", {n: pair(colour.SDS_ILLUMINANTS[n]) for n in names}
    yield "illuminants/daylight_components.csv", {n: pair(COMPONENTS[n]) for n in ("S0", "S1", "S2")}
    for name, (known_as, _, _) in CHECKERS.items():
        sds = colour.SDS_COLOURCHECKERS[known_as]
        yield f"reflectances/{name}.csv", {slug(n): pair(sd) for n, sd in sds.items()}
    for name in LAMPS:
        yield f"lamps/{name}.csv", {slug(n): pair(sd) for n, sd in lamps(name).items()}


def checks(evaluate):
    rows = []
    for path, expected in files():
        wrong, cases = differing(path, expected)
        rows.append(row(f"table {path}, samples that differ", cases, wrong, 0))
    charts = list(CHECKER_NAMES)
    kinds = ["observers", "illuminants", "lamps", "checkers", *charts]
    of_charts = [[patch for chart, patch in patches() if chart == wanted] for wanted in charts]
    expected = [list(OBSERVER_NAMES), illuminant_names(), list(all_lamps()), charts, *of_charts]
    found = evaluate("names", kinds)
    wrong = sum(len(set(have) ^ set(want)) for have, want in zip(found, expected))
    complete = len({sd.name for sd in colour.SDS_LIGHT_SOURCES.values()} ^ {sd.name for f in LAMPS for sd in lamps(f).values()})
    rows.append(row("names of tables, differing", sum(map(len, expected)), wrong + complete, 0))
    return rows
