# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Messages between the members of a team: what a protocol may use, and a seeded channel behind it.

A protocol knows a `Port` only. `Channel` is the one for benches and tests: in one process, on a
clock that its owner advances, repeatable by its seed. Each direction of each pair of members has a
random stream of its own, so that what one pair sends does not change what another one loses.
"""

from __future__ import annotations

import heapq
import math
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from random import Random
from typing import Generic, Protocol, TypeVar

from trident_fleet.core.errors import FormationError

Message = TypeVar("Message")

EVERYBODY = ""


@dataclass(frozen=True)
class Envelope(Generic[Message]):
    """A message as it has come.

    Attributes:
        source: name of the member that sent it.
        message: what it sent.
        sent_s: when [s].
    """

    source: str
    message: Message
    sent_s: float


class Port(Protocol[Message]):
    """What one member has of the network, whatever carries it (this channel, topics, radios)."""

    name: str

    def now(self) -> float:
        """Simulated time [s]."""
        ...

    def send(self, message: Message, destination: str = EVERYBODY) -> None:
        """Hand a message over: to one other member, or once to all of them."""
        ...

    def receive(self) -> list[Envelope[Message]]:
        """What has come since the last call, in the order of arrival."""
        ...


@dataclass(frozen=True)
class Bursts:
    """Gilbert and Elliott's two states of a link, in continuous time.

    Attributes:
        mean_good_s: mean time until a good link becomes bad [s].
        mean_bad_s: mean time until a bad one is good again [s].
        bad_loss: probability that a message is lost while it is bad; while good, `LinkModel.loss`.
    """

    mean_good_s: float = 20.0
    mean_bad_s: float = 1.0
    bad_loss: float = 0.9

    def bad_after(self, was_bad: bool, elapsed_s: float) -> float:
        """Probability that the link is bad `elapsed_s` after it was known to be so, or not."""
        to_bad, to_good = 1.0 / self.mean_good_s, 1.0 / self.mean_bad_s
        settled = to_bad / (to_bad + to_good)
        return settled + (float(was_bad) - settled) * math.exp(-(to_bad + to_good) * elapsed_s)


@dataclass(frozen=True)
class LinkModel:
    """What a link does to messages.

    Attributes:
        loss: probability that a message is lost.
        double: probability that it comes twice.
        min_delay_s: each copy takes a time of its own, uniform from here [s]...
        max_delay_s: ... to here, so that messages overtake one another [s].
        late: probability that a copy takes `late_s` longer.
        late_s: [s].
        bursts: of loss; None: never.
    """

    loss: float = 0.0
    double: float = 0.0
    min_delay_s: float = 0.02
    max_delay_s: float = 0.2
    late: float = 0.0
    late_s: float = 1.0
    bursts: Bursts | None = None

    def __post_init__(self) -> None:
        """Refuse what is no probability and no time.

        Raises:
            FormationError: names field, value and legal range.
        """
        for name in ("loss", "double", "late"):
            value = getattr(self, name)
            if not 0.0 <= value <= 1.0:
                raise FormationError(f"link model: {name} is {value}, legal: 0 ... 1")
        if not 0.0 <= self.min_delay_s <= self.max_delay_s < math.inf:
            raise FormationError(
                f"link model: delay from {self.min_delay_s} to {self.max_delay_s} s, legal: "
                "0 <= min_delay_s <= max_delay_s, finite"
            )


@dataclass
class _Link:
    random: Random
    bad: bool = False
    seen_s: float = 0.0


@dataclass
class _Member(Generic[Message]):
    up: bool = True
    group: int = 0
    inbox: list[Envelope[Message]] = field(default_factory=list)


class Channel(Generic[Message]):
    """The seeded network of a team in one process. Its owner advances its clock."""

    def __init__(
        self,
        members: Iterable[str],
        model: LinkModel,
        seed: int,
        reach: Callable[[str, str, float], bool] | None = None,
    ) -> None:
        """Create the network at time 0.

        Args:
            members: their names.
            model: of every link.
            seed: of all that is random.
            reach: (source, destination, time) -> whether there is a link now; None: always.
        """
        self._members: dict[str, _Member[Message]] = {name: _Member() for name in members}
        self._model, self._seed, self._reach = model, seed, reach
        self._links: dict[tuple[str, str], _Link] = {}
        self._traveling: list[tuple[float, int, str, Envelope[Message]]] = []
        self._number = 0
        self._now_s = 0.0
        self.counts: Counter[str] = Counter()

    def port(self, name: str) -> ChannelPort[Message]:
        """The network as a member has it."""
        self._member(name)
        return ChannelPort(self, name)

    def now(self) -> float:
        """Simulated time [s]."""
        return self._now_s

    def next_arrival_s(self) -> float:
        """When the next message comes [s]; infinite if nothing travels."""
        return self._traveling[0][0] if self._traveling else math.inf

    def advance(self, to_s: float) -> None:
        """Let time pass: messages due come into the inboxes.

        Raises:
            FormationError: time would run back.
        """
        if not to_s >= self._now_s:
            raise FormationError(f"network: time {to_s} s, legal: from {self._now_s} s, its clock")
        while self._traveling and self._traveling[0][0] <= to_s:
            self._now_s, _, destination, envelope = heapq.heappop(self._traveling)
            if self._linked(envelope.source, destination):
                self._members[destination].inbox.append(envelope)
                self.counts["delivered"] += 1
            else:
                self.counts["cut"] += 1
        self._now_s = to_s

    def crash(self, name: str) -> None:
        """A member is dead: it sends nothing, and what comes to it is lost."""
        member = self._member(name)
        member.up = False
        member.inbox.clear()

    def restart(self, name: str) -> None:
        """A dead member is there again, with an empty inbox."""
        self._member(name).up = True

    def is_up(self, name: str) -> bool:
        """Whether a member is not dead."""
        return self._member(name).up

    def split(self, *groups: Iterable[str]) -> None:
        """Only members of one group hear each other; those in no group are one of their own."""
        for member in self._members.values():
            member.group = 0
        for number, group in enumerate(groups, start=1):
            for name in group:
                self._member(name).group = number

    def heal(self) -> None:
        """There are no groups any more."""
        self.split()

    def _send(self, source: str, message: Message, destination: str) -> None:
        if not self._member(source).up:
            return
        self.counts["sent"] += 1
        self.counts[type(message).__name__] += 1
        others = [name for name in self._members if name != source]
        for name in others if destination == EVERYBODY else [destination]:
            self._member(name)
            self._carry(source, name, Envelope(source, message, self._now_s))

    def _carry(self, source: str, destination: str, envelope: Envelope[Message]) -> None:
        link = self._link(source, destination)
        model, random = self._model, link.random
        lost = random.random() < self._loss(link)
        copies = 2 if random.random() < model.double else 1
        for _ in range(copies):
            delay_s = random.uniform(model.min_delay_s, model.max_delay_s)
            delay_s += model.late_s if random.random() < model.late else 0.0
            if not lost:
                self._number += 1
                copy = (self._now_s + delay_s, self._number, destination, envelope)
                heapq.heappush(self._traveling, copy)
        self.counts["lost" if lost else "carried"] += 1

    def _loss(self, link: _Link) -> float:
        bursts = self._model.bursts
        if bursts is None:
            return self._model.loss
        chance = bursts.bad_after(link.bad, self._now_s - link.seen_s)
        link.bad, link.seen_s = link.random.random() < chance, self._now_s
        return bursts.bad_loss if link.bad else self._model.loss

    def _linked(self, source: str, destination: str) -> bool:
        one, other = self._members[source], self._members[destination]
        if not other.up or one.group != other.group:
            return False
        return self._reach is None or self._reach(source, destination, self._now_s)

    def _link(self, source: str, destination: str) -> _Link:
        link = self._links.get((source, destination))
        if link is None:
            link = _Link(Random(f"{self._seed}/{source}/{destination}"))
            self._links[source, destination] = link
        return link

    def _member(self, name: str) -> _Member[Message]:
        member = self._members.get(name)
        if member is None:
            legal = ", ".join(self._members)
            raise FormationError(f"network: member {name!r} is unknown, legal: {legal}")
        return member


class ChannelPort(Generic[Message]):
    """A member's end of a `Channel`: a `Port`."""

    def __init__(self, channel: Channel[Message], name: str) -> None:
        """Of an existing member."""
        self._channel, self.name = channel, name

    def now(self) -> float:
        """Simulated time [s]."""
        return self._channel.now()

    def send(self, message: Message, destination: str = EVERYBODY) -> None:
        """Hand a message over: to one other member, or once to all of them."""
        self._channel._send(self.name, message, destination)

    def receive(self) -> list[Envelope[Message]]:
        """What has come since the last call, in the order of arrival."""
        member = self._channel._member(self.name)
        inbox, member.inbox = member.inbox, []
        return inbox
