"""Makes bee.png, a bee seen from above, and hive.obj, a skep of coiled straw on a stand.

bee.png: 4 x 1 tiles of 64 x 64, RGBA, sRGB, a flip-book of one beat of the wings; the head points up. Alpha is 0 on the
border of every tile. hive.obj: a skep, 0.55 m tall, with its entrance towards +z, on a board with legs.

Data: metres, Y up, the ground at y = 0. Vertex colours in sRGB. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from obj_writer import ObjWriter  # noqa: E402
from png_writer import RGBA_8, write_png  # noqa: E402
from vectors import mix, noise, normalize, scale, smoothstep  # noqa: E402

TILE, SAMPLES = 64, 3
BEATS = (0.0, 0.55, 1.0, 0.55)  # of the wings: 0 swept back, 1 stretched out

BOARD = 0.62  # m, its top
RADIUS, HEIGHT = 0.3, 0.55  # m, of the skep
COILS, SIDES = 13, 72


def ellipse(x, y, at, half, turn=0.0):
    """Below 1 inside."""
    x, y = x - at[0], y - at[1]
    c, s = math.cos(turn), math.sin(turn)
    return math.hypot((c * x + s * y) / half[0], (c * y - s * x) / half[1])


def bee(beat, x, y):
    """sRGB and what it covers, at x, y in -1..1, y up."""
    x = abs(x)
    out = (0.0, 0.0, 0.0, 0.0)

    def over(colour, alpha):
        nonlocal out
        a = alpha + out[3] * (1 - alpha)
        if a > 0:
            out = tuple((colour[i] * alpha + out[i] * out[3] * (1 - alpha)) / a for i in range(3)) + (a,)

    def body(at, half, colour, turn=0.0):
        over(colour, smoothstep(1.06, 0.94, ellipse(x, y, at, half, turn)))

    sweep = -0.95 + 0.75 * beat
    for length, turn, root in ((0.60, sweep, 0.18), (0.42, sweep - 0.45, 0.06)):
        at = (0.1 + 0.5 * length * math.cos(turn), root + 0.5 * length * math.sin(turn))
        rim = ellipse(x, y, at, (0.5 * length, 0.15), turn)
        over(mix((0.86, 0.90, 0.94), (0.55, 0.52, 0.46), smoothstep(0.75, 0.95, rim)), 0.62 * smoothstep(1.05, 0.92, rim))
    for k in (-1, 0, 1):
        body((0.24, 0.12 + 0.16 * k), (0.13, 0.025), (0.1, 0.07, 0.04), 0.5 * k - 0.15)
    shade = 1 - 0.45 * (x / 0.26) ** 2
    stripe = math.sin(15.5 * (y + 0.02 + 0.25 * x * x))
    colour = mix((0.13, 0.08, 0.04), (0.93, 0.62, 0.12), smoothstep(-0.25, 0.25, stripe))
    body((0, -0.38), (0.235, 0.42), scale(colour, shade))
    body((0, 0.16), (0.2, 0.2), scale((0.62, 0.42, 0.16), 1 - 0.4 * (x / 0.2) ** 2))
    body((0, 0.42), (0.15, 0.11), (0.17, 0.12, 0.07))
    body((0.11, 0.44), (0.045, 0.07), (0.05, 0.04, 0.04))
    body((0.1, 0.58), (0.018, 0.1), (0.1, 0.07, 0.05), -0.5)
    return out


def write_bee():
    rows = []
    for row in range(TILE):
        pixels = bytearray()
        for column in range(TILE * len(BEATS)):
            total = [0.0] * 4
            for sample in range(SAMPLES * SAMPLES):
                u = (column % TILE + (sample % SAMPLES + 0.5) / SAMPLES) / TILE
                v = (row + (sample // SAMPLES + 0.5) / SAMPLES) / TILE
                r, g, b, a = bee(BEATS[column // TILE], 2 * u - 1, 1 - 2 * v)
                total = [total[0] + r * a, total[1] + g * a, total[2] + b * a, total[3] + a]
            most = max(total[3], 1e-6)
            pixels += bytes([min(int(255 * c / most + 0.5), 255) for c in total[:3]]
                            + [int(255 * total[3] / SAMPLES ** 2 + 0.5)])
        rows.append(bytes(pixels))
    write_png(HERE / "bee.png", TILE * len(BEATS), rows, RGBA_8, srgb=True)
    print("bee.png", (HERE / "bee.png").stat().st_size, "bytes")


def skep(turn, up):
    """Radius and height of the wall at `up` from 0 (the board) to 1 (the top), with the coils' swell."""
    angle = up * math.pi / 2
    swell = 0.016 * abs(math.sin(math.pi * COILS * (up + turn / COILS))) ** 0.6
    r = RADIUS * math.cos(angle) ** 0.62
    return max(r + swell * math.cos(angle * 0.8), 0.0), BOARD + HEIGHT * math.sin(angle) ** 0.9 + swell * math.sin(angle)


