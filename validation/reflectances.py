"""Reflectances at knots 1 nm apart and their colours by the exact rule, for what is learnt and validated about recovery."""

import numpy as np

import colour
import oracle

KNOTS = np.arange(oracle.LAMBDA_MIN, oracle.LAMBDA_MAX + 1.0)


def to_knots(wavelengths, values):
    """Straight lines between samples, constant beyond the ends."""
    return np.interp(KNOTS, np.asarray(wavelengths, dtype=float), np.asarray(values, dtype=float))


def tent_weights(lamp, white):
    """XYZ of the tent function of each knot under a lamp, by the exact rule; Y of the white is 1."""
    return np.stack([oracle.xyz((KNOTS, tent), lamp, white=white) for tent in np.eye(len(KNOTS))])


_weights = {}


def weights(name):
    """XYZ of the tent functions under an illuminant by name; their sum is its white of Y = 1."""
    if name not in _weights:
        lamp = oracle.illuminant(name)
        _weights[name] = tent_weights(lamp, lamp)
    return _weights[name]


def bradford(source, destination):
    return colour.adaptation.matrix_chromatic_adaptation_VonKries(source, destination, transform="Bradford")


def lab(xyz, name="D65"):
    """CIE Lab under the integrated white of an illuminant."""
    ratio, delta = np.asarray(xyz) / weights(name).sum(axis=0), 6.0 / 29.0
    f = np.where(ratio > delta**3, np.cbrt(ratio), ratio / (3.0 * delta**2) + 4.0 / 29.0)
    return np.stack([116.0 * f[..., 1] - 16.0, 500.0 * (f[..., 0] - f[..., 1]), 200.0 * (f[..., 1] - f[..., 2])], axis=-1)


def differences(xyz_a, xyz_b, name="D65"):
    """CIEDE2000 under an illuminant."""
    return colour.delta_E(lab(xyz_a, name), lab(xyz_b, name), method="CIE 2000")


def xyz_from_rgb(space, name="D65"):
    """Matrix of a space of colour-science, adapted to the integrated white of an illuminant."""
    space = colour.RGB_COLOURSPACES[space]
    matrix = colour.normalised_primary_matrix(space.primaries, space.whitepoint)
    return bradford(colour.xy_to_XYZ(space.whitepoint), weights(name).sum(axis=0)) @ matrix


def logistic(z):
    return 1.0 / (1.0 + np.exp(-z))


def logit(r):
    return np.log(r / (1.0 - r))


def second_differences():
    """Matrix of the gradient of half the sum of squared differences."""
    first = np.diff(np.eye(len(KNOTS)), axis=0)
    return first.T @ first


def srgb_grid(n):
    """Linear sRGB of a grid uniform in encoded sRGB."""
    levels = colour.models.eotf_sRGB(np.linspace(0.0, 1.0, n))
    return np.stack(np.meshgrid(levels, levels, levels, indexing="ij"), axis=-1).reshape(-1, 3)


def checker(name="ColorChecker N Ohta"):
    """Measured patches of a colour checker at the knots."""
    return np.array([to_knots(s.wavelengths, s.values) for s in colour.SDS_COLOURCHECKERS[name].values()])


def rawtoaces():
    """The 190 patches of rawtoaces; some exceed 1 (fluorescence, gloss) and are clipped."""
    patches = colour.characterisation.read_training_data_rawtoaces_v1()
    return np.clip(np.array([to_knots(patches.wavelengths, values) for values in patches.values.T]), 0.0, 1.0)


WEIGHTS = weights("D65")
XYZ_FROM_SRGB = xyz_from_rgb("sRGB")
