"""Makes birdbath.obj: a weathered stone bird bath, 0.93 m tall, and the boulders at its foot, for leaves to settle on.

Every object is a closed shell, and shells overlap as a mason would set them: the plinth's two slabs, the fluted
column, the bowl with its scalloped rim, boulders half in the ground. So it also shows that distance fields take
overlapping shells for the one solid that they look like.

Column and bowl are turned on a lathe: a profile of (radius, height), made smooth by a Catmull-Rom spline, about the
y axis; flutes and scallops modulate the radius. Boulders are spheres pushed about by noise.

Data: metres, Y up, the ground at y = 0. Vertex colours: stone, lichen and moss in sRGB. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import lathe, sphere  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import add, length, mix, noise, normalize, scale, smooth, smoothstep, sub  # noqa: E402

SIDES = 64
STONE, DARK = (0.60, 0.57, 0.51), (0.40, 0.38, 0.35)
LICHEN, MOSS = (0.70, 0.66, 0.42), (0.33, 0.39, 0.17)

# From the axis at the bottom to the axis at the top; anticlockwise seen from outside once turned.
COLUMN = [(0.0, 0.10), (0.17, 0.10), (0.185, 0.12), (0.18, 0.145), (0.15, 0.16), (0.125, 0.18), (0.105, 0.215),
          (0.092, 0.27), (0.088, 0.36), (0.09, 0.45), (0.098, 0.52), (0.112, 0.555), (0.128, 0.575),
          (0.128, 0.60), (0.11, 0.62), (0.0, 0.62)]
BOWL = [(0.0, 0.59), (0.10, 0.60), (0.17, 0.62), (0.27, 0.662), (0.36, 0.715), (0.42, 0.77), (0.45, 0.82),
        (0.462, 0.86), (0.458, 0.885), (0.44, 0.893), (0.422, 0.882), (0.405, 0.85), (0.37, 0.80), (0.31, 0.757),
        (0.22, 0.725), (0.12, 0.71), (0.0, 0.706)]
SLABS = [((-0.27, -0.05, -0.27), (0.27, 0.06, 0.27)), ((-0.215, 0.04, -0.215), (0.215, 0.115, 0.215))]
# middle, radii, seed
BOULDERS = [((0.62, 0.05, 0.38), (0.21, 0.15, 0.17), 3), ((0.40, 0.02, 0.56), (0.12, 0.09, 0.13), 5),
            ((-0.66, 0.04, 0.20), (0.17, 0.13, 0.20), 8), ((-0.47, 0.01, 0.49), (0.10, 0.08, 0.09), 13),
            ((0.10, 0.01, -0.62), (0.19, 0.14, 0.15), 21)]


def flutes(angle, radius, y):
    shaft = smoothstep(0.19, 0.25, y) * (1 - smoothstep(0.49, 0.54, y))
    return radius * (1 - 0.055 * shaft * (1 - abs(math.cos(8 * angle))))


def scallops(angle, radius, y):
    return radius * (1 + 0.022 * smoothstep(0.66, 0.88, y) * smoothstep(0.25, 0.44, radius) * math.cos(16 * angle))


def slab(low, high, cuts=5, bevel=0.012):
    """A box as a deformed sphere of cuts x cuts squares a face, its edges worn round."""
    positions, index, triangles = [], {}, []

    def vertex(p):
        if p not in index:
            index[p] = len(positions)
            q = tuple(l + (h - l) * c / cuts for l, h, c in zip(low, high, p))
            inner = tuple(min(max(c, l + bevel), h - bevel) for c, l, h in zip(q, low, high))
            way = sub(q, inner)
            positions.append(add(inner, scale(normalize(way), bevel)) if length(way) > 0 else q)
        return index[p]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, cuts):
            for i in range(cuts):
                for j in range(cuts):
                    corners = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0, 0, 0]
                        p[axis], p[u], p[v] = end, i + di, j + dj
                        corners.append(vertex(tuple(p)))
                    if end == 0:
                        corners.reverse()
                    a, b, c, d = corners
                    triangles += [(a, b, c), (a, c, d)]
    return positions, triangles


def boulder(middle, radii, seed):
    directions, triangles = sphere(20, 12)
    positions = []
    for n in directions:
        push = 1 + 0.28 * noise(scale(n, 1.5), seed) + 0.08 * noise(scale(n, 4), seed + 1)
        positions.append(add(middle, tuple(c * r * push for c, r in zip(n, radii))))
    return positions, triangles


def colour(p, n):
    """Stone with darker veins; lichen in spots; moss where it is damp: low, and on what looks up in the shade."""
    stone = mix(STONE, DARK, 0.5 + 0.5 * noise(scale(p, 9), 1))
    stone = mix(stone, STONE, 0.35 + 0.35 * noise(scale(p, 31), 2))
    stone = mix(stone, LICHEN, 0.55 * smoothstep(0.35, 0.6, noise(scale(p, 14), 4)))
    damp = 0.75 * (1 - smoothstep(0.0, 0.28, p[1])) + 0.45 * max(n[1], 0.0) * (1 - smoothstep(0.5, 0.9, p[1]))
    return mix(stone, MOSS, smoothstep(0.35, 0.75, damp + 0.35 * noise(scale(p, 11), 6)))


def main():
    writer = ObjWriter(["A stone bird bath with boulders, by make_birdbath.py. Metres, Y up, sRGB vertex colours."])
    meshes = [("slab %d" % (k + 1), slab(*corners)) for k, corners in enumerate(SLABS)]
    meshes += [("column", lathe(smooth(COLUMN, 2), SIDES, flutes)), ("bowl", lathe(smooth(BOWL, 2), SIDES, scallops))]
    meshes += [("boulder %d" % (k + 1), boulder(*place)) for k, place in enumerate(BOULDERS)]
    for name, (positions, triangles) in meshes:
        writer.begin_object(name)
        writer.add_mesh(positions, triangles, colour)
    writer.save(HERE / "birdbath.obj")


if __name__ == "__main__":
    main()
