"""RGB matrices and the sRGB transfer function."""

import numpy as np

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
TRANSFER = sorted(
    [float(x) for x in np.linspace(-0.1, 16.0, 1611)]
    + [np.nextafter(x, x + s) for x in (0.0031308, 0.04045) for s in (-1.0, 0.0, 1.0)]
)


def request():
    return {
        "transfer": [float(x) for x in TRANSFER],
    }


def check(values):
    return matrices(values) + transfer(values)


def matrices(values):
    derived = stored = 0.0
    for space in values["spaces"]:
        reference = colour.RGB_COLOURSPACES[SPACES[space["name"]]]
        stored = max(stored, oracle.largest_absolute(space["primaries"], reference.primaries))
        stored = max(stored, oracle.largest_absolute(space["white"], reference.whitepoint))
        matrix = colour.normalised_primary_matrix(reference.primaries, reference.whitepoint)
        derived = max(derived, oracle.largest_absolute(space["xyz_from_rgb"], matrix))
        derived = max(derived, oracle.largest_absolute(space["rgb_from_xyz"], np.linalg.inv(matrix)))
    missing = len(set(SPACES) ^ {space["name"] for space in values["spaces"]})
    return [
        oracle.row("RGB primaries and whites", 8 * len(SPACES), stored + missing, 0),
        oracle.row("RGB matrices derived from them, both ways", 18 * len(SPACES), derived, 1e-13),
    ]


def transfer(values):
    encoded = oracle.largest_absolute(values["encoded"], colour.models.eotf_inverse_sRGB(np.asarray(TRANSFER)))
    # Decoding 16 gives 670: relative above 1. colour switches at 12.92 times 0.0031308, IEC 61966-2-1 and we at 0.04045.
    expected = colour.models.eotf_sRGB(np.asarray(TRANSFER))
    differs = (np.asarray(TRANSFER) > 12.92 * 0.0031308) & (np.asarray(TRANSFER) <= 0.04045)
    expected = np.where(differs, np.asarray(TRANSFER) / 12.92, expected)
    decoded = float((np.abs(values["decoded"] - expected) / np.maximum(1.0, np.abs(expected))).max())
    return [
        oracle.row("sRGB encoding v. colour.eotf_inverse_sRGB", len(TRANSFER), encoded, 1e-12),
        oracle.row("sRGB decoding v. colour.eotf_sRGB", len(TRANSFER), decoded, 1e-12),
    ]
