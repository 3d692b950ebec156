#!/usr/bin/env python3
"""Makes the molecules that Shoal ships: run it in this folder to write all *.json beside it anew.

Units are metres, kilograms, N/m and N s/m, +Y up. Standard library only.
"""

import itertools
import json
import math
import pathlib

FORMAT = "shoal-molecule-1"


def number(value):
    """Rounded to a micrometre, and whole numbers without a point."""
    value = round(float(value), 6)
    return int(value) if value == int(value) else value


def vertex(position, uv=None, **more):
    out = {"position": [number(x) for x in position]}
    if uv is not None:
        out["uv"] = [number(x) for x in uv]
    return out | more


def springs(pairs, **more):
    """One spring a pair, each pair once, in the order given."""
    return [{"a": a, "b": b} | more for a, b in dict.fromkeys(tuple(sorted(p)) for p in pairs)]


def edges(triangles):
    return [pair for t in triangles for pair in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))]


def across(triangles):
    """The two vertices that face each other over an edge of two triangles: springs that resist bending."""
    opposite = {}
    for t in triangles:
        for i in range(3):
            opposite.setdefault(frozenset((t[i], t[(i + 1) % 3])), []).append(t[(i + 2) % 3])
    return [tuple(pair) for pair in opposite.values() if len(pair) == 2]


def write(name, comment, defaults, vertices, links=(), triangles=(), material=None):
    molecule = {"format": FORMAT, "name": name, "comment": comment, "defaults": defaults, "vertices": vertices}
    if links:
        molecule["springs"] = list(links)
    if triangles:
        molecule["triangles"] = [list(t) for t in triangles]
    molecule["material"] = material
    parts = []
    for key, value in molecule.items():
        if isinstance(value, list):  # one element a line
            lines = ",\n    ".join(json.dumps(element) for element in value)
            text = f"[\n    {lines}\n  ]"
        elif isinstance(value, dict):
            lines = ",\n    ".join(f"{json.dumps(k)}: {json.dumps(v)}" for k, v in value.items())
            text = f"{{\n    {lines}\n  }}"
        else:
            text = json.dumps(value)
        parts.append(f"  {json.dumps(key)}: {text}")
    path = pathlib.Path(__file__).parent / f"{name}.json"
    path.write_text("{\n" + ",\n".join(parts) + "\n}\n")


def point():
    write("point", "A particle: one vertex, no springs.", {"mass": 0.001}, [vertex((0, 0, 0))],
          material={"color": [0.75, 0.8, 0.9], "roughness": 0.5, "pointSize": 0.02})


def quad():
    side = 0.2
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    write("quad", "Decker's flat quad: all six pairs of its corners are sprung. Its saddle bend has no stiffness.",
          {"mass": 0.005, "stiffness": 20, "damping": 0.04},
          [vertex(((u - 0.5) * side, 0, (0.5 - v) * side), (u, v)) for u, v in corners],
          springs(itertools.combinations(range(4), 2)), [(0, 1, 2), (0, 2, 3)],
          {"color": [0.8, 0.3, 0.08], "secondColor": [0.85, 0.6, 0.1], "translucency": 0.3, "roughness": 0.6})


def leaf():
    """A leaf 6.6 cm long. Two points at its base and one up the stem are pinned: they hold it like a clamp, so
    that it cannot spin, and the blade flaps and twists on the springs above them. Its sides are folded up along
    the midrib, as a real leaf's are, so that every bend has stiffness. The texture spans 4.8 cm by 6.6 cm."""
    width, length = 0.048, 0.066
    points = [  # x, y, z, milligrams, pinned
        (-0.006, 0.000, 0.000, 60, True),
        (0.006, 0.000, 0.000, 60, True),
        (0.000, 0.012, -0.010, 60, True),
        (-0.0215, 0.022, 0.006, 60, False),
        (0.0215, 0.022, 0.006, 60, False),
        (0.000, 0.036, -0.006, 80, False),
        (-0.0195, 0.050, 0.006, 60, False),
        (0.0195, 0.050, 0.006, 60, False),
        (0.000, 0.066, 0.000, 50, False),
    ]
    triangles = [(0, 1, 2), (0, 2, 3), (1, 4, 2), (2, 5, 3), (2, 4, 5), (3, 5, 6), (4, 7, 5), (5, 8, 6), (5, 7, 8)]
    skin = edges(triangles) + across(triangles)
    # Ribs from the stem into the blade: without them the blade curls at the lightest breath.
    ribs = [(0, 6), (1, 7), (0, 5), (1, 5), (2, 8), (2, 6), (2, 7), (3, 7), (4, 6)]
    vertices = []
    for x, y, z, milligrams, pinned in points:
        more = {"mass": number(milligrams * 1e-6)} | ({"pinned": True} if pinned else {})
        vertices.append(vertex((x, y, z), (0.5 + x / width, y / length), **more))
    write("leaf", "A leaf with a stem to pin, folded along its midrib. Grows along +Y, its upper side faces +Z.",
          {"stiffness": 0.39, "damping": 0.0011}, vertices, springs(skin + ribs), triangles,
          {"color": [0.13, 0.33, 0.03], "secondColor": [0.42, 0.42, 0.05], "texture": "leaf.png", "alphaCut": 0.5,
           "translucency": 0.6, "roughness": 0.8})


