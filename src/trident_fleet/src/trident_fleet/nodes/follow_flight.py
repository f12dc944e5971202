# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A flight around a leader, driven by its measured states."""

from __future__ import annotations

import threading
import time
from dataclasses import asdict, replace

import numpy as np
import rospy

from trident_fleet.core.encoding import NS_PER_S, encode_message, encode_turning_points
from trident_fleet.core.errors import FormationError
from trident_fleet.core.follow.follow_record import FollowLog
from trident_fleet.core.follow.follow_settings import FollowSettings
from trident_fleet.core.follow.followers import Followers, Phase, Slots
from trident_fleet.core.follow.leader import Decoder, LeaderState, LeaderTrack
from trident_fleet.core.quintic import Array
from trident_fleet.nodes.flights import Flight, FlightContext, FlightMaker, Standstill
from trident_fleet.nodes.leader_topic import LeaderTopic
from trident_fleet.nodes.world_link import LONGEST_JUMP_NS

# A stamp farther than this from simulated time is from another clock [ns].
_FOREIGN_STAMP_NS = NS_PER_S
_POLL_S = 0.05
_REPORT_S = 10.0


def follow_flight(settings: FollowSettings) -> FlightMaker:
    """Flights around the leader of these settings."""

    def make(context: FlightContext, spawn: Array, start_ns: int) -> Flight:
        return FollowFlight(context, settings, spawn, start_ns)

    return make


