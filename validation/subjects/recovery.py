"""Spectra from RGB: our methods by their own conditions, by measured patches, and beside those of colour-science."""

import itertools
import json
from pathlib import Path

import numpy as np
from scipy.optimize import linprog

import colour
import comparison
import recovery_peers
import reflectances
from comparison import Comparison, row
from reflectances import WEIGHTS, XYZ_FROM_SRGB, weights

# Our name -> colour-science's.
SPACES = {
    "srgb": "sRGB",
    "display-p3": "Display P3",
    "rec2020": "ITU-R BT.2020",
    "adobe-rgb": "Adobe RGB (1998)",
    "acescg": "ACEScg",
    "aces2065-1": "ACES2065-1",
    "prophoto-rgb": "ProPhoto RGB",
}
OURS = ["natural", "smoothest"]
# What the slow methods of colour-science give to the ColorChecker: recovery_peers.py writes it.
PEERS = Path(__file__).resolve().parent.parent / "recovery_peers.json"
# Largest mean CIEDE2000 of `natural` under an illuminant, and largest spectral rmse over 400-700 nm.
CHECKER_LIMITS = {"A": 0.90, "FL2": 0.70, "FL11": 1.05, "LED-B3": 0.48, "LED-RGB1": 0.90, "HP1": 1.42}
CHECKER_RMSE = 0.033
RAWTOACES_LIMITS = {"A": 1.15, "FL11": 1.40, "LED-B3": 0.70}
GREY = slice(40, 341)  # 400-700 nm


def cube(n):
    return [list(map(float, rgb)) for rgb in reflectances.srgb_grid(n)]


def random_rgb(count, seed):
    return colour.models.eotf_sRGB(np.random.default_rng(seed).random((count, 3)))


def comparisons():
    rgb = cube(6) + [list(map(float, c)) for c in random_rgb(500, 1)]
    bins = [float(x) for x in np.linspace(380, 720, 10)]
    mallett = [float(x) for x in np.arange(380, 781, 5)]
    xyz = np.concatenate([np.array(cube(6))[1:], random_rgb(1000, 2)]) @ XYZ_FROM_SRGB.T
    return [
        # In our library black is 0, which it is in colour too.
        Comparison(
            "smits-linear v. colour.recovery.RGB_to_sd_Smits1999",
            "upsampled_at",
            [["smits-linear", "srgb", c, bins] for c in rgb],
            [colour.recovery.RGB_to_sd_Smits1999(c).values for c in rgb],
            1e-10,
        ),
        Comparison(
            "mallett v. colour.recovery.RGB_to_sd_Mallett2019",
            "upsampled_at",
            [["mallett", "srgb", c, mallett] for c in rgb],
            [colour.recovery.RGB_to_sd_Mallett2019(c).values for c in rgb],
            1e-10,
        ),
        Comparison(
            "otsu, not cut off v. colour.recovery.XYZ_to_sd_Otsu2018",
            "otsu_unclipped",
            xyz.tolist(),
            [colour.recovery.XYZ_to_sd_Otsu2018(x, clip=False).values for x in xyz],
            1e-10,
        ),
        Comparison(
            "otsu v. colour.recovery.XYZ_to_sd_Otsu2018",
            "otsu_clipped",
            xyz.tolist(),
            [colour.recovery.XYZ_to_sd_Otsu2018(x).values for x in xyz],
            1e-10,
        ),
    ]


def checks(evaluate):
    return (
        round_trips(evaluate)
        + smoothest_is_optimal(evaluate)
        + realisable(evaluate)
        + projections(evaluate)
        + textures(evaluate)
        + anchors(evaluate)
        + measured_patches(evaluate)
        + coefficient_tables(evaluate)
        + peers(evaluate)
        + emissions(evaluate)
    )


def spectra(evaluate, method, rgb, space="srgb"):
    return np.array(evaluate("upsampled", [[method, space, list(map(float, c))] for c in rgb]), dtype=float)


def rgb_of(spectra_at_knots, space="sRGB"):
    return spectra_at_knots @ WEIGHTS @ np.linalg.inv(reflectances.xyz_from_rgb(space)).T


