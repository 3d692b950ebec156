"""Makes tree.obj: an old broad-leaved tree, about 6.6 m tall, bare, for leaves to hang on.

How it grows. Five orders of axes - trunk, limbs, two orders of branches, twigs with side sprigs -
each a curve with radii. The crown is an ellipsoid with soft lobes. Every order has its targets,
points spread evenly (best of many candidates) through that crown, more of them than the order
before; each target is joined to the wood already there, where the way is short and the fork's
angle natural. So every scale fills the crown without gaps, and no branch crosses it to reach
the far side. Limbs go round the trunk, and sprigs round their twig, by the golden angle.

Curves leave along their parent, bend up towards the light, wander, and droop at their ends.
Radii come from the tips downwards by da Vinci's pipe model (a section is the sum of the sections
it feeds) plus a slope along each axis. Tubes take their frames by parallel transport.

Ideas: da Vinci's pipe model; orders, shape envelopes and tropism after [Weber 1995]; targets that
pull branches after [Runions 2007]; frames after [Bloomenthal 1990].

Data: metres, Y up, the ground near y = 0. Objects: trunk, limbs, branches, twigs. Texture
coordinates: u once round, v metres along. Vertex colours: bark in sRGB. Same bytes every run.
"""

import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import quads  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import (add, cross, distance, dot, length, mix, noise, normalize,  # noqa: E402
                     perpendicular, scale, smoothstep, sub)

SEED = 11
UP = (0.0, 1.0, 0.0)
GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))

TRUNK, LIMB, BRANCH, SMALL_BRANCH, TWIG, SPRIG = range(6)
OBJECTS = (("trunk", (TRUNK,)), ("limbs", (LIMB,)), ("branches", (BRANCH, SMALL_BRANCH)),
           ("twigs", (TWIG, SPRIG)))

CROWN_CENTRE = (0.05, 4.0, 0.0)
CROWN_RADIUS = 2.55       # m, level with the centre
CROWN_ABOVE = 2.35         # m, centre to top
CROWN_BELOW = 2.1         # m, centre to underside
LOWEST_WOOD = 2.1        # m, no target below

LIMB_COUNT = 11
TARGETS = {BRANCH: 70, SMALL_BRANCH: 215, TWIG: 700}
SHELL = {BRANCH: (0.45, 0.86), SMALL_BRANCH: (0.40, 0.94), TWIG: (0.42, 1.0)}  # part of the crown's radius
SPRINGS_FROM = {BRANCH: (TRUNK, LIMB), SMALL_BRANCH: (LIMB, BRANCH), TWIG: (BRANCH, SMALL_BRANCH)}
RING_SPACING = {LIMB: 0.08, BRANCH: 0.13, SMALL_BRANCH: 0.14, TWIG: 0.14}      # m
FORK_SPACING = {BRANCH: 0.20, SMALL_BRANCH: 0.16, TWIG: 0.07}                  # m, along the parent
WANDER = {TRUNK: 0.0, LIMB: 0.085, BRANCH: 0.075, SMALL_BRANCH: 0.06, TWIG: 0.04}  # of the length
DROOP = {LIMB: 0.03, BRANCH: 0.06, SMALL_BRANCH: 0.08, TWIG: 0.12}             # of the length
SPRIGS_PER_TWIG = 3

TIP_RADIUS = {TRUNK: 0.004, LIMB: 0.004, BRANCH: 0.003, SMALL_BRANCH: 0.0025, TWIG: 0.002, SPRIG: 0.002}
SLOPE = {TRUNK: 0.004, LIMB: 0.005, BRANCH: 0.0055, SMALL_BRANCH: 0.005, TWIG: 0.0045, SPRIG: 0.003}


class Axis:
    """One curve of wood: points from its fork to its tip, and the forks on it."""

    def __init__(self, order, points, parent=None, fork=0):
        self.order = order
        self.points = points
        self.parent = parent
        self.fork = fork          # the parent's point that it springs from
        self.children = []
        self.radii = []
        self.tangents = [normalize(sub(points[min(i + 1, len(points) - 1)], points[max(i - 1, 0)]))
                         for i in range(len(points))]
        if parent:
            parent.children.append(self)


# --- The crown ---------------------------------------------------------------------------------

