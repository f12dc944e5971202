# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What members of a mission say to each other apart from tasks, over the same network."""

from __future__ import annotations

from dataclasses import dataclass, replace

from trident_fleet.core.missions.scene import Place
from trident_fleet.core.network import EVERYBODY, Envelope, Port
from trident_fleet.core.search.sightings import LookPart
from trident_fleet.core.tasks.messages import TaskMessage


@dataclass(frozen=True)
class Fix:
    """What is known of a person who has been found.

    Attributes:
        name: of the person.
        time_s: of the newest detection [s].
        place: there and then, p_common [m].
        domain: in which a rescuer moves: ground or water.
        confirmed: a robot has stood nearby.
        served: a rescuer has.
    """

    name: str
    time_s: float
    place: Place
    domain: str
    confirmed: bool = False
    served: bool = False

    def joined(self, other: Fix) -> Fix:
        """What both know together."""
        newer = self if self.time_s >= other.time_s else other
        return replace(
            newer,
            confirmed=self.confirmed or other.confirmed,
            served=self.served or other.served,
        )


@dataclass(frozen=True)
class Report:
    """What a robot says of itself and of what it knows, once a second.

    Attributes:
        stamp_s: when it was sent [s].
        robot: who says it.
        place: where it is, p_common [m].
        task: that it works on; empty: none.
        battery: charge left, 0 ... 1.
        counts: looks of each robot that it knows.
        parts: looks that others may not know.
        people: who has been found.
    """

    stamp_s: float
    robot: str
    place: Place
    task: str
    battery: float
    counts: tuple[tuple[str, int], ...]
    parts: tuple[LookPart, ...]
    people: tuple[Fix, ...]


TeamMessage = TaskMessage | Report


class TeamPort:
    """A member's network, split: `tasks` is the port of the contract net, `reports` the rest."""

    def __init__(self, port: Port[TeamMessage]) -> None:
        """Over the port of a member."""
        self._port = port
        self._tasks: list[Envelope[TaskMessage]] = []
        self._reports: list[Report] = []
        self.tasks = _TaskPort(self)

    @property
    def name(self) -> str:
        """Of the member."""
        return self._port.name

    def now(self) -> float:
        """Simulated time [s]."""
        return self._port.now()

    def send(self, message: TeamMessage, destination: str = EVERYBODY) -> None:
        """Hand a message over."""
        self._port.send(message, destination)

    def reports(self) -> list[Report]:
        """Reports that have come since the last call."""
        self._poll()
        reports, self._reports = self._reports, []
        return reports

    def task_messages(self) -> list[Envelope[TaskMessage]]:
        """Messages about tasks that have come since the last call."""
        self._poll()
        messages, self._tasks = self._tasks, []
        return messages

    def _poll(self) -> None:
        for envelope in self._port.receive():
            message = envelope.message
            if isinstance(message, Report):
                self._reports.append(message)
            else:
                self._tasks.append(Envelope(envelope.source, message, envelope.sent_s))


class _TaskPort:
    """The contract net's half of a `TeamPort`: a `Port`."""

    def __init__(self, port: TeamPort) -> None:
        self._port, self.name = port, port.name

    def now(self) -> float:
        """Simulated time [s]."""
        return self._port.now()

    def send(self, message: TaskMessage, destination: str = EVERYBODY) -> None:
        """Hand a message over."""
        self._port.send(message, destination)

    def receive(self) -> list[Envelope[TaskMessage]]:
        """What has come since the last call."""
        return self._port.task_messages()
