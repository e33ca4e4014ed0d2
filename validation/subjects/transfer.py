"""Transfer functions."""

import colour
import numpy as np
from comparison import Comparison


def comparisons():
    at = [float(x) for x in np.linspace(-0.1, 16.0, 1611)]
    return [Comparison("sRGB encoding", "srgb_encode", at, list(colour.models.eotf_inverse_sRGB(np.asarray(at))), 1e-12)]
