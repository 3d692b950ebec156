"""Makes gorge.obj and pool.obj: a rocky gorge whose head drops in three steps, and the still water at its foot.

gorge.obj is a height field, for the particles of latta.scene.json to fall down and bounce off: a plateau with a bed for a
stream, a cliff in steps about an amphitheatre, boulders, banks. Under the pool its surface lies just below the water's,
which hides it, so that what falls there meets the water.

Data: metres, Y up, x and z from -HALF_SIZE to HALF_SIZE, the water at y = 0; vertex colours in sRGB. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import ticks  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import mix, noise, scale, smoothstep  # noqa: E402

HALF_SIZE = 8.0  # m
SQUARES = 112
STEPS = [(0.0, 1.7), (1.25, 1.4), (2.3, 1.2)]  # m behind the edge of the plateau, height of the step
TOP = sum(drop for _, drop in STEPS) + 0.1


def edge(x):
    """The z at which the plateau ends: an amphitheatre, open towards +z."""
    return -3.4 + 0.16 * x * x - 0.003 * abs(x) ** 3 + 0.35 * noise((0.8 * x, 0.5, 0.5), 1)


def height(x, z):
    ragged = 0.75 * noise((0.75 * x, 0.5, 0.75 * z), 2) + 0.16 * noise((1.9 * x, 0.5, 1.9 * z), 3)
    s = z - edge(x) + ragged
    h = TOP
    for behind, drop in STEPS:
        wander = 0.5 * noise((0.45 * x, 3.5 + 3 * behind, 0.5), 4)
        h -= drop * smoothstep(behind + wander, behind + wander + 0.8, s)
    # A bed for the stream, and the rims of the steps worn down in its way.
    stream = math.exp(-((x - 0.35 * math.sin(0.9 * z)) / 1.15) ** 2)
    h -= 0.55 * stream * smoothstep(-0.3, 0.5, h)
    # Blocks: flat facets with edges between.
    rock = 0.22 * abs(noise((1.1 * x, 0.9 * h, 1.1 * z), 5)) + 0.07 * noise((3.7 * x, 2.1 * h, 3.7 * z), 6)
    h += rock * (1 - 0.7 * stream)
    # The pool and its banks.
    r = math.hypot(0.72 * x, z - 2.2) + 0.45 * noise((0.6 * x, 0.5, 0.6 * z), 7)
    bank = smoothstep(2.7, 4.3, r)
    outlet = math.exp(-((x - 0.8) / 1.3) ** 2) * smoothstep(3.0, 5.0, z)
    foot = 0.9 * bank * (1 - outlet) + 0.22 * noise((0.9 * x, 0.5, 0.9 * z), 8) * bank - 0.06
    banked = max(h - 0.1, foot) + 0.35 * foot * smoothstep(0.0, 0.6, h) * smoothstep(2.4, 1.0, h)
    h += (banked - h) * smoothstep(1.1, 2.1, s)
    for bx, bz, size in BOULDERS:
        d = math.hypot(x - bx, z - bz) / size
        if d < 1:
            lump = size * 0.75 * math.sqrt(1 - d * d) * (1 + 0.3 * noise((2.3 * x, 1.5, 2.3 * z), 9))
            h = max(h, lump - 0.08)
    return max(h, -0.03)


BOULDERS = [(-1.5, 1.0, 0.7), (-0.75, 0.6, 0.42), (1.7, 0.75, 0.55), (2.45, 1.5, 0.8), (-2.7, 2.1, 0.6), (0.5, 0.55, 0.34),
            (-2.0, 4.2, 0.5), (3.1, 3.6, 0.45), (-3.3, 3.6, 0.8), (1.0, 1.15, 0.26), (-0.4, 3.9, 0.2)]


def colour(p, n):
    x, h, z = p
    fine = noise((4.1 * x, 4.1 * h, 4.1 * z), 10)
    strata = noise((0.3 * x, 4.2 * h + 1.2 * noise((0.6 * x, 0.5, 0.6 * z), 11), 0.3 * z), 12)
    rock = mix((0.33, 0.29, 0.28), (0.53, 0.47, 0.40), 0.5 + 0.5 * strata + 0.15 * fine)
    moss = mix((0.17, 0.25, 0.09), (0.34, 0.42, 0.14), 0.5 + 0.4 * noise((1.4 * x, 0.5, 1.4 * z), 13) + 0.2 * fine)
    level = smoothstep(0.62, 0.92, n[1] + 0.10 * fine)
    stream = math.exp(-((x - 0.35 * math.sin(0.9 * z)) / 1.0) ** 2)
    out = mix(rock, moss, level * (1 - 0.85 * stream) * smoothstep(0.02, 0.2, h))
    # What is wet is dark.
    wet = max(0.75 * stream * smoothstep(6.0, 4.6, z), smoothstep(0.3, 0.0, h + 0.1 * fine))
    return scale(out, 1 - 0.45 * min(wet, 1.0))


def write_gorge():
    obj = ObjWriter(["A gorge, by make_gorge.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("gorge")
    uv = obj.uv(0, 0)
    obj.join(obj.add_grid(ticks(HALF_SIZE, SQUARES), height, 0.05, colour), uv, flip=True)
    obj.save(HERE / "gorge.obj")


def write_pool():
    obj = ObjWriter(["Still water, by make_gorge.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("water")
    uv = obj.uv(0, 0)
    corners = [obj.add_vertex((x, 0.0, z), (0, 1, 0), (0.08, 0.21, 0.22))
               for x, z in ((-5.5, -2.0), (-5.5, HALF_SIZE), (5.5, HALF_SIZE), (5.5, -2.0))]
    obj.add_quad(*corners, uv)
    obj.save(HERE / "pool.obj")


if __name__ == "__main__":
    write_gorge()
    write_pool()
