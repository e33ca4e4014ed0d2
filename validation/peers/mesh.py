#!/usr/bin/env python3
"""Writes the mesh of scenes/mesh.json: `python3 validation/peers/mesh.py FILE.ply`.

An icosahedron, each of its faces split into four seven times (20 · 4⁷ = 327,680 triangles), pushed out onto a sphere of
radius 1 and wrinkled along its normals. Plain Python: the same bytes wherever sin is correctly rounded, and no copy of
the data in the repository.
"""

import math
import struct
import sys
from array import array
from pathlib import Path

SPLITS = 7


def icosahedron():
    golden = (1 + math.sqrt(5)) / 2
    vertices = []
    for a in (-1.0, 1.0):
        for b in (-golden, golden):
            vertices += [(0.0, a, b), (a, b, 0.0), (b, 0.0, a)]
    edge = 4.0 + 1e-9
    near = lambda i, j: sum((p - q) ** 2 for p, q in zip(vertices[i], vertices[j])) < edge
    triangles = [
        (i, j, k)
        for i in range(12)
        for j in range(i + 1, 12)
        for k in range(j + 1, 12)
        if near(i, j) and near(j, k) and near(i, k)
    ]
    return [unit(v) for v in vertices], [outward(vertices, t) for t in triangles]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def outward(vertices, triangle):
    """The triangle, counter-clockwise from outside."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (vertices[i] for i in triangle)
    volume = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return triangle if volume > 0 else triangle[::-1]


def split(vertices, triangles):
    """Each triangle in four; new vertices on the sphere."""
    middles = {}

    def middle(i, j):
        key = (i, j) if i < j else (j, i)
        if key not in middles:
            middles[key] = len(vertices)
            vertices.append(unit(tuple(p + q for p, q in zip(vertices[i], vertices[j]))))
        return middles[key]

    parts = []
    for i, j, k in triangles:
        ij, jk, ki = middle(i, j), middle(j, k), middle(k, i)
        parts += [(i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki)]
    return parts


def radius(x, y, z):
    """Folds of three sizes, each bent by the one before."""
    a = math.sin(4 * x + 3 * math.sin(3 * y)) * math.sin(5 * z + 1)
    b = math.sin(17 * y + 4 * a) * math.sin(15 * x - 13 * z)
    c = math.sin(61 * (x + z) + 5 * b) * math.sin(67 * y + 3 * a)
    return 1 + 0.09 * a + 0.035 * (1 - abs(b)) + 0.006 * c


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[0])
    vertices, triangles = icosahedron()
    for _ in range(SPLITS):
        triangles = split(vertices, triangles)
    positions = array("f")
    for v in vertices:
        positions.extend(radius(*v) * x for x in v)
    if sys.byteorder == "big":
        positions.byteswap()
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    path = Path(sys.argv[1])
    path.parent.mkdir(parents=True, exist_ok=True)
    faces = b"".join(struct.pack("<Biii", 3, *t) for t in triangles)
    path.write_bytes(header.encode() + positions.tobytes() + faces)


if __name__ == "__main__":
    main()
