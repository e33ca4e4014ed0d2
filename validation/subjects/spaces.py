"""Colour spaces and lightness scales.

XYZ of the cases has Y = 1 for white. Tolerances are 1e-11 absolute, except where coordinates are unbounded: far outside
the locus, where a denominator passes 0, they are relative to the largest coordinate.
"""

import colour
import numpy as np
from comparison import Comparison

COUNT = 10_000
FROZEN = 12
WHITES = {name: colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"][name] for name in ["D65", "A", "D50"]}
CMFS = np.asarray(colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].values)


def white_xyz(name):
    return colour.xy_to_XYZ(WHITES[name])


def in_the_locus(rng, count):
    """Mixtures of three spectral lights and white, of any luminance up to 1."""
    lights = CMFS[rng.integers(40, 340, (count, 3))]
    lights /= lights.sum(axis=-1, keepdims=True)
    mixed = np.einsum("ni,nij->nj", rng.dirichlet([0.5] * 3, count), lights)
    mixed = mixed * rng.uniform(0, 1, (count, 1)) + white_xyz("D65") / 3 * rng.uniform(0, 1, (count, 1))
    return mixed / mixed[:, 1:2] * rng.uniform(0.001, 1, (count, 1))


def dark(rng, count):
    """Around the break of CIE 1976 and below, down to 1e-12."""
    at_break = np.outer(216 / 24389 * np.array([1, 1 - 2e-16, 1 + 3e-16, 0.5]), white_xyz("D65"))
    return np.vstack([at_break, in_the_locus(rng, count) * 10 ** rng.uniform(-12, -2, (count, 1))])


def extremes():
    """Black, white, greys, one component alone."""
    greys = np.outer([1e-9, 1e-3, 0.18, 0.5, 1.0, 4.0], white_xyz("D65"))
    return np.vstack([np.zeros((1, 3)), np.eye(3), greys, [[1e-300, 1e-300, 1e-300]]])


