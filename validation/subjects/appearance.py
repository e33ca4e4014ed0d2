"""Appearance models, each with its inverse, and the uniform spaces over them."""

import colour
import numpy as np
from comparison import Comparison, row

RANDOM = np.random.default_rng(20221)
SURROUNDS = ["average", "dim", "dark"]
LUMINANCES = [0.4, 4.0, 63.66, 1000.0]
XY = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]
LUMINANCE_FACTORS = {"D65": 1.0, "A": 1.0, "FL11": 1.0, "D50": 0.9}
WHITES = {name: colour.xy_to_XYZ(XY[name]) * y for name, y in LUMINANCE_FACTORS.items()}
SRGB = colour.RGB_COLOURSPACES["sRGB"].matrix_RGB_to_XYZ
BT2020 = colour.RGB_COLOURSPACES["ITU-R BT.2020"].matrix_RGB_to_XYZ

MODELS = {
    "ciecam02": (colour.XYZ_to_CIECAM02, colour.CIECAM02_to_XYZ, colour.appearance.CAM_Specification_CIECAM02),
    "cam16": (colour.XYZ_to_CAM16, colour.CAM16_to_XYZ, colour.appearance.CAM_Specification_CAM16),
    "ciecam16": (colour.XYZ_to_CIECAM16, colour.CIECAM16_to_XYZ, colour.appearance.CAM_Specification_CIECAM16),
    "hellwig2022": (
        colour.XYZ_to_Hellwig2022,
        colour.Hellwig2022_to_XYZ,
        colour.appearance.CAM_Specification_Hellwig2022,
    ),
    "zcam": (colour.XYZ_to_ZCAM, colour.ZCAM_to_XYZ, colour.appearance.CAM_Specification_ZCAM),
}
UNIQUE_HUES = {
    "ciecam02": ([20.14, 90.0, 164.25, 237.53, 380.14], [0.8, 0.7, 1.0, 1.2, 0.8]),
    "zcam": ([33.44, 89.29, 146.3, 238.36, 393.44], [0.68, 0.64, 1.52, 0.77, 0.68]),
}


def colors(white):
    """Stimuli of Y up to 1.2: colours of two gamuts under their own white, dim ones, near greys, and the white."""
    rgb = RANDOM.uniform(0.0, 1.0, (24, 3)) ** 2.2
    saturated = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]], dtype=float) * 0.7 + 1e-3
    dim, bright = rgb[:6] * 1e-4, rgb[:4] * 1.2
    inside = np.vstack([rgb @ SRGB.T, rgb @ BT2020.T, saturated @ SRGB.T, dim @ SRGB.T, bright @ SRGB.T])
    under_white = inside / WHITES["D65"] * white
    greys = np.outer([1e-3, 0.18, 0.9], white * [1.02, 1.0, 0.97])
    return np.vstack([under_white, greys])


def cases(name):
    """Conditions as the evaluator reads them and as colour-science does, and XYZ of stimuli: in cd/m² for ZCAM."""
    for surround in SURROUNDS:
        for luminance in LUMINANCES:
            for white_name, white in WHITES.items():
                discount = white_name == "FL11"
                background = {"D65": 0.2, "A": 0.05, "D50": 0.6, "FL11": 0.2}[white_name]
                scale = 5.0 * luminance if name == "zcam" else 1.0
                white, background = white * scale, background * scale
                conditions = [surround, luminance, background, discount, white.tolist()]
                # Scale 100 of XYZ; ZCAM is absolute in either.
                factor = 1.0 if name == "zcam" else 100.0
                settings = {
                    "XYZ_w": white * factor,
                    "L_A": luminance,
                    "Y_b": background * factor,
                    "surround": getattr(colour, f"VIEWING_CONDITIONS_{name.upper()}")[surround.capitalize()],
                    "discount_illuminant": discount,
                }
                yield conditions, settings, colors(white), factor


