# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Around a spanning tree of blocks of two by two cells.

Source: Y. Gabriely, E. Rimon, Spanning-tree based coverage of continuous areas by a mobile robot,
Annals of Mathematics and Artificial Intelligence 31, 2001. Blocks that are free in part are nodes,
too; what the tour finds blocked there it passes by.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import minimum_spanning_tree

from trident_fleet.core.search.area import Index, Mask
from trident_fleet.core.search.planners.base import Cell, CoverageProblem, walk

# The cells of a block as the tour passes them, with the tree on its left hand: in each, which side
# the tree may leave by, and otherwise the next cell of the block.
_SOUTH, _EAST, _NORTH, _WEST = range(4)
_BLOCK_STEPS = ((-1, 0), (0, 1), (1, 0), (0, -1))
_TOUR: dict[Cell, tuple[int, Cell]] = {
    (0, 0): (_SOUTH, (0, 1)),
    (0, 1): (_EAST, (1, 1)),
    (1, 1): (_NORTH, (1, 0)),
    (1, 0): (_WEST, (0, 0)),
}
# Straight trees have fewer turns; links of which only one side is free cost detours.
_TURN_COST, _HALF_COST = 0.05, 1.0


class Tree:
    """Closed tours; with four offsets of the blocks and two main directions it takes the best."""

    name = "tree"

    def plan(self, problem: CoverageProblem) -> list[Cell]:
        """A path from the start, cell by neighbor cell, that visits all reachable cells."""
        paths = [
            walk(problem, tour(problem, offset, along_rows))
            for offset in ((0, 0), (0, 1), (1, 0), (1, 1))
            for along_rows in (True, False)
        ]
        return min(paths, key=len)


def tour(problem: CoverageProblem, offset: Cell, along_rows: bool) -> list[Cell]:
    """All reachable cells in the order of a tour around the tree, beginning at the start.

    Args:
        problem: the cells.
        offset: rows and columns by which the blocks are shifted, 0 or 1.
        along_rows: branches lie along rows rather than columns.
    """
    free = np.pad(problem.reachable, ((offset[0], 2), (offset[1], 2)))
    rows, columns = free.shape[0] // 2, free.shape[1] // 2
    blocks = free[: 2 * rows, : 2 * columns].reshape(rows, 2, columns, 2).swapaxes(1, 2)
    links = _tree_links(blocks, along_rows)
    at = (problem.start[0] + offset[0], problem.start[1] + offset[1])
    cells = [(row - offset[0], column - offset[1]) for row, column in _around(links, at)]
    height, width = problem.free.shape
    return [
        cell
        for cell in cells
        if 0 <= cell[0] < height and 0 <= cell[1] < width and problem.reachable[cell]
    ]


def _tree_links(blocks: Mask, along_rows: bool) -> Mask:
    """Which sides the tree leaves each block by, shape (rows, columns, 4)."""
    rows, columns = blocks.shape[:2]
    number = np.arange(rows * columns).reshape(rows, columns)
    east = (blocks[:, :-1, :, 1] & blocks[:, 1:, :, 0]).sum(axis=2)
    north = (blocks[:-1, :, 1, :] & blocks[1:, :, 0, :]).sum(axis=2)
    ends, costs = [], []
    for count, one, other, turned in (
        (east, number[:, :-1], number[:, 1:], not along_rows),
        (north, number[:-1], number[1:], along_rows),
    ):
        there = count > 0
        ends.append(np.column_stack([one[there], other[there]]))
        costs.append(1.0 + _TURN_COST * turned + _HALF_COST * (count[there] < 2))
    pairs, cost = np.concatenate(ends), np.concatenate(costs)
    size = rows * columns
    graph = csr_matrix((cost, (pairs[:, 0], pairs[:, 1])), shape=(size, size))
    tree = minimum_spanning_tree(graph).tocoo()
    return _sides(tree.row, tree.col, (rows, columns))


def _sides(one: Index, other: Index, shape: Cell) -> Mask:
    links = np.zeros((shape[0] * shape[1], 4), dtype=bool)
    sideways = other - one == 1
    upward = ~sideways
    if shape[1] == 1:
        sideways, upward = np.zeros_like(sideways), np.ones_like(upward)
    links[one[sideways], _EAST] = links[other[sideways], _WEST] = True
    links[one[upward], _NORTH] = links[other[upward], _SOUTH] = True
    return links.reshape(*shape, 4)


def _around(links: Mask, start: Cell) -> Iterator[Cell]:
    """The cells of the blocks around the tree, once."""
    block, place = (start[0] // 2, start[1] // 2), (start[0] % 2, start[1] % 2)
    first = (block, place)
    while True:
        yield 2 * block[0] + place[0], 2 * block[1] + place[1]
        side, following = _TOUR[place]
        if links[block][side]:
            step = _BLOCK_STEPS[side]
            block = (block[0] + step[0], block[1] + step[1])
            # Across the side: the cell of the other block that lies next to this one.
            place = (place[0] ^ abs(step[0]), place[1] ^ abs(step[1]))
        else:
            place = following
        if (block, place) == first:
            return
