# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which messages to send now: by the clock (planned flights) or by measured states (gates)."""

from __future__ import annotations

from dataclasses import dataclass

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.gate import FormationGate, Phase
from trident_fleet.core.quintic import Array
from trident_fleet.core.schedule import FeedConfig, PlannedFeed, encode_period, period_times

_MAX_OVERTAKEN = 6000  # messages whose time is over, and that a world in lockstep still gets

Batch = list[bytes]
"""One message per fed vehicle, all with the same stamp."""


class TimeFeeder:
    """Sends a plan, so far ahead of the clock that the world need not wait.

    In lockstep every message is sent once, in order, because a world that waits for them is never
    far ahead; if it is (the end of the flight was announced, or its clock is wrong), the messages
    between are not sent. Otherwise those that the clock has overtaken are left out, and none is
    sent early.
    """

    def __init__(self, feed: PlannedFeed, lookahead: int, is_lockstep: bool) -> None:
        """Begin with message 0.

        Args:
            feed: the encoded plan.
            lookahead: how many messages beyond the current one may be sent.
            is_lockstep: whether the world waits for messages.
        """
        self._feed = feed
        self._lookahead = lookahead if is_lockstep else 0
        self._is_lockstep = is_lockstep
        self._next = 0

    def due(self, now_ns: int) -> list[Batch]:
        """Messages to send at simulated time `now_ns`, oldest first."""
        current = self._feed.index_at(now_ns)
        if self._is_lockstep:
            current = max(current, 0)
        if not self._is_lockstep or current - self._next > _MAX_OVERTAKEN:
            self._next = max(self._next, current)
        due = range(self._next, current + self._lookahead + 1)
        self._next = max(self._next, due.stop)
        return [self._feed.messages(index) for index in due]


@dataclass(frozen=True)
class GateFeed:
    """Who is fed by a gate, and how.

    Attributes:
        vehicles: indices of the vehicles to feed.
        start_ns: stamp of message 0 [ns].
        yaw_rad: heading of all vehicles [rad, world].
        config: period and spacing.
    """

    vehicles: list[int]
    start_ns: int
    yaw_rad: float
    config: FeedConfig


class GateFeeder:
    """Sends for [(n+1) T, (n+2) T) when the state at n T is known.

    Attributes:
        end_ns: when the world may stop waiting [ns]; None until the flight is over.
    """

    def __init__(self, gate: FormationGate, feed: GateFeed) -> None:
        """Begin before message 0."""
        self._gate = gate
        self._feed = feed
        self._last = 0
        self.end_ns: int | None = None

    def begin(self) -> list[Batch]:
        """The messages that no state has to be known for: those of the first two periods."""
        return [self._encode(0), self._encode(1)]

    def on_state(self, stamp_ns: int, position: Array) -> list[Batch]:
        """Messages to send, now that the state stamped `stamp_ns` is known.

        Args:
            stamp_ns: simulated time of the state [ns]; states between two periods, of the time
                before the start, and repeated ones are left out.
            position: p_world of all vehicles of the formation [m], shape (N, 3).
        """
        period_ns = self._feed.config.period_ns
        elapsed_ns = stamp_ns - self._feed.start_ns
        index = elapsed_ns // period_ns
        if index <= self._last or elapsed_ns % period_ns:
            return []
        self._last = index
        self._gate.step(elapsed_ns, position, effective_ns=elapsed_ns + period_ns)
        if self.end_ns is None and self._gate.phase in (Phase.DONE, Phase.FAILED):
            self.end_ns = stamp_ns + 3 * period_ns
        return [self._encode(index + 1)]

    def _encode(self, index: int) -> Batch:
        elapsed_ns = index * self._feed.config.period_ns
        motion = self._gate.command(period_times(elapsed_ns, self._feed.config))
        return encode_period(
            motion,
            self._feed.vehicles,
            self._feed.yaw_rad,
            self._feed.start_ns + elapsed_ns,
            self._feed.config,
        )


def end_of_plan_ns(start_ns: int, duration_s: float, config: FeedConfig) -> int:
    """Stamp of the first period that begins at or after the end of a plan [ns]."""
    periods = -(-round(duration_s * NS_PER_S) // config.period_ns)
    return start_ns + periods * config.period_ns
