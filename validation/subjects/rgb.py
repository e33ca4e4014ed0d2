"""RGB spaces: primaries, matrices derived and published, conversions."""

import colour
import numpy as np
from comparison import Comparison, row

# Our name -> colour-science's.
SPACES = {
    "srgb": "sRGB",
    "rec709": "ITU-R BT.709",
    "rec2020": "ITU-R BT.2020",
    "display-p3": "Display P3",
    "p3-d65": "P3-D65",
    "dci-p3": "DCI-P3",
    "dci-p3-plus": "DCI-P3-P",
    "adobe-rgb": "Adobe RGB (1998)",
    "adobe-wide-gamut-rgb": "Adobe Wide Gamut RGB",
    "prophoto-rgb": "ProPhoto RGB",
    "rimm-rgb": "RIMM RGB",
    "erimm-rgb": "ERIMM RGB",
    "aces2065-1": "ACES2065-1",
    "acescg": "ACEScg",
    "acescc": "ACEScc",
    "acescct": "ACEScct",
    "acesproxy": "ACESproxy",
    "arri-wide-gamut-3": "ARRI Wide Gamut 3",
    "arri-wide-gamut-4": "ARRI Wide Gamut 4",
    "s-gamut": "S-Gamut",
    "s-gamut3": "S-Gamut3",
    "s-gamut3-cine": "S-Gamut3.Cine",
    "venice-s-gamut3": "Venice S-Gamut3",
    "venice-s-gamut3-cine": "Venice S-Gamut3.Cine",
    "v-gamut": "V-Gamut",
    "red-wide-gamut-rgb": "REDWideGamutRGB",
    "red-color": "REDcolor",
    "red-color2": "REDcolor2",
    "red-color3": "REDcolor3",
    "red-color4": "REDcolor4",
    "dragon-color": "DRAGONcolor",
    "dragon-color2": "DRAGONcolor2",
    "cinema-gamut": "Cinema Gamut",
    "f-gamut": "F-Gamut",
    "f-gamut-c": "F-Gamut C",
    "n-gamut": "N-Gamut",
    "d-gamut": "DJI D-Gamut",
    "protune-native": "Protune Native",
    "davinci-wide-gamut": "DaVinci Wide Gamut",
    "blackmagic-wide-gamut": "Blackmagic Wide Gamut",
    "filmlight-e-gamut": "FilmLight E-Gamut",
    "filmlight-e-gamut-2": "FilmLight E-Gamut 2",
    "rec470-525": "ITU-R BT.470 - 525",
    "rec470-625": "ITU-R BT.470 - 625",
    "smpte-c": "SMPTE C",
    "smpte-240m": "SMPTE 240M",
    "ebu-3213": "EBU Tech. 3213-E",
    "plasa-e1.54": "PLASA ANSI E1.54",
    "h273-film": "ITU-T H.273 - Generic Film",
    "h273-22": "ITU-T H.273 - 22 Unspecified",
    "dcdm-xyz": "DCDM XYZ",
    "cie-rgb": "CIE RGB",
    "apple-rgb": "Apple RGB",
    "best-rgb": "Best RGB",
    "beta-rgb": "Beta RGB",
    "colormatch-rgb": "ColorMatch RGB",
    "don-rgb-4": "Don RGB 4",
    "eci-rgb-v2": "ECI RGB v2",
    "ekta-space-ps5": "Ekta Space PS 5",
    "max-rgb": "Max RGB",
    "russell-rgb": "Russell RGB",
    "sharp-rgb": "Sharp RGB",
    "xtreme-rgb": "Xtreme RGB",
}
# Primaries and white of a space with another transfer function.
PARTS = {
    "rec2100-pq": "ITU-R BT.2020",
    "rec2100-hlg": "ITU-R BT.2020",
    "rec601-525": "SMPTE C",
    "rec601-625": "Pal/Secam",
}
OTHER_NAMES = {"a98-rgb": "Adobe RGB (1998)", "romm-rgb": "ROMM RGB", "ntsc-1953": "NTSC (1953)"}
PUBLISHED = [
    "srgb", "adobe-rgb", "prophoto-rgb", "aces2065-1", "arri-wide-gamut-3", "s-gamut3", "s-gamut3-cine", "v-gamut",
    "red-wide-gamut-rgb", "d-gamut", "filmlight-e-gamut-2",
]
CONVERSIONS = ["Bradford", "CAT02", "CAT16", "XYZ Scaling"]
RANDOM = np.random.default_rng(709)


