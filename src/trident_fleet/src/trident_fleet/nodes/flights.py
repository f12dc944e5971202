# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The two modes of flying a formation, wired to clock, states and set-point topics."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any, Protocol

import rospy

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.errors import RowError
from trident_fleet.core.feeders import (
    Batch,
    GateFeed,
    GateFeeder,
    TimeFeeder,
    end_of_plan_ns,
)
from trident_fleet.core.gate import FormationGate, Phase
from trident_fleet.core.plan import plan_formation
from trident_fleet.core.quintic import Array
from trident_fleet.core.record import Origin, gate_record, plan_record
from trident_fleet.core.schedule import PlannedFeed
from trident_fleet.core.settings import FleetSettings, Vehicle
from trident_fleet.nodes.setpoint_topic import SetpointTopic
from trident_fleet.nodes.world_link import SimulatorClient

_STANDS_S = 1.0
_MAX_STANDING_S = 16.0


@dataclass(frozen=True)
class FlightContext:
    """What a flight works with.

    Attributes:
        settings: of the formation.
        vehicles: the whole formation.
        fed: those that this process commands.
        topics: their set-point topics, in the same order.
        link: line to the simulator.
        record: writes a record.
        restart: to be called when the world's time has been reset.
    """

    settings: FleetSettings
    vehicles: list[Vehicle]
    fed: list[Vehicle]
    topics: list[SetpointTopic]
    link: SimulatorClient
    record: Callable[[dict[str, Any]], None]
    restart: Callable[[], None]

    @property
    def fed_indices(self) -> list[int]:
        """Columns of the fed vehicles."""
        return [vehicle.index for vehicle in self.fed]

    def restart_if_reset(self, newest_ns: int, now_ns: int) -> bool:
        """Report simulated time that has gone back, and have the flight start over.

        Args:
            newest_ns: time that was known so far [ns].
            now_ns: the simulator's time now [ns].

        Returns:
            Whether it has: nothing of this flight is to be sent any more.
        """
        if now_ns >= newest_ns - self.settings.feed.period_ns:
            return False
        rospy.loginfo(
            "formation: simulated time went back from %.3f s to %.3f s; the flight starts over",
            newest_ns / NS_PER_S,
            now_ns / NS_PER_S,
        )
        self.restart()
        return True

    def repeat(self) -> None:
        """Publish the latest messages again."""
        for topic in self.topics:
            topic.repeat()

    def send(self, batches: list[Batch]) -> None:
        """Publish messages, oldest first."""
        for batch in batches:
            for topic, message in zip(self.topics, batch, strict=True):
                topic.publish(message)


class Standstill:
    """Logs, ever more seldom, that simulated time has stood still for a second of wall time.

    A confirmation of a set-point that gets lost, as those of the first ones may while everybody
    still connects, would leave world and sources waiting for each other. Set-points that come again
    change nothing, so that the wall clock decides nothing here.
    """

    def __init__(self, link: SimulatorClient) -> None:
        """Begin to watch; without lockstep nobody waits."""
        self._is_lockstep = link.is_lockstep
        self._time_ns = -1
        self._since = time.monotonic()
        self._wait_s = _STANDS_S

    def is_due(self, time_ns: int) -> bool:
        """Whether the latest set-points should be sent again, at simulated time `time_ns`."""
        now = time.monotonic()
        if time_ns != self._time_ns:
            self._time_ns, self._since, self._wait_s = time_ns, now, _STANDS_S
        if not self._is_lockstep or now - self._since < self._wait_s:
            return False
        self._since = now
        self._wait_s = min(2.0 * self._wait_s, _MAX_STANDING_S)
        return True


class Flight(Protocol):
    """A flight that has been planned and not begun."""

    def begin(self) -> list[rospy.Subscriber]:
        """Send the first set-points and subscribe to what triggers the others."""

    def watch(self) -> None:
        """Called a few times a second, whatever simulated time does."""


FlightMaker = Callable[[FlightContext, Array, int], Flight]
"""Plans a flight from spawn positions [m, world], shape (N, 3), and the first stamp [ns]."""


def formation_flight(rows: Array) -> FlightMaker:
    """Flights through rows: p_world of each row and vehicle [m], shape (T, N, 3)."""

    def make(context: FlightContext, spawn: Array, start_ns: int) -> Flight:
        settings = context.settings
        origin = Origin(
            source=settings.source,
            vehicles=[vehicle.name for vehicle in context.vehicles],
            start_ns=start_ns,
            settings={
                "plan": asdict(settings.plan),
                "gate": asdict(settings.gate),
                "feed": asdict(settings.feed),
            },
        )
        kind = TimeFlight if settings.mode == "time" else GateFlight
        try:
            return kind(context, rows, spawn, origin)
        except RowError as error:
            raise error.of_file(settings.source.file) from None

    return make


