#!/usr/bin/env python3
"""Learns the prior of the RGB-to-spectrum method `natural` and writes it to data/recovery/, in about half a minute:

    validation/.venv/bin/python validation/learn_natural.py

What it is learnt from, all shipped in colour-science (BSD-3-Clause):

* the 99 measured reflectances of CIE 224:2017 (colour evaluation samples);
* every third of the real Munsell renotation colours (chromaticities alone, no spectra), adapted from C to D65, with the
  reflectance that the model of Otsu et al. 2018 gives them, kept where it stays within (0.005, 0.98).

No colour checker and none of the patches of rawtoaces is among them: these are what validation holds it against.

How: the residual of an anchor is the logit of its reflectance minus the smoothest logit of its colour. Residuals are kriged
over CIE Lab under D65 with a Gaussian kernel of 60 units, noise 0.3, times a factor that vanishes for greys, which stay flat.
The field is then compressed: 12 curves of wavelength, Gaussians of 60 units about 48 centres. Last come the 8 curves, the first
of them constant, that span the logits of the whole sRGB cube for the texture path.
"""

import sys
import warnings
from pathlib import Path

warnings.filterwarnings("ignore")
sys.path.insert(0, str(Path(__file__).resolve().parent))

import numpy as np  # noqa: E402

import colour  # noqa: E402
import reflectances  # noqa: E402
from colour.quality.cfi2017 import load_TCS_CIE2017  # noqa: E402
from colour.recovery import XYZ_to_sd_Otsu2018  # noqa: E402
from export_recovery import DATA, header  # noqa: E402
from reflectances import KNOTS, WEIGHTS, XYZ_FROM_SRGB, logistic, logit, srgb_grid, to_knots  # noqa: E402

LENGTH = 60.0  # of the kernel, Lab units
NOISE = 0.3  # variance of an anchor's logit
GREY_WIDTH = 10.0  # chroma within which colours count as nearly grey
CURVES, CENTERS, RIDGE = 12, 48, 1e-7
BASIS = 8
STEP = 5  # nm between the samples that are written
LARGEST_LOGIT = 14.0  # spectra of the cube beyond it would rule the basis


def munsell_by_otsu():
    whites = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]
    xyY = np.array([sample[1] for sample in colour.MUNSELL_COLOURS["Munsell Colours Real"]], dtype=float)
    xyY[:, 2] /= 102.5  # relative to the perfect diffuser instead of magnesium oxide
    colors = colour.adaptation.chromatic_adaptation_VonKries(
        colour.xyY_to_XYZ(xyY), colour.xy_to_XYZ(whites["C"]), colour.xy_to_XYZ(whites["D65"]), transform="Bradford"
    )
    spectra = [XYZ_to_sd_Otsu2018(xyz, clip=False) for xyz in colors]
    return [to_knots(s.wavelengths, s.values) for s in spectra if s.values.min() > 0.005 and s.values.max() < 0.98]


def evaluation_samples():
    samples = load_TCS_CIE2017(colour.SpectralShape(380, 780, 1))
    return [to_knots(samples.wavelengths, values) for values in samples.values.T]


def kernel(a, b):
    return np.exp(-0.5 * ((a[:, None] - b[None]) ** 2).sum(axis=-1) / LENGTH**2)


def window(lab):
    """0 for greys, near 1 for colours."""
    return 1.0 - np.exp(-0.5 * (lab[:, 1:] ** 2).sum(axis=1) / GREY_WIDTH**2)


class Field:
    """Residual logits over Lab, before the factor for greys, from all anchors."""

    def __init__(self, anchors):
        xyz = anchors @ WEIGHTS
        self.lab = reflectances.lab(xyz)
        residual = logit(np.clip(anchors, 0.005, 0.995)) - smoothest(xyz)
        factor = window(self.lab)
        covariance = kernel(self.lab, self.lab) * np.outer(factor, factor) + NOISE * np.eye(len(anchors))
        self.weights = np.linalg.solve(covariance, residual) * factor[:, None]

    def __call__(self, lab):
        return kernel(lab, self.lab) @ self.weights


def smoothest(xyz, around=None):
    """Logits of the colours: the least sum of squared differences, from `around` (or 0)."""
    around = np.zeros((len(xyz), len(KNOTS))) if around is None else around
    # Inverse of the second differences up to a constant.
    spread = np.linalg.pinv(reflectances.second_differences())
    solved = [solve_one(color, start, spread) for color, start in zip(xyz, around)]
    return around + np.array(solved)


