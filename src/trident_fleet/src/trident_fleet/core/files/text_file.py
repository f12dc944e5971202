# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of positions from the text files that MATLAB and Octave write."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import numpy.typing as npt

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.bounded_file import read_bounded

COLUMNS = ("index", "x", "y", "z")
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?\Z")
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)\Z", re.IGNORECASE)
_COMMENT = re.compile("[%#]")


def read_text_rows(path: Path) -> npt.NDArray[np.float64]:
    """Read a text file of `index x y z` rows.

    Columns are separated by tabs, spaces or commas; leading blanks, blank lines, `%` (or `#`)
    comments, CRLF and scientific notation are fine.

    Args:
        path: the file.

    Returns:
        Positions in the file's own units, shape (rows, 3). The index column is checked to be a
        number and then left out: the order of the lines is what counts.

    Raises:
        FormationError: unreadable or empty file, a missing column, a cell that is no finite number.
    """
    rows = []
    for number, line in enumerate(_decode(path).splitlines(), start=1):
        content = _COMMENT.split(line, maxsplit=1)[0].strip()
        if content:
            rows.append(_parse_row(content, f"{path}:{number}"))
    if not rows:
        raise FormationError(f"{path}: no rows; legal: lines of `{' '.join(COLUMNS)}`")
    return np.array(rows, dtype=np.float64)


def _decode(path: Path) -> str:
    raw = read_bounded(path)
    if b"\0" in raw:
        raise FormationError(
            f"{path}: binary data (a zero byte at offset {raw.index(0)}); legal: a text file of"
            f" `{' '.join(COLUMNS)}` rows, or a MATLAB .mat file"
        )
    return raw.decode("utf-8-sig", errors="replace")


def _parse_row(content: str, where: str) -> list[float]:
    cells = [cell.strip() for cell in content.split(",")] if "," in content else content.split()
    if len(cells) != len(COLUMNS):
        raise FormationError(
            f"{where}: {len(cells)} column{'s' * (len(cells) != 1)} in '{_shorten(content)}';"
            f" legal: {len(COLUMNS)} (`{' '.join(COLUMNS)}`)"
        )
    return [
        _parse_cell(cell, f"{where}: column {name}")
        for cell, name in zip(cells, COLUMNS, strict=True)
    ][1:]


def _parse_cell(cell: str, where: str) -> float:
    if _NOT_FINITE.match(cell):
        raise FormationError(f"{where}: {cell} is not finite; legal: a finite number")
    if not _NUMBER.match(cell):
        raise FormationError(f"{where}: '{_shorten(cell)}' is not a number; legal: e.g. -1.5, 2e-3")
    value = float(cell.replace("d", "e").replace("D", "e"))
    if not math.isfinite(value):
        raise FormationError(f"{where}: {cell} is out of range; legal: |value| < 1.8e308")
    return value


def _shorten(text: str, limit: int = 60) -> str:
    return text if len(text) <= limit else text[: limit - 3] + "..."
