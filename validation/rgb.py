"""Upsampled spectra."""

import itertools

import numpy as np
from scipy.optimize import linprog

import colour
import oracle

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
LEVELS = [float(x) for x in colour.models.eotf_sRGB(np.linspace(0.0, 1.0, 9))]
CUBE = [list(rgb) for rgb in itertools.product(LEVELS, repeat=3)]
COARSE_CUBE = [list(rgb) for rgb in itertools.product(LEVELS[::2], repeat=3)]
WAVELENGTHS = np.arange(360.0, 831.0)


def request():
    return {
        "reflectance_rgb": CUBE,
        "emission_rgb": CUBE,
        "realisable_rgb": COARSE_CUBE,
    }


def check(values):
    return reflectance(values) + emission(values)


def tent_weights(lamp, white):
    """XYZ of the tent function of each knot, by the exact rule."""
    eye = np.eye(len(WAVELENGTHS))
    return np.stack([oracle.xyz((WAVELENGTHS, tent), lamp, white=white) for tent in eye])


def bradford(source, destination):
    return colour.adaptation.matrix_chromatic_adaptation_VonKries(source, destination, transform="Bradford")


def reflectance(values):
    spectra = np.asarray(values["reflectance_spectra"])
    d65 = oracle.illuminant("D65")
    weights = tent_weights(d65, d65)
    srgb = colour.RGB_COLOURSPACES["sRGB"]
    white = colour.xy_to_XYZ(srgb.whitepoint)
    from_rgb = colour.normalised_primary_matrix(srgb.primaries, srgb.whitepoint)
    to_rgb = np.linalg.inv(from_rgb) @ bradford(weights.sum(axis=0), white)
    rgb = spectra @ weights @ to_rgb.T
    outside = float(np.maximum(spectra - 1.0, -spectra).max())
    greys = [i for i, c in enumerate(CUBE) if c[0] == c[1] == c[2]]
    flat = oracle.largest_absolute(spectra[greys], np.asarray(CUBE)[greys][:, :1])
    return [
        oracle.row("upsampled reflectances, round trip in linear sRGB", len(CUBE), oracle.largest_absolute(rgb, CUBE), 1e-9),
        oracle.row("upsampled reflectances, how far outside of [0, 1]", len(CUBE), outside, 0),
        oracle.row("upsampled greys, deviation from a constant", len(greys), flat, 0),
        oracle.row("upsampled reflectances, distance from the smoothest logit", *optimality(spectra, weights)),
        realisable(values, weights),
    ]


def realisable(values, weights):
    """A reflectance is found exactly where linear programming finds any r in [0, 1] of that colour."""
    white, cases, wrong = weights.sum(axis=0), 0, 0
    for name, found in values["realisable"].items():
        space = colour.RGB_COLOURSPACES[SPACES[name]]
        xyz_from_rgb = colour.normalised_primary_matrix(space.primaries, space.whitepoint)
        adapted = bradford(colour.xy_to_XYZ(space.whitepoint), white) @ xyz_from_rgb
        for rgb, is_found in zip(COARSE_CUBE, found):
            # Black and white touch the boundary: rounding decides about the programme, not about us.
            if min(rgb) == max(rgb):
                wrong += not is_found
            else:
                programme = linprog(np.zeros(len(weights)), A_eq=weights.T, b_eq=adapted @ rgb, bounds=(0, 1))
                wrong += is_found != (programme.status == 0)
            cases += 1
    return oracle.row("which colours have a reflectance v. linear programming, differing", cases, wrong, 0)


def optimality(spectra, weights):
    """The condition for least slope: second differences of the logit are a combination of the constraints' slopes."""
    worst, cases = 0.0, 0
    for r in spectra:
        # 1 - r has to keep its digits for the logit to be read from the values.
        if r.max() == r.min() or r.max() > 1.0 - 1e-4:
            continue
        z = np.log(r / (1.0 - r))
        slope = np.diff(z)
        second = np.concatenate([[-slope[0]], slope[:-1] - slope[1:], [slope[-1]]])
        gradients = weights * (r * (1.0 - r))[:, None] / max(r.max(), 1e-300)
        solution = np.linalg.lstsq(gradients, second, rcond=None)[0]
        worst = max(worst, float(np.abs(gradients @ solution - second).max() / np.abs(second).max()))
        cases += 1
    return cases, worst, 1e-8


def emission(values):
    spectra = np.asarray(values["emission_spectra"])
    flat = (np.array([360.0, 830.0]), np.array([1.0, 1.0]))
    xyz = spectra @ tent_weights(flat, flat)
    srgb = colour.RGB_COLOURSPACES["sRGB"]
    expected = np.asarray(CUBE) @ colour.normalised_primary_matrix(srgb.primaries, srgb.whitepoint).T
    return [
        oracle.row("upsampled emissions, XYZ", len(CUBE), oracle.largest_absolute(xyz, expected), 1e-9),
        oracle.row("upsampled emissions, how far below 0", len(CUBE), max(0.0, -spectra.min()), 0),
    ]
