#!/usr/bin/env python3
"""Renders a scene with Mitsuba 3: for `abbe bench --against`. Writes linear sRGB as 32-bit EXR."""

import argparse


def arguments():
    parser = argparse.ArgumentParser(description="Renders a scene with Mitsuba 3.")
    parser.add_argument("scene", help="XML file, such as `abbe scene export --format mitsuba` writes")
    parser.add_argument("--out", required=True, help="EXR to write")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int, help="all processors by default")
    parser.add_argument("--variant", default="llvm_ad_spectral", help="scalar_spectral needs no LLVM")
    return parser.parse_args()


def main():
    wanted = arguments()
    import mitsuba as mi

    mi.set_variant(wanted.variant)
    if wanted.threads:
        import drjit as dr

        dr.set_thread_count(wanted.threads)
    scene = mi.load_file(wanted.scene, spp=wanted.spp, seed=wanted.seed)
    # The scene needs no gradients: nothing is recorded for them.
    image = mi.render(scene, spp=wanted.spp, seed=wanted.seed)
    mi.Bitmap(image).write(wanted.out)


if __name__ == "__main__":
    main()
