"""XYZ by the exact rule: lamps, reflectances under lamps, emissions, lines; Planck's law."""

import numpy as np

import colour
import oracle
from export_tables import ILLUMINANTS

NAMES = [name for _, _, names in ILLUMINANTS.values() for name in names]
CHECKER = colour.SDS_COLOURCHECKERS["ColorChecker N Ohta"]
LINES = [[435.8, 1.0], [546.1, 0.1], [589.2937, 0.01], [632.816, 0.001], [555.0, 40.0]]
CUT_LINES = [[360.1, 2.0], [829.5, 5.0]]
KELVINS = [300.0, 1000.0, 2856.0, 5600.0, 6504.0, 25000.0, 1e6]
WAVELENGTHS = [float(x) for x in range(360, 831, 5)]


def reflectances():
    """The 24 measured patches and six analytic curves on awkward knots."""
    tables = [(np.asarray(sd.wavelengths, float), np.asarray(sd.values, float)) for sd in CHECKER.values()]
    knots = np.cumsum(np.concatenate([[351.3], 0.37 + 3.1 * np.abs(np.sin(np.arange(260)))]))
    for centre, width in ((430, 20), (480, 60), (555, 5), (600, 100), (650, 30), (700, 200)):
        tables.append((knots, 0.02 + 0.9 * np.exp(-(((knots - centre) / width) ** 2))))
    return tables


def request():
    as_json = [{"wavelengths_nm": list(w), "values": list(v)} for w, v in reflectances()]
    return {
        "illuminants": NAMES,
        "reflectances": as_json,
        "emissions": as_json,
        "lines": LINES + CUT_LINES,
        "blackbodies": KELVINS,
        "wavelengths_nm": WAVELENGTHS,
    }


def gaussian(centre, fwhm):
    """A line on knots of its own choice, finer than the crate's."""
    sigma = fwhm / (2.0 * np.sqrt(2.0 * np.log(2.0)))
    x = np.linspace(-8.0, 8.0, 16001)
    wavelengths = np.concatenate([[centre - 8.001 * sigma], centre + x * sigma, [centre + 8.001 * sigma]])
    values = np.concatenate([[0.0], np.exp(-0.5 * x * x) / (sigma * np.sqrt(2.0 * np.pi)), [0.0]])
    return wavelengths, values


def dense_xyz(*tables, white):
    """The same by the plainest rule there is: midpoints 0.002 nm wide, whose own error is below 1e-8."""
    at = 360.001 + 0.002 * np.arange(235000)
    lamp = np.interp(at, *white)
    weights = np.stack([np.interp(at, *oracle.cmf(axis)) for axis in range(3)], axis=1) * lamp[:, None]
    product = np.ones_like(at)
    for table in tables:
        product = product * np.interp(at, *table)
    return product @ weights / weights[:, 1].sum()


def check(values):
    lamps = [oracle.illuminant(name) for name in NAMES]
    tables = reflectances()
    rows = [oracle.row("illuminant names, differing", len(NAMES), len(set(NAMES) ^ set(values["illuminant_names"])), 0)]

    expected = [oracle.xyz(lamp, white=lamp) for lamp in lamps]
    error = oracle.largest_relative(values["illuminant_xyz"], expected)
    rows.append(oracle.row("XYZ of illuminants v. Gauss quadrature, relative", len(lamps), error, 1e-12))

    expected = [[oracle.xyz(table, lamp, white=lamp) for lamp in lamps] for table in tables]
    error = oracle.largest_relative(values["reflectance_xyz"], expected)
    cases = len(tables) * len(lamps)
    rows.append(oracle.row("XYZ of reflectances under illuminants v. Gauss quadrature, relative", cases, error, 1e-12))

    some = [NAMES.index(name) for name in ("A", "D65", "FL11", "LED-B3", "HP1")]
    expected = [[dense_xyz(table, white=lamps[i]) for i in some] for table in tables]
    error = oracle.largest_relative(np.asarray(values["reflectance_xyz"])[:, some], expected)
    rows.append(oracle.row("the same v. midpoints of 0.002 nm, relative", len(tables) * len(some), error, 1e-7))

    error = 0.0
    for (name, sd), table in zip(CHECKER.items(), values["reflectance_xyz"]):
        for i in some[:4]:
            reference = colour.colorimetry.sd_to_XYZ_integration(
                linear(sd), oracle.CMFS, linear(colour.SDS_ILLUMINANTS[NAMES[i]]), shape=oracle.CMFS.shape
            )
            error = max(error, oracle.largest_relative(table[i], reference / 100.0))
    # colour sums at 1 nm: that sum is up to 2.3e-4 away from the Gauss quadrature too (LED-B3).
    rows.append(oracle.row("the same v. colour.sd_to_XYZ_integration at 1 nm, relative", 24 * 4, error, 3e-4))

    expected = [oracle.xyz(table) for table in tables]
    error = oracle.largest_relative(values["emission_xyz"], expected)
    rows.append(oracle.row("XYZ of emissions v. Gauss quadrature, relative", len(tables), error, 1e-12))

    # Both tabulate the Gaussian: at most 40 knots a standard deviation here, 1000 there.
    for lines, xyz, what, tolerance in (
        (LINES, values["line_xyz"][: len(LINES)], "lines of 0.001 to 40 nm", 1e-5),
        (CUT_LINES, values["line_xyz"][len(LINES) :], "lines cut by the range", 1e-5),
    ):
        error = oracle.largest_relative(xyz, [oracle.xyz(gaussian(*line)) for line in lines])
        rows.append(oracle.row(f"XYZ of {what} v. a finer table, relative", len(lines), error, tolerance))
    return rows + planck(values)


def linear(sd):
    """A copy of a colour-science distribution at 1 nm, joined by straight lines and held constant at its ends."""
    at = np.arange(360.0, 831.0)
    return colour.SpectralDistribution(np.interp(at, sd.wavelengths, sd.values), at)


def planck_law(wavelengths, kelvin):
    """Radiance per nm with the exact constants of the SI."""
    h, c, k = 6.62607015e-34, 299792458.0, 1.380649e-23
    radiance = colour.colorimetry.planck_law(wavelengths * 1e-9, kelvin, c1=2.0 * np.pi * h * c * c, c2=h * c / k)
    return radiance.ravel() * 1e-9


def planck(values):
    expected = np.asarray([planck_law(np.asarray(WAVELENGTHS), kelvin) for kelvin in KELVINS])
    error = float(np.abs(np.asarray(values["blackbodies"]) / expected - 1.0).max())
    rows = [oracle.row("Planck's law v. colour.planck_law with exact constants, relative", expected.size, error, 1e-12)]
    at = 360.001 + 0.002 * np.arange(235000)
    cmfs = np.stack([np.interp(at, *oracle.cmf(axis)) for axis in range(3)], axis=1)
    expected = np.asarray([planck_law(at, kelvin) @ cmfs for kelvin in KELVINS]) / cmfs[:, 1].sum()
    error = oracle.largest_relative(values["blackbody_xyz"], expected)
    rows.append(oracle.row("XYZ of blackbodies v. midpoints of 0.002 nm, relative", len(KELVINS), error, 1e-5))
    return rows
