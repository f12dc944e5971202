# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The flight of a base station: decides at each status of its links, and sends set-points."""

from __future__ import annotations

import threading
import time
from pathlib import Path

import numpy as np
import rospy
from trident_base.station_record import station_record_path

from trident_fleet.core.base_station import BaseStation
from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array
from trident_fleet.core.record import write_object
from trident_fleet.core.schedule import encode_period
from trident_fleet.core.station.record import StationLog
from trident_fleet.core.station.settings import StationSettings
from trident_fleet.nodes.counted_topic import News
from trident_fleet.nodes.flights import Flight, FlightContext, FlightMaker, Standstill
from trident_fleet.nodes.station_inputs import StationInputs
from trident_fleet.nodes.station_report import StationReport

_POLL_S = 0.05
_REPORT_S = 10.0
_PATIENCE_S = 30.0


def station_flight(settings: StationSettings, out_dir: Path | None) -> FlightMaker:
    """Flights of a base station, with records in a folder (None: nowhere)."""

    def make(context: FlightContext, spawn: Array, start_ns: int) -> Flight:
        return StationFlight(context, settings, spawn[0], start_ns, out_dir)

    return make


def _is_connected(subscriber: rospy.Subscriber) -> bool:
    """Whether there is a publisher; a flight that ends closes its inputs in another thread."""
    impl = subscriber.impl
    return impl is not None and impl.get_num_connections() > 0


