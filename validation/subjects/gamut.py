"""Gamut mapping against an independent copy of the algorithm that color::gamut documents, and against its promises."""

import colour
import numpy as np
from colour.models.oklab import MATRIX_1_XYZ_TO_LMS
from comparison import Comparison, row
from scipy.optimize import brentq

SPACES = {
    "srgb": "sRGB",
    "display-p3": "Display P3",
    "rec2020": "ITU-R BT.2020",
    "adobe-rgb": "Adobe RGB (1998)",
    "dci-p3": "DCI-P3",
    "acescg": "ACEScg",
}
# Ottosson's inverse: its first column is 1, so that greys are neutral.
ROOTS_FROM_LAB = np.array(
    [[1.0, 0.3963377774, 0.2158037573], [1.0, -0.1055613458, -0.0638541728], [1.0, -0.0894841775, -1.2914855480]]
)
RANDOM = np.random.default_rng(264)
SAMPLES = np.linspace(1.0, 0.0, 4001)


def cones(name):
    """Linear RGB to cone responses of Oklab, with the white of the space at 1."""
    space = colour.RGB_COLOURSPACES[SPACES[name]]
    d65 = colour.xy_to_XYZ(colour.RGB_COLOURSPACES["sRGB"].whitepoint)
    white = colour.xy_to_XYZ(space.whitepoint)
    adapted = colour.adaptation.matrix_chromatic_adaptation_VonKries(white, d65, transform="Bradford")
    matrix = MATRIX_1_XYZ_TO_LMS @ adapted @ colour.normalised_primary_matrix(space.primaries, space.whitepoint)
    return matrix / matrix.sum(axis=1, keepdims=True)


def mapped(rgb, matrix):
    """By sampling the ray from the outside and bisecting where it comes in."""
    rgb = np.asarray(rgb)
    if rgb.min() >= 0.0 and rgb.max() <= 1.0:
        return rgb
    lightness, a, b = np.linalg.solve(ROOTS_FROM_LAB, np.cbrt(matrix @ rgb))
    if not 0.0 < lightness < 1.0:
        return np.full(3, float(lightness > 0.0))
    back = np.linalg.inv(matrix)
    kappa = notch(matrix, back)
    mu = kappa * 0.0185 / (1.0 - 2.0 * 0.0185)

    def colors_at(t):
        return back @ (ROOTS_FROM_LAB @ np.array([np.full_like(t, lightness), t * a, t * b])) ** 3

    def margin(t):
        red, green, blue = color = colors_at(np.atleast_1d(t))
        allowed = np.minimum(kappa * green, np.maximum(0.0, mu * (blue - 2.0 * green)))
        return np.minimum(np.min([red + allowed, green, blue], axis=0), 1.0 - color.max(axis=0))

    first = int(np.argmax(margin(SAMPLES) >= 0.0))
    t = (
        1.0
        if first == 0
        else brentq(lambda t: float(margin(t)[0]), SAMPLES[first], SAMPLES[first - 1], xtol=1e-16, rtol=1e-15)
    )
    return np.clip(colors_at(np.array([t]))[:, 0], 0.0, 1.0)


def notch(matrix, back):
    """By how much the face red = 0 is tilted at blue: 1.02 times what makes red + kappa green stationary on the ray."""
    lightness, a, b = np.linalg.solve(ROOTS_FROM_LAB, np.cbrt(matrix[:, 2]))
    color = lambda t: back @ (ROOTS_FROM_LAB @ np.array([lightness, t * a, t * b])) ** 3
    red, green, _ = color(1.0 + 1e-30j).imag  # the derivative, times 1e-30
    return 1.02 * max(0.0, red / -green) if green < 0.0 else 0.0


