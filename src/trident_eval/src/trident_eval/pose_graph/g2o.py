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


def _read_text(file: Path) -> str:
    """Text of a file, which may be gzipped."""
    try:
        data = file.read_bytes()
        plain = gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data
    except (OSError, EOFError) as error:
        raise EvalError(f"{file}: cannot be read: {error}") from error
    return plain.decode("ascii", "replace")


def _parse(text: str) -> tuple[dict[int, list[float]], list[tuple[int, int]]]:
    """Positions of vertices by their numbers, and the pairs that edges join."""
    positions: dict[int, list[float]] = {}
    edges: list[tuple[int, int]] = []
    for line in text.splitlines():
        kind, *words = line.split() or [""]
        if kind in _SIZES:
            positions[int(words[0])] = [float(word) for word in words[1 : 1 + _SIZES[kind]]]
        elif kind.startswith("EDGE_"):
            edges.append((int(words[0]), int(words[1])))
    return positions, edges


def read_layout(file: Path) -> Layout:
    """Reads a file that ``trident_slam/pose_graph`` wrote.

    Raises:
        EvalError: the file cannot be read, or has no vertices.
    """
    positions, edges = _parse(_read_text(file))
    if not positions:
        raise EvalError(f"{file}: has no vertices")
    ids = sorted(positions)
    return Layout(
        np.array(ids, dtype=np.int64),
        np.array([positions[k] for k in ids]),
        np.array(edges, dtype=np.int64).reshape(-1, 2),
    )