def straw(turn, up):
    """Strands along the coils, binding across them, dark between them."""
    groove = abs(math.sin(math.pi * COILS * (up + turn / COILS)))
    strands = noise((40 * turn * 6.28, 60 * up, 0.5), 1)
    binding = smoothstep(0.86, 0.98, math.sin(2 * math.pi * 46 * turn + 9 * up))
    colour = mix((0.66, 0.50, 0.25), (0.84, 0.69, 0.40), 0.5 + 0.5 * strands)
    colour = mix(colour, (0.46, 0.32, 0.16), 0.6 * binding)
    return scale(colour, 0.42 + 0.58 * smoothstep(0.0, 0.6, groove))


def write_hive():
    obj = ObjWriter(["A skep of straw on a stand, by make_bees.py. Metres, Y up; v: x y z r g b (sRGB). MIT licence."])
    uv = obj.uv(0, 0)
    obj.begin_object("skep")
    steps = COILS * 5
    rows = []
    for step in range(steps + 1):
        up = min(step / steps, 0.999)
        row = []
        for side in range(SIDES):
            turn = side / SIDES
            angle = 2 * math.pi * turn
            r, y = skep(turn, up)
            below, above = skep(turn, max(up - 0.008, 0)), skep(turn, min(up + 0.008, 1))
            across = normalize((above[1] - below[1], below[0] - above[0], 0.0))
            p = (r * math.sin(angle), y, r * math.cos(angle))
            n = (across[0] * math.sin(angle), across[1], across[0] * math.cos(angle))
            door = math.hypot(p[0] / 0.075, (p[1] - BOARD - 0.035) / 0.06) if p[2] > 0 else 9.0
            colour = mix((0.03, 0.02, 0.015), straw(turn, up), smoothstep(0.85, 1.1, door))
            row.append(obj.add_vertex(p, n, colour))
        rows.append(row)
    obj.join(rows, uv, closed=True)
    obj.begin_object("stand")
    box(obj, uv, (0, BOARD - 0.02, 0.05), (0.8, 0.04, 0.86), (0.47, 0.37, 0.27))
    for x in (-0.3, 0.3):
        box(obj, uv, (x, BOARD - 0.065, 0.03), (0.07, 0.05, 0.78), (0.40, 0.31, 0.22))
        for z in (-0.26, 0.34):
            box(obj, uv, (x, BOARD / 2 - 0.2, z), (0.07, BOARD + 0.25, 0.07), (0.40, 0.31, 0.22))
    obj.save(HERE / "hive.obj")


def box(obj, uv, middle, size, colour):
    """With grain along its longest side."""
    for axis in range(3):
        for sign in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            pieces = (max(1, round(size[u] / 0.05)), max(1, round(size[v] / 0.05)))
            rows = []
            for i in range(pieces[0] + 1):
                row = []
                for j in range(pieces[1] + 1):
                    p = [0.0, 0.0, 0.0]
                    p[axis] = middle[axis] + sign * size[axis] / 2
                    p[u] = middle[u] + size[u] * (i / pieces[0] - 0.5)
                    p[v] = middle[v] + size[v] * (j / pieces[1] - 0.5)
                    n = tuple(float(sign) if k == axis else 0.0 for k in range(3))
                    tone = 1 + 0.14 * noise((40 * p[0], 9 * p[1], 3 * p[2]), 3)
                    row.append(obj.add_vertex(p, n, scale(colour, tone)))
                rows.append(row)
            if sign < 0:
                rows.reverse()
            obj.join(rows, uv)


if __name__ == "__main__":
    write_bee()
    write_hive()
