"""Makes snowfield.obj, fir.obj and fence.obj: a field under snow, 64 m by 64 m, a fir and a fence along a way.

snowfield.obj is a height field of 80 x 80 squares, a function of (x, z): a way that bends through low hills. fir.obj is
8 m tall at the origin: tiers of boughs, each a star of twigs that hang down, with snow on what faces up. fence.obj stands
on the field, on the right of the way.

Data: metres, Y up. Vertex colours in sRGB. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import quads, ticks  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import cross, mix, noise, normalize, scale, smoothstep, sub  # noqa: E402

HALF_SIZE = 32.0  # m
SQUARES = 80
SNOW = (0.93, 0.94, 0.97)
NEEDLES = (0.16, 0.25, 0.20)
TIERS, TWIGS = 15, 13


def way(z):
    """x of the way's middle."""
    return 0.8 + 3.0 * math.sin(0.11 * (z - 16)) * smoothstep(22, 2, z)


def height(x, z):
    hills = 1.5 * noise((0.055 * x + 2, 0.5, 0.055 * z), 1) + 0.35 * noise((0.19 * x, 0.5, 0.19 * z), 2)
    drifts = 0.05 * noise((0.8 * x, 0.5, 0.5 * z), 3)
    away = abs(x - way(z))
    level = 0.25 * noise((0.5, 0.5, 0.07 * z), 4)
    flat = smoothstep(5.5, 0.8, away)
    rut = 0.05 * (smoothstep(0.25, 0.1, abs(away - 0.75)) + smoothstep(1.6, 1.2, away))
    return mix((hills * 0.8 + 0.25,), (level,), flat)[0] + drifts - rut


def ground_colour(p, n):
    x, _, z = p
    worn = 0.3 * smoothstep(0.35, 0.1, abs(abs(x - way(z)) - 0.75))
    return scale(mix(SNOW, (0.72, 0.74, 0.80), worn), 1 + 0.02 * noise((x, 4.5, z), 5))