def round_trips(evaluate):
    rows = []
    asked = np.array(cube(33))
    ends = (asked == 0).all(axis=1) | (asked == 1).all(axis=1)
    greys = (asked[:, 0] == asked[:, 1]) & (asked[:, 1] == asked[:, 2])
    for method in OURS:
        found = spectra(evaluate, method, asked)
        error = np.abs(rgb_of(found) - asked).max()
        difference = reflectances.differences(found @ WEIGHTS, asked @ XYZ_FROM_SRGB.T).max()
        outside = max(0.0, float((found - 1.0).max()), float(-found.min()))
        touching = int(((found <= 0.0) | (found >= 1.0))[~ends].any(axis=1).sum())
        flat = np.abs(found[greys] - asked[greys][:, :1]).max()
        rows += [
            row(f"{method}: round trip, linear sRGB 33 x 33 x 33", len(asked), error, 1e-6),
            row(f"{method}: round trip, CIEDE2000", len(asked), difference, 1e-4),
            row(f"{method}: how far outside of [0, 1]", len(asked), outside, 0),
            row(f"{method}: colours but black and white that reach 0 or 1", len(asked), touching, 0),
            row(f"{method}: greys, black and white, deviation from a constant", int(greys.sum()), flat, 0),
            row(f"{method}: change of spectra over change of colour", *steepness(asked.reshape(33, 33, 33, 3), found), 60),
        ]
    return rows


def steepness(asked, found):
    """Largest change of a reflectance between neighbours of the grid, by that of the colour."""
    found, worst, cases = found.reshape(*asked.shape[:3], -1), 0.0, 0
    for axis in range(3):
        change = np.abs(np.diff(found, axis=axis)).max(axis=-1)
        worst = max(worst, float((change / np.abs(np.diff(asked, axis=axis)).max(axis=-1)).max()))
        cases += change.size
    return cases, worst


def smoothest_is_optimal(evaluate):
    """The condition for least slope: second differences of the logit are a combination of the constraints' slopes."""
    worst, cases = 0.0, 0
    for r in spectra(evaluate, "smoothest", cube(9)):
        # 1 - r has to keep its digits for the logit to be read from the values.
        if r.max() == r.min() or r.max() > 1.0 - 1e-4:
            continue
        slope = np.diff(reflectances.logit(r))
        second = np.concatenate([[-slope[0]], slope[:-1] - slope[1:], [slope[-1]]])
        gradients = WEIGHTS * (r * (1.0 - r))[:, None] / max(r.max(), 1e-300)
        solution = np.linalg.lstsq(gradients, second, rcond=None)[0]
        worst = max(worst, float(np.abs(gradients @ solution - second).max() / np.abs(second).max()))
        cases += 1
    return [row("smoothest: distance from the smoothest logit", cases, worst, 1e-8)]


def realisable(evaluate):
    """A reflectance is found exactly where linear programming finds any r in [0, 1] of that colour."""
    colors, wrong, cases = cube(5), dict.fromkeys(OURS, 0), 0
    for ours, theirs in SPACES.items():
        matrix = reflectances.xyz_from_rgb(theirs)
        found = {m: evaluate("has_reflectance", [[m, ours, rgb] for rgb in colors]) for m in OURS}
        for i, rgb in enumerate(colors):
            # Black and white touch the boundary: rounding decides about the programme, not about us.
            possible = True
            if min(rgb) != max(rgb):
                programme = linprog(np.zeros(len(WEIGHTS)), A_eq=WEIGHTS.T, b_eq=matrix @ rgb, bounds=(0, 1))
                possible = programme.status == 0
            for method in OURS:
                wrong[method] += bool(found[method][i]) != possible
            cases += 1
    return [row(f"{m}: which colours have a reflectance v. linear programming, differing", cases, wrong[m], 0) for m in OURS]