def space(theirs):
    return colour.RGB_COLOURSPACES[theirs]


def derived(theirs):
    """A copy with matrices from primaries and white, as ours are."""
    copy = space(theirs).copy()
    copy.use_derived_transformation_matrices(True)
    return copy


def comparisons():
    everything = {**SPACES, **PARTS, **OTHER_NAMES}
    names, theirs = list(everything), [space(name) for name in everything.values()]
    matrices = [colour.normalised_primary_matrix(s.primaries, s.whitepoint) for s in theirs]
    published = [name + "-published" for name in PUBLISHED]
    stored = [space(SPACES[name]) for name in PUBLISHED]
    return [
        Comparison("RGB primaries and whites", "rgb_primaries_and_white", names, [np.vstack([s.primaries, s.whitepoint]) for s in theirs], 0.0, frozen_cases=len(names)),
        Comparison("XYZ from RGB, derived", "xyz_from_rgb_matrix", names, matrices, 1e-13),
        Comparison("RGB from XYZ, derived", "rgb_from_xyz_matrix", names, [np.linalg.inv(m) for m in matrices], 1e-13),
        Comparison("XYZ from RGB, published", "xyz_from_rgb_matrix", published, [s.matrix_RGB_to_XYZ for s in stored], 0.0),
        # Two makers print one direction: ours and numpy's inverse differ by rounding.
        Comparison("RGB from XYZ, published", "rgb_from_xyz_matrix", published, [s.matrix_XYZ_to_RGB for s in stored], 1e-15),
        *conversions(),
        *colors(),
    ]


def conversions():
    arguments, expected = [], []
    keys = list(SPACES)
    for _ in range(400):
        source, target = RANDOM.choice(keys, 2)
        adaptation = RANDOM.choice([*CONVERSIONS, None])
        name = adaptation.lower().replace(" ", "-") if adaptation else None
        arguments.append([str(source), str(target), name])
        expected.append(colour.matrix_RGB_to_RGB(derived(SPACES[source]), derived(SPACES[target]), adaptation))
    return [Comparison("linear RGB from linear RGB, with and without adaptation, relative", "rgb_from_rgb_matrix", arguments, expected, 1e-12, True)]


def colors():
    encode, decode, luminance = ([], []), ([], []), ([], [])
    for ours, theirs in SPACES.items():
        reference = derived(theirs)
        for rgb in [np.ones(3), np.full(3, 0.18), *RANDOM.uniform(0.02, 1.0, (20, 3))]:
            xyz = colour.RGB_to_XYZ(rgb, reference, chromatic_adaptation_transform=None)
            encode[0].append([ours, [float(v) for v in xyz]])
            encode[1].append(colour.XYZ_to_RGB(xyz, reference, chromatic_adaptation_transform=None, apply_cctf_encoding=True))
            # Codes that the curve has: those of these colours.
            code = encode[1][-1]
            decode[0].append([ours, [float(v) for v in code]])
            decode[1].append(colour.RGB_to_XYZ(code, reference, chromatic_adaptation_transform=None, apply_cctf_decoding=True))
            luminance[0].append([ours, [float(v) for v in rgb]])
            luminance[1].append(float(colour.RGB_luminance(rgb, reference.primaries, reference.whitepoint)))
    return [
        Comparison("encoded RGB from XYZ", "encoded_from_xyz", *encode, 1e-12),
        Comparison("XYZ from encoded RGB, relative", "xyz_from_encoded", *decode, 1e-12, True),
        Comparison("luminance of RGB", "rgb_luminance", *luminance, 1e-13),
    ]


def checks(evaluate):
    names, published = evaluate("rgb_names", [None])[0], evaluate("rgb_published_names", [None])[0]
    wrong = len(set(names) ^ {*SPACES, *PARTS}) + len(set(published) ^ {name + "-published" for name in PUBLISHED})
    # Every space of colour-science is one of ours: by primaries and white.
    known = [(space(t).primaries, space(t).whitepoint) for t in SPACES.values()]
    missing = [
        name
        for name, s in colour.RGB_COLOURSPACES.items()
        if not any(np.array_equal(s.primaries, p) and np.array_equal(s.whitepoint, w) for p, w in known)
    ]
    return [
        row("RGB spaces without a comparison", len(names) + len(published), wrong, 0),
        row("primaries and whites of colour-science that are not here", len(colour.RGB_COLOURSPACES), len(missing), 0),
    ]