def cross():
    side = 0.1
    half = side / 2
    outline = [(1, 1), (1, 3), (-1, 3), (-1, 1), (-3, 1), (-3, -1), (-1, -1), (-1, -3), (1, -3), (1, -1), (3, -1),
               (3, 1)]  # anticlockwise from the inner corner at the upper right, in half sides
    squares = [(9, 0, 3, 6), (0, 1, 2, 3), (3, 4, 5, 6), (6, 7, 8, 9), (9, 10, 11, 0)]
    triangles = [t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))]
    sides = [pair for s in squares for pair in zip(s, s[1:] + s[:1])]
    diagonals = [pair for a, b, c, d in squares for pair in ((a, c), (b, d))]
    tips = [(2, 4), (5, 7), (8, 10), (11, 1)]
    write("cross", "Decker's cross: a flat plus sign of five squares, with a spring between neighbouring tips "
          "against bending.", {"mass": 0.002, "stiffness": 10, "damping": 0.01},
          [vertex((x * half, 0, -y * half), (0.5 + x / 6, 0.5 + y / 6)) for x, y in outline],
          springs(sides + diagonals + tips), triangles,
          {"color": [0.1, 0.3, 0.7], "secondColor": [0.3, 0.15, 0.6], "translucency": 0.2, "roughness": 0.5})


def up(x, y, z):
    """From z up, in which the baselines are defined, to y up."""
    return (x, z, -y)


def cross_braced():
    arms = [(0.5, 0), (0, 0.5), (-0.5, 0), (0, -0.5)]
    vertices = [vertex(up(x, y, z), (0.5 + math.hypot(x, y) * (1 if x + y > 0 else -1), z))
                for z in (0, 1) for x, y in [(0, 0)] + arms]
    pairs = [(0, 5)]
    triangles = []
    for i in range(1, 5):
        pairs += [(0, i), (5, 5 + i), (i, 5 + i), (0, 5 + i), (5, i)]
        triangles += [(0, i, 5 + i), (0, 5 + i, 5)]
    for layer in (0, 5):
        pairs += [(layer + i, layer + i % 4 + 1) for i in range(1, 5)]
    write("cross-braced", "Four panels about an axis, braced by 29 springs: a baseline, 1 m high and every mass 1 kg. "
          "To hold it, pin the two centres (vertices 0 and 5).", {"mass": 1, "stiffness": 100, "damping": 0.5},
          vertices, springs(pairs), triangles,
          {"color": [0.6, 0.45, 0.2], "translucency": 0.1, "roughness": 0.7})


def fish():
    radii = [(0.08, 0.12), (0.16, 0.28), (0.2, 0.35), (0.16, 0.28), (0.08, 0.16), (0.05, 0.3)]
    vertices, pairs, triangles = [], [], []
    for ring, (rx, rz) in enumerate(radii):
        y = 0.4 * ring
        for side, (x, z) in enumerate([(rx, 0), (0, rz), (-rx, 0), (0, -rz)]):
            vertices.append(vertex(up(x, y, z), (y / 2, 0.5 + 0.5 * z / 0.35)))
            here, beside = 4 * ring + side, 4 * ring + (side + 1) % 4
            pairs.append((here, beside))
            if side < 2:
                pairs.append((here, here + 2))
            if ring < 5:
                pairs += [(here, here + 4), (here, beside + 4), (beside, here + 4)]
                triangles += [(here, here + 4, beside), (beside, here + 4, beside + 4)]
    triangles += [(0, 1, 2), (0, 2, 3), (20, 22, 21), (20, 23, 22)]  # snout and tail are closed
    write("fish", "Six rings of four vertices, 96 springs: a baseline, 2 m long and every mass 1 kg. Swims along +Z. "
          "To hold it, pin vertices 0 and 2.", {"mass": 1, "stiffness": 100, "damping": 0.5},
          vertices, springs(pairs), triangles,
          {"color": [0.35, 0.45, 0.55], "secondColor": [0.55, 0.5, 0.3], "roughness": 0.35})


