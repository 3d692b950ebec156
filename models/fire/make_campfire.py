"""Makes campfire.obj: logs that lean on one another, stones around them, and the ground, lit by a fire in their middle.

The fire's light is in the vertex colours: that of a point at FIRE, which falls with the square of the distance and with
the angle, times what the surface gives back; bark near it is charred, with embers in its cracks. Meant for a night: the
scene's model `color` says how much brighter than the sky's light the fire is.

Data: metres, Y up, the ground near y = 0, out to REACH. Vertex colours in sRGB, 1 being BRIGHTEST. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import on_surface  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import (add, cross, distance, dot, light_at, mix, noise, normalize, perpendicular, scale,  # noqa: E402
                     smoothstep, sub, to_srgb)

FIRE = (0.0, 0.42, 0.0)  # m
LIGHT = (1.0, 0.40, 0.12)  # linear, of a surface 0.6 m away that faces it
BRIGHTEST = 1.4  # linear
REACH = 9.0  # m
LOGS, STONES = 7, 13


def lit(albedo, p, n, glow=0.0):
    """Linear albedo to the vertex colour in sRGB."""
    light = scale(LIGHT, 0.36 * light_at(p, n, FIRE, nearest=0.18, rim=0.25))
    moon = (0.010, 0.012, 0.016)
    total = (albedo[i] * (light[i] + moon[i]) + glow * (1.3, 0.22, 0.02)[i] for i in range(3))
    return to_srgb(c / BRIGHTEST for c in total)


def height(x, z):
    r = math.hypot(x, z)
    bumps = 0.03 * noise((1.7 * x, 0.5, 1.7 * z), 1) + 0.012 * noise((6 * x, 0.5, 6 * z), 2)
    return bumps * smoothstep(0.2, 1.2, r) + 0.05 * smoothstep(2, 8, r) * noise((0.5 * x, 0.5, 0.5 * z), 3) \
        + 0.03 * smoothstep(0.4, 0.0, r)


def write_ground(obj, uv):
    obj.begin_object("ground")
    rings, sides = 70, 96
    rows = []
    for ring in range(rings + 1):
        r = REACH * (ring / rings) ** 2
        row = []
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            x, z = r * math.cos(angle), r * math.sin(angle)
            p, n = on_surface(height, x, z, 0.03)
            tone = noise((2.2 * x, 2.5, 2.2 * z), 4) + 0.6 * noise((7 * x, 2.5, 7 * z), 5)
            soil = mix((0.13, 0.10, 0.07), (0.24, 0.19, 0.13), 0.5 + 0.4 * tone)
            grass = mix((0.08, 0.11, 0.04), (0.15, 0.17, 0.06), 0.5 + 0.4 * tone)
            albedo = mix(soil, grass, smoothstep(0.9, 1.8, r + 0.35 * tone))
            ash = smoothstep(0.5, 0.2, r + 0.1 * tone)
            albedo = mix(albedo, (0.10, 0.095, 0.09), ash)
            ember = smoothstep(0.30, 0.05, r) * smoothstep(0.1, 0.7, noise((25 * x, 0.5, 25 * z), 6) + 0.25)
            # The stones keep the light low down from what lies right behind them.
            shade = 1 - 0.55 * smoothstep(0.5, 0.62, r) * smoothstep(1.5, 0.7, r)
            row.append(obj.add_vertex(p, n, lit(scale(albedo, shade), p, n, 0.8 * ember)))
        rows.append(row)
    obj.join(rows, uv, closed=True)


def write_logs(obj, uv):
    obj.begin_object("logs")
    for k in range(LOGS):
        turn = 2 * math.pi * (k + 0.3 * noise((k, 0.5, 0.5), 7)) / LOGS
        out = (math.cos(turn), 0.0, math.sin(turn))
        side = (-out[2], 0.0, out[0])
        foot = add(scale(out, 0.42 + 0.05 * noise((k, 1.5, 0.5), 8)), (0, 0.03, 0))
        top = add(add(scale(out, -0.07), scale(side, 0.05)), (0, 0.50 + 0.08 * noise((k, 2.5, 0.5), 9), 0))
        log(obj, uv, foot, top, 0.045 + 0.012 * noise((k, 3.5, 0.5), 10), k)
    # Two that have burnt through and lie.
    log(obj, uv, (-0.34, 0.05, 0.20), (0.22, 0.06, 0.30), 0.05, 11)
    log(obj, uv, (0.10, 0.045, -0.34), (0.40, 0.06, 0.10), 0.042, 12)


def log(obj, uv, start, end, radius, seed):
    along = normalize(sub(end, start))
    a = perpendicular(along)
    b = cross(along, a)
    steps, sides = 22, 18
    rows = []
    for step in range(-1, steps + 2):
        t = min(max(step / steps, 0.0), 1.0)
        middle = add(start, scale(sub(end, start), t))
        bend = scale(a, 0.03 * math.sin(3 * t + seed))
        row = []
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            n = add(scale(a, math.cos(angle)), scale(b, math.sin(angle)))
            ridge = noise((3 * math.cos(angle) + seed, 9 * t, 3 * math.sin(angle)), 12)
            r = radius * (1 + 0.10 * ridge) * (1 - 0.15 * t)
            at_end = step < 0 or step > steps
            p = add(add(middle, bend), scale(n, 0.0 if at_end else r))
            if at_end:
                n = scale(along, -1 if step < 0 else 1)
            near = smoothstep(0.36, 0.12, distance(p, (0, 0.25, 0)))
            bark = mix((0.13, 0.085, 0.05), (0.24, 0.16, 0.10), 0.5 + 0.5 * ridge)
            if at_end or step in (0, steps):
                bark = (0.42, 0.30, 0.17)
            albedo = mix(bark, (0.03, 0.028, 0.026), near)
            crack = smoothstep(0.15, 0.75, noise((38 * p[0], 38 * p[1], 38 * p[2]), 13))
            row.append(obj.add_vertex(p, n, lit(albedo, p, n, near * crack)))
        rows.append(row)
    obj.join(rows, uv, closed=True)


def write_stones(obj, uv):
    obj.begin_object("stones")
    rings, sides = 12, 18
    for k in range(STONES):
        turn = 2 * math.pi * (k + 0.25 * noise((k, 4.5, 0.5), 14)) / STONES
        away = 0.62 + 0.03 * noise((k, 5.5, 0.5), 15)
        size = 0.115 + 0.03 * noise((k, 6.5, 0.5), 16)
        middle = (away * math.cos(turn), 0.45 * size, away * math.sin(turn))

        def point(theta, phi):
            d = (math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi))
            bump = 1 + 0.20 * noise((1.6 * d[0] + 3 * k, 1.6 * d[1], 1.6 * d[2]), 17) \
                + 0.05 * noise((5 * d[0] + 3 * k, 5 * d[1], 5 * d[2]), 18)
            return add(middle, (d[0] * size * bump, 0.8 * d[1] * size * bump, d[2] * size * bump))

        grey = 0.20 + 0.06 * noise((k, 7.5, 0.5), 19)
        rows = []
        for ring in range(rings + 1):
            theta = math.pi * min(max(ring / rings, 0.001), 0.999)
            row = []
            for side in range(sides):
                phi = 2 * math.pi * side / sides
                p, e = point(theta, phi), 0.02
                n = normalize(cross(sub(point(theta, phi + e), point(theta, phi - e)),
                                    sub(point(theta + e, phi), point(theta - e, phi))))
                if dot(n, sub(p, middle)) < 0:
                    n = scale(n, -1)
                tone = grey * (1 + 0.2 * noise((20 * p[0], 20 * p[1], 20 * p[2]), 20))
                soot = 1 - 0.5 * smoothstep(0.62, 0.5, math.hypot(p[0], p[2]))
                row.append(obj.add_vertex(p, n, lit(scale((tone, 0.96 * tone, 0.9 * tone), soot), p, n)))
            rows.append(row)
        obj.join(rows, uv, closed=True)


def main():
    obj = ObjWriter(["A campfire, by make_campfire.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    uv = obj.uv(0, 0)
    write_ground(obj, uv)
    write_logs(obj, uv)
    write_stones(obj, uv)
    obj.save(HERE / "campfire.obj")


if __name__ == "__main__":
    main()
