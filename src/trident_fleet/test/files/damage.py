# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Damaged .mat files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hypothesis import strategies as st
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.mat_file import LayoutRequest, read_mat_positions


def check_damaged(path: Path, good: bytes, first: int, request: LayoutRequest, data: Any) -> None:
    """Reads a file with other bytes in one place: it is refused by its name or has positions.

    Args:
        path: where it is written.
        good: the whole file.
        first: byte of it from which on it may be damaged.
        request: how it is read.
        data: of hypothesis.
    """
    place = data.draw(st.integers(first, len(good) - 1))
    cut = data.draw(st.sampled_from([0, 1, 4, len(good)]))
    patch = data.draw(st.binary(max_size=4))
    path.write_bytes(good[:place] + patch + good[place + cut :])
    try:
        read = read_mat_positions(path, request)
    except FormationError as refusal:
        message = str(refusal)
    else:
        message = str(path)
        assert read.shape[2] == 3
    assert str(path) in message
