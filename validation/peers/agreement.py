#!/usr/bin/env python3
"""How far the pictures of two renderers are apart, by means over blocks: JSON on stdout.

Takes independent runs of each, so that the noise of every block's difference is known.
"""

import argparse
import json

import mitsuba
import numpy

mitsuba.set_variant("scalar_rgb")

# Linear sRGB to XYZ (IEC 61966-2-1).
XYZ_FROM_RGB = numpy.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
# Blocks darker than this share of the picture's mean are judged by that instead of by themselves.
DARK = 0.05


def read(path):
    bitmap = mitsuba.Bitmap(path)
    names = [field.name.upper() for field in bitmap.struct_()]
    pixels = numpy.array(bitmap, dtype=float)
    if {"X", "Y", "Z"} <= set(names):
        return pixels[..., [names.index(c) for c in "XYZ"]]
    return pixels[..., [names.index(c) for c in "RGB"]] @ XYZ_FROM_RGB.T


def block_means(path, blocks):
    pixels = read(path)
    height, width, channels = pixels.shape
    if height % blocks or width % blocks:
        raise SystemExit(f"{path}: {width}x{height} pixels; expected multiples of {blocks}")
    return pixels.reshape(blocks, height // blocks, blocks, width // blocks, channels).mean(axis=(1, 3))


def main():
    parser = argparse.ArgumentParser(description="Compares block means.")
    parser.add_argument("--blocks", type=int, default=4, help="blocks along each side")
    parser.add_argument("--reference", nargs="+", required=True, help="runs of the one")
    parser.add_argument("--test", nargs="+", required=True, help="runs of the other")
    parser.add_argument("--scale", type=float, default=1.0, help="factor of the other's pictures")
    wanted = parser.parse_args()
    runs = [
        numpy.array([block_means(path, wanted.blocks) for path in paths]) for paths in (wanted.reference, wanted.test)
    ]
    runs[1] *= wanted.scale
    reference, test = (run.mean(axis=0) for run in runs)
    variance = sum(run.var(axis=0, ddof=1) / len(run) for run in runs)
    whole = reference.mean(axis=(0, 1))
    scale = numpy.maximum(reference, DARK * whole)
    difference, error = (test - reference) / scale, numpy.sqrt(variance) / scale
    worst = numpy.unravel_index(numpy.abs(difference).argmax(), difference.shape)
    report = {
        "blocks": wanted.blocks,
        "worst": difference[worst],
        "worst_standard_error": error[worst],
        "worst_block": [int(i) for i in worst[:2]],
        "worst_channel": "XYZ"[worst[2]],
        "rms_standard_error": float(numpy.sqrt((error**2).mean())),
        "mean": list(test.mean(axis=(0, 1)) / whole - 1),
    }
    print(json.dumps(report))


if __name__ == "__main__":
    main()