def crown_depth(point):
    """0 at the crown's centre, 1 on its outside, whose radius swells and shrinks by soft lobes."""
    x, y, z = sub(point, CROWN_CENTRE)
    y /= CROWN_ABOVE if y > 0 else CROWN_BELOW
    x /= CROWN_RADIUS
    z /= CROWN_RADIUS
    depth = math.sqrt(x * x + y * y + z * z)
    if depth < 1e-6:
        return 0.0
    lobes = noise((2.0 * x / depth + 7.3, 2.0 * y / depth, 2.0 * z / depth), 3)
    return depth / (1.0 + 0.10 * lobes)


def outward(point):
    return normalize(sub(point, add(CROWN_CENTRE, (0.0, -0.9, 0.0))))


def spread_targets(rng, count, shell, taken, candidates=14):
    """Points in the crown between two depths, each the farthest of its candidates from all others."""
    chosen = []
    others = list(taken)
    while len(chosen) < count:
        best, best_distance = None, -1.0
        found = 0
        while found < candidates:
            point = tuple(CROWN_CENTRE[i] + rng.uniform(-3.2, 3.2) for i in range(3))
            if point[1] < LOWEST_WOOD or not shell[0] < crown_depth(point) < shell[1]:
                continue
            found += 1
            nearest = min((dot(d, d) for d in (sub(point, o) for o in others)), default=1e9)
            if nearest > best_distance:
                best, best_distance = point, nearest
        chosen.append(best)
        others.append(best)
    return chosen


# --- Curves ------------------------------------------------------------------------------------

def grow_curve(rng, order, start, start_direction, end, end_direction, rings):
    """A cubic Hermite curve that wanders sideways and droops towards its tip."""
    span = distance(start, end)
    first, last = scale(start_direction, span), scale(end_direction, span)
    side = perpendicular(normalize(sub(end, start)))
    other = cross(normalize(sub(end, start)), side)
    phase = (rng.uniform(0, 100), rng.uniform(0, 100))
    level = 1 - abs(normalize(sub(end, start))[1])
    points = []
    for i in range(rings):
        s = i / (rings - 1)
        a, b = 2 * s ** 3 - 3 * s ** 2 + 1, s ** 3 - 2 * s ** 2 + s
        c, d = -2 * s ** 3 + 3 * s ** 2, s ** 3 - s ** 2
        p = tuple(a * start[k] + b * first[k] + c * end[k] + d * last[k] for k in range(3))
        sway = WANDER[order] * span * smoothstep(0.0, 0.3, s)
        frequency = 2.0 + 1.2 * span
        p = add(p, scale(side, sway * noise((frequency * s, phase[0], 0.5), 5)))
        p = add(p, scale(other, sway * noise((frequency * s, phase[1], 0.5), 6)))
        points.append(add(p, (0.0, -DROOP[order] * level * span * s ** 3, 0.0)))
    return points


def grow_trunk():
    """Straight enough below, wandering among its limbs above; ends as the leader."""
    points = []
    height = -0.32
    while height < 5.35:
        free = smoothstep(0.6, 4.5, height)
        points.append((0.50 * free * noise((0.62 * height, 0.5, 0.5), 21) + 0.05 * math.sin(1.1 * height),
                       height,
                       0.55 * free * noise((0.55 * height, 9.5, 0.5), 22)
                       + 0.05 * math.sin(1.3 * height + 1) - 0.05 * math.sin(1.0)))
        height += 0.07 if height < 0.7 else 0.11
    return Axis(TRUNK, points)