class StationFlight:
    """Commands the periods after a status by what was known at that status.

    In lockstep the world waits for what has come by then; else the newest counts.
    """

    def __init__(
        self,
        context: FlightContext,
        settings: StationSettings,
        home: Array,
        start_ns: int,
        out_dir: Path | None,
    ) -> None:
        """Stand at home.

        Args:
            context: the UAV.
            settings: of the station.
            home: where it stands [m, world], shape (3,).
            start_ns: simulated time of the first set-point [ns].
            out_dir: where its record goes; None: nowhere.

        Raises:
            FormationError: a home that is not below the fence.
        """
        self._context, self._settings, self._out_dir = context, settings, out_dir
        self._start_ns = self._now_ns = start_ns
        self._period_ns = settings.fleet.feed.period_ns
        self._lead = 1 if context.link.is_lockstep else 0
        self._each = settings.status_ns // self._period_ns  # periods from decision to decision
        self._station = BaseStation(settings.fence, settings.config, home, settings.links)
        self._log = StationLog(start_ns / NS_PER_S)
        self._report = StationReport(settings)
        self._lock = threading.RLock()
        self._standstill = Standstill(context.link)
        self._over = threading.Event()
        self._has_begun = self._has_end = self._knows_battery = False
        self._next = 0  # period to command next
        self._news_at = self._reported = time.monotonic()
        news = News(self._lock, self._on_news)
        self._inputs = StationInputs(settings, start_ns, context.link.is_lockstep, news)
        rospy.on_shutdown(self._leave)

    def begin(self) -> list[rospy.Subscriber]:
        """Send the first set-points and continue with what comes."""
        context = self._context
        clock = context.link.on_clock(self._on_clock)
        self._wait_for_inputs(clock)
        context.link.close_states()
        with self._lock:
            self._note(0.0)
            for _ in range(2 * self._lead):
                self._send_period()
            self._has_begun = True
            self._continue()
        return [clock]

    def _wait_for_inputs(self, clock: rospy.Subscriber) -> None:
        """As long as the first set-points are not there, simulated time does not run."""
        link = self._context.link
        link.wait_for_publisher([clock])
        limit = time.monotonic() + self._settings.fleet.connect_wait_s
        self._wait_for_own_pose()
        self._wait_for_radios(limit)
        for subscriber in [self._inputs.status, *self._inputs.poses]:
            self._wait_for_connection(subscriber, limit)
            if self._over.is_set():
                return
        for name in self._inputs.uncounted if link.is_lockstep else []:
            link.not_repeatable(f"{name} counts as it comes")

    def _wait_for_own_pose(self) -> None:
        reported = time.monotonic()
        while not self._inputs.try_subscribe() and not self._over.wait(_POLL_S):
            if time.monotonic() - reported > _REPORT_S:
                reported = time.monotonic()
                rospy.logwarn("own_pose: nobody publishes %s yet", self._inputs.own.name)

    def _wait_for_connection(self, subscriber: rospy.Subscriber, limit: float) -> None:
        """Wait for the publisher of an input, and do without it from an instant on."""
        while not _is_connected(subscriber) and not self._over.wait(_POLL_S):
            if time.monotonic() >= limit:
                self._do_without(subscriber)
                return

    def _wait_for_radios(self, limit: float) -> None:
        """Of the robots to connect: those that are spawned later come in a moment of chance."""
        topics = {f"/{name}/link_status" for name in self._settings.links}
        while self._context.link.is_lockstep and time.monotonic() < limit:
            published = {name for name, _ in rospy.get_published_topics()}
            if topics <= published or self._over.wait(_POLL_S):
                return

    def _do_without(self, subscriber: rospy.Subscriber) -> None:
        name = subscriber.resolved_name
        if subscriber is self._inputs.status:
            raise FormationError(f"link_status: nobody publishes {name}; legal: a UAV with a radio")
        rospy.logwarn("poses: nobody publishes %s; does a rule let it cross by radio?", name)

    def watch(self) -> None:
        """Say what is waited for, and do without what has got lost."""
        with self._lock:
            self._look_at_silence()
            self._continue()
        if self._standstill.is_due(self._now_ns):
            self._context.repeat()

    def _look_at_silence(self) -> None:
        """Silence is measured in wall-clock time, for simulated time stands meanwhile."""
        missing = self._missing()
        if not missing:
            return
        silent_s = time.monotonic() - self._news_at
        if silent_s > _PATIENCE_S and missing not in (
            self._settings.link_status,
            self._inputs.own.name,
        ):
            self._context.link.not_repeatable(f"{missing}: a message has got lost")
            self._inputs.give_up_at(self._elapsed_ns())
        elif time.monotonic() - max(self._reported, self._news_at) > _REPORT_S:
            self._reported = time.monotonic()
            rospy.logwarn("nothing on %s for %.0f s; waiting", missing, silent_s)

    def _missing(self) -> str:
        """What the world waits for with this flight; "": it does not wait."""
        if not self._has_begun or not self._context.link.is_lockstep or not self._is_decision:
            return ""
        missing = self._inputs.missing_at(self._elapsed_ns())
        return missing if self._now_ns >= self._start_ns + self._elapsed_ns() else ""

    def _leave(self) -> None:
        if not self._over.is_set():
            self._over.set()
            self._inputs.close()

    def _on_news(self) -> None:
        """Under the lock."""
        self._news_at = time.monotonic()
        self._continue()

    def _on_clock(self, now_ns: int) -> None:
        with self._lock:
            if self._context.restart_if_reset(self._now_ns, now_ns):
                self._has_begun = False
                self._leave()
                return
            self._now_ns = max(now_ns, self._now_ns)
            self._continue()

    def _elapsed_ns(self) -> int:
        """Instant, since the first set-point, at which the next period is decided [ns]."""
        return (self._next - self._lead) * self._period_ns

    @property
    def _is_decision(self) -> bool:
        return (self._next - self._lead) % self._each == 0

    def _continue(self) -> None:
        """Command all periods that are due."""
        while self._has_begun and not self._over.is_set():
            elapsed_ns = self._elapsed_ns()
            if not self._is_due(elapsed_ns):
                return
            if self._is_decision:
                self._decide(elapsed_ns)
            self._send_period()

    def _is_due(self, elapsed_ns: int) -> bool:
        """Whether the next period can be commanded: in lockstep all inputs, else its time, came."""
        if self._context.link.is_lockstep:
            return not (self._is_decision and self._inputs.missing_at(elapsed_ns))
        return self._now_ns >= self._start_ns + elapsed_ns

    def _decide(self, elapsed_ns: int) -> None:
        heard = self._inputs.heard_at(elapsed_ns)
        if self._inputs.battery is not None and not self._knows_battery:
            self._knows_battery = True
            self._context.link.not_repeatable(f"{self._settings.battery} counts as it comes")
        if heard is not None:
            self._station.decide(heard)
            self._report.publish(self._station, heard)
        self._note(elapsed_ns / NS_PER_S)

    def _send_period(self) -> None:
        feed = self._settings.fleet.feed
        times = np.arange(0, feed.period_ns, feed.point_ns) / NS_PER_S
        motion = self._station.period(times, feed.period_ns / NS_PER_S)
        stamp_ns = self._start_ns + self._next * self._period_ns
        self._next += 1
        if self._station.is_over != self._has_end:
            self._announce_end(stamp_ns + 3 * self._period_ns)
        # Without lockstep, what the clock has overtaken is not worth sending.
        if self._context.link.is_lockstep or stamp_ns + self._period_ns > self._now_ns:
            yaw = self._settings.config.yaw_rad
            self._context.send([encode_period(motion, [0], yaw, stamp_ns, feed)])

    def _announce_end(self, end_ns: int) -> None:
        """It has landed: the run may end; while others continue it the world waits as before."""
        self._has_end = True
        self._note((end_ns - self._start_ns) / NS_PER_S)
        if self._context.link.is_lockstep:
            self._context.link.enroll(end_ns, waits_beyond_end=True)

    def _note(self, time_s: float) -> None:
        """Log and record a new phase."""
        if not self._log.note(self._station, time_s):
            return
        rospy.loginfo("base_station: %s: %s", self._station.phase.value, self._station.reason)
        if self._out_dir is not None:
            path = station_record_path(self._out_dir, self._settings.vehicle.name)
            try:
                write_object(path, self._log.record(self._settings))
            except FormationError as error:
                # The flight is worth more than its record.
                rospy.logerr("%s", error)