class FollowFlight:
    """Commands period n by the leader's state one period earlier (without lockstep: at its begin).

    A leader that the simulator publishes is waited for: the set-points are a function of its
    states. One from outside counts as it comes.
    """

    def __init__(
        self, context: FlightContext, settings: FollowSettings, spawn: Array, start_ns: int
    ) -> None:
        """Plan the take-off.

        Args:
            context: the followers.
            settings: of the formation.
            spawn: where the followers stand [m, world], shape (N, 3).
            start_ns: simulated time of the first set-point [ns].

        Raises:
            FormationError: an illegal configuration.
        """
        self._context, self._settings = context, settings
        self._start_ns = self._now_ns = start_ns
        self._period_ns = settings.config.feed.period_ns
        self._lead = 1 if context.link.is_lockstep else 0
        self._followers = Followers(spawn, settings.config)
        names = [vehicle.name for vehicle in context.fed]
        self._log = FollowLog(settings.leader, names, start_ns)
        self._topic = LeaderTopic(settings.leader_topic, settings.leader)
        self._track = LeaderTrack()
        self._lock = threading.Lock()
        self._standstill = Standstill(context.link)
        self._over = threading.Event()
        self._has_end = False  # the run may end, as far as the followers are concerned
        self._has_begun = False
        self._next = 0  # period to command next
        self._heard_at = self._reported = time.monotonic()
        self._is_silent = False
        self._reported_problem = ""
        rospy.on_shutdown(self._leave)

    @property
    def _waits_for_leader(self) -> bool:
        return self._topic.is_simulated and self._context.link.is_lockstep and not self._is_silent

    def begin(self) -> list[rospy.Subscriber]:
        """Send the first set-points and continue with clock and leader."""
        clock = self._context.link.on_clock(self._on_clock)
        self._context.link.wait_for_publisher([clock])
        if self._waits_for_leader:
            self._wait_for_topic()
        else:
            self._context.link.not_repeatable(f"{self._topic.name} counts as it comes")
        with self._lock:
            for _ in range(2 * self._lead):
                self._send_period(None, 0)
            self._has_begun = True
            self._heard_at = time.monotonic()
            self._continue()
        return [clock]

    def watch(self) -> None:
        """Look for the leader's topic, and notice that the world waits for a silent one."""
        if not self._over.is_set():
            self._try_subscribe()
        with self._lock:
            is_due = self._now_ns >= self._boundary_ns()
            if self._waits_for_leader and is_due:
                self._look_at_silence()
            self._continue()
        if self._standstill.is_due(self._now_ns):
            self._context.repeat()

    def _look_at_silence(self) -> None:
        """Silence is measured in wall-clock time, for simulated time stands meanwhile.

        The simulator itself is waited for as long as it publishes the topic, be it slow or stopped.
        """
        silent_s = time.monotonic() - self._heard_at
        if silent_s <= self._settings.leader_timeout_s:
            return
        if self._topic.is_of_simulator:
            if time.monotonic() - self._reported > _REPORT_S:
                self._reported = time.monotonic()
                rospy.logwarn("nothing on %s for %.0f s; waiting", self._topic.name, silent_s)
            return
        self._is_silent = True
        rospy.logwarn("nothing on %s; the followers hold their places", self._topic.name)
        self._context.link.not_repeatable(f"nothing on {self._topic.name} for {silent_s:.1f} s")

    def close(self) -> None:
        """Hear no more of the leader."""
        self._over.set()
        self._topic.close()

    def _leave(self) -> None:
        if not self._over.is_set():
            self.close()
            if not self._has_end:
                self.write_records()

    def _wait_for_topic(self) -> None:
        """As long as the first set-points are not there, simulated time does not run."""
        reported = time.monotonic()
        self._try_subscribe()
        while not self._topic.has_publisher and not self._over.wait(_POLL_S):
            self._try_subscribe()
            if time.monotonic() - reported > _REPORT_S:
                rospy.logwarn("leader_topic: nobody publishes %s yet", self._topic.name)
                reported = time.monotonic()

    def _try_subscribe(self) -> None:
        try:
            self._topic.try_subscribe(self._on_leader)
        except FormationError as error:
            self._log.error = str(error)
            with self._lock:
                self._has_begun = False
            self._leave()
            raise

    def _on_leader(self, stamp_ns: int, decode: Decoder) -> None:
        with self._lock:
            if not self._topic.is_simulated and abs(stamp_ns - self._now_ns) > _FOREIGN_STAMP_NS:
                stamp_ns = self._now_ns
            ahead_ns = max(stamp_ns - self._now_ns, self._ahead_ns(stamp_ns))
            if ahead_ns > LONGEST_JUMP_NS:
                self._topic.refuse(f"{ahead_ns / NS_PER_S:g} s ahead of the clock")
                return
            self._track.add(stamp_ns - self._start_ns, decode)
            self._heard_at = time.monotonic()
            if self._is_silent:
                self._is_silent = False
                rospy.loginfo("%s is heard again", self._topic.name)
            self._continue()

    def _on_clock(self, now_ns: int) -> None:
        with self._lock:
            if self._ahead_ns(now_ns) > LONGEST_JUMP_NS:
                self._context.link.refuse("/clock", "a world in lockstep cannot be that far ahead")
                return
            if self._context.restart_if_reset(self._now_ns, now_ns):
                self.close()
                return
            self._now_ns = max(now_ns, self._now_ns)
            self._continue()

    def _ahead_ns(self, time_ns: int) -> int:
        """How far a time is ahead of what is commanded [ns]; a world in lockstep waits for that."""
        return time_ns - self._boundary_ns() if self._context.link.is_lockstep else 0

    def _boundary_ns(self) -> int:
        """Simulated time of the leader's state that the next period is commanded by [ns]."""
        return self._start_ns + (self._next - self._lead) * self._period_ns

    def _continue(self) -> None:
        """Command all periods whose leader state is known."""
        while self._has_begun:
            elapsed_ns = self._boundary_ns() - self._start_ns
            if self._waits_for_leader:
                is_due = self._track.is_known_at(elapsed_ns)
            else:
                is_due = self._now_ns >= self._boundary_ns()
            if not is_due:
                return
            self._send_period(self._track.at(elapsed_ns), elapsed_ns)

    def _send_period(self, leader: LeaderState | None, elapsed_ns: int) -> None:
        if leader is not None:
            self._log.add(self._followers, leader)
            if elapsed_ns - leader.stamp_ns > self._settings.leader_timeout_s * NS_PER_S:
                leader = _at_rest(leader, elapsed_ns)
        window_ns = self._next * self._period_ns
        slots = self._followers.step(leader, elapsed_ns, window_ns)
        self._next += 1
        self._report_problem()
        if (self._followers.phase is Phase.DONE) != self._has_end:
            self._announce_end(self._start_ns + elapsed_ns + 3 * self._period_ns)
        # Without lockstep, what the clock has overtaken is not worth sending.
        if self._context.link.is_lockstep or self._boundary_ns() > self._now_ns:
            self._context.send([self._encoded(slots, self._start_ns + window_ns)])

    def _encoded(self, slots: Slots, stamp_ns: int) -> list[bytes]:
        feed = self._settings.config.feed
        offsets = np.arange(0, feed.period_ns, feed.point_ns, dtype=np.int64)
        turn = (slots.yaw, slots.yaw_rate)
        return [
            encode_message(stamp_ns, encode_turning_points(slots.motion, index, turn, offsets))
            for index in range(len(self._context.fed))
        ]

    def _report_problem(self) -> None:
        """Why the followers cannot join their leader, once; it changes with every state."""
        problem = self._followers.problem
        if bool(problem) != bool(self._reported_problem):
            if problem:
                rospy.logwarn("%s; they hover until there is a path", problem)
            self._reported_problem = self._log.error = problem

    def _announce_end(self, end_ns: int) -> None:
        """Let the run end when the leader stands; take that back when it was only a pause.

        The leader may move on before the run ends, so that the world continues to wait for the
        followers' commands: a set-point that nobody waits for comes by chance.
        """
        self._has_end = not self._has_end
        if self._has_end:
            # The records must be there before the world may end.
            self.write_records()
        if self._context.link.is_lockstep:
            self._context.link.enroll(end_ns if self._has_end else 0, waits_beyond_end=True)

    def write_records(self) -> None:
        """Say what the followers should have done so far."""
        config = asdict(self._settings.config)
        config["offsets"] = self._settings.config.offsets.tolist()
        for record in self._log.records({"follow": config}):
            self._context.record(record)


def _at_rest(leader: LeaderState, elapsed_ns: int) -> LeaderState:
    """Where it was last, as if it had stopped."""
    still = np.zeros(3)
    return replace(leader, stamp_ns=elapsed_ns, velocity=still, acceleration=still, yaw_rate=0.0)
