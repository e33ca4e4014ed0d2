"""Light quality: rendering indices of all standard illuminants and of measured lamps; luminous flux."""

import colour
import export_quality
import numpy as np
from colour.colorimetry import photometry
from comparison import Comparison, row

# All CIE illuminants, and ISO 7589's, which have 10 nm and end at 690 or 560 nm.
ILLUMINANTS = dict(colour.SDS_ILLUMINANTS.items())
LAMPS = dict(colour.SDS_LIGHT_SOURCES.items())
PHOTOPIC = "photopic-1924"
FUNCTIONS = {
    PHOTOPIC: "CIE 1924 Photopic Standard Observer",
    "photopic-1964-10": "CIE 1964 Photopic 10 Degree Standard Observer",
    "photopic-2008-2": "CIE 2008 2 Degree Physiologically Relevant LEF",
    "photopic-2008-10": "CIE 2008 10 Degree Physiologically Relevant LEF",
    "scotopic-1951": "CIE 1951 Scotopic Standard Observer",
    "judd-1951": "Judd Modified CIE 1951 Photopic Standard Observer",
    "judd-vos-1978": "Judd-Vos Modified CIE 1978 Photopic Standard Observer",
}


def lights():
    """Tables at 5 nm; daylights and blackbodies at 1 nm; a diode that is narrow; a table at 2 nm and one cut short."""
    made = {**ILLUMINANTS, **LAMPS}
    for kelvin in (1800, 3999.9, 4000.1, 4500, 4999, 5001, 6500, 9300, 20000):
        made[f"blackbody {kelvin}"] = colour.sd_blackbody(kelvin, colour.SpectralShape(360, 830, 1))
    peaks, widths, powers = [457, 530, 615], [20, 30, 20], [0.7, 1.0, 0.9]
    made["diodes"] = colour.sd_multi_leds(peaks, half_spectral_widths=widths, peak_power_ratios=powers)
    made["FL2 cut"] = colour.SDS_ILLUMINANTS["FL2"].copy().trim(colour.SpectralShape(400, 700, 5))
    return made


def filled(sd):
    """Zeros at 380–780 nm where a table has nothing, as CIE 224 has it. colour-science warns that it does so, but its
    `align` overrides the extrapolator that was set, and it holds the table constant."""
    if sd.shape.start <= 380 and sd.shape.end >= 780:
        return sd
    at = np.arange(380, 781, sd.shape.interval)
    return colour.SpectralDistribution(np.interp(at, sd.wavelengths, sd.values, left=0.0, right=0.0), at)


def samples(sd):
    return [sd.wavelengths.tolist(), sd.values.tolist()]


def fits_cie_224(sd):
    """colour-science takes tables at 1 and 5 nm alone."""
    return sd.shape.interval in (1, 5)


def cri():
    arguments, expected = [], []
    for sd in lights().values():
        found = colour.colour_rendering_index(sd, additional_data=True, method="CIE 2024")
        ra = np.mean([found.Q_as[i].Q_a for i in range(1, 9)])
        arguments.append(samples(sd))
        expected.append([ra, *[found.Q_as[i].Q_a for i in range(1, 16)]])
    return [Comparison("CRI: Ra, R1 to R15", "cri", arguments, expected, 1e-9, frozen_cases=8)]


def cqs():
    made = []
    for version in ("7.4", "9.0"):
        arguments, expected, preference = [], [], []
        for sd in lights().values():
            found = colour.colour_quality_scale(sd, True, method="NIST CQS " + version)
            arguments.append([version, samples(sd)])
            expected.append([found.Q_a, found.Q_f, found.Q_g, *[found.Q_as[i].Q_a for i in range(1, 16)]])
            preference.append([found.Q_p, found.Q_d])
        made.append(Comparison(f"CQS {version}: Qa, Qf, Qg, samples", "cqs", arguments, expected, 1e-9, frozen_cases=5))
        if version == "7.4":
            tables = [a[1] for a in arguments]
            made.append(Comparison("CQS 7.4: Qp, Qd", "cqs_preference", tables, preference, 1e-9, frozen_cases=3))
    return made


def cie_2017():
    arguments, indices, rendition = [], [], []
    for sd in lights().values():
        if not fits_cie_224(sd):
            continue
        found = colour.quality.colour_fidelity_index_ANSIIESTM3018(filled(sd), True)
        arguments.append(samples(sd))
        indices.append([found.R_f, *found.R_s])
        bins = np.column_stack(
            [found.R_fs, found.R_cs, found.R_hs, found.averages_test, found.averages_reference]
        )
        rendition.append([found.R_f, found.R_g, *bins.ravel()])
    return [
        Comparison("CIE 2017: Rf of all and of 99 samples", "fidelity", arguments, indices, 1e-9, frozen_cases=6),
        Comparison("TM-30-18: Rf, Rg, bins", "tm30", arguments, rendition, 1e-9, frozen_cases=6),
    ]