def grow_limbs(rng, trunk):
    """Round the trunk by the golden angle: the lowest reach out level, the highest climb."""
    limbs = []
    for i in range(LIMB_COUNT):
        t = (i + 0.5) / LIMB_COUNT
        azimuth = 0.6 + i * GOLDEN_ANGLE + rng.uniform(-0.15, 0.15)
        climb = math.asin(-0.18 + 1.02 * t) + rng.uniform(-0.08, 0.08)
        direction = (math.cos(azimuth) * math.cos(climb), math.sin(climb), math.sin(azimuth) * math.cos(climb))
        reach = 0.74 / crown_depth(add(CROWN_CENTRE, direction))
        end = add(CROWN_CENTRE, scale(direction, reach))
        fork_height = 2.0 + 2.1 * t ** 1.2
        fork = min(range(len(trunk.points)), key=lambda k: abs(trunk.points[k][1] - fork_height))
        start = trunk.points[fork]
        way = normalize(sub(end, start))
        leave = normalize(add(way, (0.0, 0.55 * (1 - t), 0.0)))
        arrive = normalize(add(add(way, scale(outward(end), 0.4)), (0.0, 0.15 + 0.3 * t, 0.0)))
        rings = max(8, int(distance(start, end) / RING_SPACING[LIMB]))
        limbs.append(Axis(LIMB, grow_curve(rng, LIMB, start, leave, end, arrive, rings), trunk, fork))
    return limbs


def choose_fork(target, parents, spacing):
    """The point of the wood from which a branch to the target is short and leaves at a natural angle."""
    best, best_cost = None, math.inf
    for axis in parents:
        last = len(axis.points) - 1
        for k in range(max(1, int(0.18 * last)), last):
            way = sub(target, axis.points[k])
            reach = length(way)
            if reach >= best_cost or axis.points[k][1] < 1.9:
                continue
            angle = math.acos(max(-1.0, min(1.0, dot(way, axis.tangents[k]) / max(reach, 1e-9))))
            excess = (angle - 0.75) / 0.9
            cost = reach * (1 + excess * excess) + 0.25 * max(0.0, -way[1])
            if cost >= best_cost:
                continue
            for child in axis.children:
                if distance(axis.points[child.fork], axis.points[k]) < spacing:
                    cost += 0.3 * spacing / 0.2
            if cost < best_cost:
                best, best_cost = (axis, k), cost
    return best


def grow_order(rng, order, axes):
    """Joins this order's targets to the wood of the orders before, the nearest to the trunk first."""
    parents = [axis for axis in axes if axis.order in SPRINGS_FROM[order]]
    tips = [axis.points[-1] for axis in axes]
    targets = spread_targets(rng, TARGETS[order], SHELL[order], tips)
    targets.sort(key=crown_depth)
    grown = []
    for target in targets:
        parent, fork = choose_fork(target, parents, FORK_SPACING[order])
        start = parent.points[fork]
        way = normalize(sub(target, start))
        leave = normalize(add(scale(way, 0.6), scale(parent.tangents[fork], 0.5)))
        rise = 0.35 * smoothstep(2.0, 4.5, target[1])
        arrive = normalize(add(add(way, scale(outward(target), 0.35)), (0.0, rise, 0.0)))
        rings = max(4, int(distance(start, target) / RING_SPACING[order]) + 1)
        grown.append(Axis(order, grow_curve(rng, order, start, leave, target, arrive, rings), parent, fork))
    return grown


def grow_sprigs(rng, twigs):
    """Short side shoots, each turned by the golden angle round its twig from the one before."""
    sprigs = []
    turn = 0.0
    for twig in twigs:
        last = len(twig.points) - 1
        for k in range(max(1, last + 1 - SPRIGS_PER_TWIG), last + 1):
            turn += GOLDEN_ANGLE
            tangent = twig.tangents[k]
            side = perpendicular(tangent)
            around = add(scale(side, math.cos(turn)), scale(cross(tangent, side), math.sin(turn)))
            way = normalize(add(add(scale(tangent, 0.75), around), scale(outward(twig.points[k]), 0.25)))
            reach = rng.uniform(0.15, 0.28)
            sprigs.append(Axis(SPRIG, [twig.points[k], add(twig.points[k], scale(way, reach))], twig, k))
    return sprigs


# --- Radii -------------------------------------------------------------------------------------

def set_radii(axis):
    """From the tip down: the pipe model at forks, a slope between them; then the steps are smoothed."""
    count = len(axis.points)
    feeds = [0.0] * count
    for child in axis.children:
        set_radii(child)
        feeds[child.fork] += child.radii[0] ** 2
    radii = [0.0] * count
    radii[-1] = TIP_RADIUS[axis.order]
    for i in range(count - 2, -1, -1):
        radius = radii[i + 1] + SLOPE[axis.order] * distance(axis.points[i], axis.points[i + 1])
        radii[i] = math.sqrt(radius ** 2 + feeds[i])
    for _ in range(3):
        radii = radii[:1] + [(radii[i - 1] + 2 * radii[i] + radii[i + 1]) / 4
                             for i in range(1, count - 1)] + radii[-1:]
    axis.radii = radii


