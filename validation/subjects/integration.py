"""Resampling; XYZ by the exact rule, by sums and by ASTM E308."""

import colour
import numpy as np
import oracle
from colour.colorimetry import SpectralShape
from comparison import Comparison, row
from subjects.sources import planck_law
from subjects.tables import OBSERVER_NAMES, all_lamps, illuminant_names, patches

SEED = 20240607
LAMPS = ["A", "C", "D50", "D65", "E", "FL2", "FL11", "LED-B3", "HP1"]
DENSE_LAMPS = ["A", "D65", "FL11", "LED-B3", "HP1"]
LINES = [[435.8, 1.0], [546.1, 0.1], [589.2937, 0.01], [632.816, 0.001], [555.0, 40.0]]
CUT_LINES = [[360.1, 2.0], [829.5, 5.0]]
KELVINS = [300.0, 1000.0, 2856.0, 5600.0, 6504.0, 25000.0, 1e6]
MIDPOINTS = 360.001 + 0.002 * np.arange(235000)
INTERPOLATORS = {
    "linear": colour.LinearInterpolator,
    "sprague": colour.SpragueInterpolator,
    "cubic-spline": colour.CubicSplineInterpolator,
}


def comparisons():
    return [*resampling(), *exact(), *lines(), *observers(), *blackbodies(), *sums(), *astm_e308()]


def as_argument(wavelengths, values):
    return [list(map(float, wavelengths)), list(map(float, values))]


def of_sd(sd):
    return as_argument(sd.wavelengths, sd.values)


def checker():
    """The 24 measured patches."""
    return [sd for (chart, _), sd in patches().items() if chart == "colorchecker-n-ohta"]


def others():
    """Some more measured reflectances, every 10 nm."""
    of = lambda chart: [sd for (c, _), sd in patches().items() if c == chart]  # noqa: E731
    return of("babelcolor-average")[::4] + of("pmc")[::5]


# Resampling


def resampling():
    """The grids of measured data and random numbers, to finer, coarser and shifted ones."""
    rng = np.random.default_rng(SEED)
    lamps = all_lamps()
    spectra = [*checker(), *others(), lamps["hps"], lamps["mercury"], lamps["kinoton-75p"]]
    tables = [(sd.wavelengths, sd.values) for sd in spectra]
    tables += [(np.arange(360.0, 831.0, step), rng.normal(size=len(np.arange(360.0, 831.0, step)))) for step in (1, 5, 10, 20)]
    rows = []
    for name, interpolator in INTERPOLATORS.items():
        arguments, expected = [], []
        for wavelengths, values in tables:
            for step in (0.7, 1.0, 5.0):
                at = np.arange(wavelengths[0], wavelengths[-1] + 1e-9, step)
                arguments.append([as_argument(wavelengths, values), at.tolist(), name])
                expected.append(interpolator(wavelengths, values)(at))
        rows.append(Comparison(f"{name} interpolation at equal distances", "interpolate", arguments, expected, 1e-12, True, 2))
    for name in ("linear", "cubic-spline"):
        arguments, expected = [], []
        for count in (4, 5, 9, 60):
            for _ in range(5):
                knots = 380.0 + np.cumsum(0.5 + rng.exponential(6.0, size=count))
                values = rng.uniform(size=count)
                at = np.sort(np.append(rng.uniform(knots[0], knots[-1], size=200), knots))
                arguments.append([as_argument(knots, values), at.tolist(), name])
                expected.append(INTERPOLATORS[name](knots, values)(at))
        rows.append(Comparison(f"{name} interpolation at unequal distances", "interpolate", arguments, expected, 1e-12, True, 2))
    return rows + aligning() + trimming()


def aligning():
    shapes = [(360.0, 830.0, 1.0), (360.0, 830.0, 5.0), (400.0, 700.0, 10.0), (300.0, 900.0, 20.0)]
    rows = []
    for outside in ("constant", "linear"):
        arguments, expected = [], []
        for sd in checker()[::2] + others():
            for inside, interpolator in INTERPOLATORS.items():
                for shape in shapes:
                    # colour-science extends from the last sample of the grid inside the range, this library from the last
                    # sample: they are the same where the grid has both ends.
                    if (sd.wavelengths[-1] - shape[0]) % shape[2] != 0 and sd.wavelengths[-1] < shape[1]:
                        continue
                    aligned = sd.copy().align(
                        SpectralShape(*shape),
                        interpolator=interpolator,
                        extrapolator_kwargs={"method": outside.capitalize(), "left": None, "right": None},
                    )
                    arguments.append([of_sd(sd), list(shape), inside, outside])
                    # colour-science extrapolates linearly from the samples as interpolated, this library from those given.
                    expected.append(aligned.values if outside == "constant" else extended(sd, aligned))
        rows.append(Comparison(f"alignment, {outside} beyond", "align", arguments, expected, 1e-12, True, 4))
    return rows