def projections(evaluate):
    """The saturation that is left v. the largest that linear programming finds, and the colour of what comes out."""
    short = error = outside = 0.0
    cases = 0
    for ours, theirs in SPACES.items():
        matrix = reflectances.xyz_from_rgb(theirs)
        colors = [c for c in itertools.product([0.0, 0.3, 1.0], repeat=3) if min(c) != max(c)]
        for rgb, (saturation, got, values) in zip(colors, evaluate("projected", [[ours, list(c)] for c in colors])):
            asked, values = matrix @ rgb, np.array(values)
            outside = max(outside, float((values - 1.0).max()), float(-values.min()))
            error = max(error, float(np.abs(rgb_of(values, theirs) - got).max()))
            cases += 1
            if not 0.0 < asked[1] < 1.0:
                continue
            # Largest u with the sum of w r = grey + u (asked - grey), r in [0, 1].
            grey = asked[1] * WEIGHTS.sum(axis=0)
            equations = np.column_stack([WEIGHTS.T, grey - asked])
            objective = np.append(np.zeros(len(WEIGHTS)), -1.0)
            programme = linprog(objective, A_eq=equations, b_eq=grey, bounds=(0, 1))
            short = max(short, float(1.0 - saturation / -programme.fun))
    return [
        row("projected: colour of the reflectance v. the colour reported", cases, error, 1e-9),
        row("projected: how far outside of [0, 1]", cases, outside, 0),
        row("projected: saturation below the largest of linear programming", cases, short, 1.2e-2),
    ]


def textures(evaluate):
    asked = np.concatenate([np.array(cube(17)), random_rgb(3000, 3), 0.08 * random_rgb(300, 4)])
    expected = asked @ XYZ_FROM_SRGB.T
    rows = []
    for steps, rgb_limit, difference_limit in [(1, 2.5e-4, 0.06), (2, 1e-5, 1e-3)]:
        found = np.array(evaluate("texture_reflectance", [[steps, list(map(float, c))] for c in asked]))
        error = np.abs(rgb_of(found) - asked).max()
        difference = reflectances.differences(found @ WEIGHTS, expected).max()
        outside = max(0.0, float((found - 1.0).max()), float(-found.min()))
        rows += [
            row(f"textures, {steps} Newton step(s): round trip, linear sRGB", len(asked), error, rgb_limit),
            row(f"textures, {steps} Newton step(s): round trip, CIEDE2000", len(asked), difference, difference_limit),
            row(f"textures, {steps} Newton step(s): how far outside of [0, 1]", len(asked), outside, 0),
        ]
    return rows


def anchors(evaluate):
    """The patches of the ColorChecker as anchors are reproduced at their colours."""
    measured = reflectances.checker()
    rgb = rgb_of(measured)
    inside = (rgb.min(axis=1) >= 0) & (rgb.max(axis=1) <= 1)
    argument = [reflectances.KNOTS.tolist(), measured.tolist(), rgb[inside].tolist()]
    found = np.array(evaluate("natural_with_anchors", [argument])[0])
    error = np.abs(found - measured[inside]).max()
    return [row("natural with anchors: reproduces them", int(inside.sum()), error, 1e-9)]


def relit(found, measured):
    """Mean CIEDE2000 under each illuminant, and the spectral rmse."""
    means = {}
    for name in CHECKER_LIMITS:
        means[name] = reflectances.differences(found @ weights(name), measured @ weights(name), name).mean()
    return means, float(np.sqrt(((found - measured)[:, GREY] ** 2).mean()))


def in_rec2020(measured):
    """Colours of patches in a space that holds all of them."""
    return rgb_of(measured, "ITU-R BT.2020")


def measured_patches(evaluate):
    """Upsample the D65 colour of a patch that is not among what was learnt from, and look at it under other lamps."""
    rows = []
    for name, measured, limits in [
        ("ColorChecker N Ohta", reflectances.checker(), CHECKER_LIMITS),
        ("190 patches of rawtoaces", reflectances.rawtoaces(), RAWTOACES_LIMITS),
    ]:
        found = spectra(evaluate, "natural", in_rec2020(measured), "rec2020")
        means, rmse = relit(found, measured)
        for lamp, limit in limits.items():
            rows.append(row(f"natural, {name} from D65 to {lamp}, mean CIEDE2000", len(measured), means[lamp], limit))
        if limits is CHECKER_LIMITS:
            rows.append(row(f"natural, {name}, spectral rmse 400-700 nm", len(measured), rmse, CHECKER_RMSE))
    return rows


