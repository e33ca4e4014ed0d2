"""What the subjects share: the stored observer, integration that is exact for piecewise linear functions, errors.

The integration is independent of the crate's closed forms: two-point Gauss-Legendre quadrature on every segment of the
merged knots, which is exact for polynomials up to the third degree, that is for a product of three linear functions.
"""

import numpy as np

import colour

LAMBDA_MIN, LAMBDA_MAX = 360.0, 830.0
CMFS = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
CMFS_WAVELENGTHS = np.asarray(CMFS.wavelengths, dtype=float)
CMFS_VALUES = np.asarray(CMFS.values, dtype=float)


def integral(*tables):
    """Integral over 360-830 nm of a product of up to three (wavelengths, values), constant beyond their ends."""
    knots = np.unique(np.concatenate([[LAMBDA_MIN, LAMBDA_MAX], *[np.asarray(t[0], dtype=float) for t in tables]]))
    knots = knots[(knots >= LAMBDA_MIN) & (knots <= LAMBDA_MAX)]
    middle, half = (knots[1:] + knots[:-1]) / 2, (knots[1:] - knots[:-1]) / 2
    total = 0.0
    for sign in (-1.0, 1.0):
        at = middle + sign * half / np.sqrt(3.0)
        product = half.copy()
        for wavelengths, values in tables:
            product = product * np.interp(at, wavelengths, values)
        total += product.sum()
    return total


def cmf(axis):
    return CMFS_WAVELENGTHS, CMFS_VALUES[:, axis]


def xyz(*tables, white=None):
    """XYZ of a product of tables; `white` (a table) normalises to Y = 1 of that lamp, else L = 1 has Y = 1."""
    y_of_white = integral(cmf(1)) if white is None else integral(white, cmf(1))
    return np.array([integral(*tables, cmf(axis)) for axis in range(3)]) / y_of_white


def illuminant(name):
    sd = colour.SDS_ILLUMINANTS[name]
    return np.asarray(sd.wavelengths, dtype=float), np.asarray(sd.values, dtype=float)


def largest_relative(values, expected):
    """Largest difference over the largest component of each expected vector."""
    values, expected = np.asarray(values), np.asarray(expected)
    scale = np.abs(expected).max(axis=-1, keepdims=True)
    return float((np.abs(values - expected) / scale).max())


def largest_absolute(values, expected):
    return float(np.abs(np.asarray(values) - np.asarray(expected)).max())


def row(subject, cases, error, tolerance):
    """One line of the report. NaN is a miss."""
    return subject, int(cases), float(error), float(tolerance), bool(error <= tolerance)
