"""Dominant wavelength, purity, optimal colours, whiteness, yellowness."""

import colour
import numpy as np
from colour.volume import XYZ_outer_surface, is_within_macadam_limits, is_within_visible_spectrum
from comparison import Comparison, row
from oracle import CMFS, CMFS_VALUES, CMFS_WAVELENGTHS, illuminant

WHITES = {name: colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"][name] for name in ["D65", "A", "E"]}
LOCUS = colour.XYZ_to_xy(CMFS_VALUES)
PURITIES = 3000


def within_the_locus(count):
    """Chromaticities uniform in the diagram, not nearer than 1e-3 to its outline's noisy ends."""
    rng = np.random.default_rng(20261122)
    i = rng.integers(40, 320, (count, 3))
    return np.einsum("ni,nij->nj", rng.dirichlet([1.0] * 3, count), LOCUS[i])


def dominant():
    """Against colour-science, which gives the nearest sample of 1 nm but the exact purity."""
    found = []
    for name, white in WHITES.items():
        xy = within_the_locus(PURITIES)
        wavelength, _, _ = colour.dominant_wavelength(xy, white)
        purities = colour.excitation_purity(xy, white), colour.colorimetric_purity(xy, white)
        found.append((name, xy, white, wavelength, *purities))
    return found


def check_dominant(evaluate):
    rows = []
    for name, xy, white, wavelength, excitation, colorimetric in dominant():
        values = np.array(evaluate("dominant_wavelength", [[v, list(white)] for v in xy.tolist()]))
        same_side = np.sign(values[:, 0]) == np.sign(wavelength)
        rows.append(row(f"dominant wavelength, {name}: purples told apart", len(xy), (~same_side).sum(), 0))
        # Beyond 680 nm the samples' chromaticities crowd and the nearest one may be many nm away.
        clear = np.abs(values[:, 0]) < 680
        error = np.abs(values[clear, 0] - wavelength[clear]).max()
        # The nearest chromaticity is not always that of the nearest wavelength: the locus is not run through evenly.
        rows.append(row(f"dominant wavelength, {name}, nm", clear.sum(), error, 0.52))
        # colour-science intersects with a line made 1e4 long, which costs it digits; see the cases by construction.
        rows.append(row(f"excitation purity, {name}", len(xy), np.abs(values[:, 1] - excitation).max(), 1e-6))
        rows.append(row(f"colorimetric purity, {name}", len(xy), np.abs(values[:, 2] - colorimetric).max(), 1e-6))
    return rows


def exact_dominant():
    """Mixtures of a light between the samples, joined by straight lines, and white: nothing is quantised."""
    rng = np.random.default_rng(7)
    found = []
    for name, white in WHITES.items():
        wavelength = rng.uniform(415, 660, 2000)
        share = rng.uniform(0.01, 1, 2000)
        light = np.column_stack([np.interp(wavelength, CMFS_WAVELENGTHS, CMFS_VALUES[:, k]) for k in range(3)])
        light_y = share[:, None] * light / light[:, 1:2]
        xy = colour.XYZ_to_xy(light_y + (1 - share[:, None]) * colour.xy_to_XYZ(white))
        spectral = colour.XYZ_to_xy(light)
        excitation = np.linalg.norm(xy - white, axis=-1) / np.linalg.norm(spectral - white, axis=-1)
        arguments = [[v, list(white)] for v in xy.tolist()]
        # 1e-16 of a chromaticity at 1 % purity is 1e-14 of the diagram, of which 1 nm is 1e-3 near 650 nm.
        expected = list(np.column_stack([wavelength, excitation, share]))
        subject = f"dominant wavelength and purities by construction, {name}"
        found.append(Comparison(subject, "dominant_wavelength", arguments, expected, 1e-8))
    return found


def check_complementary(evaluate):
    """Of the chromaticities whose complement is no purple."""
    rows = []
    for name, white in WHITES.items():
        xy = within_the_locus(PURITIES)
        wavelength, _, _ = colour.complementary_wavelength(xy, white)
        values = evaluate("complementary_wavelength", [[v, list(white)] for v in xy.tolist()])
        has_none = np.array([isinstance(v, dict) for v in values])
        wrong = (has_none != (wavelength < 0)).sum()
        rows.append(row(f"complementary wavelength, {name}: who has none", len(xy), wrong, 0))
        pairs = [(v, w) for v, w, none in zip(values, wavelength, has_none) if not none and v < 680]
        rows.append(row(f"complementary wavelength, {name}, nm", len(pairs), max(abs(v - w) for v, w in pairs), 0.52))
    return rows


def band_xyz(name, start, end):
    """XYZ of what a band reflects, by quadrature that is exact for products of two linear functions."""
    wavelengths, values = illuminant(name)

    def integral(a, b, axis):
        knots = np.unique(np.concatenate([[a, b], wavelengths, CMFS_WAVELENGTHS]))
        knots = knots[(knots >= a) & (knots <= b)]
        middle, half = (knots[1:] + knots[:-1]) / 2, (knots[1:] - knots[:-1]) / 2
        at = [middle + sign * half / np.sqrt(3) for sign in (-1, 1)]
        f = [np.interp(x, wavelengths, values) * np.interp(x, CMFS_WAVELENGTHS, CMFS_VALUES[:, axis]) for x in at]
        return ((f[0] + f[1]) * half).sum()

    white = integral(360, 830, 1)
    if start <= end:
        return [integral(start, end, axis) / white for axis in range(3)]
    return [(integral(360, 830, axis) - integral(end, start, axis)) / white for axis in range(3)]


def bands():
    rng = np.random.default_rng(11)
    arguments = [[name, *rng.uniform(360, 830, 2).tolist()] for name in ["A", "D65", "FL11", "HP1"] for _ in range(100)]
    expected = [band_xyz(*argument) for argument in arguments]
    return [Comparison("optimal colours of bands", "optimal_band", arguments, expected, 1e-12)]


def check_outer_surface(evaluate):
    """colour-science adds up samples, each for the step around it: at 5 nm that is 1e-3 off at a step of reflectance."""
    step = 5
    shape = colour.SpectralShape(360, 830, step)
    cmfs = CMFS.copy().align(shape)
    surface = XYZ_outer_surface(cmfs, colour.SDS_ILLUMINANTS["E"].copy().align(shape))
    count = len(cmfs.wavelengths)
    width, first = (part.ravel() for part in np.mgrid[1:count, 0:count])
    expected = surface[1 + (width - 1) * count + first]
    start, end = 360 + step * (first - 0.5), 360 + step * ((first + width) % count - 0.5)
    values = evaluate("optimal_band", [["E", s, e] for s, e in zip(start.tolist(), end.tolist())])
    return [row("optimal colours, sums of 5 nm", len(values), np.abs(np.array(values) - expected).max(), 2e-3)]


def check_limits(evaluate):
    """What colour-science has inside has to be inside, but for 1 % of brightness: its surfaces are convex hulls of samples to
    four digits, which leave out up to a tenth of the solid. The other side is that of linear programming."""
    rng = np.random.default_rng(17)
    rows = []
    xy = within_the_locus(4000)
    y = rng.uniform(0.1, 0.95, len(xy))
    for name in ["A", "C", "D65"]:
        inside = is_within_macadam_limits(np.column_stack([xy, y]), name)
        rows.append(check_inside(evaluate, f"within MacAdam's limits, {name}", name, xy, y, inside))
    # The same for the equal-energy illuminant, from samples of 5 nm.
    y = 10 ** rng.uniform(-2, 0, len(xy))
    inside = is_within_visible_spectrum(colour.xyY_to_XYZ(np.column_stack([xy, y])))
    return [*rows, check_inside(evaluate, "within the visible spectrum", "E", xy, y, inside)]


def check_inside(evaluate, subject, name, xy, y, inside):
    xyz = colour.xyY_to_XYZ(np.column_stack([xy, 0.99 * y]))[inside]
    values = np.array(evaluate("is_within_macadam_limits", [[name, v] for v in xyz.tolist()]))
    return row(subject, len(values), (values == 0).sum(), 0)


def check_limits_by_linear_programming(evaluate):
    """The brightest reflectance in cells of 0.5 nm, by HiGHS; cells can only lose."""
    from scipy.optimize import linprog

    edges = np.linspace(360, 830, 941)
    middle = (edges[1:] + edges[:-1]) / 2
    rows = []
    for name in ["A", "D65", "FL11", "LED-RGB1"]:
        lamp = np.interp(middle, *illuminant(name))
        cells = np.column_stack([np.interp(middle, CMFS_WAVELENGTHS, CMFS_VALUES[:, k]) * lamp for k in range(3)])
        cells /= cells[:, 1].sum()
        points = within_the_locus(25)
        values = np.array(evaluate("macadam_limit", [[name, v] for v in points.tolist()]))
        best = []
        for x, y in points:
            across = np.array([cells[:, 0] * y - cells[:, 1] * x, cells[:, 2] * y - cells[:, 1] * (1 - x - y)])
            across /= np.abs(across).sum(axis=1, keepdims=True)
            best.append(-linprog(-cells[:, 1], A_eq=across, b_eq=[0, 0], bounds=(0, 1), method="highs-ds").fun)
        error = np.abs(values - best).max()
        rows.append(row(f"MacAdam's limits by linear programming, {name}", len(points), error, 2e-4))
    return rows


def near_whites(count):
    rng = np.random.default_rng(19)
    return colour.xy_to_XYZ(WHITES["D65"]) * rng.uniform(0.7, 1.05, (count, 3))


def whiteness():
    xyz, white = near_whites(1000), colour.xy_to_XYZ(WHITES["D65"])
    xy, white_xy, y = colour.XYZ_to_xy(xyz), WHITES["D65"], 100 * xyz[:, 1]
    # colour-science's functions one by one: its wrapper passes the white's Y as the sample's to Ganz 1979 and CIE 2004.
    c = colour.colorimetry
    observers = ["CIE 1931 2 Degree Standard Observer", "CIE 1964 10 Degree Standard Observer"]
    indices = {
        "berger1959": c.whiteness_Berger1959(100 * xyz, 100 * white),
        "taube1960": c.whiteness_Taube1960(100 * xyz, 100 * white),
        "stensby1968": c.whiteness_Stensby1968(colour.XYZ_to_Lab(xyz, white_xy)),
        "astm-e313": c.whiteness_ASTME313(100 * xyz),
        "ganz1979": c.whiteness_Ganz1979(xy, y),
        "cie2004-2": c.whiteness_CIE2004(xy, y, white_xy, observers[0]),
        "cie2004-10": c.whiteness_CIE2004(xy, y, white_xy, observers[1]),
    }
    white = white.tolist()
    return [
        Comparison(f"whiteness {name}", "whiteness", [[name, v, white] for v in xyz.tolist()], list(index), 1e-10)
        for name, index in indices.items()
    ]


def yellowness():
    xyz = near_whites(1000)
    c = colour.colorimetry
    coefficients = c.YELLOWNESS_COEFFICIENTS_ASTME313
    two, ten = coefficients["cie_2_1931"], coefficients["cie_10_1964"]
    indices = {
        "astm-d1925": c.yellowness_ASTMD1925(100 * xyz),
        "astm-e313-alternative": c.yellowness_ASTME313_alternative(100 * xyz),
        "astm-e313-c-2": c.yellowness_ASTME313(100 * xyz, two["C"]),
        "astm-e313-d65-2": c.yellowness_ASTME313(100 * xyz, two["D65"]),
        "astm-e313-c-10": c.yellowness_ASTME313(100 * xyz, ten["C"]),
        "astm-e313-d65-10": c.yellowness_ASTME313(100 * xyz, ten["D65"]),
    }
    return [
        Comparison(f"yellowness {name}", "yellowness", [[name, v] for v in xyz.tolist()], list(index), 1e-10)
        for name, index in indices.items()
    ]


def comparisons():
    return exact_dominant() + bands() + whiteness() + yellowness()


def checks(evaluate):
    rows = check_dominant(evaluate) + check_complementary(evaluate) + check_outer_surface(evaluate)
    return rows + check_limits(evaluate) + check_limits_by_linear_programming(evaluate)
