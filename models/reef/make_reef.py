"""Makes reef.obj, coral.obj and seabed.obj: rocks with an arch, what grows on them, and rippled sand around them.

reef.obj: closed shells that overlap, as a distance field wants them; spheres and a bent tube pushed about by noise.
coral.obj: heads, branches, plates, fans and sponges, each an object, to be drawn only. seabed.obj: sand, 24 m by 24 m, a
function of (x, z), for a height field; its squares are smallest in the middle, where the ripples are.

Data: metres, Y up, the sand near y = 0. Vertex colours in sRGB. Same bytes every run.
"""

import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import shell, sphere  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import (add, catmull_rom, cross, dot, mix, noise, normalize, perpendicular, scale,  # noqa: E402
                     smoothstep, sub)

# middle, radii, seed, sides and rings
ROCKS = [((3.7, 0.7, -2.4), (1.45, 2.7, 1.4), 4, (58, 38)), ((5.9, 0.5, -4.6), (2.3, 4.2, 2.0), 5, (56, 36)),
         ((-3.9, 0.1, -1.3), (1.6, 1.35, 1.35), 8, (46, 28)), ((-6.3, 0.4, -4.4), (2.2, 2.7, 2.0), 16, (46, 28)),
         ((1.6, -0.15, -3.4), (1.5, 0.95, 1.2), 21, (44, 24)), ((-2.5, -0.05, 3.0), (0.95, 0.62, 0.75), 34, (36, 22)),
         ((2.75, -0.08, 2.6), (0.85, 0.5, 0.7), 55, (36, 20))]
ARCH = [(-5.0, -0.5, -2.9), (-4.7, 1.3, -3.0), (-3.7, 2.75, -3.2), (-2.3, 3.1, -3.5), (-1.1, 2.2, -3.6), (-0.7, 0.7, -3.5),
        (-0.6, -0.6, -3.4)]
ARCH_RADIUS, ARCH_SIDES, ARCH_RINGS = 0.62, 24, 44

SAND_HALF, SAND_SQUARES = 12.0, 84

ROCK, DARK, PINK, ALGAE = (0.50, 0.45, 0.42), (0.27, 0.25, 0.28), (0.62, 0.38, 0.47), (0.42, 0.47, 0.26)
SAND_LIGHT, SAND_DARK = (0.74, 0.68, 0.55), (0.60, 0.54, 0.43)


def rugged(p, seed):
    """Pushes of a rock's surface, as shares of its radius: shoulders, ledges and pits."""
    wide = 0.28 * noise(scale(p, 1.3), seed)
    ledges = 0.12 * (1 - 2 * abs(noise((p[0] * 2.4, p[1] * 3.6, p[2] * 2.4), seed + 1)))
    pits = -0.06 * smoothstep(0.25, 0.7, noise(scale(p, 5), seed + 2))
    return wide + ledges + pits + 0.045 * noise(scale(p, 9), seed + 3)


class Boulder:
    def __init__(self, middle, radii, seed, grid):
        self.middle, self.radii, self.seed, self.grid = middle, radii, seed, grid

    def point(self, n):
        x, y, z = add(self.middle, tuple(c * r * (1 + rugged(n, self.seed)) for c, r in zip(n, self.radii)))
        return x, max(y, -0.9 + 0.5 * (y + 0.9)), z  # flat below the sand

    def mesh(self):
        directions, triangles = sphere(*self.grid)
        return [self.point(n) for n in directions], triangles


def spline(points, t):
    """Catmull-Rom; t from 0 to 1."""
    t *= len(points) - 1
    i = min(int(t), len(points) - 2)
    return catmull_rom(points, i, t - i)


def tube(path, radius, sides, rings, round_ends=True):
    """A closed tube along path(t), of radius(t, angle), t from 0 to 1."""
    positions = [path(0.0)]
    across = None
    for ring in range(rings):
        t = (ring + 0.5) / rings if not round_ends else 0.5 - 0.5 * math.cos(math.pi * (ring + 0.5) / rings)
        along = normalize(sub(path(min(t + 0.01, 1.0)), path(max(t - 0.01, 0.0))))
        if across is None:
            across = perpendicular(along)
        across = normalize(sub(across, scale(along, dot(across, along))))
        other = cross(along, across)
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            r = radius(t, angle)
            positions.append(add(path(t), add(scale(across, -r * math.cos(angle)), scale(other, r * math.sin(angle)))))
    positions.append(path(1.0))
    return positions, shell(sides, rings)


def arch():
    def radius(t, angle):
        p = add(spline(ARCH, t), (0.7 * math.cos(angle), 0.0, 0.7 * math.sin(angle)))
        return ARCH_RADIUS * (1 + 0.9 * rugged(scale(p, 0.8), 89)) * (1 + 0.75 * (2 * abs(t - 0.5)) ** 2)

    return tube(lambda t: spline(ARCH, t), radius, ARCH_SIDES, ARCH_RINGS, round_ends=False)


