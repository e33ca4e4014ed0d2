"""Metrics of pictures: numpy for the relative ones, colour-science for ΔE 2000, SciPy for statistics, NVIDIA's
flip-evaluator for FLIP."""

import warnings

import colour
import flip_evaluator
import numpy as np
from comparison import Comparison, row
from scipy import stats

SRGB = colour.RGB_COLOURSPACES["sRGB"]
WHITE = np.asarray(SRGB.whitepoint)
# As abbe has them: from the primaries, not rounded to four digits.
XYZ_FROM_RGB = colour.models.normalised_primary_matrix(SRGB.primaries, SRGB.whitepoint)
RGB_FROM_XYZ = np.linalg.inv(XYZ_FROM_RGB)


def pictures(random, width, height):
    """A picture of smooth hues and edges over five orders of magnitude, and the same with noise and fireflies."""
    y, x = np.mgrid[0:height, 0:width] / max(width, height)
    hue = np.stack([np.sin(5 * x + c) * np.cos(7 * y - c) for c in range(3)], axis=-1)
    reference = 0.3 * np.exp(1.2 * hue) * np.where(x + y > 0.8, 1.0, 1e-3)[..., None]
    reference[height // 2 :: 9] = 0.0
    test = reference * random.gamma(8.0, 1 / 8.0, reference.shape)
    test[random.random((height, width)) < 0.01] *= 40.0
    return test.reshape(-1, 3), reference.reshape(-1, 3)


def relative(test, reference):
    m = reference.mean()
    error = (test - reference) ** 2 / (reference**2 + 0.01 * m**2)
    pixels = np.sort(error.mean(axis=1))
    left = len(pixels) - max(1, int(np.ceil(0.001 * len(pixels))))
    mape = np.abs(test - reference) / (np.abs(reference) + 0.01 * m)
    size = np.abs(test) + np.abs(reference)
    smape = np.divide(2 * np.abs(test - reference), size, out=np.zeros_like(size), where=size > 0)
    return [error.mean(), pixels[:left].mean(), mape.mean(), smape.mean()]


def displayed(test, reference, exposure):
    labs, encoded = [], []
    for xyz in (test * exposure, reference * exposure):
        encoded.append(colour.models.eotf_inverse_sRGB(np.clip(xyz @ RGB_FROM_XYZ.T, 0, 1)))
        shown = xyz / np.maximum(xyz[:, 1:2], 1)
        labs.append(colour.XYZ_to_Lab(shown, SRGB.whitepoint))
    psnr = -10 * np.log10(((encoded[0] - encoded[1]) ** 2).mean())
    difference = colour.difference.delta_E_CIE2000(*labs)
    return [psnr, difference.mean(), np.quantile(difference, 0.95), difference.max()]


def bias(width, test, reference):
    error = (test - reference).reshape(-1, width, 3)
    blocks = error.reshape(error.shape[0] // 8, 8, width // 8, 8, 3).mean(axis=(1, 3)).reshape(-1, 3)
    half = stats.t.ppf(0.975, len(blocks) - 1) * blocks.std(axis=0, ddof=1) / np.sqrt(len(blocks))
    return np.stack([blocks.mean(axis=0), half], axis=-1)


def as_lists(*values):
    return [v.tolist() if isinstance(v, np.ndarray) else v for v in values]


def comparisons():
    random = np.random.default_rng(2020)
    sizes = [(1, 2), (40, 50), (16, 64), (7, 3)]
    sets = [(w, *pictures(random, w, h)) for w, h in sizes]
    exposed = [(w, t, r, e) for w, t, r in sets[::-1] for e in (0.5, 3.0)]
    blocks = [(w, *pictures(random, w, h)) for w, h in [(48, 48), (64, 40)]]
    freedom = [0.3, 1.0, 2.5, 7.0, 30.0, 1e3]
    quantiles = [(p, f) for p in (0.001, 0.025, 0.3, 0.5001, 0.9, 0.975, 0.9995) for f in freedom]
    samples = [(random.normal(size=n).tolist(), p) for n in (1, 2, 9, 100) for p in (0.0, 0.31, 0.95, 1.0)]
    return [
        Comparison("relMSE, trimmed, MAPE, SMAPE (numpy)", "relative_metrics", [as_lists(*s) for s in sets],
                   [relative(t, r) for _, t, r in sets], 1e-13, relative=True, frozen_cases=2),
        Comparison("PSNR and ΔE 2000 of pictures", "displayed_metrics", [as_lists(*s) for s in exposed],
                   [displayed(t, r, e) for _, t, r, e in exposed], 1e-9, frozen_cases=1),
        Comparison("bias and its interval (SciPy)", "bias", [as_lists(*s) for s in blocks],
                   [bias(*s) for s in blocks], 1e-12, relative=True, frozen_cases=0),
        Comparison("Student's t quantile (SciPy)", "student_t_quantile", [list(q) for q in quantiles],
                   [float(stats.t.ppf(p, f)) for p, f in quantiles], 1e-10, relative=True),
        Comparison("quantile (numpy)", "quantile", [list(s) for s in samples],
                   [float(np.quantile(*s)) for s in samples], 1e-14),
    ]


def flip_cases(random):
    """Encoded sRGB in [0, 1]: noise, an edge moved by a pixel, single dots, flat extremes."""
    height, width = 48, 56
    y, x = np.mgrid[0:height, 0:width]
    smooth = np.stack([0.5 + 0.5 * np.sin(0.11 * x + 0.07 * y + c) for c in range(3)], axis=-1)
    edge = np.repeat((x > 20)[..., None].astype(float), 3, axis=2)
    moved = np.repeat((x > 21)[..., None].astype(float), 3, axis=2)
    dots = smooth.copy()
    dots[::13, ::11] = 1.0
    green, blue = np.zeros_like(smooth), np.zeros_like(smooth)
    green[..., 1], blue[..., 2] = 1.0, 1.0
    noise = np.clip(smooth + random.normal(0, 0.1, smooth.shape), 0, 1)
    chroma = smooth[..., [1, 2, 0]]
    return [(noise, smooth), (moved, edge), (dots, smooth), (green, blue), (chroma, smooth), (edge * 0, edge)]


def checks(evaluate):
    random = np.random.default_rng(3)
    arguments, expected = [], []
    for test, reference in flip_cases(random):
        for pixels_per_degree in (67.0206432766, 30.0, 100.0):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                evaluated = flip_evaluator.evaluate(
                    reference.astype(np.float32), test.astype(np.float32), "LDR",
                    applyMagma=False, parameters={"ppd": pixels_per_degree})
            expected.append(np.squeeze(evaluated[0]).ravel())
            linear = [colour.models.eotf_sRGB(p.astype(np.float32).astype(float)) for p in (test, reference)]
            xyz = [(p @ XYZ_FROM_RGB.T).reshape(-1, 3).tolist() for p in linear]
            arguments.append([test.shape[1], *xyz, pixels_per_degree])
    values = evaluate("flip_map", arguments)
    difference = [np.abs(np.asarray(v) - e) for v, e in zip(values, expected)]
    # The package computes in f32: where colours nearly agree it finds 0, which the exponent 0.7 makes 1.6e-3.
    return [
        row("FLIP, mean of a picture (flip-evaluator)", len(values),
            max(abs(np.mean(v) - np.mean(e)) for v, e in zip(values, expected)), 5e-5),
        row("FLIP, every pixel (flip-evaluator)", sum(len(d) for d in difference), max(d.max() for d in difference), 2e-3),
    ]
