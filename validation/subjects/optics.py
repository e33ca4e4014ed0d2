"""Snell's law and Fresnel's equations at one boundary."""

import colour
import numpy as np
from comparison import Comparison

# Angles from 0 to just short of grazing, in degrees.
ANGLES = np.concatenate([np.linspace(0.0, 89.9, 200), [1e-6, 41.0, 56.3099324740202, 89.9999]])
INDICES = [(1.0, 1.5), (1.5, 1.0), (1.0, 2.42), (2.42, 1.33), (1.0003, 1.0), (1.0, 4.0)]
METALS = [(0.2, 3.5), (1.5, 7.6), (2.9, 3.1), (0.05, 4.2)]


def comparisons():
    arguments, expected = [], []
    for n_1, n_2 in INDICES:
        for angle in ANGLES:
            sine = n_1 / n_2 * np.sin(np.radians(angle))
            # colour-science gives complex amplitudes beyond the critical angle; there everything is reflected.
            if sine < 1.0:
                inner = colour.phenomena.snell_law(n_1, n_2, angle)
                reflected = colour.phenomena.polarised_light_reflection_coefficient(n_1, n_2, angle, inner)
                expected.append([float(np.mean(np.real(reflected))), float(np.cos(np.radians(inner)))])
            else:
                expected.append([1.0, 0.0])
            arguments.append([float(np.cos(np.radians(angle))), n_1, n_2])
    metal_arguments, metal_expected = [], []
    for n, k in METALS:
        for angle in ANGLES:
            # colour-science takes no complex angles: the textbook's amplitudes, in complex arithmetic.
            m, cosine, sine = n + 1j * k, np.cos(np.radians(angle)), np.sin(np.radians(angle))
            root = np.sqrt(m * m - sine * sine)
            r_s = (cosine - root) / (cosine + root)
            r_p = (m * m * cosine - root) / (m * m * cosine + root)
            metal_arguments.append([float(np.cos(np.radians(angle))), 1.0, n, k])
            metal_expected.append(float((abs(r_s) ** 2 + abs(r_p) ** 2) / 2))
    metals = "reflectance of metals v. complex arithmetic"
    return [
        Comparison("refraction: reflectance and cosine v. colour.phenomena", "refract", arguments, expected, 1e-12),
        Comparison(metals, "conductor_reflectance", metal_arguments, metal_expected, 1e-12),
    ]

