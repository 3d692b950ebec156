"""Makes jar.obj, jar.mtl and table.obj: an open glass jar, 0.27 m tall, for sweets to be poured into, on a table.

A profile of (radius, height), made smooth by a Catmull-Rom spline, is turned about the y axis. jar.obj is the whole
wall, a closed shell, 8 mm thick: what is drawn, of the glass in jar.mtl, and what molecules touch, as a distance field.
table.obj are planks, their top at y = 0.

Data: metres, Y up, the jar's foot at y = 0, its axis x = z = 0. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from meshes import lathe  # noqa: E402
from obj_writer import ObjWriter  # noqa: E402
from vectors import mix, noise, normalize, scale, smooth, smoothstep  # noqa: E402

SIDES = 96
PLANKS, PLANK = 8, 0.13  # m wide
TABLE_LENGTH, TABLE_COLUMNS = 1.6, 40
TABLE_FRONT = 0.45  # m, its edge towards the camera
# What it lets through where it is seen head on, how much it scatters, and its index of refraction.
GLASS = """# Glass, by make_jar.py. MIT licence.
newmtl glass
Kd 0.92 0.97 0.96
Ks 1 1 1
Ns 800
d 0.01
Ni 1.5
"""

# From the axis at the bottom, up the outside, over the rim and down the inside to the axis.
PROFILE = [(0.0, 0.0), (0.06, 0.0), (0.098, 0.002), (0.112, 0.010), (0.118, 0.028), (0.120, 0.06), (0.120, 0.11),
           (0.120, 0.16), (0.119, 0.195), (0.114, 0.218), (0.105, 0.232), (0.1015, 0.242), (0.103, 0.25),
           (0.1065, 0.256), (0.1075, 0.262), (0.1055, 0.268), (0.101, 0.27), (0.097, 0.268), (0.0945, 0.262),
           (0.0935, 0.25), (0.094, 0.238), (0.099, 0.225), (0.107, 0.211), (0.1115, 0.192), (0.112, 0.16),
           (0.112, 0.11), (0.112, 0.06), (0.110, 0.032), (0.103, 0.018), (0.09, 0.0125), (0.05, 0.012), (0.0, 0.012)]


def write_mesh():
    writer = ObjWriter(["A glass jar, by make_jar.py. Metres, Y up; one closed shell. MIT licence."])
    writer.lines.append("mtllib jar.mtl")
    writer.begin_object("jar")
    writer.lines.append("usemtl glass")
    writer.add_mesh(*lathe(smooth(PROFILE, 4), SIDES), lambda p, n: (1, 1, 1))
    writer.save(HERE / "jar.obj")
    (HERE / "jar.mtl").write_text(GLASS)


def wood(x, z, plank):
    """Bright and dark layers of the wood along x, wider in the plank's middle; a colour a plank."""
    tone = noise((plank * 3.7, 0.5, 0.5), 3)
    base = mix((0.50, 0.33, 0.20), (0.60, 0.42, 0.27), 0.5 + 0.5 * tone)
    layers = z * 260 + 3.0 * noise((2.2 * x + 9.1 * plank, 0.5, 9 * z), 4)
    dark = smoothstep(-0.2, 0.8, noise((0.6 * x, plank, layers), 5))
    return scale(mix(base, scale(base, 0.68), dark), 1 + 0.05 * noise((6 * x, plank, 180 * z), 6))


def write_table():
    """Planks along x: their edges are worn, so that the gaps between them show."""
    writer = ObjWriter(["A table of planks, by make_jar.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    writer.begin_object("table")
    uv = writer.uv(0, 0)
    across = [(0.0, -0.004), (0.0015, -0.0008), (0.004, 0.0)]
    middle = [0.004 + (PLANK - 0.008) * i / 26 for i in range(1, 26)]
    profile = across + [(z, 0.0) for z in middle] + [(PLANK - z, y) for z, y in reversed(across)]
    for plank in range(PLANKS):
        rows = []
        for column in range(TABLE_COLUMNS + 1):
            x = TABLE_LENGTH * (column / TABLE_COLUMNS - 0.5)
            row = []
            for z, y in profile:
                tilt = (0.0, 1.0, 0.0) if y == 0 else normalize((0.0, 1.0, math.copysign(1.0, z - PLANK / 2)))
                colour = scale(wood(x, z, plank), 1.0 if y == 0 else 0.75 if y > -0.002 else 0.35)
                place = TABLE_FRONT - (PLANKS - plank) * PLANK + z
                row.append(writer.add_vertex((x, y, place), tilt, colour))
            rows.append(row)
        writer.join(rows, uv)
    writer.save(HERE / "table.obj")


if __name__ == "__main__":
    write_mesh()
    write_table()
