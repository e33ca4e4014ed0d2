#!/usr/bin/env python3
"""Writes the reflectances of data/quality from colour-science, digit for digit: what light is
judged by; and luminous efficiency functions.

Run it with the interpreter that validation/run.py made:

    validation/.venv/bin/python validation/export_quality.py

The files are checked in; this script is their origin, and validation/subjects/quality.py compares every sample with the
package again.
"""

import warnings
from importlib import metadata

warnings.filterwarnings("ignore")

import colour  # noqa: E402
from colour.quality.cfi2017 import load_TCS_CIE2017  # noqa: E402
from colour.quality.datasets.tcs import SDS_TCS  # noqa: E402
from colour.quality.datasets.vs import SDS_VS  # noqa: E402
from export_tables import DATA, samples, write  # noqa: E402


def tables():
    """File name -> (what it holds, edition, names of columns, spectra)."""
    colors = SDS_TCS["CIE 2024"]
    evaluation = load_TCS_CIE2017(colour.SpectralShape(380, 780, 1)).to_sds()
    made = {
        "cri": (
            "test colour samples of the CIE colour rendering index",
            "CIE 13.3:1995; TCS15 is the CIE's data set of 2024, Japanese skin",
            list(colors),
            list(colors.values()),
        ),
        "cie2017": (
            "99 colour evaluation samples of the CIE 2017 colour fidelity index and of ANSI/IES TM-30",
            "CIE 224:2017",
            [f"CES{i:02}" for i in range(1, 100)],
            evaluation,
        ),
    }
    for version in ("7.4", "9.0"):
        sds = SDS_VS["NIST CQS " + version]
        title = f"saturated samples of the NIST colour quality scale, version {version}"
        made["cqs_" + version] = (title, f"NIST CQS simulation {version}", list(sds), list(sds.values()))
    return made


# Name of a column -> name in colour-science. The photopic functions of the CIE are the observers' ȳ.
EFFICIENCIES = {
    "scotopic-1951": "CIE 1951 Scotopic Standard Observer",
    "judd-1951": "Judd Modified CIE 1951 Photopic Standard Observer",
    "judd-vos-1978": "Judd-Vos Modified CIE 1978 Photopic Standard Observer",
}


def header(title, edition, unit="reflectance"):
    return (
        f"# {title}\n"
        f"# edition: {edition}\n"
        f"# source: PyPI colour-science {metadata.version('colour-science')}\n"
        "# licence: BSD-3-Clause, data/LICENSES/colour-science.txt\n"
        f"# unit: wavelength in nm; {unit}\n"
        "# script: validation/export_quality.py\n"
    )


def main():
    for name, (title, edition, columns, sds) in tables().items():
        write(DATA / "quality" / f"{name}.csv", header(title, edition), columns, [samples(sd) for sd in sds])
    write(
        DATA / "quality" / "luminous_efficiency.csv",
        header(
            "luminous efficiency functions that are not an observer's", "CIE 1951; Judd 1951; Vos 1978", "dimensionless"
        ),
        list(EFFICIENCIES),
        [samples(colour.SDS_LEFS[name]) for name in EFFICIENCIES.values()],
    )


if __name__ == "__main__":
    main()
