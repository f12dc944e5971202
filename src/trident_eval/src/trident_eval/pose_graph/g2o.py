# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a picture of a pose graph needs of its g2o file."""

from __future__ import annotations

import gzip
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from trident_eval.core.errors import EvalError

_SIZES = {"VERTEX_SE2": 2, "VERTEX_SE3:QUAT": 3}


@dataclass(frozen=True)
class Layout:
    """Where the vertices of a pose graph are, and which are joined."""

    ids: NDArray[np.int64]  #: (n,), sorted
    positions: NDArray[np.float64]  #: (n, 2 or 3) [m], in the order of the ids
    edges: NDArray[np.int64]  #: (m, 2) ids

    @property
    def is_3d(self) -> bool:
        """Whether the graph is one in space."""
        return self.positions.shape[1] == 3

    def segments(self, edges: Iterable[Iterable[int]] | None = None) -> NDArray[np.float64]:
        """Ends of edges, (m, 2, 2 or 3) [m]; all of them, or those between these pairs of ids."""
        pairs = self.edges if edges is None else np.array(list(edges), dtype=np.int64)
        rows = np.searchsorted(self.ids, pairs.reshape(-1, 2))
        return np.asarray(self.positions[rows])


def read_layout(file: Path) -> Layout:
    """Reads a file that ``trident_slam/pose_graph`` wrote.

    Raises:
        EvalError: the file cannot be read, or has no vertices.
    """
    try:
        data = file.read_bytes()
        text = (gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data).decode(
            "ascii", "replace"
        )
    except (OSError, EOFError) as error:
        raise EvalError(f"{file}: cannot be read: {error}") from error
    positions: dict[int, list[float]] = {}
    edges: list[tuple[int, int]] = []
    for line in text.splitlines():
        words = line.split()
        if words and words[0] in _SIZES:
            positions[int(words[1])] = [float(word) for word in words[2 : 2 + _SIZES[words[0]]]]
        elif words and words[0].startswith("EDGE_"):
            edges.append((int(words[1]), int(words[2])))
    if not positions:
        raise EvalError(f"{file}: has no vertices")
    ids = sorted(positions)
    return Layout(
        np.array(ids, dtype=np.int64),
        np.array([positions[k] for k in ids]),
        np.array(edges, dtype=np.int64).reshape(-1, 2),
    )
