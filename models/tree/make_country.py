"""Makes country.obj: hills around the meadow of make_terrain.py, out to a kilometre, for scenes that look that far.

Rings, each farther from the last than that from the one before, the first of them the corners of the meadow's edge: they
turn from its square into circles, and from 60 m on they rise to hills of up to 85 m, with woods, whose crowns are part of
the ground's shape, on some of them. Vertex colours are in sRGB. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE))

from make_terrain import HALF_SIZE, SQUARES, ground_colour, height  # noqa: E402
from meshes import on_surface, ticks  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import mix, noise, scale, smoothstep  # noqa: E402

FARTHEST = 1000.0  # m
RINGS = 50


def layers(x, z, size, seed, octaves):
    total, weight = 0.0, 1.0
    for octave in range(octaves):
        total += weight * noise((x / size + 7.3 * octave, 0.5, z / size), seed + octave)
        size, weight = size / 2.1, weight / 2
    return total


def woods(x, z):
    """How far a place is inside a wood, 0..1."""
    far = smoothstep(45, 130, math.hypot(x, z))
    return far * smoothstep(0.18, 0.34, layers(x, z, 150, 50, 4))


def ground(x, z):
    reach = math.hypot(x, z)
    hills = 0.5 + 0.5 * layers(x, z, 330, 31, 3)
    swells = layers(x, z, 60, 41, 3)
    rise = smoothstep(60, 700, reach)
    return height(x, z) + 1.2 * smoothstep(17, 60, reach) * swells + 85 * rise * hills - 14 * smoothstep(25, 160, reach)


def crowns(x, z):
    wood = woods(x, z)
    return wood * (9 + 3.5 * noise((x / 5.0, 0.5, z / 5.0), 61) + 2 * noise((x / 11.0, 0.5, z / 11.0), 62))


def surface(x, z):
    return ground(x, z) + crowns(x, z)


def colour(x, z):
    reach = math.hypot(x, z)
    near = ground_colour(x, z)
    # Fields of several greens and a stubble, with soft borders.
    field = noise((x / 48, 3.5, z / 75), 71) + 0.35 * noise((x / 17, 3.5, z / 17), 72)
    far = mix((0.27, 0.38, 0.15), (0.44, 0.50, 0.22), smoothstep(-0.7, 0.7, field))
    far = mix(far, (0.60, 0.53, 0.30), 0.8 * smoothstep(0.35, 0.6, noise((x / 95, 5.5, z / 70), 73)))
    base = mix(near, far, smoothstep(14, 60, reach))
    tree = mix((0.13, 0.20, 0.09), (0.29, 0.28, 0.10), smoothstep(-0.5, 0.9, noise((x / 7, 1.5, z / 7), 74)))
    tree = scale(tree, 1 + 0.25 * noise((x / 4, 2.5, z / 4), 75))
    return mix(base, tree, smoothstep(0.05, 0.5, woods(x, z)))


def edge():
    """The corners of the meadow's edge, anticlockwise as seen from above, from its corner at -x, -z on."""
    steps = ticks(HALF_SIZE, SQUARES)[:-1]
    return ([(-HALF_SIZE, s) for s in steps] + [(s, HALF_SIZE) for s in steps] +
            [(HALF_SIZE, -s) for s in steps] + [(-s, -HALF_SIZE) for s in steps])


def write_mesh():
    obj = ObjWriter(["Hills around the meadow, by make_country.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("country")
    uv = obj.uv(0, 0)
    rings = []
    for ring in range(RINGS + 1):
        grown = (FARTHEST / HALF_SIZE) ** (ring / RINGS)
        row = []
        for x, z in edge():
            round_ = smoothstep(0, 0.4, ring / RINGS)
            factor = grown * ((1 - round_) + round_ * HALF_SIZE / math.hypot(x, z))
            x, z = x * factor, z * factor
            row.append(obj.add_vertex(*on_surface(surface, x, z, 0.05 * grown), colour(x, z)))
        rings.append(row)
    obj.join(rings, uv, closed=True, flip=True)
    obj.save(HERE / "country.obj")


if __name__ == "__main__":
    write_mesh()
