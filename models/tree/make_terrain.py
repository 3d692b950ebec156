"""Makes terrain.obj and terrain-height.png: a gentle meadow, 24 m by 24 m, the tree at its middle.

A low mound plus value noise of three sizes, lowered so that the height at (0, 0) is exactly 0. The
mesh has 96 x 96 squares, normals from the height function's differences, and vertex colours in sRGB:
meadow greens, drier patches on what is high, bare earth round the tree.

terrain-height.png: one 16-bit grey channel, 257 x 257 samples on [-12, 12] x [-12, 12] m, row 0 at
z = -12, column 0 at x = -12, samples on the edges themselves (a step is 24 m / 256).
    height in metres = HEIGHT_MIN + (HEIGHT_MAX - HEIGHT_MIN) * sample / 65535,  from -0.8 to +0.8
so one step is 0.024 mm. Same bytes every run.
"""

import pathlib
import struct
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import on_surface, quads, ticks  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from png_writer import GREY_16, write_png  # noqa: E402
from vectors import mix, noise, scale, smoothstep  # noqa: E402

HALF_SIZE = 12.0     # m
SQUARES = 96
SAMPLES = 257
HEIGHT_MIN, HEIGHT_MAX = -0.8, 0.8  # m, what black and white mean in the picture


def raw_height(x, z):
    mound = 0.75 / (1.0 + (x * x + z * z) / 50.0)
    swell = 0.24 * noise((0.14 * x + 3.1, 0.5, 0.14 * z + 1.7), 1)
    rolls = 0.11 * noise((0.42 * x, 0.5, 0.42 * z), 2)
    tufts = 0.018 * noise((1.3 * x, 0.5, 1.3 * z), 3)
    return mound + swell + rolls + tufts


HEIGHT_AT_TREE = raw_height(0.0, 0.0)


def height(x, z):
    """Metres above the tree's foot."""
    return raw_height(x, z) - HEIGHT_AT_TREE


def ground_colour(x, z):
    patch = noise((0.35 * x, 2.5, 0.35 * z), 11) + 0.5 * noise((0.9 * x, 2.5, 0.9 * z), 12)
    fine = noise((2.6 * x, 2.5, 2.6 * z), 13)
    colour = mix((0.30, 0.42, 0.17), (0.42, 0.51, 0.23), smoothstep(-0.8, 0.8, patch + 0.3 * fine))
    dry = smoothstep(0.15, 0.9, noise((0.22 * x + 9, 4.5, 0.22 * z), 14) + 0.8 * height(x, z) + 0.25 * fine)
    colour = mix(colour, (0.58, 0.54, 0.32), 0.6 * dry)
    reach = (x * x + z * z) ** 0.5 + 0.55 * patch + 0.2 * fine
    colour = mix((0.36, 0.29, 0.21), colour, 0.15 + 0.85 * smoothstep(0.3, 1.9, reach))
    return scale(colour, 1.0 + 0.05 * fine)


def write_mesh():
    obj = ObjWriter(["Shoal's meadow, made by make_terrain.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("terrain")
    rows = []
    for i, z in enumerate(ticks(HALF_SIZE, SQUARES)):
        row = []
        for j, x in enumerate(ticks(HALF_SIZE, SQUARES)):
            vertex = obj.add_vertex(*on_surface(height, x, z, 0.05), ground_colour(x, z))
            row.append((vertex, obj.uv(j / SQUARES, 1 - i / SQUARES)))
        rows.append(row)
    for a, b, c, d in quads(rows):
        obj.add_triangle(a, d, c)
        obj.add_triangle(a, c, b)
    obj.save(HERE / "terrain.obj")


def write_heights():
    places = ticks(HALF_SIZE, SAMPLES - 1)
    heights = [[height(x, z) for x in places] for z in places]
    low, high = min(map(min, heights)), max(map(max, heights))
    assert HEIGHT_MIN <= low and high <= HEIGHT_MAX
    rows = [struct.pack(">%dH" % SAMPLES, *(round((h - HEIGHT_MIN) / (HEIGHT_MAX - HEIGHT_MIN) * 65535)
                                            for h in row)) for row in heights]
    write_png(HERE / "terrain-height.png", SAMPLES, rows, GREY_16,
              comment="height in metres = -0.8 + 1.6 * sample / 65535")
    print("terrain-height.png  heights %.3f to %.3f m" % (low, high))


if __name__ == "__main__":
    write_mesh()
    write_heights()
