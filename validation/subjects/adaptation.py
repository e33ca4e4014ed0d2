"""Chromatic adaptation: von Kries' rule in twelve transforms, and the models."""

import itertools

import colour
import numpy as np
from colour.adaptation import CAT_VON_KRIES
from comparison import Comparison, row

OBSERVER = "CIE 1931 2 Degree Standard Observer"
WHITES_XY = {name: colour.CCS_ILLUMINANTS[OBSERVER][name] for name in ("A", "D50", "D65", "D75", "E", "FL2", "FL11")}
WHITES = {name: colour.xy_to_XYZ(xy) for name, xy in WHITES_XY.items()}
PAIRS = list(itertools.product(WHITES, repeat=2))
TRANSFORMS = {name.lower().replace(" ", "-"): name for name in colour.CHROMATIC_ADAPTATION_TRANSFORMS}
# colour's CMCCAT97 is the transpose of the published matrix, and one sign of it is wrong; Luo and Hunt's is Bradford's.
REFERENCE = {**TRANSFORMS, "cmccat97": "Bradford"}
RANDOM = np.random.default_rng(1985)


def numbers(array):
    return [float(x) for x in np.ravel(array)]


def colors(count):
    """Black, a perfect diffuser, an imaginary colour, random ones."""
    return [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [-0.05, 0.1, 0.4], *map(numbers, RANDOM.uniform(0.0, 1.1, (count, 3)))]


def comparisons():
    with colour.domain_range_scale("1"):
        return [von_kries(), *cie1994(), *cmccat2000(), zhai2018(), *fairchild1991(), fairchild2020(), li2025()]


def von_kries():
    arguments, expected = [], []
    for ours, theirs in REFERENCE.items():
        for a, b in PAIRS:
            arguments.append([ours, numbers(WHITES[a]), numbers(WHITES[b])])
            expected.append(colour.adaptation.matrix_chromatic_adaptation_VonKries(WHITES[a], WHITES[b], transform=theirs))
    return Comparison("adaptation, 12 von Kries transforms", "cone_adaptation_matrix", arguments, expected, 1e-12, frozen_cases=96)


def cie1994():
    cases = [(xyz, a, b, e, y, n) for (a, b), xyz in zip(PAIRS * 4, colors(193)) for e, y, n in (((1000.0, 1000.0), 0.2, 0.01), ((50.0, 5000.0), 0.5, 0.001))]
    arguments = [[xyz, [numbers(WHITES_XY[a]), numbers(WHITES_XY[b])], list(e), y, n] for xyz, a, b, e, y, n in cases]
    # colour takes the noise in percent whatever the scale of the rest.
    expected = [
        colour.adaptation.chromatic_adaptation_CIE1994(np.asarray(xyz), WHITES_XY[a], WHITES_XY[b], y, *e, 100.0 * n)
        for xyz, a, b, e, y, n in cases
    ]
    back = [[numbers(y), *argument[1:]] for argument, y in zip(arguments, expected)]
    # colour has no inverse: the way back has to end where it began.
    return [
        Comparison("adaptation, CIE 1994", "cie1994_forward", arguments, expected, 1e-12),
        Comparison("adaptation, CIE 1994, the way back", "cie1994_inverse", back, [a[0] for a in arguments], 1e-12),
    ]


def cmccat2000():
    surrounds = colour.VIEWING_CONDITIONS_CMCCAT2000
    luminances = ((200.0, 200.0), (20.0, 2000.0), (2000.0, 1.0))
    cases = [(xyz, a, b, l, dim) for (a, b), xyz in zip(PAIRS * 4, colors(193)) for l in luminances for dim in (False, True)]
    arguments = [[xyz, numbers(WHITES[a]), numbers(WHITES[b]), list(l), dim] for xyz, a, b, l, dim in cases]
    both = []
    for function in (colour.adaptation.chromatic_adaptation_forward_CMCCAT2000, colour.adaptation.chromatic_adaptation_inverse_CMCCAT2000):
        both.append([function(np.asarray(xyz), WHITES[a], WHITES[b], *l, surrounds["Dim" if dim else "Average"]) for xyz, a, b, l, dim in cases])
    return [
        Comparison("adaptation, CMCCAT2000", "cmccat2000_forward", arguments, both[0], 1e-12),
        Comparison("adaptation, CMCCAT2000 inverse", "cmccat2000_inverse", arguments, both[1], 1e-12),
    ]


