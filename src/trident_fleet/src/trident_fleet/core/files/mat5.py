# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""MATLAB level 5 MAT-files (v5, v6, v7): their full numeric matrices, and the names of the rest.

Source: MathWorks, MAT-File Format (level 5). A reader of its own, because a damaged file must give
an error and not take the process with it, and because it is read in the start-up of every vehicle.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

MAGIC = b"MATLAB 5.0 MAT-file"
_HEADER_BYTES = 128
_MAX_BYTES = 1 << 28

_MI_MATRIX = 14
_MI_COMPRESSED = 15
_MI_INT8, _MI_INT32, _MI_UINT32 = 1, 5, 6
_NUMBERS = {
    1: "i1",
    2: "u1",
    3: "i2",
    4: "u2",
    5: "i4",
    6: "u4",
    7: "f4",
    9: "f8",
    12: "i8",
    13: "u8",
}
_CLASSES = {
    1: "cell",
    2: "struct",
    3: "object",
    4: "char",
    5: "sparse",
    6: "double",
    7: "single",
    8: "int8",
    9: "uint8",
    10: "int16",
    11: "uint16",
    12: "int32",
    13: "uint32",
    14: "int64",
    15: "uint64",
}
_FIRST_NUMERIC = 6
_COMPLEX_FLAG = 0x0800


class MatError(ValueError):
    """Not a level 5 MAT-file, or a damaged one: what is wrong, and where in the file."""


@dataclass(frozen=True)
class Variable:
    """One variable of a file.

    Attributes:
        name: of the variable.
        kind: MATLAB class, e.g. `double`; `complex double` for complex numbers.
        values: numbers as float64 in MATLAB's shape; None unless a full, real, numeric matrix.
    """

    name: str
    kind: str
    values: npt.NDArray[np.float64] | None


@dataclass(frozen=True)
class _Element:
    """A tagged piece of data: its type, and where it lies."""

    kind: int
    data: memoryview
    offset: int


def read_variables(raw: bytes) -> list[Variable]:
    """Read all variables of a file.

    Args:
        raw: the whole file.

    Raises:
        MatError: another format, or damaged.
    """
    order = _byte_order(raw)
    variables = []
    for element in _elements(memoryview(raw), _HEADER_BYTES, order):
        if element.kind == _MI_COMPRESSED:
            inner = memoryview(_inflate(element))
            for matrix in _elements(inner, 0, order):
                variables.append(_read_matrix(matrix, order))
        else:
            variables.append(_read_matrix(element, order))
    return variables


def _byte_order(raw: bytes) -> str:
    if len(raw) < _HEADER_BYTES:
        raise MatError(f"{len(raw)} bytes, the header alone has {_HEADER_BYTES}")
    mark = raw[126:128]
    if mark not in (b"IM", b"MI"):
        raise MatError(f"byte order mark {mark!r} at offset 126, must be b'IM' or b'MI'")
    return "<" if mark == b"IM" else ">"


def _inflate(element: _Element) -> bytes:
    decompressor = zlib.decompressobj()
    try:
        inflated = decompressor.decompress(element.data, _MAX_BYTES)
    except zlib.error as error:
        raise MatError(f"compressed data at offset {element.offset}: {error}") from error
    if decompressor.unconsumed_tail:
        raise MatError(f"compressed data at offset {element.offset}: more than {_MAX_BYTES} bytes")
    return inflated


def _elements(data: memoryview, start: int, order: str) -> Iterator[_Element]:
    """Elements of `data` from offset `start` to its end."""
    offset = start
    while offset < len(data):
        if len(data) - offset < 8:
            raise MatError(f"{len(data) - offset} stray bytes at offset {offset}")
        kind, size = struct.unpack_from(order + "II", data, offset)
        begin = offset + 8
        if kind >> 16:
            # Up to four bytes lie in the tag itself, their number in its upper half.
            kind, size, begin = kind & 0xFFFF, kind >> 16, offset + 4
            end = offset + 8
        else:
            padding = 0 if kind == _MI_COMPRESSED else -size % 8
            end = begin + size + padding
        if begin + size > min(len(data), end):
            raise MatError(
                f"{size} bytes announced at offset {offset}, {len(data) - begin} are there"
            )
        yield _Element(kind, data[begin : begin + size], offset)
        offset = end


def _read_matrix(element: _Element, order: str) -> Variable:
    if element.kind != _MI_MATRIX:
        raise MatError(f"element of type {element.kind} at offset {element.offset}, must be 14")
    parts = _elements(element.data, 0, order)
    flags = _numbers(_next(parts, "flags", element), order)
    shape = _numbers(_next(parts, "dimensions", element), order)
    name = bytes(_next(parts, "name", element).data).decode("latin-1")
    kind, is_numeric = _class_of(flags, name)
    if not is_numeric:
        return Variable(name, kind, None)
    values = _numbers(_next(parts, "values", element), order).astype(np.float64)
    return Variable(name, kind, _shaped(values, [int(size) for size in shape], name))


def _class_of(flags: npt.NDArray[Any], name: str) -> tuple[str, bool]:
    """The class of a matrix in words, and whether its values are real numbers."""
    if not len(flags) or not flags[0] & 0xFF:
        raise MatError(f"matrix '{name}' without a class")
    number = int(flags[0]) & 0xFF
    kind = _CLASSES.get(number, f"class {number}")
    if int(flags[0]) & _COMPLEX_FLAG:
        return f"complex {kind}", False
    return kind, number >= _FIRST_NUMERIC and number in _CLASSES


def _shaped(
    values: npt.NDArray[np.float64], sizes: list[int], name: str
) -> npt.NDArray[np.float64]:
    """The matrix of values that stand column by column."""
    if len(sizes) < 2 or min(sizes) < 0 or _product(sizes) != len(values):
        raise MatError(f"matrix '{name}': {len(values)} values for dimensions {sizes}")
    return values.reshape(sizes, order="F")


def _next(parts: Iterator[_Element], what: str, matrix: _Element) -> _Element:
    part = next(parts, None)
    if part is None:
        raise MatError(f"matrix at offset {matrix.offset} without {what}")
    return part


def _numbers(element: _Element, order: str) -> npt.NDArray[np.generic]:
    kind = _NUMBERS.get(element.kind)
    if kind is None:
        raise MatError(f"numbers of type {element.kind}, must be one of {sorted(_NUMBERS)}")
    dtype = np.dtype(order + kind)
    if len(element.data) % dtype.itemsize:
        raise MatError(f"{len(element.data)} bytes are no whole number of {dtype.itemsize}")
    return np.frombuffer(element.data, dtype=dtype)


def _product(sizes: list[int]) -> int:
    total = 1
    for size in sizes:
        total *= size
    return total