def swimmer(name, comment, length, frequency, stiffness, damping, colors, metallic, plump=1.0):
    """A fish whose muscles send a wave of bending from head to tail, along +Z with +Y up. All is for a length of 1 m.

    Every spring that bending about y stretches is a muscle: a fibre at x of a body bent by the curvature c has the
    length l (1 - c x (dz/l)^2). The curvature is that of the wave y(s) = a(s) sin(2 pi (f t - s)) of a swimming fish, s
    from the snout, whose envelope grows from head to tail like a saithe's, a(s) ~ 0.02 - 0.083 s + 0.163 s^2 [Videler
    1993]. So the bent shape is at rest, and stiff springs do not hinder it; the stalk of the tail, which swings the fin
    through the water, is stiffer. The masses are the fish's with the water that it carries along, most at the fin.
    """
    #          z   half width, half height, mass of a vertex, kg
    rings = [(0.34, 0.055, 0.085, 0.6), (0.11, 0.075, 0.125, 0.7), (-0.13, 0.06, 0.095, 0.6), (-0.35, 0.035, 0.045, 0.6)]
    scale = lambda x, y, z: (plump * length * x, length * y, length * z)
    uv = lambda y, z: (0.5 - z, 0.5 + y / 0.3)
    # a snout with two sides, whose normals look aside: one point's would look ahead, and brake
    shape = [((x, 0, 0.5), 0.3) for x in (0.012, -0.012)]
    for z, rx, ry, mass in rings:
        shape += [((x, y, z), mass) for x, y in ((rx, 0), (0, ry), (-rx, 0), (0, -ry))]
    shape += [((0, y, -0.5), 0.8) for y in (0.14, -0.14)]
    vertices = [vertex(scale(*place), uv(*place[1:]), mass=float(f"{mass * length**3:.4g}")) for place, mass in shape]
    ring = lambda r: [2 + 4 * r + k for k in range(4)]
    tips, last, head = (18, 19), ring(3), ring(0)
    pairs = [(0, 1)] + [(snout, k) for snout in (0, 1) for k in head] + [(0, ring(1)[0]), (1, ring(1)[2])]
    triangles = [(0, head[0], head[1]), (0, head[1], 1), (1, head[1], head[2]),
                 (1, head[2], head[3]), (1, head[3], 0), (0, head[3], head[0])]
    for r in range(4):
        here = ring(r)
        pairs += [(here[k], here[(k + 1) % 4]) for k in range(4)] + [(here[0], here[2]), (here[1], here[3])]
        for k in range(4 if r > 0 else 0):
            before, after = ring(r - 1)[k], ring(r - 1)[(k + 1) % 4]
            pairs += [(before, here[k]), (before, here[(k + 1) % 4]), (after, here[k])]
            # left and right, top and bottom alike: else the water rolls it
            triangles += ([(before, here[k], after), (after, here[k], here[(k + 1) % 4])] if k % 2 == 0 else
                          [(before, here[k], here[(k + 1) % 4]), (before, here[(k + 1) % 4], after)])
    pairs += [(tip, here) for tip in tips for here in last] + [tips]
    pairs += [(tip, here) for tip in tips for here in (ring(2)[0], ring(2)[2])]
    triangles += [(last[1], tips[0], last[3]), (last[1], last[3], tips[1])]  # a forked sheet: its normals look aside

    def curvature(z):
        """Amplitude, and phase in rad, of the wave's curvature: its second derivative."""
        s, k, tail = 0.5 - z, 2 * math.pi, 1.0
        a, a1, a2 = (tail * f for f in (0.02 - 0.083 * s + 0.163 * s * s, -0.083 + 0.326 * s, 0.326))
        sine, cosine = a2 - k * k * a, -2 * k * a1  # of (a sin(wt - ks))''
        return math.hypot(sine, cosine), math.atan2(cosine, sine) - k * s

    links = []
    for link in springs(pairs):
        a, b = (shape[link[end]][0] for end in "ab")
        span = [q - p for p, q in zip(a, b)]
        share = -0.5 * plump * (a[0] + b[0]) * span[2] ** 2 / sum(d * d for d in span)
        if abs(share) > 1e-9:
            size, phase = curvature(0.5 * (a[2] + b[2]))
            phase = (phase + (math.pi if share < 0 else 0)) % (2 * math.pi)
            link["actuation"] = {"amplitude": number(size * abs(share)), "frequency": frequency, "phase": number(phase)}
        if max(link["a"], link["b"]) >= last[0]:
            link["stiffness"] = number(2 * stiffness)
        links.append(link)
    write(name, comment, {"stiffness": stiffness, "damping": damping}, vertices, links, triangles,
          {"color": colors[0], "secondColor": colors[1], "texture": "fry.png", "roughness": 0.28, "metallic": metallic})


