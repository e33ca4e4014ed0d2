#!/usr/bin/env python3
"""Renders an abbe scene with raysect: for `abbe bench --against`. Writes CIE XYZ as 32-bit EXR.

Reads the part of the scene format that both renderers have: a pinhole camera, spheres and quads, constant reflectances,
Sellmeier glasses, constant emission of spheres. Everything else is refused.
"""

import argparse
import json
import math
import sys

# Bands that the range is split into, each with rays and an index of its own: raysect's way of rendering dispersion.
BANDS = 16
RANGE_NM = (375.0, 785.0)  # of raysect's colour matching functions


def arguments():
    parser = argparse.ArgumentParser(description="Renders an abbe scene with raysect.")
    parser.add_argument("scene", help="abbe scene file")
    parser.add_argument("--out", required=True, help="EXR to write")
    parser.add_argument("--spp", type=int, default=16, help="samples per pixel of each band")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--bands", type=int, default=BANDS)
    return parser.parse_args()


def refuse(what):
    sys.exit(f"render_raysect.py: {what} is not translated")


def only(table, *keys):
    """The values of these keys, and no others in the table."""
    for key in table:
        if key not in keys and key not in ("comment", "name"):
            refuse(f"{key!r}")
    return [table.get(key) for key in keys]


def material(description, emission):
    from raysect.optical import ConstantSF
    from raysect.optical.material import AbsorbingSurface, Dielectric, Lambert, Sellmeier, UniformSurfaceEmitter

    kind, reflectance, ior = only(description, "type", "reflectance", "ior")
    if emission is not None:
        if kind != "diffuse" or reflectance != 0 or not isinstance(emission, (int, float)):
            refuse("a lamp that reflects, or whose spectrum is not constant,")
        return UniformSurfaceEmitter(ConstantSF(1.0), emission)
    if kind == "diffuse" and isinstance(reflectance, (int, float)):
        return Lambert(ConstantSF(reflectance)) if reflectance else AbsorbingSurface()
    if kind == "dielectric":
        (terms,) = only(ior, "sellmeier")
        (b, c) = only(terms, "b", "c_um2")
        b, c = ([*v, 0.0, 0.0, 0.0][:3] for v in (b, c))
        # Sampled finely enough that a band's mean index is exact.
        return Dielectric(Sellmeier(*b, *c, sample_resolution=1), ConstantSF(1.0))
    return refuse(f"the material {description}")


def shape(description, surface, world):
    from raysect.core import translate
    from raysect.primitive import Mesh, Sphere

    if description["type"] == "sphere":
        _, center, radius = only(description, "type", "center", "radius")
        return Sphere(radius, parent=world, transform=translate(*center), material=surface)
    if description["type"] == "quad":
        _, origin, u, v = only(description, "type", "origin", "u", "v")
        corner = lambda a, b: [o + a * p + b * q for o, p, q in zip(origin, u, v)]
        corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
        return Mesh(corners, [[0, 1, 2], [0, 2, 3]], closed=False, parent=world, material=surface)
    return refuse(f"the shape {description['type']!r}")


def camera(scene, world, wanted):
    from raysect.core import Point3D, SerialEngine, rotate_basis, translate
    from raysect.optical.observer import FullFrameSampler2D, PinholeCamera, RGBPipeline2D

    kind, start, end, up, fov = only(scene["camera"], "type", "from", "to", "up", "fov_degrees")
    width, height, film_filter = only(scene["film"], "width", "height", "filter")
    if kind != "perspective" or up or width != height or film_filter != {"type": "box"}:
        refuse("a camera other than a square pinhole with a box filter")
    start, end = Point3D(*start), Point3D(*end)
    forward = start.vector_to(end)
    from raysect.core import Vector3D

    pipeline = RGBPipeline2D(display_progress=False)
    observer = PinholeCamera(
        (width, height),
        fov=fov,
        parent=world,
        transform=translate(start.x, start.y, start.z) * rotate_basis(forward, Vector3D(0, 1, 0)),
        pipelines=[pipeline],
        frame_sampler=FullFrameSampler2D(),
    )
    observer.quiet = True
    # One process: no CPU time goes into passing pixels about, and the seed decides all.
    observer.render_engine = SerialEngine()
    observer.pixel_samples = wanted.spp
    observer.min_wavelength, observer.max_wavelength = RANGE_NM
    observer.spectral_bins = observer.spectral_rays = wanted.bands
    observer.ray_max_depth = scene["render"]["max_depth"] + 1
    return observer, pipeline


def flat(pipeline, scene):
    """XYZ by rows. Pixels of raysect's pinhole weigh rays by the cosine to its axis, as a flat sensor would."""
    import numpy

    mean = numpy.asarray(pipeline.xyz_frame.mean).transpose(1, 0, 2)
    height, width, _ = mean.shape
    half = math.tan(math.radians(0.5 * scene["camera"]["fov_degrees"]))
    # Four by four points of each pixel: enough for what is all but linear within it.
    fine = (numpy.arange(4 * width) + 0.5) / (2 * width) - 1
    x, y = numpy.meshgrid(fine * half, fine * half)
    cos = (1 / numpy.sqrt(1 + x * x + y * y)).reshape(height, 4, width, 4).mean(axis=(1, 3))
    return (mean / cos[..., None]).astype(numpy.float32)


def main():
    wanted = arguments()
    with open(wanted.scene, encoding="utf-8") as file:
        scene = json.load(file)
    from raysect.core.math.random import seed
    from raysect.optical import World

    world = World()
    for entry in scene["objects"]:
        form, name, emission = only(entry, "shape", "material", "emission")
        shape(form, material(scene["materials"][name], emission), world)
    if "environment" in scene or "lights" in scene:
        refuse("light from elsewhere than spheres")
    observer, pipeline = camera(scene, world, wanted)
    seed(wanted.seed)
    observer.observe()
    picture = flat(pipeline, scene)
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    mitsuba.Bitmap(picture, mitsuba.Bitmap.PixelFormat.XYZ).write(wanted.out)


if __name__ == "__main__":
    main()
