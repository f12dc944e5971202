# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What has been won is auctioned again, in pieces, while somebody can do it at less.

Robots say which route they have (one message when it has changed). Others bid for a segment of up
to three tasks, for a tail in exchange for their own, or for one task in exchange for another; the
best trades that have nothing in common are awarded and confirmed. When no trade is left, a few
tasks that lie together are released and auctioned again by regret, and kept so if that is better.
Their prices are computed for all robots at once, as arrays; messages are counted as each robot
would send them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random

import numpy as np

from trident_fleet.core.quintic import Array
from trident_fleet.core.tasks.plan import Plan
from trident_fleet.core.tasks.trading.tours import Edges, Index, Tours

_SEGMENTS = (1, 2, 3)
_TRADE_MESSAGES = 6  # two bids, award and confirmation of each of two robots
_BIDDERS = 4  # robots that bid for a task that lies near them
_LOOKED_AT = 40  # best candidates that are tried in one sweep
_SHAKES = 8000  # of all tasks together
_LEAST_GAIN = 1e-7

Change = dict[int, list[int]]


class Trades:
    """Trades between the robots of a team until nothing is gained, or messages run out."""

    def __init__(self, plans: Sequence[Plan], messages: int) -> None:
        """Of plans that are to be changed, with no more messages than this."""
        self._tours, self._limit = Tours(plans), messages
        self._messages = 0
        self._random = Random(len(self._tours.jobs))

    def run(self) -> int:
        """Trade; the plans have the result. Returns the messages."""
        tours = self._tours
        if not tours.jobs:
            return 0
        self._descend()
        if len(tours.jobs) > 2:
            for _ in range(max(_SHAKES // len(tours.jobs), 10)):
                if self._messages + self._shake_cost(8) > self._limit:
                    break
                self._shake()
        tours.write()
        return self._messages

    def _descend(self) -> None:
        changed = len(self._tours.routes)
        while changed and self._messages + changed < self._limit:
            self._messages += changed
            changed = 0
            for sweep in (self._segments, self._tails, self._swaps, self._turns):
                changed = self._apply(sweep(self._tours.edges()))
                if changed:
                    break

    def _apply(self, changes: Iterator[Change]) -> int:
        """Make the best changes that touch no route twice; returns how many routes they touch."""
        touched: set[int] = set()
        for change in changes:
            fits = all(self._tours.fits(route, nodes) for route, nodes in change.items())
            if touched & set(change) or not fits:
                continue
            if self._messages + _TRADE_MESSAGES > self._limit:
                break
            self._messages += _TRADE_MESSAGES if len(change) > 1 else 0
            touched |= set(change)
            for route, nodes in change.items():
                self._tours.routes[route] = nodes
        return len(touched)

    @staticmethod
    def _best(loss: Array) -> Iterator[tuple[int, int]]:
        """Row and column of the most negative losses, the best first."""
        flat = loss.ravel()
        count = min(_LOOKED_AT, len(flat))
        lowest = np.argpartition(flat, count - 1)[:count] if count else np.zeros(0, dtype=np.intp)
        for place in lowest[np.argsort(flat[lowest], kind="stable")]:
            if flat[place] < -_LEAST_GAIN:
                yield divmod(int(place), loss.shape[1])

    def _segments(self, edges: Edges) -> Iterator[Change]:
        """Segments that another robot, or the same one elsewhere, does at less."""
        tours, d = self._tours, self._tours.lengths
        finish_s, kind = tours.finish(), tours.kind[edges.route]
        rows = [
            (route, first, length)
            for route, nodes in enumerate(tours.routes)
            for length in _SEGMENTS
            for first in range(len(nodes) - length + 1)
        ]
        route, first, length = np.array(rows, dtype=np.intp).T
        ends = np.array([(tours.nodes(r)[i], tours.nodes(r)[i + n + 1]) for r, i, n in rows])
        pieces = np.array(
            [[tours.routes[r][i + min(j, n - 1)] for j in range(3)] for r, i, n in rows]
        )
        head, tail, own_kind = pieces[:, 0], pieces[:, 2], tours.kind[route]
        forward_m = d[:, head, pieces[:, 1]] + d[:, pieces[:, 1], tail]
        backward_m = d[:, tail, pieces[:, 1]] + d[:, pieces[:, 1], head]
        work_s = np.array([tours.work[tours.routes[r][i : i + n]].sum() for r, i, n in rows])
        saved = d[own_kind, ends[:, 0], head] + d[own_kind, tail, ends[:, 1]]
        saved += forward_m[own_kind, np.arange(len(rows))] - d[own_kind, ends[:, 0], ends[:, 1]]
        gap = d[kind, edges.start, edges.end]
        there, back = d[kind, edges.start], tours.lengths_to[kind, edges.end]
        inner, turned = (
            inner_m.T[:, kind] if len(d) > 1 else inner_m.T for inner_m in (forward_m, backward_m)
        )
        forward = there[:, head].T + inner + back[:, tail].T
        backward = there[:, tail].T + turned + back[:, head].T
        cost = np.minimum(forward, backward) - gap
        other = tours.loss(finish_s, route[:, None], -saved[:, None], -work_s[:, None])
        other = other + tours.loss(finish_s, edges.route[None], cost, work_s[:, None])
        zero = np.zeros((1, 1))
        own = tours.loss(finish_s, route[:, None], cost - saved[:, None], zero)
        same = route[:, None] == edges.route[None]
        inside = (edges.index[None] >= first[:, None]) & (
            edges.index[None] <= (first + length)[:, None]
        )
        loss = np.where(same, np.where(inside, np.inf, own), other)
        for row, column in self._best(loss):
            is_turned = bool(backward[row, column] < forward[row, column])
            to, index = int(edges.route[column]), int(edges.index[column])
            yield self._moved(rows[row], to, index, is_turned)

    def _moved(self, segment: tuple[int, int, int], to: int, index: int, turned: bool) -> Change:
        route, first, length = segment
        nodes = self._tours.routes[route]
        piece = nodes[first : first + length]
        rest = nodes[:first] + nodes[first + length :]
        piece = piece[::-1] if turned else piece
        if route == to:
            index -= length if index > first else 0
            return {route: rest[:index] + piece + rest[index:]}
        goal = self._tours.routes[to]
        return {route: rest, to: goal[:index] + piece + goal[index:]}

    def _tails(self, edges: Edges) -> Iterator[Change]:
        """Two robots that exchange all that they have after some task."""
        tours, d = self._tours, self._tours.lengths
        finish_s, length_m = tours.finish(), tours.length()
        work_s = np.array([tours.work[nodes].sum() for nodes in tours.routes])
        kind = tours.kind[edges.route]
        legs_m = d[:, edges.start, edges.end]
        so_far_m = np.cumsum(legs_m, axis=1)
        last = np.searchsorted(edges.route, edges.route, side="right") - 1
        after_m = so_far_m[:, last] - so_far_m
        after_s = work_s[edges.route] - edges.work_before_s
        # What a route becomes that ends as the other one does: from the row to the column.
        join = d[kind, edges.start][:, edges.end] + after_m[kind]
        one_m = (edges.before_m - length_m[edges.route])[:, None] + join
        other_m = one_m.T
        more_s = after_s[None] - after_s[:, None]
        loss = tours.loss(finish_s, edges.route[:, None], one_m, more_s)
        loss = loss + tours.loss(finish_s, edges.route[None], other_m, -more_s)
        loss = np.where(edges.route[:, None] < edges.route[None], loss, np.inf)
        for row, column in self._best(loss):
            one, other = int(edges.route[row]), int(edges.route[column])
            i, j = int(edges.index[row]), int(edges.index[column])
            a, b = tours.routes[one], tours.routes[other]
            yield {one: a[:i] + b[j:], other: b[:j] + a[i:]}

    def _tasks(self) -> tuple[Index, Index, Index, Index, Index]:
        """Route, index, and node of each task, with the nodes before and after it."""
        rows = []
        for route in range(len(self._tours.routes)):
            nodes = self._tours.nodes(route)
            rows += [
                (route, i - 1, nodes[i], nodes[i - 1], nodes[i + 1])
                for i in range(1, len(nodes) - 1)
            ]
        route, index, node, prev, after = np.array(rows, dtype=np.intp).T
        return route, index, node, prev, after

    def _swaps(self, _: Edges) -> Iterator[Change]:
        """Two robots that exchange one task each."""
        tours, d = self._tours, self._tours.lengths
        finish_s = tours.finish()
        route, index, node, prev, after = self._tasks()
        kind = tours.kind[route]
        own_m = d[kind, prev, node] + d[kind, node, after]
        instead = d[kind, prev][:, node] + tours.lengths_to[kind, after][:, node]
        one_m = instead - own_m[:, None]
        more_s = tours.work[node][None] - tours.work[node][:, None]
        loss = tours.loss(finish_s, route[:, None], one_m, more_s)
        loss = loss + tours.loss(finish_s, route[None], one_m.T, -more_s)
        loss = np.where(route[:, None] < route[None], loss, np.inf)
        for row, column in self._best(loss):
            one, other = int(route[row]), int(route[column])
            a, b = list(tours.routes[one]), list(tours.routes[other])
            a[index[row]], b[index[column]] = int(node[column]), int(node[row])
            yield {one: a, other: b}

    def _turns(self, _: Edges) -> Iterator[Change]:
        """A robot that does a part of its route in reverse."""
        tours, d = self._tours, self._tours.lengths
        route, index, node, prev, after = self._tasks()
        kind = tours.kind[route]
        more_m = np.where(after == tours.end, 0.0, d[kind, after, node] - d[kind, node, after])
        before_m = np.concatenate([[0.0], np.cumsum(more_m)[:-1]])
        own_m = d[kind, prev, node][:, None] + d[kind, node, after][None]
        loss = d[kind, prev][:, node] + d[kind, node][:, after]
        loss = loss - own_m + before_m[None] - before_m[:, None]
        pair = (route[:, None] == route[None]) & (index[:, None] < index[None])
        loss = np.where(pair, loss, np.inf)
        for row, column in self._best(loss):
            i, j = int(index[row]), int(index[column]) + 1
            nodes = tours.routes[int(route[row])]
            yield {int(route[row]): nodes[:i] + nodes[i:j][::-1] + nodes[j:]}

    def _shake_cost(self, count: int) -> int:
        return count * (1 + min(len(self._tours.routes), _BIDDERS))

    def _shake(self) -> None:
        """Some tasks that lie together are auctioned again; undone if that is no better."""
        tours = self._tours
        before, score = [list(nodes) for nodes in tours.routes], tours.score()
        count = self._random.randint(2, min(8, len(tours.jobs)))
        seed = self._random.randrange(len(tours.jobs))
        near = np.argsort(tours.lengths[0, seed, : len(tours.jobs)], kind="stable")[: 2 * count]
        taken = self._random.sample([int(node) for node in near], min(count, len(near)))
        self._messages += self._shake_cost(len(taken))
        tours.routes = [[node for node in nodes if node not in taken] for nodes in tours.routes]
        if self._insert_by_regret(taken):
            self._descend()
        if sum(map(len, tours.routes)) < len(tours.jobs) or tours.score() > score - _LEAST_GAIN:
            tours.routes = before
        else:
            self._messages += 2 * len(taken)

    def _insert_by_regret(self, waiting: list[int]) -> bool:
        """The task first that would lose most if its best robot were not there."""
        tours, d = self._tours, self._tours.lengths
        while waiting:
            edges, finish_s = tours.edges(), tours.finish()
            node, kind = np.array(waiting)[:, None], tours.kind[edges.route]
            more_m = d[kind, edges.start][:, waiting].T - d[kind, edges.start, edges.end]
            more_m = more_m + tours.lengths_to[kind, edges.end][:, waiting].T
            loss = tours.loss(finish_s, edges.route[None], more_m, tours.work[node])
            loss = np.where(tours.can[edges.route[None], node], loss, np.inf)
            firsts = np.flatnonzero(edges.index == 0)
            by_route = np.sort(np.minimum.reduceat(loss, firsts, axis=1), axis=1)
            best = by_route[:, 0]
            second = by_route[:, 1] if by_route.shape[1] > 1 else best
            regret = np.where(np.isfinite(second), second - best, 1e12)
            row = int(np.argmax(regret * (1.0 + 0.2 * self._random.random())))
            column = int(np.argmin(loss[row]))
            route, index = int(edges.route[column]), int(edges.index[column])
            nodes = tours.routes[route]
            new = [*nodes[:index], waiting.pop(row), *nodes[index:]]
            if not tours.fits(route, new):
                return False
            tours.routes[route] = new
        return True
