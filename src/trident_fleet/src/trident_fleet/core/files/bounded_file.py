# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Files of limited size: a device is endless, and nobody writes so much by hand."""

from __future__ import annotations

import stat
from pathlib import Path

from trident_fleet.core.errors import FormationError

LARGEST_BYTES = 1 << 28
LARGEST_YAML_BYTES = 1 << 24


def read_bounded(path: Path, most_bytes: int = LARGEST_BYTES) -> bytes:
    """Content of a file, or of a pipe.

    Raises:
        FormationError: a device, or more than `most_bytes`.
        OSError: it cannot be read.
    """
    check_kind(path)
    size = path.stat().st_size
    if size <= most_bytes:
        with path.open("rb") as stream:
            content = stream.read(most_bytes + 1)  # a pipe reports no size
        size = max(size, len(content))
    if size > most_bytes:
        raise FormationError(f"{path}: more than {most_bytes} bytes; legal: at most so many")
    return content


def check_kind(path: Path) -> None:
    """Refuse a device.

    Raises:
        FormationError: it is one.
        OSError: there is no such file.
    """
    mode = path.stat().st_mode
    if stat.S_ISCHR(mode) or stat.S_ISBLK(mode):
        raise FormationError(f"{path}: a device; legal: a file")