def coefficient_tables(evaluate):
    """A table as colour-science writes it, read by us: coefficients between its nodes."""
    size = 6
    rng = np.random.default_rng(5)
    table = colour.recovery.LUT3D_Jakob2019()
    table._size = size
    table._lightness_scale = np.float32(colour.recovery.jakob2019.lightness_scale(size))
    table._coefficients = np.float32(rng.normal(size=(3, size, size, size, 3)))
    path = Path(comparison.__file__).resolve().parent / ".venv" / "recovery_table.coeff"
    table.write(path)
    table = colour.recovery.LUT3D_Jakob2019().read(path)
    content = list(path.read_bytes())
    path.unlink()
    # colour divides by the largest component plus 1e-10: not by less than 0.01 here.
    rgb = 0.01 + 0.99 * rng.random((2000, 3))
    expected = table.RGB_to_coefficients(rgb)
    found = np.array(evaluate("coefficient_table", [[content, rgb.tolist()]])[0])
    return [row("jakob-hanika: coefficients from a .coeff table v. colour.recovery.LUT3D_Jakob2019", len(rgb), np.abs(found - expected).max(), 1e-6)]


def peers(evaluate):
    """Beside colour-science: the same slow methods, and all of its methods on the ColorChecker."""
    frozen = json.loads(PEERS.read_text(encoding="utf-8"))["spectra"]
    measured = reflectances.checker()
    rgb = in_rec2020(measured)
    rows = []
    for ours in ["jakob-hanika", "meng"]:
        found = spectra(evaluate, ours, rgb, "rec2020")
        difference = reflectances.differences(found @ WEIGHTS, measured @ WEIGHTS).max()
        rmse = np.sqrt(((found - np.array(frozen[ours]))[:, GREY] ** 2).mean(axis=1)).max()
        rows += [
            row(f"{ours}: round trip of the ColorChecker, CIEDE2000", len(rgb), difference, 1e-6),
            # Theirs are fitted with sums at 5 nm and stop at errors of the colour of up to 0.03 CIEDE2000.
            row(f"{ours}: largest spectral rmse v. colour-science", len(rgb), rmse, 5e-3),
        ]
    natural, _ = relit(spectra(evaluate, "natural", rgb, "rec2020"), measured)
    others = {**{name: np.array(found) for name, found in frozen.items()}, **recovery_peers.fast_methods(measured)}
    for name, found in others.items():
        means, _ = relit(found, measured)
        ratio = max(natural[lamp] / means[lamp] for lamp in means)
        rows.append(row(f"natural v. {name} of colour-science on the ColorChecker, largest ratio of means", len(rgb), ratio, 1.0))
    return rows


def emissions(evaluate):
    flat = (np.array([360.0, 830.0]), np.array([1.0, 1.0]))
    tents = reflectances.tent_weights(flat, flat)
    colors = cube(9)
    found = np.array(evaluate("upsampled_emission", [["srgb", rgb] for rgb in colors]))
    srgb = colour.RGB_COLOURSPACES["sRGB"]
    expected = np.asarray(colors) @ colour.normalised_primary_matrix(srgb.primaries, srgb.whitepoint).T
    rows = [
        row("upsampled emissions, XYZ", len(colors), np.abs(found @ tents - expected).max(), 1e-9),
        row("upsampled emissions, how far below 0", len(colors), max(0.0, -found.min()), 0),
    ]
    # The lamp's own white is the white of a tint. Its samples, 5 nm apart, are joined by straight lines.
    worst, below = 0.0, 0.0
    lamps = ["A", "D65", "FL11", "LED-B3"]
    colors = cube(5)
    for name in lamps:
        white = weights(name).sum(axis=0)
        found = np.array(evaluate("upsampled_lamp", [[name, "srgb", rgb] for rgb in colors]))
        worst = max(worst, np.abs(found @ tents - np.asarray(colors) @ reflectances.xyz_from_rgb("sRGB", name).T).max())
        below = max(below, -found.min())
        assert abs(white[1] - 1.0) < 1e-12
    return rows + [
        row("tinted lamps, XYZ", len(lamps) * len(colors), worst, 1e-9),
        row("tinted lamps, how far below 0", len(lamps) * len(colors), max(0.0, below), 0),
    ]
