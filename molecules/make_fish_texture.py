"""Makes fry.png: the flank of a small fish, 256 x 96 RGBA, sRGB, to be multiplied by a molecule's own colour.

u = 0 is the snout, u = 1 the tail's end; v = 0 the belly, v = 1 the back; the picture's last row is v = 0. The back is
dark, the flank a mirror, the belly white: seen from above such a fish is lost against the deep, from below against the
light, and from the side in what it mirrors. Alpha cuts the fork out of the tail. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "models"))

from png_writer import RGBA_8, write_png  # noqa: E402
from vectors import mix, noise, scale, smoothstep  # noqa: E402

WIDTH, HEIGHT, SAMPLES = 256, 96, 3
BACK, FLANK, BELLY, STRIPE = (0.20, 0.30, 0.34), (0.86, 0.90, 0.92), (0.97, 0.96, 0.93), (0.36, 0.52, 0.58)
FIN, PUPIL, IRIS = (0.62, 0.62, 0.50), (0.03, 0.03, 0.04), (0.93, 0.90, 0.72)
EYE = (0.085, 0.56)
TAIL = 0.87  # u, where the fin begins


def scales(u, v):
    """Rows of scales, each half a place on from the one below: light in the middle, dark at the rim."""
    across, along = 46 * u, 24 * v
    shift = 0.5 * (math.floor(along) % 2)
    x, y = (across + shift) % 1 - 0.5, along % 1 - 0.5
    return smoothstep(0.62, 0.30, math.hypot(x, y))


def colour(u, v):
    edge = 0.70 + 0.02 * noise((14 * u, 0.5, 0.5), 1)
    out = mix(FLANK, BACK, smoothstep(edge - 0.05, edge + 0.07, v))
    out = mix(out, STRIPE, 0.8 * smoothstep(0.045, 0.015, abs(v - edge + 0.07)))
    out = mix(out, BELLY, smoothstep(0.30, 0.16, v))
    body = smoothstep(0.20, 0.26, u) * smoothstep(TAIL + 0.01, TAIL - 0.06, u)
    out = scale(out, 1 - body * 0.16 * (1 - scales(u, v)))
    out = scale(out, 1 - 0.28 * body * smoothstep(0.62, 0.8, v) * smoothstep(0.1, 0.5, noise((30 * u, 12 * v, 0.5), 2)))
    gill = abs(math.hypot((u - 0.09) * 2.1, v - 0.5) - 0.24)
    out = scale(out, 1 - 0.45 * smoothstep(0.03, 0.008, gill) * smoothstep(0.1, 0.16, u) * smoothstep(0.85, 0.7, v))
    if u > TAIL - 0.03:
        rays = 0.85 + 0.15 * math.cos(70 * (v - 0.5) / (0.35 + 1.6 * (u - TAIL + 0.03)))
        out = mix(out, scale(FIN, rays), smoothstep(TAIL - 0.03, TAIL + 0.02, u))
    r = math.hypot((u - EYE[0]) * 3.3, v - EYE[1])
    out = mix(out, IRIS, smoothstep(0.118, 0.10, r))
    out = mix(out, PUPIL, smoothstep(0.072, 0.055, r))
    mouth = abs(v - 0.44 - 0.6 * u)
    return scale(out, 1 - 0.5 * smoothstep(0.03, 0.01, mouth) * smoothstep(0.06, 0.03, u))


def inside(u, v):
    """The fork is cut out behind the fin's middle."""
    reach = 0.995 - 0.09 * smoothstep(0.36, 0.0, abs(v - 0.5))
    return 1.0 if u < reach else 0.0


def main():
    rows = []
    for row in range(HEIGHT):
        pixels = bytearray()
        for column in range(WIDTH):
            total, cover = (0.0, 0.0, 0.0), 0.0
            for sample in range(SAMPLES * SAMPLES):
                u = (column + (sample % SAMPLES + 0.5) / SAMPLES) / WIDTH
                v = 1 - (row + (sample // SAMPLES + 0.5) / SAMPLES) / HEIGHT
                total = tuple(t + c for t, c in zip(total, colour(u, v)))
                cover += inside(u, v)
            count = SAMPLES * SAMPLES
            pixels += bytes([min(max(int(255 * c / count + 0.5), 0), 255) for c in total] + [int(255 * cover / count + 0.5)])
        rows.append(bytes(pixels))
    write_png(HERE / "fry.png", WIDTH, rows, RGBA_8, srgb=True)
    print("fry.png", (HERE / "fry.png").stat().st_size, "bytes")


if __name__ == "__main__":
    main()