def fry():
    swimmer("fry", "A fish of 10 cm, to be had in thousands: a wave of bending runs from head to tail, along +Z. Give it "
            "directional drag, some 40 1/s across and 1 1/s along, so that its flanks push the water.",
            0.1, 4, 10, 0.004, ([0.95, 0.97, 1], [0.8, 0.86, 0.9]), 0.9)


def hunter():
    swimmer("hunter", "A fish of 70 cm that hunts smaller ones; swims like a fry. Give it directional drag, some 20 1/s "
            "across and 0.5 1/s along.", 0.7, 2, 900, 1.2, ([0.5, 0.56, 0.58], [0.54, 0.56, 0.5]), 0.5, plump=1.15)


def flake():
    """A hexagon 1.6 cm across whose corners stand up and down in turn, so that no bend is free."""
    radius, fold = 0.008, 0.0015
    vertices = [vertex((0, 0.001, 0), (0.5, 0.5))]
    for i in range(6):
        x, z = math.cos(i * math.pi / 3), -math.sin(i * math.pi / 3)
        vertices.append(vertex((radius * x, fold if i % 2 else -fold, radius * z), (0.5 + x / 2, 0.5 - z / 2)))
    ring = [1, 2, 3, 4, 5, 6]
    after = dict(zip(ring, ring[1:] + ring[:1]))
    pairs = [(0, i) for i in ring] + [(i, after[i]) for i in ring] + [(i, after[after[i]]) for i in ring]
    write("flake", "A light flake of snow or a petal: a folded hexagon.",
          {"mass": 0.000003, "stiffness": 0.02, "damping": 0.00002},
          vertices, springs(pairs), [(0, i, after[i]) for i in ring],
          {"color": [0.9, 0.93, 1.0], "secondColor": [0.75, 0.82, 0.95], "translucency": 0.5, "roughness": 0.4})


def berry():
    """Four balls of 16 mm, their middles 12 mm apart: a contact radius of 8 mm is just what is drawn."""
    side = 0.012 / math.sqrt(8)
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    write("berry", "A sweet of four balls that overlap: drawn as spheres, 16 mm across.",
          {"mass": 0.0015, "stiffness": 2000, "damping": 0.5},
          [vertex([side * c for c in corner]) for corner in corners], springs(itertools.combinations(range(4), 2)),
          material={"color": [0.6, 0.03, 0.03], "roughness": 0.25, "pointSize": 0.016})


def snow():
    write("snow", "A grain of snow, drawn as a sphere 2.3 cm across: a little wider than the contact radius of 10 mm that suits it.", {"mass": 0.0006}, [vertex((0, 0, 0))],
          material={"color": [0.86, 0.88, 0.92], "secondColor": [0.8, 0.84, 0.9], "roughness": 1, "translucency": 0.8, "pointSize": 0.023})


def kelp():
    """A blade of 80 cm in seven rows of three, folded along its middle so that it stands; the lowest row is pinned."""
    rows, length, width, fold = 7, 0.8, 0.08, 0.03
    vertices, triangles, pairs = [], [], []
    for row in range(rows):
        t = row / (rows - 1)
        half = 0.5 * width * (0.55 + 1.3 * t - 1.75 * t * t) if row < rows - 1 else 0.004
        sway = 0.02 * math.sin(5 * t)
        for column in (-1, 0, 1):
            deep = -fold * (1 - 0.6 * t) if column == 0 else 0
            vertices.append(vertex((column * half + sway, length * t, deep), (0.5 + 0.5 * column, t),
                                   **({"pinned": True} if row == 0 else {})))
    for row in range(rows):
        left, middle, right = (3 * row + column for column in range(3))
        pairs += [(left, middle), (middle, right), (left, right)]
        if row < rows - 1:
            for here, beside in ((left, middle), (middle, right)):
                triangles += [(here, beside, beside + 3), (here, beside + 3, here + 3)]
            pairs += [(k, k + 3) for k in (left, middle, right)]
            pairs += [(left, middle + 3), (middle, left + 3), (middle, right + 3), (right, middle + 3)]
        if row < rows - 2:
            pairs += [(middle, middle + 6)]
    write("kelp", "A blade of seaweed, 80 cm, folded along its middle; its foot is pinned. Grows along +Y and bends in a "
          "current.", {"mass": 0.0012, "stiffness": 14, "damping": 0.006}, vertices, springs(pairs), triangles,
          {"color": [0.1, 0.22, 0.03], "secondColor": [0.32, 0.3, 0.05], "translucency": 0.5, "roughness": 0.4})


if __name__ == "__main__":
    for make in (point, quad, leaf, cross, cross_braced, fish, fry, hunter, flake, berry, snow, kelp):
        make()
