"""Every sample stored in data/ equals colour-science's, bit for bit, and none is missing."""

import csv
from pathlib import Path

import oracle
from export_tables import ILLUMINANTS

DATA = Path(__file__).resolve().parent.parent / "data"


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


def differences(stored, wavelengths, values):
    """How many samples differ, are missing or are too many."""
    expected = dict(zip(map(float, wavelengths), map(float, values)))
    keys = stored.keys() | expected.keys()
    return sum(stored.get(key) != expected.get(key) for key in keys), len(keys)


def check():
    wrong = cases = 0
    observer = read(DATA / "observers" / "cie_1931_2deg.csv")
    for axis, name in enumerate(["x_bar", "y_bar", "z_bar"]):
        n_wrong, n = differences(observer[name], *oracle.cmf(axis))
        wrong, cases = wrong + n_wrong, cases + n
    rows = [oracle.row("table CIE 1931 2 degree observer, samples that differ", cases, wrong, 0)]
    for family, (_, _, names) in ILLUMINANTS.items():
        wrong = cases = 0
        columns = read(DATA / "illuminants" / f"{family}.csv")
        wrong += len(columns.keys() ^ set(names))
        for name in names:
            n_wrong, n = differences(columns.get(name, {}), *oracle.illuminant(name))
            wrong, cases = wrong + n_wrong, cases + n
        rows.append(oracle.row(f"table illuminants {family}, samples that differ", cases, wrong, 0))
    return rows
