"""Writes PNG files with nothing but the standard library.

Rows are bytes objects, from the top of the picture to the bottom; 16-bit samples are big-endian,
as PNG has them. Every row uses the filter that leaves the smallest sum of residuals.
Source: PNG specification, third edition [W3C 2025], sections 5, 9 and 11.
"""

import struct
import zlib

GREY_16 = (16, 0, 2)  # bit depth, colour type, bytes per pixel
RGBA_8 = (8, 6, 4)


def write_png(path, width, rows, layout, srgb=False, comment=None):
    """rows: one bytes object per row, each width * bytes per pixel long."""
    depth, colour_type, pixel_bytes = layout
    assert all(len(row) == width * pixel_bytes for row in rows)
    header = struct.pack(">IIBBBBB", width, len(rows), depth, colour_type, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        _write_chunk(file, b"IHDR", header)
        if srgb:
            _write_chunk(file, b"sRGB", b"\x00")
        if comment:
            _write_chunk(file, b"tEXt", b"Comment\x00" + comment.encode("latin-1"))
        _write_chunk(file, b"IDAT", zlib.compress(_filter_rows(rows, pixel_bytes), 9))
        _write_chunk(file, b"IEND", b"")


def _write_chunk(file, kind, data):
    file.write(struct.pack(">I", len(data)) + kind + data)
    file.write(struct.pack(">I", zlib.crc32(kind + data)))


def _filter_rows(rows, pixel_bytes):
    out = bytearray()
    above = bytes(len(rows[0]))
    for row in rows:
        left = bytes(pixel_bytes) + row[:-pixel_bytes]
        candidates = (
            (0, row),
            (1, bytes((x - a) & 255 for x, a in zip(row, left))),
            (2, bytes((x - b) & 255 for x, b in zip(row, above))),
            (3, bytes((x - (a + b) // 2) & 255 for x, a, b in zip(row, left, above))),
        )
        kind, best = min(candidates, key=lambda c: sum(min(x, 256 - x) for x in c[1]))
        out.append(kind)
        out += best
        above = row
    return bytes(out)
