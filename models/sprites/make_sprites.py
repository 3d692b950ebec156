"""Makes flakes.png and sparks.png: 2 x 2 tiles of 64 x 64, RGBA, sRGB, white, shape in alpha.

flakes.png: four snowflakes with six arms, each with twigs at angles of 60 degrees, soft at their edges.
sparks.png: a round glow, a star of four rays, one of six, and a streak that points upwards.

Alpha is 0 on the border of every tile. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from png_writer import RGBA_8, write_png  # noqa: E402
from vectors import smoothstep  # noqa: E402

TILE = 64  # pixels
SAMPLES = 3  # a pixel, each way


def segment_distance(p, a, b):
    ax, ay = p[0] - a[0], p[1] - a[1]
    bx, by = b[0] - a[0], b[1] - a[1]
    t = min(max((ax * bx + ay * by) / (bx * bx + by * by), 0.0), 1.0)
    return math.hypot(ax - t * bx, ay - t * by)


# Of each flake: (place along the arm, length) of its twigs, and the size of its middle.
FLAKES = [([(0.35, 0.24), (0.58, 0.2), (0.78, 0.1)], 0.1),
          ([(0.5, 0.34)], 0.16),
          ([(0.3, 0.12), (0.45, 0.18), (0.6, 0.24), (0.75, 0.14)], 0.05),
          ([(0.66, 0.26), (0.3, 0.14)], 0.22)]


def flake(tile, x, y):
    twigs, middle = FLAKES[tile]
    # One arm and a half: the rest is mirrored and turned.
    angle = math.atan2(y, x) % (math.pi / 3)
    angle = min(angle, math.pi / 3 - angle)
    r = math.hypot(x, y)
    p = (r * math.cos(angle), r * math.sin(angle))
    nearest = segment_distance(p, (0, 0), (0.86, 0))
    for place, length in twigs:
        tip = (place + length * 0.5, length * math.sqrt(0.75))
        nearest = min(nearest, segment_distance(p, (place, 0), tip))
    body = max(smoothstep(0.075, 0.02, nearest), smoothstep(middle + 0.05, middle - 0.03, p[0] * 0.95 + p[1] * 0.3))
    glow = 0.28 * max(1 - r * r, 0.0) ** 2
    return max(body, glow) * smoothstep(0.98, 0.84, r)


def spark(tile, x, y):
    r = math.hypot(x, y)
    glow = max(1 - r * r, 0.0) ** 6 + 0.35 * max(1 - r, 0.0) ** 2
    rim = smoothstep(0.98, 0.7, r)
    if tile == 0:
        return min(glow, 1.0) * rim
    if tile == 3:
        body = math.exp(-(x / (0.05 + 0.1 * (0.5 + 0.5 * y))) ** 2) * smoothstep(-0.95, 0.7, y)
        head = math.exp(-((x / 0.16) ** 2 + ((y - 0.62) / 0.2) ** 2))
        return min(body * 0.8 + head, 1.0) * smoothstep(0.98, 0.8, abs(y))
    rays = 0.0
    for k in range(2 if tile == 1 else 3):
        angle = math.pi * k / (2 if tile == 1 else 3)
        along, across = x * math.cos(angle) + y * math.sin(angle), y * math.cos(angle) - x * math.sin(angle)
        rays = max(rays, max(1 - abs(along), 0.0) ** 2 * math.exp(-(across / (0.035 + 0.03 * (1 - abs(along)))) ** 2))
    return min(0.6 * glow + rays, 1.0) * rim


def draw(file, shape):
    rows = []
    for row in range(2 * TILE):
        pixels = bytearray()
        for column in range(2 * TILE):
            total = 0.0
            for sample in range(SAMPLES * SAMPLES):
                u = (column % TILE + (sample % SAMPLES + 0.5) / SAMPLES) / TILE
                v = (row % TILE + (sample // SAMPLES + 0.5) / SAMPLES) / TILE
                total += shape(row // TILE * 2 + column // TILE, 2 * u - 1, 1 - 2 * v)
            pixels += bytes([255, 255, 255, int(total / SAMPLES ** 2 * 255 + 0.5)])
        rows.append(bytes(pixels))
    write_png(HERE / file, 2 * TILE, rows, RGBA_8, srgb=True)
    print(file, (HERE / file).stat().st_size // 1024, "KiB")


def main():
    draw("flakes.png", flake)
    draw("sparks.png", spark)


if __name__ == "__main__":
    main()
