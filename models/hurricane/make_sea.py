"""Makes sea.obj: the sea under the hurricane, with circles every 10 m, numbers at them, and the scale of the crosses' colours.

Lines and the scale lie a little above the water, on which nothing moves; numbers lie above most of the crosses. The scale's colours are those of
src/scene/color_scale.h. Metres, Y up, the eye at x = z = 0. Vertex colours in sRGB. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from obj_writer import ObjWriter  # noqa: E402
from vectors import mix, noise, scale, smoothstep, to_srgb  # noqa: E402

REACH = 140.0  # m, where the sea has the sky's colour below the horizon
CIRCLES = range(10, 61, 10)  # m
SIDES = 160
WATER, FOAM, LINE = (0.07, 0.13, 0.19), (0.24, 0.33, 0.39), (0.55, 0.66, 0.72)
NUMBER = (0.92, 0.95, 0.96)
SCALE_FROM, SCALE_TO = 3, 17  # m/s
SCALE_COLOURS = [(0.03, 0.012, 0.186), (0.005, 0.057, 0.304), (0.001, 0.141, 0.289), (0.001, 0.25, 0.322),
                 (0.002, 0.4, 0.334), (0.057, 0.584, 0.268), (0.346, 0.728, 0.197), (0.827, 0.847, 0.171)]  # linear

# Strokes on a field 0..1 wide and 0..2 high.
GLYPHS = {
    "0": [(0, 0, 1, 0), (1, 0, 1, 2), (1, 2, 0, 2), (0, 2, 0, 0)],
    "1": [(0.5, 0, 0.5, 2), (0.5, 2, 0.15, 1.6)],
    "2": [(0, 2, 1, 2), (1, 2, 1, 1), (1, 1, 0, 1), (0, 1, 0, 0), (0, 0, 1, 0)],
    "3": [(0, 2, 1, 2), (1, 2, 1, 0), (0, 0, 1, 0), (0.2, 1, 1, 1)],
    "4": [(0, 2, 0, 1), (0, 1, 1, 1), (1, 2, 1, 0)],
    "5": [(1, 2, 0, 2), (0, 2, 0, 1), (0, 1, 1, 1), (1, 1, 1, 0), (1, 0, 0, 0)],
    "6": [(1, 2, 0, 2), (0, 2, 0, 0), (0, 0, 1, 0), (1, 0, 1, 1), (1, 1, 0, 1)],
    "7": [(0, 2, 1, 2), (1, 2, 0.4, 0)],
    "m": [(0, 0, 0, 1.2), (0, 1.2, 1, 1.2), (0.5, 1.2, 0.5, 0), (1, 1.2, 1, 0)],
    "s": [(1, 1.2, 0, 1.2), (0, 1.2, 0, 0.6), (0, 0.6, 1, 0.6), (1, 0.6, 1, 0), (1, 0, 0, 0)],
    "/": [(0.1, -0.2, 0.9, 2.1)],
    " ": [],
}


class Sheet:
    """Flat shapes at some height, seen from above."""

    def __init__(self, writer):
        self.writer = writer
        self.uv = writer.uv(0, 0)

    def corner(self, x, y, z, colour):
        return self.writer.add_vertex((x, y, z), (0.0, 1.0, 0.0), colour)

    def quad(self, corners, y, colour):
        """The corners are four pairs (x, z), anticlockwise as seen from above."""
        self.writer.add_quad(*[self.corner(x, y, z, colour) for x, z in corners], self.uv)

    def stroke(self, x0, z0, x1, z1, width, y, colour):
        length = math.hypot(x1 - x0, z1 - z0)
        ux, uz = (x1 - x0) / length * width / 2, (z1 - z0) / length * width / 2
        x0, z0, x1, z1 = x0 - ux, z0 - uz, x1 + ux, z1 + uz
        self.quad(((x0 - uz, z0 + ux), (x1 - uz, z1 + ux), (x1 + uz, z1 - ux), (x0 + uz, z0 - ux)), y, colour)

    def text(self, words, x, z, size, y, colour):
        """From x to the right, its foot at z, `size` high, upright for who looks along -z."""
        step = 0.8 * size
        for i, glyph in enumerate(words):
            for a, b, c, d in GLYPHS[glyph]:
                left = x + i * step
                self.stroke(left + a * size / 2, z - b * size / 2, left + c * size / 2, z - d * size / 2, 0.13 * size, y,
                            colour)

    def ring(self, inner, outer, y, colours, sides):
        """`colours`: of the inner and the outer edge, of a place."""
        rows = []
        for reach, colour in ((inner, colours[0]), (outer, colours[1])):
            row = []
            for side in range(sides):
                angle = 2 * math.pi * side / sides
                x, z = reach * math.cos(angle), reach * math.sin(angle)
                row.append(self.corner(x, y, z, colour(x, z)))
            rows.append(row)
        self.writer.join(rows, self.uv, closed=True)


def water(x, z):
    """Streaks of foam that wind in towards the eye."""
    reach = max(math.hypot(x, z), 0.5)
    turn = math.atan2(z, x) + 1.6 * math.log(reach)
    streak = noise((2.2 * math.cos(turn), 2.2 * math.sin(turn), 0.06 * reach), 5)
    streak += 0.5 * noise((0.25 * x, 0.5, 0.25 * z), 6)
    colour = mix(WATER, FOAM, 0.9 * smoothstep(0.0, 0.9, streak))
    return scale(colour, 1 - 0.75 * smoothstep(70, REACH, reach))


def main():
    writer = ObjWriter(["The sea under a hurricane, by make_sea.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    sheet = Sheet(writer)
    writer.begin_object("water")
    reaches = [0.02] + [1.5 * 1.1 ** i for i in range(48)]
    reaches = [r for r in reaches if r < REACH] + [REACH]
    for inner, outer in zip(reaches, reaches[1:]):
        sheet.ring(inner, outer, 0.0, (water, water), 96)
    writer.begin_object("circles")
    for reach in CIRCLES:
        sheet.ring(reach - 0.12, reach + 0.12, 0.05, (lambda x, z: LINE,) * 2, SIDES)
    for reach in CIRCLES:
        last = reach == CIRCLES[-1]
        sheet.text("%d" % reach + (" m" if last else ""), reach + 0.8, -0.7, 2.6, 9.0, NUMBER)
    writer.begin_object("scale")
    left, top, bottom, pieces = -84.0, -44.0, -12.0, 56
    for i in range(pieces):
        q = i / (pieces - 1) * (len(SCALE_COLOURS) - 1)
        k = min(int(q), len(SCALE_COLOURS) - 2)
        colour = to_srgb(mix(SCALE_COLOURS[k], SCALE_COLOURS[k + 1], q - k))
        z0 = bottom + (top - bottom) * i / pieces
        z1 = bottom + (top - bottom) * (i + 1) / pieces
        sheet.quad(((left, z0), (left + 3.4, z0), (left + 3.4, z1), (left, z1)), 0.06, colour)
    for speed in (SCALE_FROM, (SCALE_FROM + SCALE_TO) // 2, SCALE_TO):
        z = bottom + (top - bottom) * (speed - SCALE_FROM) / (SCALE_TO - SCALE_FROM)
        sheet.text("%d" % speed + (" m/s" if speed == SCALE_TO else ""), left + 4.6, z + 1.4, 2.8, 0.06, NUMBER)
    writer.save(HERE / "sea.obj")


if __name__ == "__main__":
    main()