def zhai2018():
    arguments, expected = [], []
    for (a, b), xyz in zip(PAIRS * 4, colors(193)):
        for transform, degrees, baseline in (("CAT16", (1.0, 1.0), "E"), ("CAT02", (0.7, 0.9), "E"), ("CAT16", (0.2, 0.0), "D65")):
            arguments.append([xyz, [numbers(WHITES[a]), numbers(WHITES[b])], list(degrees), numbers(WHITES[baseline]), transform.lower()])
            expected.append(colour.adaptation.chromatic_adaptation_Zhai2018(np.asarray(xyz), WHITES[a], WHITES[b], *degrees, WHITES[baseline], transform))
    return Comparison("adaptation, Zhai and Luo 2018", "zhai2018", arguments, expected, 1e-12)


def fairchild1991():
    """colour takes the degree of adaptation from the sample instead of the white, uses it for both fields and makes the
    interaction matrix a multiple of the identity, so that everything but von Kries cancels. It can be the reference only
    where the model is that: an observer who discounts the illuminant, at one luminance. The rest is compared with the
    published equations in numpy."""
    lists = {True: ([], []), False: ([], [])}
    for (a, b), xyz in zip(PAIRS * 4, colors(193)):
        white, reference = WHITES[a], WHITES[b]
        arguments, expected = lists[True]
        arguments.append([xyz, [numbers(white), numbers(reference)], [200.0, 200.0], True])
        expected.append(colour.adaptation.chromatic_adaptation_Fairchild1990(np.asarray(xyz), white, reference, 200.0, True))
        arguments, expected = lists[False]
        for luminances in ((200.0, 200.0), (5.0, 2000.0)):
            arguments.append([xyz, [numbers(white), numbers(reference)], list(luminances), False])
            first, second = (adapted_cones(w, l) for w, l in zip((white, reference), luminances))
            expected.append(np.linalg.solve(second, first @ np.asarray(xyz)))
    return [
        Comparison("adaptation, Fairchild 1991, illuminant discounted", "fairchild1991", *lists[True], 1e-12),
        Comparison("adaptation, Fairchild 1991 v. its equations", "fairchild1991", *lists[False], 1e-12),
    ]


def adapted_cones(white, luminance):
    cones = CAT_VON_KRIES @ white
    relative = cones / CAT_VON_KRIES.sum(axis=1)
    excess = 3.0 * relative / relative.sum()
    degree = (1.0 + luminance ** (1 / 3) + excess) / (1.0 + luminance ** (1 / 3) + 1.0 / excess)
    interaction = np.full((3, 3), 0.219 - 0.0784 * np.log10(luminance))
    np.fill_diagonal(interaction, 1.0)
    return interaction @ np.diag(degree / cones) @ CAT_VON_KRIES


def fairchild2020():
    arguments, expected = [], []
    conditions = colour.adaptation.CONDITIONS_DEGREE_OF_ADAPTATION_VK20
    for (a, b), (ours, theirs) in itertools.product(PAIRS, REFERENCE.items()):
        coefficients = list(conditions.values())[len(arguments) % len(conditions)]
        whites = [WHITES[a], WHITES[b], colour.adaptation.fairchild2020.TVS_XYZ_R_VK20]
        weights = [coefficients.D_p, coefficients.D_n, coefficients.D_r]
        arguments.append([[numbers(w) for w in whites], [float(w) for w in weights], ours])
        expected.append(colour.adaptation.matrix_chromatic_adaptation_vk20(*whites, theirs, coefficients))
    return Comparison("adaptation, Fairchild 2020", "fairchild2020_matrix", arguments, expected, 1e-12)


def li2025():
    arguments, expected = [], []
    for (a, b), xyz in zip(PAIRS * 4, colors(193)):
        for luminance, surround, discounts in ((100.0, 1.0, False), (0.1, 0.8, False), (5000.0, 0.9, False), (100.0, 1.0, True)):
            arguments.append([xyz, numbers(WHITES[a]), numbers(WHITES[b]), luminance, None if discounts else surround])
            expected.append(colour.adaptation.chromatic_adaptation_Li2025(np.asarray(xyz), WHITES[a], WHITES[b], luminance, surround, discounts))
    return Comparison("adaptation, Li 2025", "li2025", arguments, expected, 1e-12)


def checks(evaluate):
    names = evaluate("cone_transform_names", [None])[0]
    return [row("von Kries transforms that only one of both has", len(names), len(set(names) ^ set(TRANSFORMS)), 0)]
