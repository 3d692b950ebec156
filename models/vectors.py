"""Small maths for the generators: three-vectors as tuples, repeatable smooth noise, curves, light and colours."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def distance(a, b):
    return length(sub(a, b))


def normalize(a):
    size = length(a)
    return scale(a, 1 / size) if size > 1e-12 else (0.0, 1.0, 0.0)


def perpendicular(a):
    """A unit vector at right angles to the unit vector a."""
    return normalize(cross(a, (1.0, 0.0, 0.0) if abs(a[0]) < 0.7 else (0.0, 0.0, 1.0)))


def smoothstep(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def _lattice(x, y, z, seed):
    """A number in -1..1 for a lattice point: an integer hash, the same on every machine."""
    h = (x * 374761393 + y * 668265263 + z * 2147483647 + seed * 1274126177) & 0xFFFFFFFF
    h = ((h ^ (h >> 15)) * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 3266489917) & 0xFFFFFFFF
    return (h ^ (h >> 16)) / 0x7FFFFFFF - 1.0


def noise(p, seed=0):
    """Value noise in three dimensions with quintic interpolation: about -1..1, features of size 1."""
    base = [math.floor(c) for c in p]
    t = [c - b for c, b in zip(p, base)]
    fx, fy, fz = (c * c * c * (c * (c * 6 - 15) + 10) for c in t)
    total = 0.0
    for dx, wx in ((0, 1 - fx), (1, fx)):
        for dy, wy in ((0, 1 - fy), (1, fy)):
            for dz, wz in ((0, 1 - fz), (1, fz)):
                total += wx * wy * wz * _lattice(base[0] + dx, base[1] + dy, base[2] + dz, seed)
    return total


def catmull_rom(points, i, t):
    """Returns a place on the curve through the points, t from 0 to 1 of the way from point i to the one after it."""
    a, b, c, d = (points[min(max(j, 0), len(points) - 1)] for j in (i - 1, i, i + 1, i + 2))
    return tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t + (3 * q - p - 3 * r + s) * t ** 3)
                 for p, q, r, s in zip(a, b, c, d))


def smooth(points, pieces):
    """Catmull-Rom through the points (radius, height) of a profile; its ends stay on the axis."""
    out = [catmull_rom(points, i, k / pieces) for i in range(len(points) - 1) for k in range(pieces)]
    return [(max(r, 0.0), y) for r, y in out + [points[-1]]]


def light_at(p, n, lamp, nearest, rim):
    """Returns how much of a lamp's light falls on a surface, by the angle and the square of the distance.

    A distance counts as at least `nearest`. A lamp has some size: what turns away from its middle still sees its `rim`.
    """
    towards = sub(lamp, p)
    d = max(length(towards), nearest)
    return max(dot(n, scale(towards, 1 / d)) + rim, 0.0) / (1 + rim) / (d * d)


def to_srgb(colour):
    """Returns a linear colour in sRGB; what is brighter than 1 becomes 1."""
    return tuple(12.92 * c if c <= 0.0031308 else 1.055 * min(c, 1.0) ** (1 / 2.4) - 0.055 for c in colour)