def sets():
    """Named sets of XYZ: what all spaces have to do, what is far from any light, and negatives."""
    rng = np.random.default_rng(20261122)
    anywhere = rng.uniform(0, 2, (COUNT, 3))
    negative = rng.uniform(-0.5, 2, (COUNT // 4, 3))
    return {
        "lights": np.vstack([in_the_locus(rng, COUNT), dark(rng, COUNT // 10)]),
        "out of locus": anywhere,
        "extremes": extremes(),
        "negatives": negative[(negative < 0).any(axis=-1)],
    }


def lch(lab):
    lab = np.asarray(lab)
    return np.stack([lab[:, 0], np.hypot(lab[:, 1], lab[:, 2]), np.degrees(np.arctan2(lab[:, 2], lab[:, 1])) % 360], -1)


def uvy_1976(xyz):
    return np.column_stack([colour.xy_to_Luv_uv(colour.XYZ_to_xy(xyz)), xyz[:, 1]])


def uvy_1960(xyz):
    return np.column_stack([colour.xy_to_UCS_uv(colour.XYZ_to_xy(xyz)), xyz[:, 1]])


def din99(method):
    return lambda xyz, xy: colour.XYZ_to_DIN99(xyz, xy, method=method)


def hunter(function):
    return lambda xyz, xy: function(100 * xyz, 100 * colour.xy_to_XYZ(xy))


ALL = ["lights", "out of locus", "extremes", "negatives"]
LIGHTS = ["lights", "extremes"]
# Name, colour-science's function of XYZ and the white's xy, inverse, the sets that both define. Sets that are left out
# are covered by round trips below: PQ responses of negatives are not monotone in colour-science (powers of negative
# ratios), where abbe continues the curve point-symmetrically; chromaticity coordinates of negatives pass through
# infinity; colour-science's Hunter Lab is NaN for black, and its U*V*W* takes u = v = 0 there.
SPACES = [
    ("xyy", lambda xyz, xy: colour.XYZ_to_xyY(xyz), lambda v, xy: colour.xyY_to_XYZ(v), ALL),
    ("lab", colour.XYZ_to_Lab, colour.Lab_to_XYZ, ALL),
    ("luv", colour.XYZ_to_Luv, colour.Luv_to_XYZ, ALL),
    ("ucs-1960", lambda xyz, xy: colour.XYZ_to_UCS(xyz), lambda v, xy: colour.UCS_to_XYZ(v), ALL),
    ("uv-1976", lambda xyz, xy: uvy_1976(xyz), None, ["lights", "out of locus"]),
    ("uv-1960", lambda xyz, xy: uvy_1960(xyz), None, ["lights", "out of locus"]),
    (
        "uvw-1964",
        lambda xyz, xy: colour.XYZ_to_UVW(100 * xyz, xy),
        lambda v, xy: colour.UVW_to_XYZ(v, xy) / 100,
        ["lights", "out of locus"],
    ),
    ("oklab", lambda xyz, xy: colour.XYZ_to_Oklab(xyz), lambda v, xy: colour.Oklab_to_XYZ(v), ALL),
    ("ipt", lambda xyz, xy: colour.XYZ_to_IPT(xyz), lambda v, xy: colour.IPT_to_XYZ(v), ALL),
    (
        "ipt-ragoo2021",
        lambda xyz, xy: colour.XYZ_to_IPT_Ragoo2021(xyz),
        lambda v, xy: colour.IPT_Ragoo2021_to_XYZ(v),
        ALL,
    ),
    ("igpgtg", lambda xyz, xy: colour.XYZ_to_IgPgTg(xyz), lambda v, xy: colour.IgPgTg_to_XYZ(v), ALL),
    ("sucs", lambda xyz, xy: colour.XYZ_to_sUCS(xyz), lambda v, xy: colour.sUCS_to_XYZ(v), ALL),
    ("ictcp", lambda xyz, xy: colour.XYZ_to_ICtCp(xyz), lambda v, xy: colour.ICtCp_to_XYZ(v), LIGHTS),
    ("icacb", lambda xyz, xy: colour.XYZ_to_ICaCb(xyz), lambda v, xy: colour.ICaCb_to_XYZ(v), LIGHTS),
    ("jzazbz", lambda xyz, xy: colour.XYZ_to_Jzazbz(xyz), lambda v, xy: colour.Jzazbz_to_XYZ(v), LIGHTS),
    ("din99", din99("DIN99"), lambda v, xy: colour.DIN99_to_XYZ(v, xy, method="DIN99"), LIGHTS),
    ("din99b", din99("DIN99b"), lambda v, xy: colour.DIN99_to_XYZ(v, xy, method="DIN99b"), LIGHTS),
    ("din99c", din99("DIN99c"), lambda v, xy: colour.DIN99_to_XYZ(v, xy, method="DIN99c"), LIGHTS),
    ("din99d", din99("DIN99d"), lambda v, xy: colour.DIN99_to_XYZ(v, xy, method="DIN99d"), LIGHTS),
    (
        "hunter-lab",
        hunter(colour.XYZ_to_Hunter_Lab),
        lambda v, xy: colour.Hunter_Lab_to_XYZ(v, 100 * colour.xy_to_XYZ(xy)) / 100,
        ["lights", "out of locus"],
    ),
    (
        "hunter-rdab",
        hunter(colour.models.XYZ_to_Hunter_Rdab),
        lambda v, xy: colour.models.Hunter_Rdab_to_XYZ(v, 100 * colour.xy_to_XYZ(xy)) / 100,
        ["lights", "out of locus", "extremes"],
    ),
    ("osa-ucs", lambda xyz, xy: colour.XYZ_to_OSA_UCS(100 * xyz), None, ["lights", "out of locus"]),
    ("prolab", colour.XYZ_to_ProLab, colour.ProLab_to_XYZ, ["lights", "out of locus", "extremes"]),
    ("yrg", lambda xyz, xy: colour.models.XYZ_to_Yrg(xyz), None, LIGHTS),
]
ABSOLUTE = {"ictcp", "icacb", "jzazbz"}
BT2020 = colour.RGB_COLOURSPACES["ITU-R BT.2020"]
CONES = {
    "ictcp": colour.models.rgb.ictcp.MATRIX_ICTCP_RGB_TO_LMS @ BT2020.matrix_XYZ_to_RGB,
    "icacb": colour.models.icacb.MATRIX_ICACB_XYZ_TO_LMS,
    "jzazbz": colour.models.jzazbz.MATRIX_JZAZBZ_XYZ_TO_LMS @ [[1.15, 0, -0.15], [0.34, 0.66, 0], [0, 0, 1]],
}
# Coordinates without bounds, or of thousands, in the sets named: a relative tolerance there.
UNBOUNDED = {
    "negatives": {"xyy", "luv", "lab", "sucs", "igpgtg"},
    "out of locus": {"luv", "uvw-1964", "hunter-lab", "osa-ucs", "hunter-rdab"},
    "extremes": {"luv", "lab"},
    "lights": {"osa-ucs", "luv", "uvw-1964"},
}


def cases(name, kind, xyz):
    """The cases of a set that a space is defined for."""
    if name in ABSOLUTE:
        xyz = xyz * 10 ** np.random.default_rng(3).uniform(0, 4, (len(xyz), 1))
        xyz = xyz[(xyz @ CONES[name].T >= 0).all(axis=-1)]
    if name in ("osa-ucs",):
        # Its chroma is infinite for an effective luminance of 0.003 and 0 for 0.005.
        xyz = xyz[xyz[:, 1] > 0.01]
    return xyz


def with_white(name, values, white="D65"):
    """Arguments of a space's functions."""
    return [[name, v, white_xyz(white).tolist()] for v in np.asarray(values).tolist()]


def forward(all_sets):
    """One comparison a space over all its sets, and one of the sets where it has no bounds."""
    found = []
    for name, function, _, kinds in SPACES:
        for relative in [False, True]:
            chosen = [kind for kind in kinds if (name in UNBOUNDED[kind]) == relative]
            arguments, expected = [], []
            for kind, white in [(kind, white) for kind in chosen for white in ["D65", "A"]]:
                xyz = cases(name, kind, all_sets[kind])
                xyz = xyz if white == "D65" else xyz[:: 10 if len(xyz) > 100 else 1]
                arguments += with_white(name, xyz, white)
                expected += list(function(xyz, WHITES[white]))
            if chosen:
                subject = f"{name}: " + ", ".join(chosen) + (" (relative)" if relative else "")
                found.append(Comparison(subject, "space_from_xyz", arguments, expected, 1e-11, relative, FROZEN))
    for name, lab in [("lch-ab", colour.XYZ_to_Lab), ("lch-uv", colour.XYZ_to_Luv), ("oklch", colour.XYZ_to_Oklab)]:
        xyz = all_sets["lights"]
        # The hue of a nearly grey colour turns with the rounding of a and b.
        xyz = xyz[np.hypot(*np.asarray(lab(xyz))[:, 1:].T) > 1e-3]
        arguments, expected = with_white(name, xyz), list(lch(lab(xyz)))
        found.append(Comparison(f"{name}: lights", "space_from_xyz", arguments, expected, 1e-10, False, FROZEN))
    return found


def inverse(all_sets):
    """colour-science's inverse of its own coordinates; relative, for XYZ goes to thousands in the PQ spaces."""
    found = []
    for name, function, back, _ in SPACES:
        if back is None:
            continue
        xyz = cases(name, "lights", all_sets["lights"])[:: 4]
        values = np.asarray(function(xyz, WHITES["D65"]))
        arguments, expected = with_white(name, values), list(np.asarray(back(values.copy(), WHITES["D65"])))
        found.append(Comparison(f"{name}, inverse", "space_to_xyz", arguments, expected, 1e-11, True, FROZEN))
    # Yrg: colour-science inverts by the paper's other matrix, which is rounded to two digits.
    values = colour.models.XYZ_to_Yrg(all_sets["lights"][::4])
    arguments, expected = with_white("yrg", values), list(colour.models.Yrg_to_XYZ(values))
    found.append(Comparison("yrg, inverse", "space_to_xyz", arguments, expected, 2e-3, True, 0))
    # OSA-UCS: colour-science's own inverse stops at 1e-10 of luminance in per cent, so XYZ itself is the reference.
    xyz = cases("osa-ucs", "lights", all_sets["lights"])[::4]
    arguments = with_white("osa-ucs", colour.XYZ_to_OSA_UCS(100 * xyz))
    found.append(Comparison("osa-ucs, inverse", "space_to_xyz", arguments, list(xyz), 1e-10, True, FROZEN))
    return found


def round_trips(all_sets):
    found = []
    names = [name for name, *_ in SPACES] + ["lch-ab", "lch-uv", "oklch", "hdr-cielab", "hdr-ipt"]
    for name in names:
        kinds = [] if name in ("osa-ucs", "yrg", "uvw-1964") else ["out of locus"]
        negatives = name not in ("xyy", "hunter-lab", "hunter-rdab", "osa-ucs", "yrg", "prolab")
        # DIN99 ends at L* = -63 and less; u, v and their like pass through infinity.
        negatives = negatives and not name.startswith(("din99", "uv", "luv", "lch-uv"))
        arguments, expected = [], []
        for kind in ["lights", *kinds, *(["negatives"] if negatives else [])]:
            xyz = cases(name, kind, all_sets[kind]) if kind == "lights" else all_sets[kind]
            xyz = xyz * (100.0 if name in ABSOLUTE and kind != "lights" else 1.0)
            arguments += with_white(name, xyz)
            expected += list(xyz)
        subject = f"{name}, round trip"
        found.append(Comparison(subject, "space_round_trip", arguments, expected, 1e-10, name in ABSOLUTE, 0))
    return found


def hdr(all_sets):
    """In three conditions by both papers; lights whose cone responses are not negative."""
    xyz = all_sets["lights"][::10]
    xyz = xyz[(xyz @ colour.models.ipt.MATRIX_IPT_XYZ_TO_LMS.T >= 0).all(axis=-1)]
    white = white_xyz("D65").tolist()
    cielab, back, ipt = ([], []), ([], []), ([], [])
    for year in [2010, 2011]:
        for surround, luminance in [(0.2, 100.0), (0.0, 400.0), (0.4, 50.0)]:
            keywords = {"Y_s": surround, "Y_abs": luminance, "method": f"Fairchild {year}"}
            lab = colour.XYZ_to_hdr_CIELab(xyz, WHITES["D65"], **keywords)
            sides = [("cielab", xyz, lab, cielab), ("cielab", lab, xyz, back)]
            for name, values, expected, both in [*sides, ("ipt", xyz, hdr_ipt(xyz, keywords), ipt)]:
                both[0].extend(["hdr-" + name, year, surround, luminance, v, white] for v in values.tolist())
                both[1].extend(expected)
    return [
        Comparison("hdr-cielab, conditions", "hdr_space_from_xyz", *cielab, 1e-11, False, FROZEN),
        # What is left of the digits of lightness decides: 0.02 is added to one that may be 1e-10.
        Comparison("hdr-cielab, conditions, inverse", "hdr_space_to_xyz", *back, 1e-10, False, FROZEN),
        Comparison("hdr-ipt, conditions", "hdr_space_from_xyz", *ipt, 1e-10, False, FROZEN),
    ]


def hdr_ipt(xyz, keywords):
    """colour-science's hdr-IPT uses the maximum of hdr-CIELAB, 247, where the paper of 2011 has 246 for IPT."""
    if keywords["method"] == "Fairchild 2010":
        return colour.XYZ_to_hdr_IPT(xyz, **keywords)
    exponent = colour.models.hdr_ipt.exponent_hdr_IPT(**keywords)
    lms = xyz @ colour.models.ipt.MATRIX_IPT_XYZ_TO_LMS.T
    response = colour.colorimetry.lightness_Fairchild2011(lms, exponent, method="hdr-IPT")
    return response @ colour.models.ipt.MATRIX_IPT_LMS_P_TO_IPT.T


def din99_factors():
    """colour-science multiplies L99 by k_E; its inverse and DIN 6176 divide, and so do the expected values."""
    rng = np.random.default_rng(99)
    lab = np.column_stack([rng.uniform(0, 100, 1000), rng.uniform(-128, 128, (1000, 2))])
    there, back = ([], []), ([], [])
    for method in ["DIN99", "DIN99b", "DIN99c", "DIN99d"]:
        for k_e, k_ch in [(2.0, 0.5), (1.3, 0.8)]:
            lab_99 = colour.Lab_to_DIN99(lab, k_e, k_ch, method=method) / [k_e**2, 1, 1]
            for values, expected, both in [(lab, lab_99, there), (lab_99, lab, back)]:
                both[0].extend([method.lower(), k_e, k_ch, v] for v in values.tolist())
                both[1].extend(expected)
    return [
        Comparison("din99, parametric factors", "din99_from_lab", *there, 1e-11, False, FROZEN),
        Comparison("din99, parametric factors, inverse", "lab_from_din99", *back, 1e-10, False, FROZEN),
    ]


def scales():
    y = np.concatenate([[0, 1e-12, 216 / 24389, np.nextafter(216 / 24389, 1)], np.linspace(0, 1.2, 1201)])
    lightness = {
        "cie1976": lambda y: colour.colorimetry.lightness_CIE1976(100 * y, 100),
        "glasser1958": lambda y: colour.colorimetry.lightness_Glasser1958(100 * y),
        "wyszecki1963": lambda y: colour.colorimetry.lightness_Wyszecki1963(100 * y),
        "fairchild2010": colour.colorimetry.lightness_Fairchild2010,
        "fairchild2011": colour.colorimetry.lightness_Fairchild2011,
    }
    value = np.linspace(0, 10, 201)
    luminance = {
        "cie1976": (100 * y, lambda v: colour.colorimetry.luminance_CIE1976(v, 1)),
        "newhall1943": (value, lambda v: colour.colorimetry.luminance_Newhall1943(v) / 100),
        "astm-d1535": (value, lambda v: colour.colorimetry.luminance_ASTMD1535(v) / 100),
        "fairchild2010": (0.02 + 80 * y[y < 1.19], colour.colorimetry.luminance_Fairchild2010),
        "fairchild2011": (0.02 + 100 * y, colour.colorimetry.luminance_Fairchild2011),
    }
    found = [scale(f"lightness-{name}", y, function(y)) for name, function in lightness.items()]
    found += [scale(f"luminance-{name}", x, function(x)) for name, (x, function) in luminance.items()]
    # colour-science interpolates a table of Munsell values; its luminance of V is exact.
    found.append(scale("munsell-value-astm-d1535", colour.colorimetry.luminance_ASTMD1535(value) / 100, value))
    return found + abebe(y)


def scale(name, x, expected):
    arguments = [[name, v] for v in x.tolist()]
    return Comparison(name, "scale", arguments, list(np.asarray(expected, dtype=float)), 1e-11, False, FROZEN)


def abebe(y):
    found = []
    for method, name in [("Michaelis-Menten", "michaelis-menten"), ("Stevens", "stevens")]:
        there, back = ([], []), ([], [])
        for white in [50.0, 100.0, 1000.0]:
            value = colour.colorimetry.lightness_Abebe2017(y * white, white, method)
            inverse_value = colour.colorimetry.luminance_Abebe2017(value, white, method) / white
            for x, expected, both in [(y, value, there), (value, inverse_value, back)]:
                both[0].extend([name, v, white] for v in x.tolist())
                both[1].extend(expected)
        subject = f"lightness-abebe2017, {name}"
        found.append(Comparison(subject, "abebe2017", *there, 1e-11, False, FROZEN))
        found.append(Comparison(subject + ", inverse", "abebe2017_inverse", *back, 1e-11, False, FROZEN))
    return found


def chromaticities(all_sets):
    xyz = all_sets["lights"]
    uv_1976, uv_1960 = uvy_1976(xyz)[:, :2], uvy_1960(xyz)[:, :2]
    return [
        Comparison("xy of u'v' 1976", "xy_from_uv_1976", uv_1976.tolist(), list(colour.Luv_uv_to_xy(uv_1976)), 1e-12),
        Comparison("xy of uv 1960", "xy_from_uv_1960", uv_1960.tolist(), list(colour.UCS_uv_to_xy(uv_1960)), 1e-12),
    ]


def comparisons():
    with np.errstate(all="ignore"):
        all_sets = sets()
        parts = [forward(all_sets), inverse(all_sets), round_trips(all_sets), hdr(all_sets), din99_factors(), scales()]
        return [comparison for part in parts for comparison in part] + chromaticities(all_sets)
