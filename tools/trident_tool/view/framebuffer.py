# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a virtual X screen, without an image library: XWD in, PNG out."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

from trident_tool.workspace import TridentError

_HEADER = struct.Struct(">25I")
_COLOR_BYTES = 12  # size of one entry of the colour map between header and pixels


@dataclass(frozen=True)
class Image:
    """An RGB picture; ``rgb`` holds 3 bytes per pixel, row by row from the top."""

    width: int
    height: int
    rgb: bytes

    def is_blank(self) -> bool:
        """Whether every pixel has the same colour."""
        return self.rgb == self.rgb[:3] * (self.width * self.height)

    def cropped(self) -> Image:
        """This picture without the black rows and columns around it; as it is if all is black."""
        rows = self._rows()
        bright_rows = [index for index, row in enumerate(rows) if any(row)]
        if not bright_rows:
            return self
        rows = rows[bright_rows[0] : bright_rows[-1] + 1]
        left = min(len(row) - len(row.lstrip(b"\0")) for row in rows) // 3
        right = -(-max(len(row.rstrip(b"\0")) for row in rows) // 3)
        return Image(right - left, len(rows), b"".join(row[3 * left : 3 * right] for row in rows))

    def _rows(self) -> list[bytes]:
        stride = 3 * self.width
        return [self.rgb[row * stride : (row + 1) * stride] for row in range(self.height)]


def read_xwd(data: bytes) -> Image:
    """Decodes an X window dump of version 7 in 32 bits per pixel, as Xvfb keeps it.

    Raises:
        TridentError: the data is something else or cut short.
    """
    fields = _header_fields(data)
    header_bytes, width, height = fields[0], fields[4], fields[5]
    little_endian, row_bytes, colors = fields[7] == 0, fields[12], fields[19]
    start = header_bytes + colors * _COLOR_BYTES
    if len(data) < start + row_bytes * height:
        raise TridentError("the X window dump is cut short")
    offsets = (2, 1, 0) if little_endian else (1, 2, 3)
    begins = range(start, start + row_bytes * height, row_bytes)
    rows = [_rgb(data[begin : begin + 4 * width], width, offsets) for begin in begins]
    return Image(width, height, b"".join(rows))


def _header_fields(data: bytes) -> tuple[int, ...]:
    if len(data) < _HEADER.size:
        raise TridentError(f"not an X window dump: {len(data)} bytes, need at least {_HEADER.size}")
    fields: tuple[int, ...] = _HEADER.unpack_from(data)
    version, bits_per_pixel = fields[1], fields[11]
    if version != 7 or bits_per_pixel != 32:
        raise TridentError(f"X window dump of version {version}, {bits_per_pixel} bits: need 7, 32")
    return fields


def _rgb(pixels: bytes, width: int, offsets: tuple[int, int, int]) -> bytes:
    """A row of 4 bytes a pixel in 3 bytes each; ``offsets``: where red, green and blue are."""
    rgb = bytearray(3 * width)
    for channel, offset in enumerate(offsets):
        rgb[channel::3] = pixels[offset::4]
    return bytes(rgb)


def write_png(image: Image, target: Path) -> None:
    """Writes ``image`` as an 8-bit RGB PNG file."""
    stride = 3 * image.width
    rows = b"".join(
        b"\0" + image.rgb[row * stride : (row + 1) * stride] for row in range(image.height)
    )

    def chunk(kind: bytes, body: bytes) -> bytes:
        return (
            struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        )

    header = struct.pack(">IIBBBBB", image.width, image.height, 8, 2, 0, 0, 0)
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(rows, 6))
        + chunk(b"IEND", b"")
    )