def extended(sd, aligned):
    """Aligned values, with those outside the samples by colour.Extrapolator on the samples."""
    at = aligned.wavelengths
    by_lines = colour.Extrapolator(colour.LinearInterpolator(sd.wavelengths, sd.values), method="Linear")
    outside = (at < sd.wavelengths[0]) | (at > sd.wavelengths[-1])
    return np.where(outside, by_lines(at), aligned.values)


def trimming():
    ranges = [(400.0, 700.0), (360.0, 555.0), (501.0, 519.9)]
    arguments, expected = [], []
    for sd in checker()[::6]:
        for start, end in ranges:
            trimmed = sd.copy().trim(SpectralShape(start, end, 1))
            arguments.append([of_sd(sd), start, end])
            expected.append(np.stack([trimmed.wavelengths, trimmed.values], axis=1))
    return [Comparison("trimming", "trim", arguments, expected, 0.0, frozen_cases=3)]


# The exact rule


def reflectances():
    """The 24 measured patches and six analytic curves on awkward knots."""
    tables = [(sd.wavelengths, sd.values) for sd in checker()]
    knots = np.cumsum(np.concatenate([[351.3], 0.37 + 3.1 * np.abs(np.sin(np.arange(260)))]))
    for centre, width in ((430, 20), (480, 60), (555, 5), (600, 100), (650, 30), (700, 200)):
        tables.append((knots, 0.02 + 0.9 * np.exp(-(((knots - centre) / width) ** 2))))
    return tables


def dense_xyz(*tables, white):
    """The same by the plainest rule there is: midpoints 0.002 nm wide, whose own error is below 1e-8."""
    lamp = np.interp(MIDPOINTS, *white)
    weights = np.stack([np.interp(MIDPOINTS, *oracle.cmf(axis)) for axis in range(3)], axis=1) * lamp[:, None]
    product = np.ones_like(MIDPOINTS)
    for table in tables:
        product = product * np.interp(MIDPOINTS, *table)
    return product @ weights / weights[:, 1].sum()


def linear(sd):
    """A copy of a colour-science distribution at 1 nm, joined by straight lines and held constant at its ends."""
    at = np.arange(360.0, 831.0)
    return colour.SpectralDistribution(np.interp(at, sd.wavelengths, sd.values), at)


def under(tables, lamps, observer="1931-2"):
    """Arguments of a reflectance under an illuminant, for all pairs."""
    return [[as_argument(*table), lamp, observer] for table in tables for lamp in lamps]


def exact():
    names, tables = illuminant_names(), reflectances()
    lamps = {name: oracle.illuminant(name) for name in names}
    yield Comparison(
        "XYZ of illuminants v. Gauss quadrature",
        "xyz_of_illuminant",
        names,
        [oracle.xyz(lamp, white=lamp) for lamp in lamps.values()],
        1e-12,
        True,
    )
    yield Comparison(
        "XYZ of reflectances under illuminants v. Gauss quadrature",
        "xyz_of_reflectance",
        under(tables, names),
        [oracle.xyz(table, lamp, white=lamp) for table in tables for lamp in lamps.values()],
        1e-12,
        True,
        frozen_cases=4,
    )
    yield Comparison(
        "the same v. midpoints of 0.002 nm",
        "xyz_of_reflectance",
        under(tables, DENSE_LAMPS),
        [dense_xyz(table, white=lamps[name]) for table in tables for name in DENSE_LAMPS],
        1e-7,
        True,
        frozen_cases=0,
    )
    integrate = colour.colorimetry.sd_to_XYZ_integration
    yield Comparison(
        "the same v. colour.sd_to_XYZ_integration at 1 nm",
        "xyz_of_reflectance",
        under([(sd.wavelengths, sd.values) for sd in checker()], DENSE_LAMPS[:4]),
        [
            integrate(linear(sd), oracle.CMFS, linear(colour.SDS_ILLUMINANTS[name]), shape=oracle.CMFS.shape) / 100.0
            for sd in checker()
            for name in DENSE_LAMPS[:4]
        ],
        3e-4,  # colour sums at 1 nm: that sum is up to 2.3e-4 away from the Gauss quadrature too (LED-B3)
        True,
        frozen_cases=0,
    )
    yield Comparison(
        "XYZ of emissions v. Gauss quadrature",
        "xyz_of_emission",
        [[as_argument(*table), "1931-2"] for table in tables],
        [oracle.xyz(table) for table in tables],
        1e-12,
        True,
        frozen_cases=4,
    )


