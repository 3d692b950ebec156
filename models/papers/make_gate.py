"""Makes gate.obj: a ring of stones that stands on a round dais between two fire bowls, at night, for kapoulkine.scene.json.

The light of what burns there is in the vertex colours, as in fire/make_campfire.py: that of the ring's inside (blue, from
points round it) and of the two bowls (orange), which falls with the square of the distance, times what the surface gives
back. The scene's model `color` says how much brighter that is than the sky's light.

Data: metres, Y up, the ground near y = 0, out to REACH; the ring stands in the plane z = 0. Vertex colours in sRGB, 1 being
BRIGHTEST. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import on_surface, quads  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import add, light_at, mix, noise, normalize, scale, smoothstep, to_srgb  # noqa: E402

CENTRE, RADIUS = (0.0, 1.85, 0.0), 1.3  # m, of the ring
BOWLS = [(-2.35, 1.12, 0.75), (2.35, 1.12, 0.75)]  # m, where the flames stand
BLUE, ORANGE = (0.16, 0.42, 1.0), (1.0, 0.36, 0.08)  # linear
BRIGHTEST = 1.2  # linear
REACH = 11.0  # m
BLOCKS = 18

LIGHTS = [(add(CENTRE, (0.6 * RADIUS * math.cos(a), 0.6 * RADIUS * math.sin(a), 0.0)), BLUE, 0.16)
          for a in (2 * math.pi * k / 6 for k in range(6))]
LIGHTS += [(add(bowl, (0.0, 0.3, 0.0)), ORANGE, 0.42) for bowl in BOWLS]


def lit(albedo, p, n, glow=(0.0, 0.0, 0.0)):
    """Linear albedo to the vertex colour in sRGB."""
    total = (0.006, 0.008, 0.014)
    for place, colour, strength in LIGHTS:
        total = add(total, scale(colour, strength * light_at(p, n, place, nearest=0.25, rim=0.2)))
    return to_srgb((albedo[i] * total[i] + glow[i]) / BRIGHTEST for i in range(3))


def stone(p, seed, light=0.34):
    tone = noise((2.3 * p[0], 2.3 * p[1], 2.3 * p[2]), seed) + 0.6 * noise((8 * p[0], 8 * p[1], 8 * p[2]), seed + 1)
    grey = light * (1 + 0.28 * tone)
    return (grey, 0.97 * grey, 0.92 * grey)


def ground_height(x, z):
    r = math.hypot(x, z)
    h = 0.18 * smoothstep(2.02, 1.96, r) + 0.18 * smoothstep(1.62, 1.56, r)
    # Slabs of the dais, and worn paving about it.
    turn = math.atan2(z, x)
    joint = min(abs(math.sin(9 * turn)) * r * 0.11, 1.0)
    h -= 0.025 * smoothstep(0.035, 0.0, joint) * smoothstep(0.5, 0.6, r) * smoothstep(4.0, 3.0, r)
    for ring in (0.9, 1.27, 2.6, 3.3):
        h -= 0.025 * smoothstep(0.035, 0.0, abs(r - ring))
    h += 0.012 * noise((5 * x, 0.5, 5 * z), 1)
    rough = 0.10 * noise((0.9 * x, 0.5, 0.9 * z), 2) + 0.05 * noise((2.6 * x, 0.5, 2.6 * z), 3)
    return h + (rough + 0.1) * smoothstep(3.2, 4.6, r) + 0.8 * smoothstep(6, 11, r) * (1 + noise((0.3 * x, 0.5, 0.3 * z), 4))


def write_ground(obj, uv):
    obj.begin_object("ground")
    sides = 144
    radii = [0.05 + 0.075 * i for i in range(46)]
    while radii[-1] < REACH:
        radii.append(radii[-1] * 1.045 + 0.02)
    rows = []
    for r in radii:
        row = []
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            x, z = r * math.cos(angle), r * math.sin(angle)
            p, n = on_surface(ground_height, x, z, 0.02)
            albedo = stone(p, 5, 0.30)
            tone = noise((2.2 * x, 2.5, 2.2 * z), 7) + 0.5 * noise((7 * x, 2.5, 7 * z), 8)
            grass = mix((0.08, 0.12, 0.05), (0.17, 0.2, 0.08), 0.5 + 0.4 * tone)
            albedo = mix(albedo, grass, smoothstep(2.9, 4.2, r + 0.5 * tone))
            row.append(obj.add_vertex(p, n, lit(albedo, p, n)))
        rows.append(row)
    join(obj, uv, rows)


def write_ring(obj, uv):
    """Blocks, each a bent box with rounded edges; a groove that glows runs along their front."""
    obj.begin_object("ring")
    steps, around = 9, 28
    for k in range(BLOCKS):
        size = 1 + 0.10 * noise((k, 0.5, 0.5), 9)
        start = 2 * math.pi * (k + 0.03) / BLOCKS - 0.5 * math.pi
        end = 2 * math.pi * (k + 0.97) / BLOCKS - 0.5 * math.pi
        rows = []
        for step in range(-1, steps + 2):
            t = min(max(step / steps, 0.0), 1.0)
            angle = start + (end - start) * t
            out = (math.cos(angle), math.sin(angle), 0.0)
            middle = add(CENTRE, scale(out, RADIUS + 0.17 + 0.02 * (size - 1)))
            cap = step < 0 or step > steps
            bevel = 0.9 if t in (0.0, 1.0) else 1.0
            row = []
            for side in range(around):
                a = 2 * math.pi * side / around
                c, s = math.cos(a), math.sin(a)
                # A superellipse: nearly a rectangle.
                u = math.copysign(abs(c) ** 0.35, c) * 0.19 * size
                v = math.copysign(abs(s) ** 0.35, s) * 0.24 * size
                flat = bevel * (0.0 if cap else 1.0)
                p = add(middle, add(scale(out, u * flat), (0, 0, v * flat)))
                n = normalize(add(scale(out, math.copysign(abs(c) ** 1.65, c)), (0, 0, math.copysign(abs(s) ** 1.65, s))))
                if cap:
                    along = (-out[1], out[0], 0.0)
                    n = scale(along, -1 if step < 0 else 1)
                p = add(p, scale(n, 0.012 * noise((6 * p[0], 6 * p[1], 6 * p[2]), 10)))
                rune = 0.0
                if s > 0 and abs(c) < 0.9 and not cap:
                    line = noise((26 * u + 5 * k, 13 * t, k), 11)
                    rune = smoothstep(0.16, 0.02, abs(line)) * smoothstep(0.15, 0.25, t) * smoothstep(0.85, 0.75, t) \
                        * smoothstep(0.13, 0.10, abs(u))
                row.append(obj.add_vertex(p, n, lit(stone(p, 12, 0.36), p, n, scale((0.10, 0.42, 1.0), 0.9 * rune))))
            rows.append(row)
        join(obj, uv, rows)


def write_bowls(obj, uv):
    profile = [(0.0, 0.0), (0.34, 0.0), (0.35, 0.10), (0.27, 0.14), (0.20, 0.18), (0.16, 0.30), (0.15, 0.62), (0.18, 0.74),
               (0.24, 0.80), (0.36, 0.92), (0.44, 1.08), (0.45, 1.13), (0.41, 1.13), (0.36, 1.05), (0.2, 0.98), (0.0, 0.96)]
    sides = 40
    for index, bowl in enumerate(BOWLS):
        obj.begin_object("bowl %d" % (index + 1))
        rows = []
        for i, (r, y) in enumerate(profile):
            before, after = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
            n2 = normalize((after[1] - before[1], before[0] - after[0], 0.0))
            row = []
            for side in range(sides):
                a = 2 * math.pi * side / sides
                n = (n2[0] * math.cos(a), n2[1], n2[0] * math.sin(a))
                p = (bowl[0] + r * math.cos(a), y + 0.02, bowl[2] + r * math.sin(a))
                inside = i >= 12
                ember = smoothstep(-0.1, 0.6, noise((17 * p[0], 0.5, 17 * p[2]), 13)) if inside else 0.0
                albedo = (0.05, 0.045, 0.04) if inside else stone(p, 14, 0.26)
                row.append(obj.add_vertex(p, n, lit(albedo, p, n, scale((1.0, 0.24, 0.03), 0.7 * ember))))
            rows.append(row)
        join(obj, uv, rows)


def write_pillars(obj, uv):
    """Broken pillars that stand about in the dark."""
    obj.begin_object("pillars")
    sides = 28
    for k, (x, z, height) in enumerate([(-4.1, -1.6, 2.9), (4.2, -1.4, 1.5), (-3.0, -4.2, 3.6), (3.2, -4.4, 3.3), (-5.0, 2.0, 0.8)]):
        rows = []
        for i in range(17):
            t = i / 15
            row = []
            for side in range(sides):
                a = 2 * math.pi * side / sides
                flute = 1 - 0.05 * abs(math.sin(7 * a))
                broken = 0.25 * noise((math.cos(a) + k, math.sin(a), 0.5), 15) * (t > 0.9)
                r = (0.0 if i == 16 else (0.36 if t < 0.04 else 0.27) * flute * (1 - 0.08 * t))
                p = (x + r * math.cos(a), min(t, 1.0) * height + broken, z + r * math.sin(a))
                n = (math.cos(a), 0.0, math.sin(a)) if i < 15 else (0.0, 1.0, 0.0)
                row.append(obj.add_vertex(p, n, lit(stone(p, 16, 0.33), p, n)))
            rows.append(row)
        join(obj, uv, rows)


def join(obj, uv, rings):
    """As ObjWriter.join with flip, but a face's two triangles come in the other order."""
    for a, b, c, d in quads(rings, closed=True):
        obj.add_triangles(((a, c, b), (a, d, c)), uv)


def main():
    obj = ObjWriter(["A gate of stones, by make_gate.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    uv = obj.uv(0, 0)
    write_ground(obj, uv)
    write_ring(obj, uv)
    write_bowls(obj, uv)
    write_pillars(obj, uv)
    obj.save(HERE / "gate.obj")


if __name__ == "__main__":
    main()