def ssi():
    arguments, expected = [], []
    tables = lights()
    references = ["D65", "A", "FL11", "blackbody 6500", "LED-B3", "FL2 cut"]
    for name, sd in tables.items():
        for reference in references:
            arguments.append([samples(sd), samples(tables[reference])])
            expected.append(colour.spectral_similarity_index(sd, tables[reference], round_result=False))
    # HP lamps have indices of −1e3 and less against smooth references: relative to them.
    return [Comparison("SSI, relative", "ssi", arguments, expected, 1e-10, relative=True, frozen_cases=8)]


def luminous():
    at_samples, sums = [], []
    for sd in lights().values():
        for name, known_as in FUNCTIONS.items():
            lef = colour.SDS_LEFS[known_as]
            k_m = 1700 if name.startswith("scotopic") else 683
            at_samples.append([name, samples(sd)])
            sums.append([photometry.luminous_flux(sd, lef, k_m), photometry.luminous_efficiency(sd, lef)])
    # The tables of 1924 and 1931, and of 2008 and 2015, differ by rounding: 5e-13 and 5e-7.
    subject = "luminous flux and efficiency, sums at samples"
    return [Comparison(subject, "luminous_at_samples", at_samples, sums, 1e-6, True, frozen_cases=14)]


def comparisons():
    return cri() + cqs() + cie_2017() + ssi() + luminous()


def table_row():
    """Every sample of data/quality against the package."""
    wrong = count = 0
    sources = {name: (columns, sds) for name, (_, _, columns, sds) in export_quality.tables().items()}
    efficiencies = [colour.SDS_LEFS[name] for name in export_quality.EFFICIENCIES.values()]
    sources["luminous_efficiency"] = (list(export_quality.EFFICIENCIES), efficiencies)
    for name, (columns, sds) in sources.items():
        text = (export_quality.DATA / "quality" / f"{name}.csv").read_text(encoding="utf-8")
        rows = [line.split(",") for line in text.splitlines() if not line.startswith("#")]
        for i, (column, sd) in enumerate(zip(columns, sds, strict=True), start=1):
            kept = {float(r[0]): float(r[i]) for r in rows[1:] if r[i]}
            published = dict(zip(sd.wavelengths.tolist(), sd.values.tolist()))
            wrong += rows[0][i] != column or kept != published
            count += len(published)
    return row("tables of data/quality", count, wrong, 0.0)


def goldens(evaluate):
    """Values that were known before this library was."""
    known = {
        "FL2": (64.233724, 70.120824),
        "FL11": (82.859147, 80.040413),
        "LED-B3": (84.844064, 85.324309),
        "HP1": (8.498155, 34.192104),
    }
    tables = [samples(ILLUMINANTS[name]) for name in known]
    found = [[ra[0], rf[0]] for ra, rf in zip(evaluate("cri", tables), evaluate("fidelity", tables))]
    error = np.abs(np.array(found) - np.array(list(known.values()))).max()
    return row("CRI Ra and CIE 2017 Rf of four lamps, known to 6 decimals", len(known), error, 6e-7)


def exact_flux(evaluate):
    """The integral of the product of straight lines, by Simpson's rule on halves of 1 nm, which is exact for it."""
    arguments, expected = [], []
    lef = colour.SDS_LEFS[FUNCTIONS[PHOTOPIC]]
    for sd in {**ILLUMINANTS, **LAMPS}.values():
        start, end = max(360.0, sd.shape.start), sd.shape.end
        at = np.arange(start, end + 0.25, 0.5)
        product = np.interp(at, sd.wavelengths, sd.values) * np.interp(at, lef.wavelengths, lef.values)
        flux = (product[0:-1:2] + 4 * product[1::2] + product[2::2]).sum() / 6
        power = np.trapezoid(sd.values, sd.wavelengths)
        arguments.append([PHOTOPIC, samples(sd)])
        expected.append([683 * flux, 683 * flux / power])
    found = np.array(evaluate("luminous", arguments))
    return row("luminous flux and efficacy, integrals, relative", len(found), np.abs(found / expected - 1).max(), 1e-11)


def checks(evaluate):
    return [table_row(), goldens(evaluate), exact_flux(evaluate)]
