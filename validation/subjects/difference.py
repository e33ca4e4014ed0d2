"""Colour differences: random pairs, near pairs, pairs about the grey axis, the 34 pairs of Sharma et al. (2005)."""

import colour
import numpy as np
from colour.difference import delta_E_CAM02LCD, delta_E_CAM02SCD, delta_E_CAM02UCS, delta_E_HyCH
from comparison import Comparison

COUNT = 10_000

# Lab, Lab, difference to four digits.
SHARMA = """
50 2.6772 -79.7751 50 0 -82.7485 2.0425
50 3.1571 -77.2803 50 0 -82.7485 2.8615
50 2.8361 -74.02 50 0 -82.7485 3.4412
50 -1.3802 -84.2814 50 0 -82.7485 1
50 -1.1848 -84.8006 50 0 -82.7485 1
50 -0.9009 -85.5211 50 0 -82.7485 1
50 0 0 50 -1 2 2.3669
50 -1 2 50 0 0 2.3669
50 2.49 -0.001 50 -2.49 0.0009 7.1792
50 2.49 -0.001 50 -2.49 0.001 7.1792
50 2.49 -0.001 50 -2.49 0.0011 7.2195
50 2.49 -0.001 50 -2.49 0.0012 7.2195
50 -0.001 2.49 50 0.0009 -2.49 4.8045
50 -0.001 2.49 50 0.001 -2.49 4.8045
50 -0.001 2.49 50 0.0011 -2.49 4.7461
50 2.5 0 50 0 -2.5 4.3065
50 2.5 0 73 25 -18 27.1492
50 2.5 0 61 -5 29 22.8977
50 2.5 0 56 -27 -3 31.903
50 2.5 0 58 24 15 19.4535
50 2.5 0 50 3.1736 0.5854 1
50 2.5 0 50 3.2972 0 1
50 2.5 0 50 1.8634 0.5757 1
50 2.5 0 50 3.2592 0.335 1
60.2574 -34.0099 36.2677 60.4626 -34.1751 39.4387 1.2644
63.0109 -31.0961 -5.8663 62.8187 -29.7946 -4.0864 1.263
61.2901 3.7196 -5.3901 61.4292 2.248 -4.962 1.8731
35.0831 -44.1164 3.7933 35.0232 -40.0716 1.5901 1.8645
22.7233 20.0904 -46.694 23.0331 14.973 -42.5619 2.0373
36.4612 47.858 18.3852 36.2715 50.5065 21.2231 1.4146
90.8027 -2.0831 1.441 91.1528 -1.6435 0.0447 1.4441
90.9257 -0.5406 -0.9208 88.6381 -0.8985 -0.7239 1.5381
6.7747 -0.2908 -2.4247 5.8714 -0.0985 -2.2286 0.6377
2.0776 0.0795 -1.135 0.9033 -0.0636 -0.5514 0.9082
"""


def din99_textiles(one, two):
    """colour-science multiplies L99 by k_E = 2 where its inverse and DIN 6176 divide: a factor of 4 put right."""
    lab_99 = [colour.Lab_to_DIN99(lab, 2, 0.5) / [4, 1, 1] for lab in (one, two)]
    return np.linalg.norm(lab_99[0] - lab_99[1], axis=-1)


def din99(method):
    def difference(one, two):
        return np.linalg.norm(
            colour.Lab_to_DIN99(one, method=method) - colour.Lab_to_DIN99(two, method=method), axis=-1
        )

    return difference


def method(name, **keywords):
    return lambda one, two: colour.delta_E(one, two, method=name, **keywords)


FORMULAS = {
    "cie1976": method("CIE 1976"),
    "cie1994": method("CIE 1994"),
    "cie1994-textiles": method("CIE 1994", textiles=True),
    "cie2000": method("CIE 2000"),
    "cie2000-textiles": method("CIE 2000", textiles=True),
    "cmc-1-1": method("CMC", l=1, c=1),
    "cmc-2-1": method("CMC", l=2, c=1),
    "din99": method("DIN99"),
    "din99-textiles": din99_textiles,
    "din99b": din99("DIN99b"),
    "din99c": din99("DIN99c"),
    "din99d": din99("DIN99d"),
    "hyab": method("HyAB"),
    "hych": delta_E_HyCH,
}


