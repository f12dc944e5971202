# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a base station's node hears: its links, its own pose, where others say they are."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from typing import Any

import numpy as np
import rospy
from sensor_msgs.msg import BatteryState, NavSatFix

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.follow.leader import LeaderTrack, Measurement
from trident_fleet.core.quintic import Array
from trident_fleet.core.station.settings import StationSettings
from trident_fleet.core.station.visits import Heard, Place
from trident_fleet.nodes.counted_topic import CountedTopic, News
from trident_fleet.nodes.leader_topic import LeaderTopic
from trident_fleet.nodes.pose_readers import READERS
from trident_fleet.nodes.world_link import foreign_problem
from trident_msgs.msg import LinkStatusArray
from trident_ros import Refusals, numbers_problem, stamp_problem

_FIX = "sensor_msgs/NavSatFix"
_KEPT = 100


class StationInputs:
    """Subscriptions, and what they say of an instant.

    A status of the links says how many messages had come to the UAV by radio by then. So it is
    known which of them count at an instant, whenever they come to this process, and the world waits
    until they have.
    """

    def __init__(
        self, settings: StationSettings, start_ns: int, is_lockstep: bool, news: News
    ) -> None:
        """Subscribe to everything but the UAV's own pose, which waits for its type.

        Args:
            settings: of the station.
            start_ns: instant that others count from [ns].
            is_lockstep: whether the world waits for this node.
            news: called with each message.
        """
        self._settings, self._start_ns, self._is_lockstep = settings, start_ns, is_lockstep
        self._news = news
        self.own = LeaderTopic(settings.own_pose, settings.vehicle.name)
        self._track = LeaderTrack()
        self._statuses: deque[LinkStatusArray] = deque(maxlen=_KEPT)
        self._status_ns = -1  # stamp of the newest
        self._refusals: Refusals | None = None  # made when there is one
        self.battery: float | None = None
        self._places: dict[str, Place] = {
            name: Place(position, 0.0) for name, position in settings.places.items()
        }
        self._topics = {
            name: CountedTopic(topic, self._is_counted(topic), news)
            for name, topic in settings.pose_topics.items()
        }
        self._used = dict.fromkeys(self._topics, 0)  # numbers of the messages read last
        self._status = rospy.Subscriber(
            settings.link_status, LinkStatusArray, self._take_status, tcp_nodelay=True
        )
        self._battery = rospy.Subscriber(
            settings.battery, BatteryState, self._take_battery, tcp_nodelay=True
        )

    def _is_counted(self, topic: str) -> bool:
        """Whether a topic comes by rules to the UAV, so that its status counts it."""
        return self._is_lockstep and topic.startswith(self._settings.vehicle.prefix + "from/")

    @property
    def uncounted(self) -> list[str]:
        """Topics of which nobody says when their messages count."""
        return [log.name for log in self._topics.values() if not self._is_counted(log.name)]

    @property
    def status(self) -> rospy.Subscriber:
        """That of the links' status, without which there is nothing to do."""
        return self._status

    @property
    def poses(self) -> list[rospy.Subscriber]:
        """Those of the others' poses."""
        return [log.subscriber for log in self._topics.values()]

    def try_subscribe(self) -> bool:
        """Subscribe to the UAV's own pose if somebody publishes it; whether that is so.

        Raises:
            FormationError: the topic is of another type.
        """
        return self.own.try_subscribe(self._take_own) and self.own.has_publisher

    def close(self) -> None:
        """Hear no more."""
        self.own.close()
        for subscriber in (self._status, self._battery):
            subscriber.unregister()
        for log in self._topics.values():
            log.close()

    def _take_own(self, stamp_ns: int, decode: Callable[[], Measurement | None]) -> None:
        with self._news.lock:
            self._track.add(stamp_ns - self._start_ns, decode)
            self._news.take()

    def _take_status(self, status: LinkStatusArray) -> None:
        problem = foreign_problem(status) if self._is_lockstep else ""
        problem = problem or stamp_problem(status.header.stamp)
        if problem:
            self._refuse(self._settings.link_status, problem)
            return
        with self._news.lock:
            if status.header.stamp.to_nsec() > self._status_ns:
                self._status_ns = status.header.stamp.to_nsec()
                self._statuses.append(status)
                self._news.take()

    def _take_battery(self, state: BatteryState) -> None:
        if math.isnan(state.percentage):
            return
        if not 0.0 <= state.percentage <= 1.0:
            self._refuse(
                self._settings.battery, f"percentage is {state.percentage:g}, legal: 0 to 1, or NaN"
            )
            return
        self.battery = float(state.percentage)

    def _refuse(self, topic: str, problem: str) -> None:
        if self._refusals is None:
            self._refusals = Refusals()
        self._refusals.note(f"{topic} refused", f"{topic} refused: {problem}")

    def missing_at(self, elapsed_ns: int) -> str:
        """What of an instant has not come yet; "": nothing, so that it can be decided."""
        period_ns = self._settings.status_ns
        time_ns = self._start_ns + elapsed_ns
        if self._status_ns < time_ns // period_ns * period_ns:
            return self._settings.link_status
        if self.own.is_simulated and not self._track.is_known_at(elapsed_ns):
            return self.own.name
        counts = self._counts(self._status_at(time_ns))
        late = [log.name for log in self._topics.values() if log.count < counts.get(log.name, 0)]
        return ", ".join(late)

    def give_up_at(self, elapsed_ns: int) -> None:
        """Do without the messages by radio that have not come."""
        counts = self._counts(self._status_at(self._start_ns + elapsed_ns))
        for log in self._topics.values():
            log.give_up_to(counts.get(log.name, 0))

    def _status_at(self, time_ns: int) -> LinkStatusArray | None:
        """The newest one that is not younger than an instant; older ones are forgotten."""
        while len(self._statuses) > 1 and self._statuses[1].header.stamp.to_nsec() <= time_ns:
            self._statuses.popleft()
        first = self._statuses[0] if self._statuses else None
        return first if first and first.header.stamp.to_nsec() <= time_ns else None

    def _counts(self, status: LinkStatusArray | None) -> dict[str, int]:
        """Messages that had come by radio, by the names of their topics here."""
        prefix = self._settings.vehicle.prefix
        return {prefix + heard.topic: heard.messages for heard in status.heard} if status else {}

    def heard_at(self, elapsed_ns: int) -> Heard | None:
        """What is known of an instant; None: the UAV does not know where it is."""
        own = self._track.at(elapsed_ns)
        if own is None:
            return None
        status = self._status_at(self._start_ns + elapsed_ns)
        self._read_poses(self._counts(status) if self._is_lockstep else {})
        time_s = elapsed_ns / NS_PER_S
        places = {
            name: Place(place.position, time_s if name in self._settings.places else place.time_s)
            for name, place in self._places.items()
        }
        return Heard(time_s, own.position, _snr(status), places, self.battery)

    def _read_poses(self, counts: dict[str, int]) -> None:
        for name, log in self._topics.items():
            number = counts.get(log.name, 0) if self._is_counted(log.name) else log.count
            if number == self._used[name]:
                continue
            self._used[name] = number
            message = log.message(number)
            place = None if message is None else self._place(name, log, message)
            if place is not None:
                self._places[name] = place

    def _place(self, name: str, log: CountedTopic, message: Any) -> Place | None:
        problem = _header_problem(message)
        position = None if problem else self._position(name, message)
        if position is None:
            legal = ", ".join([*READERS, _FIX + " with datum"])
            log.refuse(problem or f"a {message._type} without a pose of {name}, legal: {legal}")
            return None
        problem = numbers_problem("position", *position)
        if problem:
            log.refuse(problem)
            return None
        stamp_ns = message.header.stamp.to_nsec() - self._start_ns
        return Place(position, stamp_ns / NS_PER_S)

    def _position(self, name: str, message: Any) -> Array | None:
        if isinstance(message, NavSatFix):
            datum = self._settings.datum
            angles = (message.latitude, message.longitude, message.altitude)
            if datum is None or not all(map(math.isfinite, angles)):
                return None
            return datum.position(*angles)
        reader = READERS.get(message._type)
        measured = reader(message, name) if reader else None
        return None if measured is None else measured.position


def _header_problem(message: Any) -> str:
    if not hasattr(message, "header"):
        return f"a {message._type} has no header"
    return stamp_problem(message.header.stamp)


def _snr(status: LinkStatusArray | None) -> dict[str, float]:
    """Of the links by the robot at their other end [dB]; what is no number is left out."""
    links = status.links if status else []
    return {
        str(link.destination): -np.inf if not link.up else float(link.snr_db)
        for link in links
        if link.snr_db < np.inf
    }