def gaussian(centre, fwhm, knots=16001):
    """A line on knots of its own choice, finer than the crate's."""
    sigma = fwhm / (2.0 * np.sqrt(2.0 * np.log(2.0)))
    x = np.linspace(-8.0, 8.0, knots)
    reach = 8.0 * (1.0 + 1.0 / knots)
    wavelengths = np.concatenate([[centre - reach * sigma], centre + x * sigma, [centre + reach * sigma]])
    values = np.concatenate([[0.0], np.exp(-0.5 * x * x) / (sigma * np.sqrt(2.0 * np.pi)), [0.0]])
    return wavelengths, values


def subdivided(table, parts):
    """The same piecewise linear function with more knots."""
    wavelengths, values = table
    at = np.concatenate([np.linspace(a, b, parts, endpoint=False) for a, b in zip(wavelengths, wavelengths[1:])])
    at = np.append(at, wavelengths[-1])
    return at, np.interp(at, wavelengths, values)


def lines():
    # Both tabulate the Gaussian: at most 40 knots a standard deviation here, 1000 there.
    for cases, what in ((LINES, "lines of 0.001 to 40 nm"), (CUT_LINES, "lines cut by the range")):
        expected = [oracle.xyz(gaussian(*line)) for line in cases]
        yield Comparison(f"XYZ of {what} v. a finer table", "xyz_of_line", cases, expected, 1e-5, True)
    # The line itself in a table: now both integrate the same function.
    tables = [gaussian(centre, width, 101) for centre, width in [*LINES[:4], (404.65, 0.01), (700.0, 0.01)]]
    yield Comparison(
        "XYZ of tabulated lines of 0.001 to 1 nm v. quadrature on 20 times the knots",
        "xyz_of_emission",
        [[as_argument(*table), "1931-2"] for table in tables],
        [oracle.xyz(subdivided(table, 20)) for table in tables],
        1e-12,
        True,
        frozen_cases=2,
    )


def observers():
    """The exact rule for the other observers; those of 2015 are 0 below 390 nm."""
    tables, arguments, expected = reflectances()[::4], [], []
    for name, known_as in OBSERVER_NAMES.items():
        cmfs = colour.MSDS_CMFS[known_as]
        for table in tables:
            arguments.append([as_argument(*table), name])
            first = cmfs.wavelengths[0]
            curves = [(cmfs.wavelengths, cmfs.values[:, axis]) for axis in range(3)]
            integrals = [integral_from(first, table, curve) for curve in curves]
            expected.append(np.array(integrals) / integral_from(first, curves[1]))
    return [Comparison("XYZ of emissions for four observers", "xyz_of_emission", arguments, expected, 1e-12, True, 6)]


def integral_from(first, *tables):
    """As oracle.integral, from another wavelength on: what is below is taken off."""
    knots = np.unique(np.concatenate([[first, oracle.LAMBDA_MAX], *[np.asarray(t[0], dtype=float) for t in tables]]))
    knots = knots[(knots >= first) & (knots <= oracle.LAMBDA_MAX)]
    middle, half = (knots[1:] + knots[:-1]) / 2, (knots[1:] - knots[:-1]) / 2
    total = 0.0
    for sign in (-1.0, 1.0):
        at = middle + sign * half / np.sqrt(3.0)
        product = half.copy()
        for table in tables:
            product = product * np.interp(at, *table)
        total += product.sum()
    return total


def blackbodies():
    cmfs = np.stack([np.interp(MIDPOINTS, *oracle.cmf(axis)) for axis in range(3)], axis=1)
    expected = np.asarray([planck_law(MIDPOINTS, kelvin) @ cmfs for kelvin in KELVINS]) / cmfs[:, 1].sum()
    return [Comparison("XYZ of blackbodies v. midpoints of 0.002 nm", "xyz_of_blackbody", KELVINS, list(expected), 1e-5, True)]


# Parity modes


def sums():
    """Reflectances by Sprague's interpolation, illuminants by lines, constant ends: as colour does it by default."""
    integrate = colour.colorimetry.sd_to_XYZ_integration
    arguments, expected = [], []
    for observer, known_as in OBSERVER_NAMES.items():
        cmfs = colour.MSDS_CMFS[known_as]
        shape = [float(cmfs.shape.start), float(cmfs.shape.end), 1.0]
        for lamp in LAMPS:
            for sd in checker() + others():
                arguments.append([of_sd(sd), lamp, observer, shape, "sprague"])
                expected.append(integrate(sd, cmfs, colour.SDS_ILLUMINANTS[lamp]) / 100.0)
    yield Comparison("XYZ by sums at 1 nm", "xyz_by_sum", arguments, expected, 1e-12, True, 12)

    arguments, expected = [], []
    for observer, known_as in OBSERVER_NAMES.items():
        for shape in ([400.0, 700.0, 5.0], [390.0, 770.0, 10.0], [400.0, 700.0, 20.0]):
            cmfs = colour.MSDS_CMFS[known_as].copy().align(SpectralShape(*shape))
            for lamp in LAMPS:
                for sd in checker()[::5] + others()[::3]:
                    arguments.append([of_sd(sd), lamp, observer, shape, "sprague"])
                    expected.append(integrate(sd, cmfs, colour.SDS_ILLUMINANTS[lamp]) / 100.0)
    yield Comparison("XYZ by sums at 5, 10 and 20 nm", "xyz_by_sum", arguments, expected, 1e-12, True, 12)