def hue_quadrature(name, h):
    """As CIE 159, CIE 248 and ZCAM's paper have it."""
    degrees, e = (np.array(x) for x in UNIQUE_HUES.get(name, UNIQUE_HUES["ciecam02"]))
    h = np.where(h < degrees[0], h + 360.0, h)
    i = np.searchsorted(degrees, h, side="right") - 1
    since, until = (h - degrees[i]) / e[i], (degrees[i + 1] - h) / e[i + 1]
    return 100.0 * i + 100.0 * since / (since + until)


def of_model(name):
    """Forward, and both inverses from the oracle's own correlates."""
    forward, inverse, specification_type = MODELS[name]
    arguments, seen, from_jch, from_jmh, back_jch, back_jmh = [], [], [], [], [], []
    for conditions, settings, xyz, factor in cases(name):
        s = forward(xyz * factor, **settings)
        # colour-science adds 360 to the hues of ZCAM below 33.44 when it is given arrays.
        h = s.h % 360.0
        seen += np.stack([s.J, s.C, h, s.s, s.Q, s.M, hue_quadrature(name, h)], axis=-1).tolist()
        arguments += [[name, conditions, x] for x in xyz.tolist()]
        for m, requests, expected in ((s.C, from_jch, back_jch), (s.M, from_jmh, back_jmh)):
            requests += [[name, conditions, x] for x in np.stack([s.J, m, h], axis=-1).tolist()]
            key = "C" if m is s.C else "M"
            extra = {"C": s.C} if name == "hellwig2022" and key == "M" else {}
            expected += (inverse(specification_type(J=s.J, h=h, **{key: m}, **extra), **settings) / factor).tolist()
    # Values reach 1000; ZCAM's PQ curve has powers of 134, which multiply the rounding of both sides.
    return [
        Comparison(f"{name}: J C h s Q M H", "appearance_from_xyz", arguments, seen, 1e-9),
        Comparison(f"{name}: XYZ from J C h", "xyz_from_jch", from_jch, back_jch, 1e-9, relative=True, frozen_cases=12),
        Comparison(f"{name}: XYZ from J M h", "xyz_from_jmh", from_jmh, back_jmh, 1e-9, relative=True, frozen_cases=12),
    ]


def out_of_locus():
    """Stimuli that no light gives, with negative responses: J, C and h, as Q and s of negative J are NaN in
    colour-science."""
    xyz = RANDOM.uniform([-0.3, -0.2, -0.3], [0.9, 0.6, 0.9], (60, 3))
    arguments, expected = [], []
    for name in ["ciecam02", "cam16", "ciecam16", "hellwig2022"]:
        for conditions, settings, _xyz, factor in list(cases(name))[::6]:
            s = MODELS[name][0](xyz * factor, **settings)
            arguments += [[name, conditions, x] for x in xyz.tolist()]
            expected += np.stack([s.J, s.C, s.h], axis=-1).tolist()
    # Chroma reaches 1e5 where the sum that it is divided by is near 0.
    subject = "appearance out of the locus: J C h, relative"
    return [Comparison(subject, "jch_from_xyz", arguments, expected, 1e-9, relative=True)]


def hellwig_extension():
    arguments, expected, inverse_arguments, inverse_expected = [], [], [], []
    for conditions, settings, xyz, factor in cases("hellwig2022"):
        s = colour.XYZ_to_Hellwig2022(xyz * factor, **settings)
        arguments += [[conditions, x] for x in xyz.tolist()]
        expected += np.stack([s.J_HK, s.Q_HK], axis=-1).tolist()
        inverse_arguments += [[conditions, x] for x in np.stack([s.J_HK, s.C, s.h], axis=-1).tolist()]
        specification = colour.appearance.CAM_Specification_Hellwig2022(J_HK=s.J_HK, C=s.C, h=s.h)
        inverse_expected += (colour.Hellwig2022_to_XYZ(specification, **settings) / factor).tolist()
    return [
        Comparison("hellwig2022: Helmholtz–Kohlrausch J Q", "hellwig_hk", arguments, expected, 1e-9),
        Comparison(
            "hellwig2022: XYZ from J_HK C h",
            "hellwig_xyz_from_jch_hk",
            inverse_arguments,
            inverse_expected,
            1e-9,
            relative=True,
            frozen_cases=12,
        ),
    ]


