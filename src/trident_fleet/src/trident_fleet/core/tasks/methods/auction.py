# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""One task for each robot by prices that bidders drive up, exact by scaling the least increment.

Source: D. P. Bertsekas, The auction algorithm: a distributed relaxation method for the assignment
problem, Annals of Operations Research 14, 1988: with integer costs and an increment below 1/N the
assignment is optimal.

Robots bid their costs once, and the manager lets them raise prices against each other in mind: over
a network each rise would be a message, hundreds for each task, and a lossy one would stop it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from trident_fleet.core.quintic import Array
from trident_fleet.core.tasks.methods.base import Offer
from trident_fleet.core.tasks.methods.optimal import Optimal, paired

_STEPS = 1_000_000  # of the largest cost: costs that differ by less are equal
_SCALE = 5


class PriceAuction(Optimal):
    """Robots without a task bid for all tasks; prices pair them."""

    name = "auction"

    def winners(self, offers: Sequence[Offer]) -> list[Offer]:
        """The pairs that the prices lead to."""
        return paired(offers, auction_pairs)


def auction_pairs(cost: Array) -> list[tuple[int, int]]:
    """Pairs of rows and columns of the least total cost, to 1e-6 of the largest cost each.

    Args:
        cost: finite, at least 0, shape (N, M).
    """
    size = max(cost.shape)
    square = np.zeros((size, size), dtype=np.int64)
    steps = np.rint(cost / max(float(cost.max()), 1e-300) * _STEPS)
    square[: cost.shape[0], : cost.shape[1]] = steps
    gain = -square * (size + 1)
    prices = np.zeros(size, dtype=np.int64)
    increment = max(int(-gain.min()) // 2, 1)
    while True:
        owner = _one_scale(gain, prices, increment)
        if increment == 1:
            break
        increment = max(increment // _SCALE, 1)
    return [
        (int(row), column)
        for column, row in enumerate(owner)
        if row < cost.shape[0] and column < cost.shape[1]
    ]


def _one_scale(
    gain: npt.NDArray[np.int64], prices: npt.NDArray[np.int64], increment: int
) -> npt.NDArray[np.intp]:
    """Bid until every row has a column; prices rise in place. Returns the row of each column."""
    owner = np.full(len(gain), -1, dtype=np.intp)
    waiting = list(range(len(gain)))
    while waiting:
        row = waiting.pop()
        worth = gain[row] - prices
        best = int(np.argmax(worth))
        first = int(worth[best])
        worth[best] = np.iinfo(np.int64).min
        second = int(worth.max()) if len(worth) > 1 else first
        prices[best] += first - second + increment
        if owner[best] >= 0:
            waiting.append(int(owner[best]))
        owner[best] = row
    return owner