def solve_one(color, around, spread):
    y = np.full(len(KNOTS), 0.0 if around.any() else logit(np.clip(color[1], 1e-9, 1 - 1e-9)))
    error = np.inf
    for _ in range(60):
        r = logistic(around + y)
        residual, slopes = color - r @ WEIGHTS, WEIGHTS * (r * (1.0 - r))[:, None]
        # Under linear constraints: a combination of three curves and a constant.
        curves, sums = spread @ slopes, slopes.sum(axis=0)
        system = np.block([[slopes.T @ curves, sums[:, None]], [sums[None], np.zeros((1, 1))]])
        x = np.linalg.solve(system, np.append(residual + slopes.T @ y, 0.0))
        goal, fraction = curves @ x[:3] + x[3], 1.0
        before = np.abs(residual).max()
        while fraction > 1e-4:
            moved = y + fraction * (goal - y)
            error = np.abs(color - logistic(around + moved) @ WEIGHTS).max()
            if error < before or before < 1e-12:
                break
            fraction *= 0.5
        change, y = np.abs(moved - y).max(), moved
        if change < 1e-8 and error < 1e-10:
            break
    return y


def farthest_points(points, count):
    """Points of a set that lie far from each other; the first is the nearest to the mean."""
    chosen = [int(((points - points.mean(axis=0)) ** 2).sum(axis=1).argmin())]
    distance = ((points - points[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < count:
        chosen.append(int(distance.argmax()))
        distance = np.minimum(distance, ((points - points[chosen[-1]]) ** 2).sum(axis=1))
    return points[chosen]


def compressed(field):
    """Centres in Lab, their weights and the curves whose combination is nearly the field in the sRGB cube."""
    points = np.concatenate([reflectances.lab(srgb_grid(11) @ XYZ_FROM_SRGB.T), field.lab])
    values = field(points)
    curves = np.linalg.svd(values, full_matrices=False)[2][:CURVES]
    centers = farthest_points(points, CENTERS)
    design = kernel(points, centers)
    normal = design.T @ design + RIDGE * len(points) * np.eye(CENTERS)
    weights = np.linalg.solve(normal, design.T @ (values @ curves.T))
    error = np.abs(design @ weights @ curves - values)
    print(f"field of up to {np.abs(values).max():.2f}, compressed with an error of {error.mean():.4f}, at most {error.max():.3f}")
    return centers, weights, curves.T


def texture_basis(centers, weights, curves):
    """Orthogonal curves at every STEP nm for the natural logits of the sRGB cube; the first is 1."""
    colors = srgb_grid(9) @ XYZ_FROM_SRGB.T
    colors = colors[(colors > 0).any(axis=1) & (colors[:, 1] < 1 - 1e-9)]
    lab = reflectances.lab(colors)
    residual = window(lab)[:, None] * (kernel(lab, centers) @ weights @ curves.T)
    logits = smoothest(colors, smoothest(colors) + residual)[:, ::STEP]
    logits = logits[np.abs(logits).max(axis=1) < LARGEST_LOGIT]
    logits = logits / np.maximum(1.0, np.sqrt((logits**2).mean(axis=1, keepdims=True)))
    logits = logits - logits.mean(axis=1, keepdims=True)
    others = np.linalg.svd(logits, full_matrices=False)[2][: BASIS - 1] * np.sqrt(logits.shape[1])
    return np.concatenate([np.ones((1, others.shape[1])), others]).T


def write(name, title, unit, columns, rows):
    source = "CIE 224:2017 samples; Munsell renotation colours with the model of Otsu et al. 2018"
    lines = [",".join(columns)] + [",".join(f"{value:.6g}" for value in row) for row in rows]
    head = header(title, source, unit, "learn_natural.py")
    (DATA / name).write_text(head + "\n".join(lines) + "\n", encoding="utf-8", newline="\n")
    print("data/recovery/" + name, len(rows), "rows")


def main():
    anchors = np.array(munsell_by_otsu()[::3] + evaluation_samples())
    print(len(anchors), "anchors")
    centers, weights, curves = compressed(Field(anchors))
    knots = KNOTS[::STEP]
    write(
        "natural_curves.csv",
        "Curves of the residual field of the method `natural`, joined by straight lines",
        "wavelength in nm; logit",
        ["wavelength_nm", *(f"curve_{i}" for i in range(CURVES))],
        np.column_stack([knots, curves[::STEP]]),
    )
    write(
        "natural_centers.csv",
        f"Centres in CIE Lab under D65 of Gaussians of {LENGTH:g} units, with the weight of each curve",
        "L, a, b in CIE Lab; dimensionless",
        ["L", "a", "b", *(f"curve_{i}" for i in range(CURVES))],
        np.column_stack([centers, weights]),
    )
    write(
        "natural_basis.csv",
        "Curves that span the logits of natural reflectances, joined by straight lines; the first is constant",
        "wavelength in nm; logit",
        ["wavelength_nm", *(f"basis_{i}" for i in range(BASIS))],
        np.column_stack([knots, texture_basis(centers, weights, curves)]),
    )


if __name__ == "__main__":
    main()
