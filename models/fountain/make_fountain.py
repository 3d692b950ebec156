"""Makes fountain.obj and water.obj: a round stone basin on a paved square, a stem in its middle, and its water.

fountain.obj is a height field, for drops to land in: within the basin its surface lies just below the water's, which
hides it. A profile of (radius, height) is turned about the y axis; the paving around it is a square.

Data: metres, Y up, the paving's top at y = 0.06, the water's at WATER, the stem's at NOZZLE. Vertex colours in sRGB. Same
bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import on_surface  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import cross, mix, noise, normalize, scale, smoothstep, sub  # noqa: E402

SIDES = 96
HALF_SIZE = 2.1  # m, of the paving
PAVING, WATER, NOZZLE = 0.06, 0.42, 1.02
INSIDE = 1.42  # m, the wall's inner radius

# From the nozzle down the stem, under the water, over the wall and out onto the paving.
STEM = [(0.0, 1.0), (0.03, 1.0), (0.035, NOZZLE), (0.05, NOZZLE), (0.055, 0.98), (0.07, 0.95), (0.1, 0.93), (0.3, 0.98),
        (0.33, 0.985), (0.34, 0.97), (0.33, 0.955), (0.12, 0.87), (0.085, 0.83), (0.08, 0.75), (0.10, 0.66), (0.13, 0.60),
        (0.13, 0.57), (0.17, 0.55), (0.19, 0.50), (0.2, WATER - 0.012)]
WALL = [(INSIDE, WATER - 0.012), (INSIDE + 0.005, 0.48), (INSIDE - 0.02, 0.50), (INSIDE - 0.03, 0.53), (INSIDE - 0.02, 0.555),
        (INSIDE + 0.02, 0.565), (INSIDE + 0.2, 0.565), (INSIDE + 0.235, 0.555), (INSIDE + 0.245, 0.53), (INSIDE + 0.23, 0.50),
        (INSIDE + 0.2, 0.485), (INSIDE + 0.18, 0.45), (INSIDE + 0.18, 0.16), (INSIDE + 0.21, 0.13), (INSIDE + 0.25, 0.12),
        (INSIDE + 0.26, PAVING)]


def stone(p, joint):
    """Limestone: patches, and where water stands a greener tone."""
    tone = noise((2.1 * p[0], 2.1 * p[1], 2.1 * p[2]), 1) + 0.5 * noise((6 * p[0], 6 * p[1], 6 * p[2]), 2)
    colour = mix((0.60, 0.57, 0.51), (0.74, 0.71, 0.64), 0.5 + 0.4 * tone)
    radius = math.hypot(p[0], p[2])
    wet = smoothstep(0.16, 0.0, abs(p[1] - WATER)) if radius < INSIDE + 0.02 else 0.0
    wet = max(wet, 0.6 * smoothstep(0.14, 0.04, p[1] - PAVING) * smoothstep(0.2, 0.0, abs(radius - INSIDE - 0.25)))
    colour = mix(colour, (0.36, 0.40, 0.30), wet * (0.7 + 0.3 * tone))
    return scale(colour, 0.72 if joint else 1.0)


def turned(obj, profile, uv, joints):
    rows = []
    for i, (r, y) in enumerate(profile):
        before, after = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        across = normalize((before[1] - after[1], after[0] - before[0], 0.0))
        row = []
        for side in range(SIDES):
            angle = 2 * math.pi * side / SIDES
            c, s = math.cos(angle), math.sin(angle)
            p = (r * c, y, r * s)
            row.append(obj.add_vertex(p, (across[0] * c, across[1], across[0] * s), stone(p, joints and side % 8 == 0)))
        rows.append(row)
    obj.join(rows, uv, closed=True)


def write_fountain():
    obj = ObjWriter(["A fountain, by make_fountain.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("fountain")
    uv = obj.uv(0, 0)
    turned(obj, STEM, uv, False)
    turned(obj, [(0.2, WATER - 0.012), (INSIDE, WATER - 0.012)], uv, False)
    turned(obj, WALL, uv, True)
    write_paving(obj, uv)
    obj.save(HERE / "fountain.obj")


def write_paving(obj, uv):
    """Slabs with joints between them, and a skirt that goes into the ground."""
    slabs, edge = 7, 0.012
    size = 2 * HALF_SIZE / slabs
    ticks = []
    for k in range(slabs):
        start = -HALF_SIZE + k * size
        ticks += [(start, True), (start + edge, False), (start + size - edge, False)]
    ticks.append((HALF_SIZE, True))
    rows = []
    for z, jointed_z in ticks:
        row = []
        for x, jointed_x in ticks:
            slab = (math.floor((x + HALF_SIZE - 1e-6) / size), math.floor((z + HALF_SIZE - 1e-6) / size))
            joint = jointed_x or jointed_z
            tone = 0.9 + 0.1 * noise((3.7 * slab[0], 0.5, 5.3 * slab[1]), 5)
            p = (x, PAVING - (0.008 if joint else 0.0), z)
            row.append(obj.add_vertex(p, (0, 1, 0), scale(stone(p, joint), tone)))
        rows.append(row)
    obj.join(rows, uv, flip=True)
    corners = [(-1, -1), (-1, 1), (1, 1), (1, -1)]
    for (ax, az), (bx, bz) in zip(corners, corners[1:] + corners[:1]):
        top, bottom = PAVING - 0.008, -0.4
        points = [(HALF_SIZE * ax, top, HALF_SIZE * az), (HALF_SIZE * bx, top, HALF_SIZE * bz),
                  (HALF_SIZE * bx, bottom, HALF_SIZE * bz), (HALF_SIZE * ax, bottom, HALF_SIZE * az)]
        n = normalize(cross(sub(points[2], points[0]), sub(points[1], points[0])))
        v = [obj.add_vertex(p, n, scale(stone(p, True), 0.9)) for p in points]
        obj.add_triangles(((v[0], v[2], v[1]), (v[0], v[3], v[2])), uv)


def ripples(x, z):
    """Height above WATER: rings that run out from where the drops fall, smaller towards the wall."""
    r = math.hypot(x, z)
    fade = smoothstep(0.15, 0.35, r) * smoothstep(INSIDE, 0.6, r)
    ring = math.sin(26 * r + 2.5 * noise((2 * x, 0.5, 2 * z), 9))
    return 0.004 * fade * ring + 0.005 * noise((7 * x, 0.5, 7 * z), 10) + 0.0025 * noise((17 * x, 0.5, 17 * z), 11)


def write_water():
    obj = ObjWriter(["A fountain's water, by make_fountain.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("water")
    uv = obj.uv(0, 0)
    rings, sides = 44, 72
    rows = []
    for ring in range(rings + 1):
        r = 0.12 + (INSIDE + 0.003 - 0.12) * ring / rings
        row = []
        for side in range(sides):
            angle = 2 * math.pi * (side + 0.5 * (ring % 2)) / sides
            (x, y, z), n = on_surface(ripples, r * math.cos(angle), r * math.sin(angle), 0.01)
            colour = mix((0.34, 0.43, 0.38), (0.20, 0.36, 0.38), smoothstep(INSIDE, INSIDE - 0.3, r))
            row.append(obj.add_vertex((x, WATER + y, z), n, colour))
        rows.append(row)
    obj.join(rows, uv, closed=True)
    obj.save(HERE / "water.obj")


if __name__ == "__main__":
    write_fountain()
    write_water()
