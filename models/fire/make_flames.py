"""Makes flames.png and puffs.png: flip-books of 6 x 6 frames of 64 x 64, RGBA, sRGB, frame 0 at the upper left.

flames.png: one tongue of fire from its birth to its end. Noise is carried upwards through the frames faster
than it changes, so that from frame to frame the eye sees it rise; the outline narrows to the top, and from
below it burns away. Alpha is the density of what glows, the colour goes from red at the thin rim to a pale yellow
where it is dense. To be added to what is behind.

puffs.png: one puff of smoke that swells, breaks up and thins out. White, to be given a colour; alpha is how
much it hides.

Each frame fades to nothing before its border, so that no square edge shows. Same bytes every run.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from png_writer import RGBA_8, write_png  # noqa: E402
from vectors import noise, smoothstep  # noqa: E402

COLUMNS = ROWS = 6
TILE = 64  # pixels


def turbulence(x, y, z, octaves, seed):
    """Octaves of noise, each half as large and strong: about -1..1."""
    total, strength, size = 0.0, 0.55, 1.0
    for octave in range(octaves):
        total += strength * noise((x * size, y * size, z * size), seed + octave)
        strength, size = strength * 0.5, size * 2
    return total


def flame(x, y, t):
    """Density in 0..1 at x, y in -1..1 (y up) and t in 0..1."""
    rise = 3.2 * t
    # What rises also sways, the more the higher.
    sway = 0.28 * (0.5 + 0.5 * y) * noise((0.0, 1.1 * y - rise, 2.0 * t), 90)
    x = x - sway
    height = 0.5 + 0.5 * y
    wide = 0.74 * (1 - height) ** 0.7 * smoothstep(-0.04, 0.34, height) * (0.7 + 0.3 * smoothstep(0, 0.15, t))
    inside = 1 - abs(x) / max(wide, 1e-3)
    ragged = turbulence(2.6 * x, 1.7 * y - rise, 1.6 * t, 4, 7)
    density = inside + 1.5 * ragged * (0.3 + 0.7 * height) - 0.1
    # Lit from below, burnt away from below.
    density -= 1.25 * smoothstep(0.4, 1.05, t) * (1.2 - height)
    density -= 1.2 * (1 - smoothstep(0.0, 0.18, t)) * height
    return smoothstep(0.05, 1.0, density) * margin(x + sway, y)


def puff(x, y, t):
    radius = 0.42 + 0.42 * math.sqrt(t)
    r = math.hypot(x, y) / radius
    bumps = turbulence(2.6 * x / radius, 2.6 * y / radius - 0.9 * t, 1.3 * t, 4, 31)
    density = 1 - r * r + (0.45 + 0.5 * t) * bumps
    thin = (1 - 0.75 * t) * (1 - smoothstep(0.75, 1.0, t))
    return smoothstep(0.0, 0.9, density) * thin * margin(x, y)


def margin(x, y):
    """1, and 0 on the border of a frame."""
    return smoothstep(0.98, 0.8, abs(x)) * smoothstep(0.98, 0.8, abs(y))


def fire_color(density):
    """sRGB, 0..1."""
    return (0.75 + 0.25 * smoothstep(0, 0.25, density),
            0.14 + 0.74 * smoothstep(0.02, 0.95, density),
            0.02 + 0.5 * smoothstep(0.5, 1.0, density))


def smoke_color(x, y, density):
    shade = 0.86 + 0.14 * smoothstep(-0.6, 0.6, y + 0.3 * (1 - density))
    return (shade, shade, shade)


def to_byte(value):
    return min(max(int(value * 255 + 0.5), 0), 255)


def draw(file, density_at, color_at):
    frames = COLUMNS * ROWS
    rows = []
    for row in range(ROWS * TILE):
        pixels = bytearray()
        for column in range(COLUMNS * TILE):
            frame = row // TILE * COLUMNS + column // TILE
            x = ((column % TILE) + 0.5) / TILE * 2 - 1
            y = 1 - ((row % TILE) + 0.5) / TILE * 2
            density = density_at(x, y, frame / (frames - 1))
            alpha = to_byte(density)
            color = color_at(x, y, density) if alpha else (0, 0, 0)
            pixels += bytes([to_byte(c) for c in color] + [alpha])
        rows.append(bytes(pixels))
    write_png(HERE / file, COLUMNS * TILE, rows, RGBA_8, srgb=True)
    print(file, (HERE / file).stat().st_size // 1024, "KiB")


def main():
    draw("flames.png", flame, lambda x, y, density: fire_color(density))
    draw("puffs.png", puff, smoke_color)


if __name__ == "__main__":
    main()