# --- The mesh ----------------------------------------------------------------------------------

def side_count(axis):
    if axis.order == TRUNK:
        return 24
    if axis.order == SPRIG:
        return 3
    radius = axis.radii[0]
    for limit, sides in ((0.08, 12), (0.035, 8), (0.016, 6), (0.009, 5)):
        if radius > limit:
            return sides
    return 4


def visible_part(axis):
    """Points and radii from the parent's bark on, with a collar where the branch leaves it."""
    points, radii = list(axis.points), list(axis.radii)
    if not axis.parent:
        return points, radii
    parent_radius = axis.parent.radii[axis.fork]
    hidden = max(0.0, 0.6 * parent_radius - 1.1 * radii[0])  # a thick branch's slanted end must stay inside
    while len(points) > 3 and distance(points[1], points[0]) <= hidden:
        hidden -= distance(points[1], points[0])
        del points[0], radii[0]
    gap = distance(points[0], points[1])
    points[0] = mix(points[0], points[1], min(hidden / gap, 0.8))
    along = 0.0
    for i in range(len(points)):
        if i:
            along += distance(points[i - 1], points[i])
        collar = 0.45 * math.exp(-max(0.0, along + hidden - 0.7 * parent_radius) / parent_radius)
        radii[i] = min(radii[i] * (1 + collar), max(radii[i], 0.9 * parent_radius))
    return points, radii


def transported_frames(points):
    """Tangent and two normals at each point; the normals turn no more than the curve bends."""
    last = len(points) - 1
    tangents = [normalize(sub(points[min(i + 1, last)], points[max(i - 1, 0)])) for i in range(last + 1)]
    side = perpendicular(tangents[0])
    frames = []
    for tangent in tangents:
        side = normalize(sub(side, scale(tangent, dot(side, tangent))))
        frames.append((tangent, side, cross(tangent, side)))
    return frames


def blend_with_parent(axis, position, normal):
    """Turns the normals near a fork towards those of the parent's bark, which hides the crease."""
    if not axis.parent or axis.order > SMALL_BRANCH:
        return normal
    parent, fork = axis.parent, axis.fork
    nearby = range(max(0, fork - 4), min(len(parent.points), fork + 8))
    k = min(nearby, key=lambda i: distance(parent.points[i], position))
    out = sub(position, parent.points[k])
    out = sub(out, scale(parent.tangents[k], dot(out, parent.tangents[k])))
    depth = length(out) / parent.radii[k]
    near = smoothstep(1.9, 0.9, depth) * smoothstep(0.6, 0.9, depth)
    return normalize(mix(normal, normalize(out), 0.75 * near))


def surface_radius(axis, radius, point, angle):
    """The trunk flares into roots at the ground and is fluted; all thick wood is a little uneven."""
    if axis.order > BRANCH:
        return radius
    uneven = 0.05 * noise((3 * math.cos(angle), 3 * math.sin(angle), 2.2 * point[1] + 3 * point[0]), 31)
    if axis.order != TRUNK:
        return radius * (1 + uneven)
    ridges = noise((6 * math.cos(angle), 6 * math.sin(angle), 1.3 * point[1]), 32)
    height = max(point[1], -0.1)
    roots = 0.5 + 0.5 * math.cos(5 * angle + 1.1 * math.sin(2 * angle + 0.4) + 0.6 * height)
    flare = math.exp(-height / 0.26) * (0.30 + 0.75 * roots) + 0.10 * math.exp(-height / 1.0) * roots
    return radius * (1 + flare + 1.2 * uneven + 0.045 * ridges)