def rock_colour(p, n):
    """Limestone, dark in its hollows and below; crusts of pink algae, green ones on what faces up."""
    stone = mix(DARK, ROCK, 0.5 + 0.5 * noise(scale(p, 2.1), 61))
    stone = mix(stone, DARK, 0.6 * smoothstep(0.1, -0.7, n[1]))
    stone = mix(stone, PINK, 0.85 * smoothstep(0.12, 0.45, noise(scale(p, 1.7), 62) + 0.25 * noise(scale(p, 7), 63)))
    green = smoothstep(0.3, 0.8, n[1]) * smoothstep(-0.25, 0.3, noise(scale(p, 1.3), 64))
    return scale(mix(stone, ALGAE, 0.7 * green), 1 + 0.18 * noise(scale(p, 11), 65))


# ---- Corals

def head(base, up, size, seed):
    """A brain coral: half a ball with winding ridges."""
    sides, rings = (26, 11) if size > 0.2 else (16, 7)
    side_way = perpendicular(up)
    other = cross(up, side_way)
    positions, triangles = [add(base, scale(up, size * 0.8))], shell(sides, rings)
    for ring in range(rings):
        polar = 0.6 * math.pi * (ring + 1) / rings
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            n = (math.sin(polar) * math.cos(angle), math.cos(polar), math.sin(polar) * math.sin(angle))
            q = scale(n, 3.2)
            winding = math.sin(9 * noise(q, seed) + 5 * noise(scale(q, 0.6), seed + 1))
            r = size * (1 + 0.05 * winding + 0.12 * noise(scale(n, 1.4), seed + 2))
            positions.append(add(base, add(scale(side_way, -r * n[0]), add(scale(up, 0.8 * r * n[1]), scale(other, r * n[2])))))
    positions.append(add(base, scale(up, -0.3 * size)))
    return positions, triangles


def branches(base, up, size, seed, sides=4):
    """Staghorn: tapered arms that fork upwards. Yields meshes."""
    rng = random.Random(seed)
    arms = [(base, normalize(add(up, (rng.uniform(-0.9, 0.9), 0.0, rng.uniform(-0.9, 0.9)))), size * rng.uniform(0.45, 0.7), 0)
            for _ in range(5)]
    while arms:
        at, way, reach, order = arms.pop()
        bend = scale((rng.uniform(-1, 1), 0.6, rng.uniform(-1, 1)), 0.28 * reach)
        end = add(add(at, scale(way, reach)), bend)
        thick = 0.07 * size * 0.72 ** order

        def path(t, at=at, way=way, reach=reach, bend=bend):
            return add(add(at, scale(way, reach * t)), scale(bend, t * t))

        yield tube(path, lambda t, _, thick=thick: thick * (1.15 - 0.55 * t), sides, 3)
        if order < 2:
            for _ in range(2 if size > 0.4 else 1):
                turn = normalize(add(way, (rng.uniform(-0.8, 0.8), rng.uniform(0.1, 0.6), rng.uniform(-0.8, 0.8))))
                t = rng.uniform(0.5, 0.95)
                arms.append((path(t), turn, reach * rng.uniform(0.5, 0.75), order + 1))


def plate(base, up, size, seed):
    """A table on a stalk, its rim wavy."""
    sides = 30 if size > 0.3 else 20
    profile = [(0.06, 0.0), (0.05, 0.16), (0.2, 0.25), (0.55, 0.33), (0.95, 0.40), (1.0, 0.425), (0.94, 0.44), (0.6, 0.40),
               (0.25, 0.36)]
    positions = [add(base, (0.0, -0.1 * size, 0.0))]
    for r, y in profile:
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            wave = 1 + 0.22 * r * noise((2.2 * math.cos(angle), 0.5, 2.2 * math.sin(angle)), seed)
            rib = 0.012 * r * math.sin(17 * angle)
            positions.append(add(base, (size * r * wave * math.cos(angle), size * (y + rib + 0.05 * r * wave),
                                        -size * r * wave * math.sin(angle))))
    positions.append(add(base, (0.0, 0.36 * size, 0.0)))
    triangles = [tuple(reversed(t)) for t in shell(sides, len(profile))]
    return positions, triangles


