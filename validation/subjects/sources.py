"""Light by formula, and correlated colour temperature."""

import colour
import numpy as np
import oracle
from comparison import Comparison
from colour.colorimetry import SpectralShape

SEED = 20240608
KELVINS = [300.0, 1000.0, 2856.0, 5600.0, 6504.0, 25000.0, 1e6]
WAVELENGTHS = [float(x) for x in range(360, 831, 5)]
SI_C2 = 6.62607015e-34 * 299792458.0 / 1.380649e-23


def comparisons():
    return [*thermal(), *daylight(), *leds(), *by_definition(), *by_approximation()]


def planck_law(wavelengths, kelvin, **constants):
    """Radiance per nm, with the exact constants of the SI unless others are given."""
    h, c = 6.62607015e-34, 299792458.0
    constants = constants or {"c1": 2.0 * np.pi * h * c * c, "c2": SI_C2}
    return colour.colorimetry.planck_law(np.asarray(wavelengths) * 1e-9, kelvin, **constants).ravel() * 1e-9


def thermal():
    grid = [[kelvin, WAVELENGTHS] for kelvin in KELVINS]
    at = np.asarray(WAVELENGTHS)
    # One wavelength a case, so that the error is relative to each value.
    alone = [[kelvin, [wavelength]] for kelvin in KELVINS for wavelength in WAVELENGTHS]
    expected = np.concatenate([planck_law(at, kelvin) for kelvin in KELVINS])
    yield Comparison("Planck's law with exact constants", "blackbody", alone, list(expected), 1e-12, True)
    rng = np.random.default_rng(SEED)
    random = [(float(10.0 ** rng.uniform(3.0, 4.4)), float(rng.uniform(200.0, 2000.0))) for _ in range(2000)]
    its_90 = {"c1": 3.741771e-16, "c2": 1.4388e-2}
    yield Comparison(
        "Planck's law with colour's constants",
        "planck_law",
        [["its-90", kelvin, [wavelength]] for kelvin, wavelength in random],
        [planck_law([wavelength], kelvin, **its_90) for kelvin, wavelength in random],
        1e-12,
        True,
    )
    # colour has k to 6 digits; the law is proportional to it.
    exact_k = 1.380649e-23 / colour.constants.CONSTANT_BOLTZMANN
    yield Comparison(
        "Rayleigh-Jeans law",
        "rayleigh_jeans_law",
        grid,
        [colour.colorimetry.rayleigh_jeans_law(at * 1e-9, kelvin) * 1e-9 * exact_k for kelvin in KELVINS],
        1e-12,
        True,
    )
    shape = SpectralShape(300, 830, 1)
    by_formula = colour.sd_CIE_standard_illuminant_A(shape)
    table = colour.SDS_ILLUMINANTS["A"]
    yield Comparison(
        "illuminant A by its formula", "illuminant_a", by_formula.wavelengths.tolist(), list(by_formula.values), 1e-12, True
    )
    yield Comparison(
        "the same v. its table", "illuminant_a", table.wavelengths.tolist(), list(table.values), 5e-6, True
    )


def daylight():
    rng = np.random.default_rng(SEED + 1)
    kelvins = [4000.0, 5003.0, 6504.0, 6999.999999, 7000.0, 7000.000001, 25000.0, *rng.uniform(4000.0, 25000.0, size=500)]
    kelvins = [float(kelvin) for kelvin in kelvins]
    xy = np.array([colour.CCT_to_xy(kelvin, method="CIE Illuminant D Series") for kelvin in kelvins])
    yield Comparison("chromaticity of daylight", "daylight_xy", kelvins, list(xy), 1e-12, True)
    for rounded in (True, False):
        yield Comparison(
            f"spectra of daylight, {'rounded' if rounded else 'exact'} factors",
            "daylight_of_kelvin",
            [[kelvin, rounded] for kelvin in kelvins],
            [colour.sd_CIE_illuminant_D_series(c, M1_M2_rounding=rounded).values for c in xy],
            1e-12,
            True,
            frozen_cases=6,
        )
    some = [[float(x), float(y)] for x, y in rng.uniform((0.24, 0.25), (0.40, 0.42), size=(200, 2))]
    yield Comparison(
        "the same by chromaticity, off the locus",
        "daylight_of_xy",
        [[c, False] for c in some],
        [colour.sd_CIE_illuminant_D_series(c, M1_M2_rounding=False).values for c in some],
        1e-12,
        True,
        frozen_cases=6,
    )


