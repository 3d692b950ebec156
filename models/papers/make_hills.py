"""Makes hills.obj: smooth pale hills about a basin with terraces, for the balls of uberflow.scene.json to run down.

A ridge at the back with three springs' beds that wind down it, three terraces with rims that hold some of what comes, and a
basin in front. A height field: one height at every x and z.

Data: metres, Y up, x and z from -HALF_SIZE to HALF_SIZE; vertex colours in sRGB. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import ticks  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import mix, noise, smoothstep  # noqa: E402

HALF_SIZE = 4.5  # m
SQUARES = 128
BEDS = [(-1.5, 0.30, 0.5), (0.1, 0.38, 2.1), (1.6, 0.28, 4.0)]  # x of the spring, way to either side, phase
TERRACES = [(1.15, 0.10), (0.62, 0.09)]  # heights, rims


def bed(x, z):
    """How near a point is to one of the beds, 0 to 1."""
    nearest = 0.0
    for spring, way, phase in BEDS:
        middle = spring * (0.62 - 0.13 * z) + way * math.sin(1.5 * z + phase)
        nearest = max(nearest, math.exp(-((x - middle) / 0.24) ** 2))
    return nearest


def height(x, z):
    fall = smoothstep(1.3, -2.8, z)
    h = 2.3 * fall ** 1.25 + 0.22 * noise((0.8 * x, 0.5, 0.8 * z), 1) * (0.4 + fall)
    h -= 0.30 * bed(x, z) * smoothstep(0.0, 0.5, fall)
    # Terraces: what is near one of their heights is drawn to it, and a rim stands before the drop.
    for level, rim in TERRACES:
        near = math.exp(-((h - level) / 0.16) ** 2)
        h += 0.8 * near * (level - h)
        h += rim * math.exp(-((h - level + 0.10) / 0.05) ** 2)
    # The basin, and a border that holds all in.
    r = math.hypot(0.62 * x, z - 1.55)
    h += 0.5 * smoothstep(0.95, 1.75, r) * (1 - fall) - 0.1
    border = max(abs(x) - 0.1 * noise((1.1 * z, 0.5, 0.5), 2), z)
    h += 0.55 * smoothstep(2.35, 2.85, border) * (1 + 0.5 * noise((0.9 * x, 0.5, 0.9 * z), 3))
    h -= 0.8 * smoothstep(2.9, 4.4, border)
    return h - 2.2 * smoothstep(-2.95, -4.2, z) * (1 + 0.3 * noise((0.7 * x, 0.5, 0.7 * z), 6))


def colour(p, n):
    x, _, z = p
    tone = noise((3 * x, 0.5, 3 * z), 4) + 0.6 * noise((9 * x, 0.5, 9 * z), 5)
    level = smoothstep(0.55, 0.95, n[1])
    return mix((0.42, 0.47, 0.53), (0.83, 0.84, 0.84), min(max(level + 0.04 * tone, 0.0), 1.0))


def main():
    obj = ObjWriter(["Hills, by make_hills.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("hills")
    uv = obj.uv(0, 0)
    obj.join(obj.add_grid(ticks(HALF_SIZE, SQUARES), height, 0.02, colour), uv, flip=True)
    obj.save(HERE / "hills.obj")


if __name__ == "__main__":
    main()