def every(sd, step):
    """The samples at multiples of a step, with the interval that colour looks at."""
    chosen = (sd.wavelengths - sd.wavelengths[0]) % step == 0
    if step == 1:
        return sd.copy().align(SpectralShape(sd.shape.start, sd.shape.end, 1))
    return colour.SpectralDistribution(sd.values[chosen], sd.wavelengths[chosen])


def astm_e308():
    practice = colour.colorimetry.sd_to_XYZ_ASTME308
    for step, spectra in (
        (1, checker()[::3]),
        (5, checker()),
        (10, checker() + others()),
        (20, checker() + others()),
    ):
        arguments, expected = [], []
        for observer, known_as in OBSERVER_NAMES.items():
            for lamp in LAMPS:
                for sd in spectra:
                    sampled = every(sd, step)
                    arguments.append([of_sd(sampled), lamp, observer])
                    xyz = practice(sampled, colour.MSDS_CMFS[known_as], colour.SDS_ILLUMINANTS[lamp])
                    expected.append(xyz / 100.0)
        frozen = 2 if step == 1 else 8
        yield Comparison(f"XYZ by ASTM E308 at {step} nm", "xyz_by_astm_e308", arguments, expected, 1e-12, True, frozen)

    arguments, expected = [], []
    for observer, known_as in list(OBSERVER_NAMES.items())[:2]:
        for lamp in LAMPS:
            for sd in checker():
                sampled = every(sd, 20)
                arguments.append([of_sd(sampled), lamp, observer])
                xyz = practice(
                    sampled, colour.MSDS_CMFS[known_as], colour.SDS_ILLUMINANTS[lamp], mi_20nm_interpolation_method=False
                )
                expected.append(xyz / 100.0)
    yield Comparison("XYZ by weights at 20 nm", "xyz_by_astm_e308_weights", arguments, expected, 1e-12, True, 6)

    arguments, expected = [], []
    for observer, known_as in OBSERVER_NAMES.items():
        cmfs = colour.MSDS_CMFS[known_as]
        cmfs = cmfs.copy().trim(SpectralShape(360, 780, 1))
        for lamp in LAMPS:
            illuminant = colour.SDS_ILLUMINANTS[lamp].copy().align(cmfs.shape)
            for step in (10, 20):
                table = colour.colorimetry.tristimulus_weighting_factors_ASTME2022(
                    cmfs, illuminant, SpectralShape(cmfs.shape.start, cmfs.shape.end, step)
                )
                arguments.append([lamp, observer, float(step)])
                expected.append(table / 100.0)
    yield Comparison("weights of ASTM E308 at 10 and 20 nm", "astm_e308_weights", arguments, expected, 1e-12, True, 6)


def checks(evaluate):
    """What needs no reference: a perfect diffuser has the illuminant's XYZ, and nothing positive gives a negative XYZ."""
    white = as_argument([360.0, 830.0], [1.0, 1.0])
    lamps = illuminant_names()
    found = evaluate("xyz_of_reflectance", [[white, lamp, "1931-2"] for lamp in lamps])
    of_lamps = evaluate("xyz_of_illuminant", lamps)
    error = float(np.abs(np.asarray(found) - of_lamps).max())
    rows = [row("a perfect diffuser is its illuminant", len(lamps), error, 1e-13)]
    rng = np.random.default_rng(SEED + 1)
    arguments = []
    for _ in range(300):
        knots = np.sort(rng.uniform(350.0, 840.0, size=rng.integers(2, 30)))
        values = rng.uniform(size=len(knots)) * (rng.uniform(size=len(knots)) < 0.3)
        arguments.append([as_argument(knots, values), str(rng.choice(LAMPS)), str(rng.choice(list(OBSERVER_NAMES)))])
    least = np.asarray(evaluate("xyz_of_reflectance", arguments)).min()
    rows.append(row("negative XYZ of reflectances that are not", len(arguments), max(0.0, -least), 0.0))
    return rows
