"""Makes hollow.obj: a rocky hollow, 4 m by 4 m, for snow to fall into.

Ledges and steep faces rise around a floor, high at the back and low towards the camera, with boulders in between:
ledges keep what falls on them, faces let it slide, the floor gathers it. A function of (x, z), so that the mesh is a
height field: 128 x 128 squares over [-2, 2] x [-2, 2] m.

Data: metres, Y up; the floor is near y = 0. Vertex colours in sRGB: rock, and old snow on what is flat, with heath at its
rims. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import ticks  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import mix, noise, scale, smoothstep  # noqa: E402

HALF_SIZE = 2.0  # m
SQUARES = 128
STEP_HEIGHT = 0.3  # m, of a ledge

# x, z, radius, height, m
BOULDERS = [(-0.42, 0.35, 0.26, 0.25), (0.52, -0.02, 0.3, 0.34), (0.18, 0.72, 0.17, 0.14), (-0.75, -0.38, 0.22, 0.22),
            (0.86, 0.62, 0.24, 0.24), (-0.12, -0.62, 0.2, 0.16), (-0.95, 0.8, 0.2, 0.18)]


def ledges(h, sharpness=0.85):
    """Flat for a part of every step, then steep."""
    whole = math.floor(h / STEP_HEIGHT)
    return STEP_HEIGHT * (whole + smoothstep(1 - sharpness, 1.0, h / STEP_HEIGHT - whole))


def height(x, z):
    bend = 0.25 * noise((0.9 * x + 4, 0.5, 0.9 * z), 1)
    reach = math.hypot(0.95 * x, 0.85 * (z - 0.1)) + bend
    rim = 0.45 + 0.85 * smoothstep(-1.2, 1.6, -z) + 0.35 * noise((1.1 * x, 2.5, 1.1 * z), 2)
    slope = rim * smoothstep(0.75, 1.95, reach) * 1.25
    h = 0.5 * slope + 0.5 * ledges(slope + 0.1 * noise((2.2 * x, 0.5, 2.2 * z), 3))
    for bx, bz, radius, top in BOULDERS:
        away = math.hypot(x - bx, z - bz) / radius + 0.16 * noise((5 * x, bx, 5 * z), 5)
        h = max(h, top * max(1 - away * away, 0.0) ** 0.8 - 0.01)
    return h + 0.03 * noise((2.4 * x, 0.5, 2.4 * z), 6) + 0.012 * noise((7 * x, 0.5, 7 * z), 7)


def ground_colour(p, n):
    x, y, z = p
    steep = 1 - n[1]
    layer = noise((0.8 * x, 9 * y, 0.8 * z), 8)
    rock = mix((0.36, 0.33, 0.32), (0.50, 0.46, 0.42), 0.5 + 0.5 * layer)
    heath = mix((0.33, 0.27, 0.17), (0.40, 0.38, 0.20), 0.5 + 0.5 * noise((4 * x, 1.5, 4 * z), 9))
    bare = scale(mix(heath, rock, smoothstep(0.08, 0.3, steep)), 1 + 0.06 * noise((13 * x, 3.5, 13 * z), 10))
    edge = 0.06 * noise((3 * x, 6.5, 3 * z), 11) + 0.04 * noise((9 * x, 6.5, 9 * z), 12)
    snow = scale((0.90, 0.92, 0.95), 1 + 0.02 * noise((20 * x, 7.5, 20 * z), 13))
    return mix(snow, bare, smoothstep(0.16, 0.24, steep + edge))


def main():
    obj = ObjWriter(["A rocky hollow, by make_hollow.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("hollow")
    rows = obj.add_grid(ticks(HALF_SIZE, SQUARES), height, 0.02, ground_colour)
    obj.join(rows, obj.uv(0, 0), flip=True)
    obj.save(HERE / "hollow.obj")


if __name__ == "__main__":
    main()
