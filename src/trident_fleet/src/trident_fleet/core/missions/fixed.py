# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pieces shared out before a mission, so that all robots are done together: no auction."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from trident_fleet.core.missions.duties import searchers_of
from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.pieces import Piece
from trident_fleet.core.missions.robot import Ground
from trident_fleet.core.search.area import Array
from trident_fleet.core.search.shares import Searcher, balanced_shares


def fixed_owners(
    pieces: Sequence[Piece], kinds: dict[str, Kind], grounds: dict[str, Ground]
) -> dict[str, str]:
    """Who searches which piece, by the name of its task; pieces that nobody gets to are left out.

    Args:
        pieces: of the area.
        kinds: of the robots by name.
        grounds: of the kinds by name.
    """
    cell, shape = _grid(pieces)
    flies = any(kind.domain == "air" for kind in kinds.values())
    searchers = []
    for name, kind in kinds.items():
        seconds = np.full(shape, np.inf)
        for piece in _pieces_for(kind, pieces, flies):
            seconds[cell[piece.name]] = grounds[kind.name].work_m[piece.place] / kind.speed_m_s
        searchers += _searcher(name, seconds)
    owner = balanced_shares(searchers).owner
    return {
        piece.name: searchers[owner[cell[piece.name]]].name
        for piece in pieces
        if owner[cell[piece.name]] >= 0
    }


def _grid(pieces: Sequence[Piece]) -> tuple[dict[str, tuple[int, int]], tuple[int, int]]:
    """Row and column of each piece by name, and how many of both there are."""
    xs = sorted({piece.x for piece in pieces})
    ys = sorted({piece.y for piece in pieces})
    cell = {piece.name: (ys.index(piece.y), xs.index(piece.x)) for piece in pieces}
    return cell, (len(ys), len(xs))


def _pieces_for(kind: Kind, pieces: Sequence[Piece], flies: bool) -> list[Piece]:
    """Those that robots of a kind search."""
    return [piece for piece in pieces if kind.domain in searchers_of(piece, flies)]


def _searcher(name: str, seconds: Array) -> list[Searcher]:
    """A robot that begins at the first piece it gets to; none if it gets to no piece."""
    free = np.argwhere(np.isfinite(seconds))
    return [Searcher(name, (int(free[0][0]), int(free[0][1])), seconds)] if len(free) else []