def colors(count):
    fixed = [
        [0, 0, 0],
        [1, 1, 1],
        [2, 2, 2],
        [-1, -1, -1],
        [0, 0, 50],
        [1, 1, -0.2],
        [-0.001, -0.001, 0.3],
        [-0.0005, 0.0, 0.3],
        [-1e-4, 1e-3, 0.3],
        [-1e-17, 0.0, 1.0],
        [1, 1e-9, -1e-9],
    ]
    wide = RANDOM.uniform(-0.5, 1.5, (count // 2, 3))
    # A P3, Rec. 2020 or ACEScg picture in sRGB.
    others = [colour.RGB_COLOURSPACES[name] for name in ("Display P3", "ITU-R BT.2020", "ACEScg")]
    pictures = [
        colour.RGB_to_RGB(RANDOM.uniform(0.0, 1.0, (count // 6, 3)) ** 2, other, colour.RGB_COLOURSPACES["sRGB"])
        for other in others
    ]
    # Near blue, where a ray would leave the gamut, enter it again and leave it for good.
    blue = np.array([0.0, 0.0, 0.3]) + RANDOM.uniform(-1e-3, 1e-3, (count // 6, 3)) * [1.0, 10.0, 1.0]
    return [[float(x) for x in rgb] for rgb in np.vstack([fixed, wide, blue, *pictures])]


def comparisons():
    arguments, expected = [], []
    for name in SPACES:
        matrix = cones(name)
        for rgb in colors(900):
            arguments.append([name, "desaturate", rgb])
            expected.append(mapped(rgb, matrix))
    some = colors(600)
    clipped = [np.clip(rgb, 0.0, 1.0) for rgb in some]
    lists = [some, some[:1], [[0.5, 0.5, 0.5]] * 3 + [[0.5, -0.5, 2.0]]]
    return [
        Comparison(
            "gamut, desaturation v. its algorithm in numpy", "gamut_map", arguments, expected, 1e-11, frozen_cases=120
        ),
        Comparison("gamut, clipping", "gamut_map", [["srgb", "clip", rgb] for rgb in some], clipped, 0.0),
        Comparison(
            "gamut, report", "gamut_report", lists, [report(np.asarray(rgb)) for rgb in lists], 1e-12, frozen_cases=0
        ),
    ]


def report(rgb):
    excess = np.maximum(0.0, np.maximum(-rgb.min(axis=1), rgb.max(axis=1) - 1.0))
    outside = excess > 0.0
    mean = excess[outside].mean() if outside.any() else 0.0
    return [
        outside.sum(),
        (rgb.min(axis=1) < 0.0).sum(),
        (rgb.max(axis=1) > 1.0).sum(),
        outside.mean(),
        excess.max(),
        mean,
    ]


def checks(evaluate):
    """The promises, with the Oklab of colour-science, which does not scale to white."""
    some = colors(6000)
    rows = []
    for name in ("srgb", "display-p3", "rec2020"):
        space = colour.RGB_COLOURSPACES[SPACES[name]]
        first = evaluate("gamut_map", [[name, "desaturate", rgb] for rgb in some])
        again = evaluate("gamut_map", [[name, "desaturate", rgb] for rgb in first])
        first, again = np.asarray(first), np.asarray(again)
        outside = float(np.maximum(first - 1.0, -first).max())
        to_xyz = colour.normalised_primary_matrix(space.primaries, space.whitepoint).T
        before, after = colour.XYZ_to_Oklab(np.asarray(some) @ to_xyz), colour.XYZ_to_Oklab(first @ to_xyz)
        hues = [np.degrees(np.arctan2(lab[:, 2], lab[:, 1])) for lab in (before, after)]
        turn = np.abs((hues[0] - hues[1] + 180.0) % 360.0 - 180.0)
        # Nearer to grey a hue is not worth the name, and white's own a and b (1e-4) decide it.
        colored = np.hypot(after[:, 1], after[:, 2]) > 0.02
        rows += [
            row(f"gamut {name}: how far outside of [0, 1]", len(some), max(0.0, outside), 0),
            row(f"gamut {name}: change when mapped again", len(some), np.abs(again - first).max(), 0),
            row(f"gamut {name}: change of hue in Oklab, degrees", colored.sum(), turn[colored].max(), 0.5),
        ]
    return rows
