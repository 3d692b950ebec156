#!/usr/bin/env python3
"""Makes minnow.obj, a small fish of about 1,900 triangles, and minnow.png, its flank: run it in this folder.

minnow.obj: closed, metres, Y up, 0.12 m long, swims along +Z, its middle at the origin. Sections across the body are
closed curves of SIDES vertices that lie close together at the back and the belly, where the fins rise out of them; the
last sections are thin and tall and lean back above and below, which makes the forked tail. uv is the side view, the same
on both flanks: u from snout to tail, v from the lowest to the highest place.
minnow.png: 512 x 256 RGBA, sRGB, opaque. Its last row is v = 0.

minnow.json is then made from it:
    shoal molecule from-mesh minnow.obj -o minnow.json --force --rings 6 --texture minnow.png --name minnow
Standard library only; same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "models"))

from png_writer import RGBA_8, write_png  # noqa: E402
from vectors import mix, noise, scale, smoothstep  # noqa: E402

LENGTH = 0.12
SECTIONS = 37
WIDTH, HEIGHT = 512, 256
# t from snout to the tip of the tail: half the width, heights of back and belly, mm
PROFILE = [
    (0.00, 0.5, 0.6, 0.6), (0.02, 2.0, 2.0, 2.4), (0.06, 3.8, 4.2, 4.9), (0.12, 5.4, 6.6, 7.2), (0.20, 6.6, 8.8, 9.2),
    (0.30, 7.1, 10.2, 10.6), (0.40, 6.7, 10.2, 10.6), (0.50, 5.6, 8.9, 9.2), (0.60, 4.2, 6.8, 6.9), (0.70, 2.8, 4.8, 4.8),
    (0.78, 1.8, 3.7, 3.7), (0.82, 1.3, 4.2, 4.2), (0.87, 0.9, 7.5, 7.5), (0.93, 0.6, 11.5, 11.5), (1.00, 0.35, 13.5, 13.5),
]
FORK = 0.016  # m, how far the tail's tips lie behind its middle
# from, to, height mm, where it is highest
DORSAL, ANAL = (0.40, 0.58, 6.5, 0.3), (0.56, 0.70, 4.5, 0.25)


def profile(t):
    """Catmull-Rom through the table."""
    i = max(k for k in range(len(PROFILE) - 1) if PROFILE[k][0] <= t or k == 0)
    p = [PROFILE[min(max(i + k, 0), len(PROFILE) - 1)] for k in (-1, 0, 1, 2)]
    s = (t - p[1][0]) / (p[2][0] - p[1][0])
    out = []
    for n in (1, 2, 3):
        slope = [(p[k + 1][n] - p[k - 1][n]) / max(p[k + 1][0] - p[k - 1][0], 1e-9) * (p[2][0] - p[1][0]) for k in (1, 2)]
        a, b = p[1][n], p[2][n]
        out.append((2 * s**3 - 3 * s**2 + 1) * a + (s**3 - 2 * s**2 + s) * slope[0]
                   + (3 * s**2 - 2 * s**3) * b + (s**3 - s**2) * slope[1])
    return [0.001 * max(x, 0.2) for x in out]


def fin(t, shape):
    start, end, height, peak = shape
    if not start < t < end:
        return 0.0
    s = (t - start) / (end - start)
    return 0.001 * height * (math.sin(0.5 * math.pi * s / peak) if s < peak else ((1 - s) / (1 - peak)) ** 0.8)


# Degrees from the right flank over the back; dense where fins rise.
QUARTER = [0, 22, 44, 62, 76, 86]
ANGLES = QUARTER + [90] + [180 - a for a in reversed(QUARTER[1:])]
ANGLES = ANGLES + [180 + a for a in ANGLES]
SIDES = len(ANGLES)


def section(t):
    """The vertices (x, y, z) of one section."""
    width, back, belly = profile(t)
    lean = smoothstep(0.80, 1.0, t)
    out = []
    for angle in ANGLES:
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        high = back if s > 0 else belly
        x, y = width * c, high * s
        edge = smoothstep(0.985, 1.0, abs(s))
        y += edge * (fin(t, DORSAL) if s > 0 else -fin(t, ANAL))
        x *= 1 - 0.45 * edge * (1 if fin(t, DORSAL if s > 0 else ANAL) > 0 else 0)
        tall = abs(y) / 0.0135
        z = 0.5 * LENGTH - t * (LENGTH - FORK) - FORK * lean * tall ** 1.3
        out.append((x, y, z))
    return out


LOW, HIGH = -0.0175, 0.0175  # m, of the picture


def place_in_picture(p):
    return (0.5 * LENGTH - p[2]) / LENGTH, (p[1] - LOW) / (HIGH - LOW)


def write_mesh():
    lines = ["# A minnow by make_minnow.py. Metres, Y up, swims along +Z. MIT licence.", "o minnow"]
    rows = [section(k / (SECTIONS - 1)) for k in range(SECTIONS)]
    vertices = [p for row in rows for p in row]
    snout = (0.0, 0.0, rows[0][0][2] + 0.0006)
    tail = (0.0, 0.0, sum(p[2] for p in rows[-1]) / SIDES)
    vertices += [snout, tail]
    for p in vertices:
        lines.append("v %.6f %.6f %.6f" % p)
    for p in vertices:
        lines.append("vt %.5f %.5f" % place_in_picture(p))
    faces = []
    for k in range(SECTIONS - 1):
        for i in range(SIDES):
            a, b = k * SIDES + i, k * SIDES + (i + 1) % SIDES
            faces += [(a, a + SIDES, b), (b, a + SIDES, b + SIDES)]
    first, last = len(vertices) - 2, len(vertices) - 1
    end = (SECTIONS - 1) * SIDES
    for i in range(SIDES):
        n = (i + 1) % SIDES
        faces += [(first, i, n), (last, end + n, end + i)]
    for f in faces:
        lines.append("f " + " ".join("%d/%d" % (v + 1, v + 1) for v in f))
    (HERE / "minnow.obj").write_text("\n".join(lines) + "\n", encoding="ascii")
    print("minnow.obj: %d vertices, %d triangles" % (len(vertices), len(faces)))


def colour(u, v):
    """sRGB of the flank."""
    y = LOW + v * (HIGH - LOW)
    _, back, belly = profile(min(max(u, 0.0), 1.0))
    up = y / back if y > 0 else y / belly  # -1 belly to 1 back
    grain = noise((90 * u, 55 * v, 0.5), 1)
    # overlapping scales: rows that are shifted against one another
    row = 46 * v
    shift = 0.5 if int(math.floor(row)) % 2 else 0.0
    sx, sy = (80 * u + shift) % 1 - 0.5, row % 1 - 0.5
    rim = smoothstep(0.34, 0.5, math.hypot(sx + 0.12, 0.8 * sy))
    silver = mix((0.66, 0.70, 0.70), (0.84, 0.87, 0.86), 0.5 + 0.5 * grain)
    c = mix((0.90, 0.89, 0.84), silver, smoothstep(-0.8, -0.25, up))
    c = mix(c, (0.42, 0.43, 0.25), smoothstep(0.18, 0.55, up))
    c = mix(c, (0.20, 0.22, 0.13), smoothstep(0.5, 1.0, up))
    body = smoothstep(0.13, 0.18, u) * (1 - smoothstep(0.80, 0.84, u)) * (1 - smoothstep(0.95, 1.1, abs(up)))
    c = scale(c, 1 - 0.22 * rim * body)
    # a dark stripe along the flank with a gold one above it, and blotches
    stripe = math.exp(-((up - 0.10 + 0.05 * noise((18 * u, 0.3, 2.0), 2)) / 0.13) ** 2)
    gold = math.exp(-((up - 0.34) / 0.10) ** 2)
    along = smoothstep(0.16, 0.26, u) * (1 - smoothstep(0.80, 0.86, u))
    c = mix(c, (0.78, 0.66, 0.30), 0.55 * gold * along)
    c = mix(c, (0.13, 0.14, 0.12), (0.62 + 0.2 * noise((30 * u, 3 * v, 4.0), 3)) * stripe * along)
    # fins: what stands out beyond the body, and the tail, with rays
    out = max(smoothstep(1.0, 1.12, abs(up)) * smoothstep(0.38, 0.40, u), smoothstep(0.83, 0.87, u))
    fan = math.sin(150 * math.atan2(v - 0.5, 0.30 + u - 0.80)) if u > 0.8 else math.sin(2 * math.pi * 62 * (u - 0.35 * abs(v - 0.5)))
    rays = mix((0.66, 0.62, 0.46), (0.42, 0.38, 0.24), 0.5 + 0.5 * fan)
    c = mix(c, rays, out)
    # the edge of the gill cover, the mouth and the eye
    gill = math.hypot((u - 0.115) / 0.055, (v - 0.48) / 0.22)
    if u > 0.10:
        c = mix(c, (0.25, 0.24, 0.18), 0.6 * math.exp(-((gill - 1) / 0.07) ** 2))
    if u < 0.028:
        c = mix(c, (0.25, 0.18, 0.14), 0.7 * math.exp(-((v - 0.475 + u) / 0.012) ** 2))
    eye = math.hypot((u - 0.062) * LENGTH, y - 0.0012)
    c = mix((0.86, 0.76, 0.38), c, smoothstep(0.0022, 0.0025, eye))
    c = mix((0.03, 0.03, 0.03), c, smoothstep(0.0012, 0.0015, eye))
    glint = math.hypot((u - 0.057) * LENGTH, y - 0.0019)
    return mix((1.0, 1.0, 1.0), c, smoothstep(0.0003, 0.0006, glint))


def write_picture():
    rows = []
    for j in range(HEIGHT):
        row = bytearray()
        for i in range(WIDTH):
            total = [0.0, 0.0, 0.0]
            for k in range(4):
                c = colour((i + 0.25 + 0.5 * (k % 2)) / WIDTH, 1 - (j + 0.25 + 0.5 * (k // 2)) / HEIGHT)
                total = [a + b / 4 for a, b in zip(total, c)]
            row += bytes([min(max(int(255 * x + 0.5), 0), 255) for x in total] + [255])
        rows.append(bytes(row))
    write_png(HERE / "minnow.png", WIDTH, rows, RGBA_8, srgb=True)
    print("minnow.png", (HERE / "minnow.png").stat().st_size, "bytes")


if __name__ == "__main__":
    write_mesh()
    write_picture()