def write_field():
    obj = ObjWriter(["A field under snow, by make_snowfield.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("snowfield")
    uv = obj.uv(0, 0)
    obj.join(obj.add_grid(ticks(HALF_SIZE, SQUARES), height, 0.2, ground_colour), uv, flip=True)
    obj.save(HERE / "snowfield.obj")


def bough(tier, side, along):
    """A point of a tier: `along` 0 at the trunk, 1 at the tips, which alternate with the gaps between twigs."""
    up = tier / (TIERS - 1)
    reach = (2.1 * (1 - up) ** 0.9 + 0.14) * (1 + 0.16 * noise((3.1 * tier, 0.7 * side, 0.5), 6))
    reach *= 1.0 if side % 2 == 0 else 0.68
    angle = 2 * math.pi * (side + 0.5 * (tier % 2) + 0.3 * noise((tier, side, 2.5), 7)) / (2 * TWIGS) + 0.7 * tier
    r = reach * along
    y = 0.9 + 6.9 * up ** 0.94 + 0.32 * (1 - up) - 0.62 * r * (0.5 + 0.5 * along) / (1 + 0.15 * r)
    if side % 2:
        y -= 0.1 * along * (1 - 0.6 * up)
    return (r * math.cos(angle), y, r * math.sin(angle))


def write_fir():
    obj = ObjWriter(["A fir under snow, by make_snowfield.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("fir")
    uv = obj.uv(0, 0)
    sides, steps = 2 * TWIGS, 5
    for tier in range(TIERS):
        for below in (False, True):
            rows = []
            for step in range(steps + 1):
                along = step / steps
                row = []
                for side in range(sides):
                    p = bough(tier, side, along)
                    snow = smoothstep(-0.55, 0.25, noise((2.3 * p[0], 2.3 * p[1], 2.3 * p[2]), 8) + 0.55 - 0.9 * along ** 3)
                    colour = scale(NEEDLES, 0.35 + 0.4 * along) if below else mix(NEEDLES, SNOW, snow)
                    a, b = bough(tier, side + 1, max(along, 0.15)), bough(tier, side - 1, max(along, 0.15))
                    c, d = bough(tier, side, along + 0.1), bough(tier, side, max(along, 0.1) - 0.1)
                    n = normalize(cross(sub(a, b), sub(c, d)))
                    if n[1] < 0:
                        n = scale(n, -1)
                    if below:
                        p, n = (p[0], p[1] - 0.03 * (1 - along), p[2]), scale(n, -1)
                    row.append(obj.add_vertex(p, n, colour))
                rows.append(row)
            for a, b, c, d in quads(rows, closed=True):
                obj.add_triangles(((c, b, a), (d, c, a)) if below else ((a, b, c), (a, c, d)), uv)
    rows = []
    for y, r in ((-0.5, 0.2), (0.8, 0.15), (4.0, 0.08)):
        rows.append([obj.add_vertex((r * math.cos(k * math.pi / 5), y, r * math.sin(k * math.pi / 5)),
                                    (math.cos(k * math.pi / 5), 0, math.sin(k * math.pi / 5)), (0.27, 0.21, 0.17))
                     for k in range(10)])
    obj.join(rows, uv, closed=True, flip=True)
    obj.save(HERE / "fir.obj")


def beam(obj, uv, start, end, wide, tall, colour, top):
    """A beam from start to end, its top in a colour of its own."""
    along = normalize(sub(end, start))
    across = normalize(cross((0, 1, 0) if abs(along[1]) < 0.9 else (0, 0, 1), along))
    up = cross(along, across)
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]

    def at(end_of, corner):
        return tuple(end_of[i] + across[i] * wide / 2 * corner[0] + up[i] * tall / 2 * corner[1] for i in range(3))

    def face(points, n, tone):
        obj.add_quad(*[obj.add_vertex(p, n, tone) for p in points], uv)

    for a, b in zip(corners, corners[1:] + corners[:1]):
        n = normalize(tuple(across[i] * (a[0] + b[0]) + up[i] * (a[1] + b[1]) for i in range(3)))
        face([at(start, a), at(end, a), at(end, b), at(start, b)], n, top if n[1] > 0.7 else colour)
    face([at(end, c) for c in corners], along, top if along[1] > 0.7 else colour)


def write_fence():
    obj = ObjWriter(["A fence under snow, by make_snowfield.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("fence")
    uv = obj.uv(0, 0)
    places = [(way(z) + 2.3 + 0.1 * noise((z, 0.5, 0.5), 9), z) for z in [20.5 - 2.2 * k for k in range(15)]]
    for i, (x, z) in enumerate(places):
        tone = 1 + 0.15 * noise((3.3 * i, 0.5, 0.5), 10)
        wood = scale((0.36, 0.30, 0.25), tone)
        foot = height(x, z)
        lean = 0.05 * noise((i, 0.5, 7.5), 11)
        beam(obj, uv, (x, foot - 0.3, z), (x + lean, foot + 1.12, z), 0.13, 0.13, wood, SNOW)
        beam(obj, uv, (x + lean, foot + 1.1, z), (x + lean, foot + 1.22, z), 0.18, 0.18, SNOW, SNOW)
        if i + 1 == len(places):
            break
        nx, nz = places[i + 1]
        for level in (0.45, 0.92):
            a, b = (x - 0.08, foot + level, z + 0.12), (nx - 0.08, height(nx, nz) + level, nz - 0.12)
            beam(obj, uv, a, b, 0.05, 0.12, wood, SNOW)
            lift = (0, 0.085, 0)
            beam(obj, uv, tuple(map(sum, zip(a, lift))), tuple(map(sum, zip(b, lift))), 0.07, 0.06, SNOW, SNOW)
    obj.save(HERE / "fence.obj")


if __name__ == "__main__":
    write_field()
    write_fir()
    write_fence()