def zcam_scales():
    arguments, expected = [], []
    for conditions, settings, xyz, _factor in cases("zcam"):
        s = colour.XYZ_to_ZCAM(xyz, **settings)
        arguments += [[conditions, x] for x in xyz.tolist()]
        expected += np.stack([s.V, s.K, s.W], axis=-1).tolist()
    return [Comparison("zcam: vividness, blackness, whiteness", "zcam_scales", arguments, expected, 1e-9)]


def uniform_spaces():
    jmh = np.vstack(
        [
            RANDOM.uniform([0, 0, 0], [105, 120, 360], (2000, 3)),
            [[0, 0, 0], [100, 0, 0], [50, 1e-9, 359.999], [1e-9, 60, 180]],
        ]
    )
    pairs = RANDOM.uniform([0, -50, -50], [100, 50, 50], (1000, 2, 3))
    pairs[:100, 1] = pairs[:100, 0] + RANDOM.normal(0.0, 0.01, (100, 3))
    made = []
    for kind in ["UCS", "LCD", "SCD"]:
        space = kind.lower()
        ucs = getattr(colour, f"JMh_CIECAM02_to_CAM02{kind}")(jmh)
        back = getattr(colour, f"CAM02{kind}_to_JMh_CIECAM02")(ucs[:2000])
        difference = colour.delta_E(pairs[:, 0], pairs[:, 1], method=f"CAM02-{kind}")
        there, here = [[space, x] for x in jmh.tolist()], [[space, x] for x in ucs[:2000].tolist()]
        two = [[space, *x] for x in pairs.tolist()]
        made += [
            Comparison(f"CAM02/CAM16-{kind} from J M h", "ucs_from_jmh", there, list(ucs), 1e-11),
            Comparison(f"J M h from CAM02/CAM16-{kind}", "jmh_from_ucs", here, list(back), 1e-9),
            Comparison(f"ΔE' CAM02/CAM16-{kind}", "ucs_difference", two, list(difference), 1e-11),
        ]
    return made


def comparisons():
    made = [c for name in MODELS for c in of_model(name)]
    return made + out_of_locus() + hellwig_extension() + zcam_scales() + uniform_spaces()


def checks(evaluate):
    """Hue quadrature is compared with CIE 159's formula above. colour-science has it between red and blue hues, 20.14°
    to 237.53°; beyond it takes Hunt's constants 385.9, 14.1, 85.9 and 0.856, which differ by up to 6."""
    h = np.linspace(20.15, 237.52, 5001)
    formula = np.abs(hue_quadrature("ciecam02", h) - colour.appearance.ciecam02.hue_quadrature(h.copy())).max()
    z = np.linspace(0.0, 359.99, 5001)
    of_zcam = np.abs(hue_quadrature("zcam", z) - colour.appearance.zcam.hue_quadrature(z.copy()) % 400.0).max()
    worst = 0.0
    for name in MODELS:
        for conditions, _settings, xyz, _factor in list(cases(name))[::5]:
            seen = evaluate("appearance_from_xyz", [[name, conditions, x] for x in xyz.tolist()])
            back = evaluate("xyz_from_jch", [[name, conditions, s[:3]] for s in seen])
            worst = max(worst, float(np.abs((np.array(back) - xyz) / xyz.max(axis=1, keepdims=True)).max()))
    return [
        row("hue quadrature of the oracle v colour-science, 20.14–237.53", len(h), formula, 1e-10),
        row("hue quadrature of the oracle v colour-science, ZCAM", len(z), of_zcam, 1e-10),
        row("appearance: XYZ → J C h → XYZ, relative", 5 * 10 * 63, worst, 1e-10),
    ]