def pairs():
    rng = np.random.default_rng(20261122)
    scale = np.array([100.0, 256.0, 256.0])

    def lab(count):
        return (rng.uniform(0, 1, (count, 3)) - [0, 0.5, 0.5]) * scale

    one = lab(COUNT // 4)
    near = one + rng.normal(0, 1, one.shape) * 10 ** rng.uniform(-6, 0.5, (len(one), 1))
    greys = np.column_stack([rng.uniform(0, 100, (COUNT // 10, 1)), rng.normal(0, 1, (COUNT // 10, 2))])
    greys[:, 1:] *= 10 ** rng.uniform(-9, 0, (len(greys), 1))
    exact = np.column_stack([np.linspace(0, 100, 101), np.zeros((101, 2))])
    # Hues around 0, 164 and 345 degrees, where formulas wrap or jump, and L* around 16.
    hues = np.radians([359.999, 0.001, 163.999, 164.001, 344.999, 345.001, 274.999, 275.001])
    wrapped = np.array([[level, 40 * np.cos(h), 40 * np.sin(h)] for h in hues for level in (15.999, 16.0, 16.001)])
    return {
        "random": (lab(COUNT), lab(COUNT)),
        "near": (one, near),
        "about grey": (greys, np.roll(greys, 1, axis=0)),
        "grey against random": (exact, lab(101)),
        "greys": (exact, np.roll(exact, 1, axis=0)),
        "hues that wrap": (np.repeat(wrapped, len(wrapped), axis=0), np.tile(wrapped, (len(wrapped), 1))),
    }


def lab_comparisons():
    """One comparison a formula, over all kinds of pairs."""
    one, two = (np.vstack(side) for side in zip(*pairs().values()))
    found = []
    for name, formula in FORMULAS.items():
        arguments = [[name, a, b] for a, b in zip(one.tolist(), two.tolist())]
        found.append(Comparison(name, "difference", arguments, list(np.asarray(formula(one, two))), 1e-11))
    return found


def published():
    rows = np.array([[float(x) for x in line.split()] for line in SHARMA.strip().split("\n")])
    found = []
    for label, one, two in [("", rows[:, :3], rows[:, 3:6]), (", swapped", rows[:, 3:6], rows[:, :3])]:
        arguments = [["cie2000", a, b] for a, b in zip(one.tolist(), two.tolist())]
        subject = "cie2000, 34 pairs as published" + label
        found.append(Comparison(subject, "difference", arguments, list(rows[:, 6]), 5e-5, False, len(rows)))
    return found


def other_spaces():
    rng = np.random.default_rng(5)
    one, two = (np.column_stack([rng.uniform(0, 1, COUNT), rng.uniform(-0.5, 0.5, (COUNT, 2))]) for _ in range(2))
    arguments = [[a, b] for a, b in zip(one.tolist(), two.tolist())]
    # colour-science halves T of its arguments in place.
    expected = colour.delta_E(one.copy(), two.copy(), method="ITP")
    found = [Comparison("itp", "difference_itp", arguments, list(expected), 1e-11)]
    for kind, formula in [("lcd", delta_E_CAM02LCD), ("scd", delta_E_CAM02SCD), ("ucs", delta_E_CAM02UCS)]:
        arguments = [[kind, a, b] for a, b in zip((100 * one).tolist(), (100 * two).tolist())]
        expected = formula(100 * one, 100 * two)
        subject = f"cam02-{kind}, cam16-{kind}"
        found.append(Comparison(subject, "difference_cam", arguments, list(expected), 1e-11))
    return found


def comparisons():
    return lab_comparisons() + published() + other_spaces()
