"""Makes leaf.png: one leaf, 512 x 512 RGBA, sRGB, to be multiplied by a molecule's own colour.

The stalk enters at the bottom's middle (u = 0.5, v = 0), the blade begins at v = 0.15, its tip is at
(u = 0.5, v = 1). The picture's last row is v = 0. RGB is light, near grey (mean about 0.75 over the
leaf, veins brighter, edge and hollows darker); alpha is the outline, anti-aliased. The colour is
defined everywhere, outside the outline too, so that no dark fringe shows at any mip level.

The outline is ovate with saw teeth, as a beech's or elm's; each side vein runs into a tooth, because
both follow the same coordinate (see vein_coordinate). The mottling between the veins is cellular
noise [Worley 1996]. Same bytes every run.
"""

import functools
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "models"))

from png_writer import RGBA_8, write_png  # noqa: E402
from vectors import noise, smoothstep  # noqa: E402

SIZE = 512
BLADE_FROM, BLADE_TO = 0.15, 0.992   # v
HALF_WIDTH = 0.405                   # u, at the broadest place
STALK_HALF_WIDTH = 0.0125            # u
VEINS = 9.0                          # side veins along the blade, on each side


def blade_place(v):
    """0 where the blade begins, 1 at its tip."""
    return (v - BLADE_FROM) / (BLADE_TO - BLADE_FROM)


def midrib(v):
    """The midrib's u: a slight S, so that the leaf does not look stamped."""
    t = min(max(blade_place(v), 0.0), 1.0)
    return 0.5 + 0.012 * math.sin(2 * math.pi * t) * (1 - t)


def vein_coordinate(x, v):
    """Whole numbers are side veins; x is measured from the midrib, the two sides alternate."""
    a = abs(x)
    rise = 0.74 * a - 0.45 * a * a
    return VEINS * (blade_place(v) - rise) * (1.10 - 0.10 * blade_place(v)) + (0.45 if x < 0 else 0.0) + 0.6


def smooth_half_width(t):
    """The outline without teeth: ovate, broadest at 0.42 of the blade, with a drawn-out tip."""
    if not 0.0 < t < 1.0:
        return 0.0
    base = math.sin(math.pi * min(t, 1.0) ** 0.80) ** 0.72
    tip = 1 - 0.42 * smoothstep(0.55, 1.0, t)
    return HALF_WIDTH * base * tip


def half_width(x, v):
    t = blade_place(v)
    width = smooth_half_width(t)
    if width <= 0.0:
        return 0.0
    q = vein_coordinate(math.copysign(width, x), v)
    large, small = q - math.floor(q), 3 * q - math.floor(3 * q)
    tooth = (large if large < 0.88 else (1 - large) / 0.12 * 0.88) - 0.45
    notch = (small if small < 0.8 else (1 - small) / 0.2 * 0.8) - 0.4
    fade = smoothstep(0.02, 0.14, t) * smoothstep(1.0, 0.9, t) if t < 0.9 else 1 - smoothstep(0.9, 1.0, t)
    return width * (1 + fade * (0.045 * tooth + 0.020 * notch))


def stalk_half_width(v):
    return STALK_HALF_WIDTH * (1.0 + 0.7 * smoothstep(0.04, 0.0, v) if v < 0.04 else 1.0)


def is_inside(u, v):
    x = u - midrib(v)
    if v < BLADE_FROM + 0.02 and abs(x) < stalk_half_width(v):
        return True
    return abs(x) < half_width(x, v)


def alpha(u, v):
    """The covered part of a pixel, from 5 x 5 places where the outline may cross it."""
    pixel = 1.0 / SIZE
    corners = [is_inside(u + dx * pixel, v + dy * pixel) for dx in (-1.0, 0.0, 1.0) for dy in (-1.0, 0.0, 1.0)]
    if all(corners) or not any(corners):
        return float(corners[0])
    places = [(i - 2) / 5 * pixel for i in range(5)]
    return sum(is_inside(u + dx, v + dy) for dx in places for dy in places) / 25


@functools.lru_cache(maxsize=None)
def feature_point(cx, cy, seed):
    return (cx + 0.5 + 0.45 * noise((cx, cy, 0), seed), cy + 0.5 + 0.45 * noise((cx, cy, 0), seed + 1))


def cells(x, y, seed):
    """Distance to the wall between the two nearest feature points, in cells: 0 on the wall."""
    bx, by = math.floor(x), math.floor(y)
    nearest, second = 9.0, 9.0
    for cy in (by - 1, by, by + 1):
        for cx in (bx - 1, bx, bx + 1):
            px, py = feature_point(cx, cy, seed)
            d = math.hypot(px - x, py - y)
            if d < nearest:
                nearest, second = d, nearest
            elif d < second:
                second = d
    return second - nearest


def line(distance, width):
    """1 on a line, falling off smoothly over its width."""
    return math.exp(-(distance / width) ** 2)


def shade(u, v):
    """Red, green, blue at a place, in sRGB 0..1."""
    t = min(max(blade_place(v), 0.0), 1.0)
    x = u - midrib(v)
    width = max(smooth_half_width(t), 0.03)
    across = min(abs(x) / width, 1.2)

    main = line(x, 0.0125 * (1.0 - 0.75 * t) + 0.002)
    q = vein_coordinate(x, v)
    to_vein = abs(q - math.floor(q + 0.5)) / VEINS
    side = line(to_vein, 0.0058 * (1.0 - 0.6 * min(across, 1.0)) + 0.0012) * smoothstep(-0.01, 0.05, blade_place(v))
    hollow = line(max(to_vein - 0.008, 0.0), 0.012) + line(max(abs(x) - 0.014, 0.0), 0.014)

    wall = cells(0.9 * VEINS * (q - 0.4 * across), 34 * x + 3 * q, 5)
    fine = cells(95 * u, 95 * v, 8)
    blotch = noise((7 * u, 7 * v, 0.5), 21) + 0.5 * noise((19 * u, 19 * v, 0.5), 22)

    value = 0.780 + 0.030 * blotch
    value += 0.050 * line(wall, 0.10) + 0.030 * (min(fine, 0.5) - 0.2)
    value -= 0.045 * min(hollow, 1.0)
    value -= 0.14 * smoothstep(0.86, 1.03, across)
    value += 0.02 * math.sin(2 * math.pi * q + 1.2)  # the blade bulges between its veins
    vein = max(main, 0.62 * side)
    value += (1.0 - value) * vein
    warm = 0.5 * vein + 0.12 * blotch
    return (value * (0.965 + 0.035 * warm), value, value * (0.90 + 0.06 * warm))


def to_byte(value):
    return min(max(round(255 * value), 0), 255)


def main():
    rows = []
    total, covered = 0.0, 0.0
    for row in range(SIZE):
        v = 1 - (row + 0.5) / SIZE
        pixels = bytearray()
        for column in range(SIZE):
            u = (column + 0.5) / SIZE
            colour, cover = shade(u, v), alpha(u, v)
            total += cover * sum(colour) / 3
            covered += cover
            pixels += bytes((*map(to_byte, colour), to_byte(cover)))
        rows.append(bytes(pixels))
    write_png(HERE / "leaf.png", SIZE, rows, RGBA_8, srgb=True)
    print("leaf.png  %.2f of the picture covered, mean colour %.3f" % (covered / SIZE ** 2, total / covered))


if __name__ == "__main__":
    main()