def fan(base, up, size, seed):
    """A sea fan: a thin sheet with a ragged rim, ribbed from its foot."""
    rng = random.Random(seed)
    turn = rng.uniform(-0.5, 0.5)
    side_way, front = (math.cos(turn), 0.0, math.sin(turn)), (-math.sin(turn), 0.0, math.cos(turn))
    spokes, rings = (20, 6) if size > 0.45 else (12, 5)
    positions, triangles = [], []
    for ring in range(rings + 1):
        for spoke in range(spokes + 1):
            angle = 1.25 * (2 * spoke / spokes - 1)
            lobes = 1 + 0.16 * noise((2.5 * angle, 0.5, seed), 5) - 0.05 * (spoke % 2) * (ring / rings) ** 4 + 0.07 * noise((9 * angle, 1.5, seed), 7)
            r = size * (0.05 + 0.95 * ring / rings) * lobes * (1 - 0.12 * angle * angle)
            out = size * (0.07 * noise((1.6 * angle, 2.0 * ring / rings, seed), 6) + 0.012 * (spoke % 2))
            positions.append(add(base, add(scale(up, r * math.cos(angle)),
                                           add(scale(side_way, r * math.sin(angle)), scale(front, out)))))
    across = spokes + 1
    for ring in range(rings):
        for spoke in range(spokes):
            a = ring * across + spoke
            triangles += [(a, a + 1, a + across + 1), (a, a + across + 1, a + across)]
    return positions, triangles


def sponges(base, up, size, seed):
    """A clump of tubes, open at the top. Yields meshes."""
    rng = random.Random(seed)
    for _ in range(4 + seed % 3):
        lean = normalize(add(up, (rng.uniform(-0.4, 0.4), 0.2, rng.uniform(-0.4, 0.4))))
        foot = add(base, (rng.uniform(-0.25, 0.25) * size, -0.05, rng.uniform(-0.25, 0.25) * size))
        tall = size * rng.uniform(0.6, 1.2)

        def path(t, foot=foot, lean=lean, tall=tall):
            return add(foot, scale(lean, tall * (min(t, 0.8) / 0.8 - 0.6 * max(t - 0.8, 0.0))))

        def radius(t, angle, tall=tall, k=rng.random()):
            wall = 0.13 * tall * (0.75 + 0.35 * min(t / 0.8, 1.0)) * (1 + 0.08 * noise((3 * t, angle, 9 * k), 7))
            return wall if t < 0.8 else wall * 0.62

        yield tube(path, radius, 9, 6, round_ends=False)


def tinted(colour, dark, seed):
    def at(p, n):
        light = smoothstep(-0.6, 0.7, n[1])
        return scale(mix(dark, colour, 0.35 + 0.65 * light), 1 + 0.14 * noise(scale(p, 14), seed))

    return at


KINDS = {"head": (head, 0.36, [((0.72, 0.62, 0.28), (0.38, 0.30, 0.14)), ((0.46, 0.58, 0.36), (0.2, 0.28, 0.2)),
                               ((0.72, 0.45, 0.40), (0.4, 0.2, 0.22))]),
         "branches": (branches, 0.6, [((0.86, 0.70, 0.42), (0.5, 0.34, 0.2)), ((0.80, 0.74, 0.36), (0.42, 0.36, 0.16)),
                                       ((0.93, 0.56, 0.58), (0.5, 0.2, 0.28))]),
         "plate": (plate, 0.5, [((0.62, 0.56, 0.42), (0.28, 0.24, 0.2)), ((0.46, 0.52, 0.62), (0.2, 0.22, 0.3))]),
         "fan": (fan, 0.7, [((0.80, 0.22, 0.36), (0.45, 0.08, 0.2)), ((0.86, 0.52, 0.14), (0.5, 0.24, 0.06)),
                             ((0.92, 0.74, 0.30), (0.55, 0.4, 0.12))]),
         "sponges": (sponges, 0.42, [((0.92, 0.58, 0.12), (0.5, 0.24, 0.05)), ((0.58, 0.30, 0.62), (0.26, 0.1, 0.34))])}

# rock, direction from its middle (azimuth from +x towards +z, height; rad), kind, size
GROWTH = [(0, 1.9, 0.9, "fan", 1.1), (0, 1.2, 0.35, "branches", 1.0), (0, 2.5, 0.2, "head", 1.1), (0, 0.6, 1.25, "plate", 1.1),
          (0, 2.2, 1.35, "branches", 1.2), (0, 1.55, 0.0, "sponges", 0.9), (0, 3.0, 0.65, "plate", 0.9),
          (2, 1.2, 0.75, "branches", 1.2), (2, 0.4, 0.6, "plate", 1.0), (2, 2.2, 0.55, "head", 1.2), (2, 1.7, 1.2, "head", 0.9),
          (2, 0.9, 0.15, "fan", 0.8), (2, 2.9, 1.0, "fan", 1.0), (2, 1.7, 0.25, "sponges", 0.8),
          (4, 1.3, 1.0, "branches", 1.0), (4, 0.6, 0.6, "head", 1.0), (4, 2.2, 0.7, "plate", 0.8), (4, 1.8, 0.35, "sponges", 1.0),
          (5, 0.4, 0.9, "branches", 0.85), (5, 2.3, 0.95, "head", 0.85), (5, 1.3, 0.55, "head", 0.6), (5, 3.4, 0.8, "fan", 0.75),
          (5, -0.9, 0.9, "sponges", 0.8), (5, 1.3, 1.35, "plate", 0.7),
          (6, 2.0, 1.0, "branches", 0.8), (6, 0.8, 0.8, "head", 0.7), (6, 3.1, 0.7, "sponges", 0.7), (6, 0.0, 0.9, "fan", 0.6),
          (1, 1.8, 0.5, "plate", 1.6), (1, 2.3, 0.9, "fan", 1.4), (1, 1.3, 0.9, "branches", 1.5), (3, 0.8, 0.8, "plate", 1.5),
          (3, 1.4, 1.0, "branches", 1.5), (3, 0.3, 0.5, "fan", 1.3)]


