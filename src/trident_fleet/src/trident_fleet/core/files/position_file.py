# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Writes position files in the forms that `formation_file` reads."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.files.mat_file import VARIABLE
from trident_fleet.core.quintic import Array

_MAT_LAYOUT = "3xNxT"
_MAT_TEXT_BYTES = 116


def write_positions(path: Path, rows: Array, comments: list[str]) -> None:
    """Write rows as a .mat file (v5, 3 x N x T) or, by any other suffix, as text.

    The same rows give the same bytes.

    Args:
        path: of the file.
        rows: p_world of each row and vehicle [m], shape (T, N, 3).
        comments: lines that a text file begins with.

    Raises:
        FormationError: the file cannot be written.
    """
    is_mat = path.suffix.lower() == ".mat"
    content = _mat_bytes(rows) if is_mat else _text(rows, comments).encode()
    try:
        path.write_bytes(content)
    except OSError as error:
        raise FormationError(f"{path}: {error.strerror}; legal: a file in a folder") from error


def reading_args(path: Path, rows: Array) -> dict[str, str]:
    """Arguments that a reader of `write_positions`' file needs in addition to `formation_file`."""
    vehicles = rows.shape[1]
    try:
        if read_formation(FormationSource(str(path), uavs=vehicles)).shape == rows.shape:
            return {}
    except FormationError:
        pass
    if path.suffix.lower() == ".mat":
        return {"layout": _MAT_LAYOUT}
    return {"vehicles_in_file": str(vehicles)}


def _text(rows: Array, comments: list[str]) -> str:
    lines = [f"% {comment}" for comment in comments]
    lines.append("% index\tx\ty\tz")
    # Adding 0 makes a zero of minus zero.
    for number, point in enumerate(np.round(rows, 6).reshape(-1, 3) + 0.0, start=1):
        lines.append("\t".join([str(number), *(f"{value:.6f}" for value in point)]))
    return "\n".join(lines) + "\n"


def _mat_bytes(rows: Array) -> bytes:
    from scipy.io import savemat

    stream = io.BytesIO()
    matrix = np.transpose(rows, ["TN3".index(axis) for axis in _MAT_LAYOUT.split("x")])
    savemat(stream, {VARIABLE: matrix}, do_compression=True)
    # The text at the beginning holds the time of writing.
    text = b"MATLAB 5.0 MAT-file, positions of a formation".ljust(_MAT_TEXT_BYTES)
    return text + stream.getvalue()[_MAT_TEXT_BYTES:]
