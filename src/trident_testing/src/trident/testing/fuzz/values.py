# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Values of the fields of messages that programs do not expect."""

from __future__ import annotations

import math

_INF, _NAN = math.inf, math.nan
_INT_BITS = {
    **{f"int{bits}": (bits, True) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (bits, False) for bits in (8, 16, 32, 64)},
    "byte": (8, True),
    "char": (8, False),
}

#: Of float64: what no sum, no cell index and no int survives.
DOUBLES = (_NAN, _INF, -_INF, 1e308, -1e308, 1e9, -1e9, 1e30, 5e-324, 0.0, -0.0, -1.0)
#: Of float32, whose largest number is smaller.
SINGLES = (_NAN, _INF, -_INF, 3.4e38, -3.4e38, 1e9, -1e9, 1e30, 1e-45, 0.0, -0.0, -1.0)

#: Of time, in seconds and nanoseconds; the last ones have too many nanoseconds.
STAMPS = (
    (0, 0),
    (0, 1),
    (1_000_000_000, 0),
    (2**31 - 1, 0),
    (2**31, 0),
    (4_000_000_000, 0),
    (2**32 - 1, 999_999_999),
    (1, 2**32 - 1),
    (2**32 - 1, 2**32 - 1),
)
#: Of duration.
DURATIONS = (
    (0, 0),
    (0, 1),
    (-1, 0),
    (1_000_000_000, 0),
    (2**31 - 1, 999_999_999),
    (-(2**31), 0),
    (0, 2**31 - 1),
    (0, -(2**31)),
)
#: Of string; where a name is meant, where a number is, where a file is.
TEXTS = (
    "",
    "/",
    "~",
    " ",
    "no_such_name",
    "/no_such_folder/no_such_file",
    "a::b::c",
    "::",
    "../../..",
    "%s%n%x",
    "nan",
    "1e400",
    "[[[[[[[[",
    "<sdf><model/>",
    "two\nlines\r\x1b[31m",
    "\x00",
    "\u00e9\u202e\U0001f916",
    "n" * 300,
)
LONG_TEXT = "x" * 50_000

#: Of arrays: lengths that are more or less than a program counts on, and now and then a huge one.
LENGTHS = (0, 0, 1, 2, 1000)
HUGE_LENGTH = 100_000
#: Of arrays of messages, which may have arrays in them.
FEW_LENGTHS = (0, 0, 1, 2, 20)
HUGE_FEW_LENGTH = 300


def whole_numbers(kind: str) -> tuple[int, ...]:
    """Those at the ends of an integer type's range, and next to zero."""
    bits, is_signed = _INT_BITS[kind]
    least = -(2 ** (bits - 1)) if is_signed else 0
    most = 2 ** (bits - 1) - 1 if is_signed else 2**bits - 1
    return (0, 1, most, most - 1, least, -1 if is_signed else 2 ** (bits - 1))


def is_whole_number(kind: str) -> bool:
    """Whether a field type is an integer."""
    return kind in _INT_BITS


def fits(kind: str, value: int) -> int:
    """A value that the integer type can hold."""
    numbers = whole_numbers(kind)
    return min(max(value, min(numbers)), max(numbers))