# rock, how many smaller ones, where it faces most (azimuth)
SCATTER = [(0, 18, 1.9), (2, 12, 1.2), (4, 8, 1.4), (5, 6, 1.6), (6, 6, 1.6), (1, 4, 1.8)]


def scattered():
    """Smaller ones, where the rocks look up and towards +z."""
    rng = random.Random(144)
    for rock, count, facing in SCATTER:
        for _ in range(count):
            kind = rng.choices(("head", "branches", "sponges", "fan", "plate"), (6, 1, 2, 3, 1))[0]
            yield rock, facing + rng.uniform(-1.3, 1.3), math.asin(rng.uniform(0.1, 0.98)), kind, rng.uniform(0.3, 0.62)


def write_corals(rocks):
    obj = ObjWriter(["Corals for reef.obj, by make_reef.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    used = {}
    for number, (rock, azimuth, rise, kind, size) in enumerate(GROWTH + list(scattered())):
        n = (math.cos(rise) * math.cos(azimuth), math.sin(rise), math.cos(rise) * math.sin(azimuth))
        base = rocks[rock].point(n)
        outwards = normalize(tuple(c / r for c, r in zip(n, rocks[rock].radii)))
        up = normalize(add(scale(outwards, 0.55), (0.0, 1.0, 0.0)))
        make, usual, tints = KINDS[kind]
        light, dark = tints[used.get(kind, 0) % len(tints)]
        used[kind] = used.get(kind, 0) + 1
        base = sub(base, scale(outwards, 0.03))
        made = make(base, up, usual * size, number)
        for k, (positions, triangles) in enumerate([made] if isinstance(made, tuple) else made):
            if k == 0:
                name = "%s %d" % (kind, used[kind])
            obj.begin_object(name if k == 0 else "%s, part %d" % (name, k + 1))
            obj.add_mesh(positions, triangles, tinted(light, dark, number))
    obj.save(HERE / "coral.obj")


# ---- Sand

def sand_height(x, z):
    dunes = 0.16 * noise((0.33 * x, 0.5, 0.33 * z), 71) + 0.05 * noise((0.9 * x, 0.5, 0.9 * z), 72)
    bend = 1.1 * noise((0.5 * x, 0.5, 0.5 * z), 73)
    near = smoothstep(7.5, 3.0, math.hypot(x, z - 2.0))
    ripples = 0.016 * near * math.sin(15.5 * (z + 0.35 * x) + 3.0 * bend)
    return dunes - 0.06 + ripples


def sand_colour(p, n):
    x, _, z = p
    tone = 0.5 + 0.5 * noise((1.1 * x, 0.5, 1.1 * z), 74)
    coarse = 0.05 * noise((9 * x, 0.5, 9 * z), 75)
    return tuple(c + coarse for c in mix(SAND_DARK, SAND_LIGHT, tone))


def spaced(i):
    t = 2 * i / SAND_SQUARES - 1
    return SAND_HALF * (0.38 * t + 0.62 * t * abs(t) ** 1.6)


def write_seabed():
    obj = ObjWriter(["Rippled sand, by make_reef.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    obj.begin_object("sand")
    rows = obj.add_grid([spaced(i) for i in range(SAND_SQUARES + 1)], sand_height, 0.04, sand_colour)
    obj.join(rows, obj.uv(0, 0), flip=True)
    obj.save(HERE / "seabed.obj")


def main():
    obj = ObjWriter(["Rocks of a reef with an arch, by make_reef.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    rocks = [Boulder(*rock) for rock in ROCKS]
    for number, rock in enumerate(rocks):
        obj.begin_object("rock %d" % (number + 1))
        obj.add_mesh(*rock.mesh(), rock_colour)
    obj.begin_object("arch")
    obj.add_mesh(*arch(), rock_colour)
    obj.save(HERE / "reef.obj")
    write_corals(rocks)
    write_seabed()


if __name__ == "__main__":
    main()