def leds():
    rng = np.random.default_rng(SEED + 2)
    shape = SpectralShape(360, 780, 1)
    at = shape.wavelengths.tolist()
    pairs = [[float(p), float(w)] for p, w in rng.uniform((380.0, 2.0), (760.0, 80.0), size=(100, 2))]
    for method, function in (("Normal", "gaussian"), ("FWHM", "gaussian_of_fwhm")):
        expected = [colour.sd_gaussian(p, w, shape, method=method).values for p, w in pairs]
        yield Comparison(f"Gaussian by {method}", function, [[p, w, at] for p, w in pairs], expected, 1e-12, True, 2)
    grid = [360.0, 780.0, 1.0]
    expected = [colour.sd_single_led(p, shape, half_spectral_width=w).values for p, w in pairs]
    yield Comparison("single LED by Ohno 2005", "leds", [[[[p, w, 1.0]], grid] for p, w in pairs], expected, 1e-12, True, 2)
    arguments, expected = [], []
    for _ in range(50):
        count = int(rng.integers(2, 6))
        peaks, widths = rng.uniform(400.0, 700.0, size=count), rng.uniform(8.0, 40.0, size=count)
        powers = rng.uniform(0.1, 3.0, size=count)
        arguments.append([np.stack([peaks, widths, powers], axis=1).tolist(), grid])
        led = colour.sd_multi_leds(peaks, shape, half_spectral_widths=widths, peak_power_ratios=powers)
        expected.append(led.values)
    yield Comparison("several LEDs by Ohno 2005", "leds", arguments, expected, 1e-12, True, 2)


# Correlated colour temperature


def planckian(mireds, duvs):
    """u, v of points beside the exact locus, in extended precision: four-point Gauss quadrature in each nanometre."""
    x, w = map(np.longdouble, np.polynomial.legendre.leggauss(5))
    at = (np.arange(360, 830, dtype=np.longdouble)[:, None] + (x + 1) / 2).ravel()
    cmfs = np.stack([interpolated(at, axis) for axis in range(3)], axis=1)
    cmfs = cmfs * np.tile(w, 470)[:, None] / at[:, None] ** 5
    mired = np.asarray(mireds, dtype=np.longdouble)[:, None]
    power = np.longdouble(SI_C2) * 1e3 / at * mired
    # d/dm of 1 / (exp(x) - 1) is -x / (4 m sinh²(x/2)).
    value = (1 / np.expm1(power)) @ cmfs
    slope = (-power / (4 * mired * np.sinh(power / 2) ** 2)) @ cmfs
    s, ds = (v @ np.array([1, 15, 3], dtype=np.longdouble) for v in (value, slope))
    uv = np.stack([4 * value[:, 0], 6 * value[:, 1]], axis=1) / s[:, None]
    tangent = (np.stack([4 * slope[:, 0], 6 * slope[:, 1]], axis=1) - uv * ds[:, None]) / s[:, None]
    normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1) / np.hypot(tangent[:, 0], tangent[:, 1])[:, None]
    return (uv + normal * np.asarray(duvs, dtype=np.longdouble)[:, None]).astype(float)


def interpolated(at, axis):
    """A colour-matching function between its samples, in extended precision."""
    values = np.asarray(oracle.CMFS_VALUES[:, axis], dtype=np.longdouble)
    i = np.floor(at).astype(int) - 360
    t = at - np.floor(at)
    return values[i] * (1 - t) + values[i + 1] * t


def near_the_locus(count, hottest=25000.0, widest=0.03):
    """Temperatures (K) and distances: the ends and random ones."""
    rng = np.random.default_rng(SEED + 3)
    kelvins = 1e6 / rng.uniform(1e6 / hottest, 1e6 / 1667.0, size=count)
    duvs = rng.uniform(-widest, widest, size=count)
    for i, (kelvin, duv) in enumerate([(1667.0, 0.0), (hottest, 0.0), (6504.0, 0.0), (1667.0, widest), (hottest, -widest)]):
        kelvins[i], duvs[i] = kelvin, duv
    return kelvins, duvs


def by_definition():
    kelvins, duvs = near_the_locus(1000)
    uv = planckian(1e6 / kelvins, duvs)
    points = uv.tolist()
    pairs = np.stack([kelvins, duvs], axis=1).tolist()
    yield Comparison("CCT v. its definition, K", "cct", points, list(kelvins), 1e-6)
    yield Comparison("Duv v. its definition", "duv", points, list(duvs), 1e-12)
    yield Comparison("u, v of CCT and Duv v. its definition", "uv_of_cct", pairs, list(uv), 1e-13)
    # Ohno's method with colour's default sums at 1 nm over 360-780 nm is as far from the definition as those sums are from
    # integrals. With sums at 0.25 nm over 360-830 nm what is left is the method's own interpolation.
    for cmfs, what, tolerance in ((None, "sums at 1 nm", 1.0), (fine_cmfs(), "sums at 0.25 nm", 0.06)):
        ohno = list(colour.temperature.uv_to_CCT_Ohno2013(uv, cmfs=cmfs)[:, 0])
        yield Comparison(f"CCT v. Ohno 2013 with {what}, K", "cct_its_90", points, ohno, tolerance, frozen_cases=8)


