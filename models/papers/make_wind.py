"""Makes wind.raw: the velocities of a hurricane at one moment on a grid, as Decker's volume of wind speeds was.

The data of hurricane Bonnie that he used are not ours to ship, so that the velocities are those of the profile of Holland
[Holland 1980] with inflow below and outflow above, as the field `hurricane` of docs/scene-format.md has them, scaled to
100 m. wind.json says how the numbers lie: x, y and z of a cell together, x fastest, half floats, little-endian.

Metres, metres a second; Y is up, the eye at x = z = 0. Same bytes every run.
"""

import json
import math
import pathlib
import struct

HERE = pathlib.Path(__file__).resolve().parent

CELLS = (48, 8, 48)
LOW, HIGH = (-72.0, 0.0, -72.0), (72.0, 40.0, 72.0)  # m
SPEED, RADIUS, SHAPE, INFLOW, HEIGHT = 16.0, 12.0, 1.6, 0.3, 40.0


def around(r):
    """The speed around the axis at the ground, and what the updraft hangs on: V/r + dV/dr."""
    s = (RADIUS / r) ** SHAPE
    v = SPEED * math.sqrt(s * math.exp(1 - s))
    return v, v / r * (1 + 0.5 * SHAPE * (s - 1))


def velocity(x, y, z):
    r = max(math.hypot(x, z), 0.5)
    v, rise = around(r)
    turn = v * math.cos(0.5 * math.pi * y / HEIGHT)
    inwards = math.tan(INFLOW) * v * math.cos(math.pi * y / HEIGHT)
    up = math.tan(INFLOW) * rise * HEIGHT / math.pi * math.sin(math.pi * y / HEIGHT)
    # Anticlockwise seen from above: +x turns to -z.
    return (turn * z / r - inwards * x / r, up, -turn * x / r - inwards * z / r)


def main():
    numbers = []
    for k in range(CELLS[2]):
        for j in range(CELLS[1]):
            for i in range(CELLS[0]):
                p = [LOW[a] + (HIGH[a] - LOW[a]) * (n + 0.5) / CELLS[a] for a, n in enumerate((i, j, k))]
                numbers += velocity(*p)
    (HERE / "wind.raw").write_bytes(struct.pack("<%de" % len(numbers), *numbers))
    layout = {"$schema": "../field.schema.json", "format": "shoal-field-1", "resolution": CELLS,
              "bounds": {"low": LOW, "high": HIGH}, "encoding": "float16"}
    lines = ",\n".join("  %s: %s" % (json.dumps(key), json.dumps(value)) for key, value in layout.items())
    (HERE / "wind.json").write_text("{\n" + lines + "\n}\n", encoding="ascii", newline="\n")
    print("wind.raw: %d cells" % math.prod(CELLS))


if __name__ == "__main__":
    main()