class TimeFlight:
    """A flight that is planned in time and sent ahead of the clock."""

    def __init__(self, context: FlightContext, rows: Array, spawn: Array, origin: Origin) -> None:
        """Plan it.

        Args:
            context: who flies.
            rows: p_world of each row and vehicle [m], shape (T, N, 3).
            spawn: where the vehicles stand [m, world], shape (N, 3).
            origin: where the flight comes from, and its start.

        Raises:
            FormationError: it cannot be flown.
        """
        settings = context.settings
        self._context = context
        self._lock = threading.Lock()
        self._standstill = Standstill(context.link)
        self._now_ns = origin.start_ns
        plan = plan_formation(rows, spawn, settings.plan)
        self._end_ns = end_of_plan_ns(origin.start_ns, plan.duration, settings.feed)
        feed = PlannedFeed(plan, context.fed_indices, origin.start_ns, settings.feed)
        self._feeder = TimeFeeder(feed, settings.lookahead, context.link.is_lockstep)
        for vehicle in context.fed:
            context.record(plan_record(plan, vehicle.index, origin))

    def begin(self) -> list[rospy.Subscriber]:
        """Send the first set-points and continue with the clock."""
        self._context.link.close_states()
        if self._context.link.is_lockstep:
            self._context.link.enroll(self._end_ns)
        clock = self._context.link.on_clock(self._on_clock)
        self._context.link.wait_for_publisher([clock])
        with self._lock:
            # The clock may have run meanwhile: its callback sends, too.
            self._send_due()
        return [clock]

    def watch(self) -> None:
        """Help a world that waits for what it has been sent."""
        if self._standstill.is_due(self._now_ns):
            self._context.repeat()

    def _on_clock(self, now_ns: int) -> None:
        with self._lock:
            if self._context.restart_if_reset(self._now_ns, now_ns):
                return
            self._now_ns = max(now_ns, self._now_ns)
            self._send_due()

    def _send_due(self) -> None:
        """Under the lock: a thread that waits for it must not bring an old time."""
        self._context.send(self._feeder.due(self._now_ns))


class GateFlight:
    """A flight row by row, driven by measured states."""

    def __init__(self, context: FlightContext, rows: Array, spawn: Array, origin: Origin) -> None:
        """Plan its take-off. Arguments and errors as for `TimeFlight`."""
        settings = context.settings
        self._context = context
        self._rows = rows
        self._origin = origin
        names = [vehicle.name for vehicle in context.vehicles]
        self._gate = FormationGate(rows, spawn, names, settings.plan, settings.gate)
        feed = GateFeed(context.fed_indices, origin.start_ns, settings.plan.yaw_rad, settings.feed)
        self._feeder = GateFeeder(self._gate, feed)
        self._stamp_ns = origin.start_ns
        self._lock = threading.Lock()
        self._standstill = Standstill(context.link)
        self._is_over = False

    def begin(self) -> list[rospy.Subscriber]:
        """Send the first set-points and continue with each state."""
        self._write_records()
        subscribers = self._context.link.on_state(self._on_state)
        self._context.link.wait_for_publisher(subscribers)
        with self._lock:
            self._context.send(self._feeder.begin())
        return subscribers

    def watch(self) -> None:
        """Help a world that waits for what it has been sent."""
        if self._standstill.is_due(self._stamp_ns):
            self._context.repeat()

    def _on_state(self, stamp_ns: int, position: Array) -> None:
        with self._lock:
            if self._context.restart_if_reset(self._stamp_ns, stamp_ns):
                return
            self._stamp_ns = max(stamp_ns, self._stamp_ns)
            batches = self._feeder.on_state(stamp_ns, position)
            if self._feeder.end_ns is not None and not self._is_over:
                self._finish(self._feeder.end_ns)
            self._context.send(batches)

    def _finish(self, end_ns: int) -> None:
        self._is_over = True
        # The records must be there before the world may end.
        self._write_records()
        if self._gate.phase is Phase.FAILED:
            rospy.logerr("formation: %s", self._gate.failure)
        if self._context.link.is_lockstep:
            self._context.link.enroll(end_ns)

    def _write_records(self) -> None:
        for vehicle in self._context.fed:
            rows = self._rows[:, vehicle.index].tolist()
            self._context.record(gate_record(self._gate, rows, vehicle.index, self._origin))