def bark_colour(axis, radius, relief, point, normal):
    """Grey-brown bark, darker in hollows and at the foot, moss to -z low down, reddish lighter twigs."""
    grain = noise(scale(point, 5.0), 41) + 0.6 * noise(scale(point, 13.0), 42)
    colour = (0.455 + 0.030 * grain, 0.405 + 0.030 * grain, 0.350 + 0.026 * grain)
    twig = smoothstep(0.022, 0.004, radius) if radius < 0.022 else 0.0
    colour = mix(colour, (0.52 + 0.03 * grain, 0.41 + 0.02 * grain, 0.335 + 0.02 * grain), twig)
    if radius > 0.02:
        colour = scale(colour, min(max(1 + 2.2 * relief, 0.78), 1.10))
    colour = scale(colour, 1 - 0.22 * smoothstep(0.5, -0.1, point[1]) if point[1] < 0.5 else 1)
    if axis.order <= LIMB:
        shade = smoothstep(-0.1, 0.9, -normal[2] * 0.8 + normal[1] * 0.5 + 0.35 * noise(scale(point, 3.5), 43))
        low = 1 - smoothstep(0.8, 3.2, point[1])
        colour = mix(colour, (0.37, 0.43, 0.26), 0.55 * shade * low)
    return tuple(min(max(c, 0.0), 1.0) for c in colour)


def write_tube(obj, axis):
    points, radii = visible_part(axis)
    sides = side_count(axis)
    frames = transported_frames(points)
    rings, reliefs = [], []
    for point, radius, (_, side, other) in zip(points, radii, frames):
        ring, relief = [], []
        for j in range(sides):
            angle = 2 * math.pi * j / sides
            r = surface_radius(axis, radius, point, angle)
            ring.append(add(point, add(scale(side, r * math.cos(angle)), scale(other, r * math.sin(angle)))))
            relief.append(r)
        mean = sum(relief) / sides
        rings.append(ring)
        reliefs.append([r / mean - 1 for r in relief])

    last = len(rings) - 1
    numbers = []
    for i, ring in enumerate(rings):
        numbers.append([])
        for j in range(sides):
            round_way = sub(ring[(j + 1) % sides], ring[j - 1])
            along = sub(rings[min(i + 1, last)][j], rings[max(i - 1, 0)][j])
            normal = blend_with_parent(axis, ring[j], normalize(cross(round_way, along)))
            colour = bark_colour(axis, radii[i], reliefs[i][j], ring[j], normal)
            numbers[-1].append(obj.add_vertex(ring[j], normal, colour))
    tangent = frames[-1][0]
    apex = add(points[-1], scale(tangent, 1.5 * radii[-1]))
    apex_number = obj.add_vertex(apex, tangent, bark_colour(axis, radii[-1], 0.0, apex, tangent))

    metres = [0.0]
    for a, b in zip(points, points[1:]):
        metres.append(metres[-1] + distance(a, b))
    write_tube_faces(obj, numbers, apex_number, metres)


def write_tube_faces(obj, numbers, apex, metres):
    sides = len(numbers[0])
    rings = [[(ring[j % sides], obj.uv(j / sides, v)) for j in range(sides + 1)] for ring, v in zip(numbers, metres)]
    for a, b, c, d in quads(rings):
        obj.add_triangle(a, b, c)
        obj.add_triangle(a, c, d)
    for a, b in zip(rings[-1], rings[-1][1:]):
        obj.add_triangle(a, b, (apex, obj.uv(0.5, metres[-1])))
    # The foot lies within the parent, or the ground, and is closed, so that nothing is seen from behind.
    for a, b in zip(rings[0][1:], rings[0][2:sides]):
        obj.add_triangle(rings[0][0], b, a)


def grow_tree():
    rng = random.Random(SEED)
    trunk = grow_trunk()
    axes = [trunk] + grow_limbs(rng, trunk)
    for order in (BRANCH, SMALL_BRANCH, TWIG):
        axes += grow_order(rng, order, axes)
    axes += grow_sprigs(rng, [axis for axis in axes if axis.order == TWIG])
    set_radii(trunk)
    return axes


def main():
    axes = grow_tree()
    obj = ObjWriter(["Shoal's tree, made by make_tree.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    for name, orders in OBJECTS:
        before = (obj.vertex_count, obj.triangle_count)
        obj.begin_object(name)
        for axis in axes:
            if axis.order in orders:
                write_tube(obj, axis)
        print("%-9s %6d vertices %6d triangles" % (name, obj.vertex_count - before[0],
                                                   obj.triangle_count - before[1]))
    obj.save(HERE / "tree.obj")


if __name__ == "__main__":
    main()
