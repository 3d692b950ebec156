"""Writes Wavefront OBJ meshes with vertex colours (x y z r g b), which Assimp and Blender read.

Metres, Y up, counter-clockwise faces; colours are sRGB in 0..1. Texture coordinates are stored
once per distinct value, so that the seam of a tube needs no doubled vertices.
"""

from meshes import normals_of, on_surface, quads


class ObjWriter:
    def __init__(self, comment):
        self.lines = ["# " + line for line in comment]
        self.vertex_count = 0
        self.triangle_count = 0
        self.uv_index = {}

    def begin_object(self, name):
        self.lines.append("o " + name)

    def add_vertex(self, position, normal, colour):
        """Returns the vertex's number, counted from 1 as OBJ does."""
        self.lines.append("v %.4f %.4f %.4f %.3f %.3f %.3f" % (*_no_minus_zero(position, 4), *colour))
        self.lines.append("vn %.3f %.3f %.3f" % _no_minus_zero(normal, 3))
        self.vertex_count += 1
        return self.vertex_count

    def uv(self, u, v):
        text = "vt %.3f %.3f" % _no_minus_zero((u, v), 3)
        if text not in self.uv_index:
            self.uv_index[text] = len(self.uv_index) + 1
            self.lines.append(text)
        return self.uv_index[text]

    def add_triangle(self, *corners):
        """Three pairs (vertex number, texture coordinate number)."""
        self.lines.append("f " + " ".join("%d/%d/%d" % (v, t, v) for v, t in corners))
        self.triangle_count += 1

    def add_triangles(self, triangles, uv):
        """Each triangle is three vertex numbers, and all have one texture coordinate."""
        for triangle in triangles:
            self.add_triangle(*((v, uv) for v in triangle))

    def add_quad(self, a, b, c, d, uv):
        self.add_triangles(((a, b, c), (a, c, d)), uv)

    def join(self, rows, uv, closed=False, flip=False):
        """Adds the faces between rows of vertex numbers; `closed` rows are rings.

        Seen from the front, the next row is on the left of one who goes along a row, or with `flip` on the right.
        """
        for a, b, c, d in quads(rows, closed):
            self.add_quad(*((a, d, c, b) if flip else (a, b, c, d)), uv)

    def add_mesh(self, positions, triangles, colour):
        """Adds a smooth mesh, its triangles counting positions from 0, with `colour` of a position and its normal."""
        numbers = [self.add_vertex(p, n, tuple(min(max(c, 0.0), 1.0) for c in colour(p, n)))
                   for p, n in zip(positions, normals_of(positions, triangles))]
        self.add_triangles(([numbers[v] for v in triangle] for triangle in triangles), self.uv(0, 0))

    def add_grid(self, ticks, height, step, colour):
        """Adds vertices of a height field at the x and z of `ticks`, with `colour` of a position and its normal.

        Returns rows of their numbers along x; joined with `flip`, they face up.
        """
        return [[self.add_vertex(p, n, colour(p, n)) for p, n in (on_surface(height, x, z, step) for x in ticks)]
                for z in ticks]

    def save(self, path):
        """Writes the file and prints how much is in it."""
        with open(path, "w", encoding="ascii", newline="\n") as file:
            file.write("\n".join(self.lines) + "\n")
        print("%s: %d vertices, %d triangles" % (path.name, self.vertex_count, self.triangle_count))


def _no_minus_zero(values, digits):
    return tuple(round(value, digits) + 0.0 for value in values)
