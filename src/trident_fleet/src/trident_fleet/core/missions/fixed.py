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
    xs = sorted({piece.x for piece in pieces})
    ys = sorted({piece.y for piece in pieces})
    cell = {piece.name: (ys.index(piece.y), xs.index(piece.x)) for piece in pieces}
    flies = any(kind.domain == "air" for kind in kinds.values())
    searchers = []
    for name, kind in kinds.items():
        seconds = np.full((len(ys), len(xs)), np.inf)
        for piece in pieces:
            if kind.domain in searchers_of(piece, flies):
                seconds[cell[piece.name]] = grounds[kind.name].work_m[piece.place] / kind.speed_m_s
        free = np.argwhere(np.isfinite(seconds))
        if len(free):
            searchers.append(Searcher(name, (int(free[0][0]), int(free[0][1])), seconds))
    owner = balanced_shares(searchers).owner
    names = [searcher.name for searcher in searchers]
    return {
        piece.name: names[owner[cell[piece.name]]]
        for piece in pieces
        if owner[cell[piece.name]] >= 0
    }
