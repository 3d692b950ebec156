"""Writes Wavefront OBJ meshes with vertex colours (x y z r g b), which Assimp and Blender read.

Metres, Y up, counter-clockwise faces; colours are sRGB in 0..1. Texture coordinates are stored
once per distinct value, so that the seam of a tube needs no doubled vertices.
"""


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

    def save(self, path):
        with open(path, "w", encoding="ascii", newline="\n") as file:
            file.write("\n".join(self.lines) + "\n")


def _no_minus_zero(values, digits):
    return tuple(round(value, digits) + 0.0 for value in values)
