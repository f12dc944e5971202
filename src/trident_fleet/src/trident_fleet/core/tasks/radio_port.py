# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The radios of a world in this process as the network of a team."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Protocol

from trident_fleet.core.network import EVERYBODY, Envelope
from trident_fleet.core.tasks.codec import decode, encode
from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.messages import TaskMessage

LONGEST = 11_000  # bytes that a radio carries in one message, about 150 tasks of a table
_TO_ALL = "all"


class Received(Protocol):
    """What has come to a radio: `trident_sim.radio.RadioMessage`."""

    source: str
    data: bytes
    sent: float


class Air(Protocol):
    """Radios: `world.radio` of trident_sim."""

    def send(self, source: str, destination: str, data: bytes) -> bool:
        """Whether the queue had room for it."""
        ...

    def receive(self, name: str) -> Sequence[Received]:
        """What has come since the last call."""
        ...


class RadioPort:
    """A member's `Port`: its radio, of the same name.

    To one other member it is acknowledged and tried again, to all it is sent once.

    Attributes:
        problems: what was not sent or not understood, by its text.
    """

    def __init__(self, air: Air, name: str, clock: Callable[[], float]) -> None:
        """Of a member.

        Args:
            air: the world's radios.
            name: of the radio.
            clock: simulated time [s].
        """
        self._air, self.name, self._clock = air, name, clock
        self.problems: Counter[str] = Counter()

    def now(self) -> float:
        """Simulated time [s]."""
        return self._clock()

    def send(self, message: TaskMessage, destination: str = EVERYBODY) -> None:
        """Hand a message over: to one other member, or once to all of them."""
        data, kind = encode(message), type(message).__name__
        if len(data) > LONGEST:
            self.problems[f"{kind} to send: length is above the legal {LONGEST} bytes"] += 1
        elif not self._air.send(self.name, destination or _TO_ALL, data):
            self.problems[f"{kind} to send: the radio's queue is full"] += 1

    def receive(self) -> list[Envelope[TaskMessage]]:
        """What has come since the last call, in the order of arrival."""
        heard = []
        for one in self._air.receive(self.name):
            try:
                heard.append(Envelope(one.source, decode(one.data), one.sent))
            except TaskError as error:
                self.problems[f"from {one.source}: {error}"] += 1
        return heard