def fine_cmfs():
    """The observer at 0.25 nm, by lines; halves at both ends make the sum a trapezoid rule."""
    at = np.arange(360.0, 830.1, 0.25)
    values = np.stack([np.interp(at, *oracle.cmf(axis)) for axis in range(3)], axis=1)
    values[[0, -1]] /= 2.0
    return colour.MultiSpectralDistributions(values, at, labels=["x", "y", "z"])


def by_approximation():
    kelvins, duvs = near_the_locus(600)
    points = planckian(1e6 / kelvins, duvs).tolist()
    pairs = np.stack([kelvins, duvs], axis=1).tolist()
    for name, method, forward, backward in (
        ("ohno", "ohno-2013", colour.temperature.CCT_to_uv_Ohno2013, colour.temperature.uv_to_CCT_Ohno2013),
        ("robertson", "robertson-1968", colour.temperature.CCT_to_uv_Robertson1968, colour.temperature.uv_to_CCT_Robertson1968),
    ):
        function = method.replace("-", "_")
        found = backward(np.asarray(points))
        by_method = [[method, point] for point in points]
        yield Comparison(f"CCT by {method}", "cct_by", by_method, list(found[:, 0]), 1e-8, True)
        yield Comparison(f"Duv by {method}", f"{function}_duv", points, list(found[:, 1]), 1e-10)
        # The direction of Ohno's locus is a difference over 0.01 K, which is a few 1e-10 in u, v with 8 digits left.
        tolerance = 1e-8 if name == "ohno" else 1e-10
        yield Comparison(f"u, v by {method}", f"uv_of_{function}", pairs, list(forward(np.asarray(pairs))), tolerance)
    xy = colour.models.UCS_uv_to_xy(np.asarray(points))
    for method, function in (
        ("mccamy-1992", colour.temperature.xy_to_CCT_McCamy1992),
        ("hernandez-1999", colour.temperature.xy_to_CCT_Hernandez1999),
    ):
        yield Comparison(f"CCT by {method}", "cct_by", [[method, point] for point in points], list(function(xy)), 1e-8, True)
    yield from curves()


def curves():
    """The methods that look for the nearest point of a curve: the curve, and the way back from it."""
    rng = np.random.default_rng(SEED + 4)
    uv_of_xy = lambda xy: colour.models.xy_to_UCS_uv(xy)  # noqa: E731
    for method, (low, high), curve, search, in_xy in (
        ("krystek-1985", (1000.0, 15000.0), colour.temperature.CCT_to_uv_Krystek1985, colour.temperature.uv_to_CCT_Krystek1985, False),
        ("kang-2002", (1667.0, 25000.0), colour.temperature.CCT_to_xy_Kang2002, colour.temperature.xy_to_CCT_Kang2002, True),
        ("cie-d", (4000.0, 25000.0), colour.temperature.CCT_to_xy_CIE_D, colour.temperature.xy_to_CCT_CIE_D, True),
    ):
        kelvins = [low, high, *map(float, rng.uniform(low, high, size=300))]
        kelvins += [k for k in (2222.0, 4000.0, 7000.0) if low <= k <= high and method != "krystek-1985"]
        on_curve = curve(np.asarray(kelvins))
        uv = uv_of_xy(on_curve) if in_xy else on_curve
        yield Comparison(f"curve of {method}", "uv_of_cct_by", [[method, k] for k in kelvins], list(uv), 1e-12)
        back = [[method, point.tolist()] for point in uv]
        yield Comparison(f"CCT by {method}, of colours on its curve", "cct_by", back, kelvins, 1e-8, True)
        # colour-science searches with a simplex that stops at 1e-4 K or 1e-10 in distance.
        inner = np.asarray([k for k in kelvins if 1.2 * low < k < 0.6 * high][:40])
        off = curve(inner) + rng.uniform(-0.0005, 0.0005, size=(len(inner), 2))
        points = uv_of_xy(off) if in_xy else off
        found = search(off)
        yield Comparison(
            f"CCT by {method}, beside its curve", "cct_by", [[method, p.tolist()] for p in points], list(found), 1e-6, True
        )
