"""Positions and triangles of the generators' meshes: closed shells, height fields, and faces between rows of vertices.

A mesh is a list of positions and a list of triangles, which count the positions from 0.
"""

import math

from vectors import add, cross, normalize, sub


def quads(rows, closed=False):
    """Yields the corners of faces between rows, two along a row, two back along the next; `closed` rows are rings."""
    for a, b in zip(rows, rows[1:]):
        for i in range(len(a) if closed else len(a) - 1):
            n = (i + 1) % len(a)
            yield a[i], a[n], b[n], b[i]


def shell(sides, rings, clockwise=False):
    """Returns the triangles of a closed tube, whose positions are a first point, the rings' and a last point.

    They face outwards if the rings run anticlockwise, or else `clockwise`, as one looks from the first point on.
    """
    triangles = []
    last = 1 + sides * rings
    for side in range(sides):
        after = (side + 1) % sides
        faces = [[0, 1 + side, 1 + after]]
        faces += [[a + side, a + sides + side, a + sides + after, a + after] for a in range(1, last - sides, sides)]
        faces.append([last, last - sides + after, last - sides + side])
        for first, *others in faces:
            if clockwise:
                others.reverse()
            triangles += [(first, b, c) for b, c in zip(others, others[1:])]
    return triangles


def sphere(sides, rings):
    """Returns the unit sphere as a mesh, its positions in rings from the top to the bottom."""
    positions = [(0.0, 1.0, 0.0)]
    for ring in range(1, rings):
        r, y = math.sin(math.pi * ring / rings), math.cos(math.pi * ring / rings)
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            positions.append((r * math.cos(angle), y, -r * math.sin(angle)))
    positions.append((0.0, -1.0, 0.0))
    return positions, shell(sides, rings - 1)


def lathe(profile, sides, shape=lambda angle, radius, y: radius):
    """Returns a closed mesh: a profile of (radius, height) is turned about the y axis, on which it begins and ends.

    What is outside lies to the right of the profile. `shape` of an angle, a radius and a height is the radius there.
    """
    rings = profile[1:-1]
    positions = [(0.0, profile[0][1], 0.0)]
    for r, y in rings:
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            radius = shape(angle, r, y)
            positions.append((radius * math.cos(angle), y, -radius * math.sin(angle)))
    positions.append((0.0, profile[-1][1], 0.0))
    return positions, shell(sides, len(rings), clockwise=True)


def normals_of(positions, triangles):
    """Returns the normal of each position, the mean of its triangles' by their areas."""
    sums = [(0.0, 0.0, 0.0)] * len(positions)
    for t in triangles:
        n = cross(sub(positions[t[1]], positions[t[0]]), sub(positions[t[2]], positions[t[0]]))
        for v in t:
            sums[v] = add(sums[v], n)
    return [normalize(n) for n in sums]


def ticks(half_size, squares):
    """Returns the edges of equal squares in a row from -half_size to half_size."""
    return [-half_size + 2 * half_size * i / squares for i in range(squares + 1)]


def on_surface(height, x, z, step):
    """Returns the position on a height field at x and z and the normal there, by differences over `step` either way."""
    return (x, height(x, z), z), normalize((height(x - step, z) - height(x + step, z), 2 * step,
                                            height(x, z - step) - height(x, z + step)))
