# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A team of points that move straight and work: the protocol end to end, for tests and benches."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from trident_fleet.core.network import Channel
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.member import Member
from trident_fleet.core.tasks.messages import Point, TaskAnnounce, TaskMessage
from trident_fleet.core.tasks.methods.base import Method
from trident_fleet.core.tasks.plan import Plan
from trident_fleet.core.tasks.protocol import Guards, Team
from trident_fleet.core.tasks.requests import Requests
from trident_fleet.core.tasks.worker import Worker


@dataclass
class Truth:
    """What has been done in truth.

    Attributes:
        begun: (time, task, robot) [s].
        done: (time, task, robot) [s].
    """

    begun: list[tuple[float, str, str]] = field(default_factory=list)
    done: list[tuple[float, str, str]] = field(default_factory=list)


class Rehearsal:
    """A team on a channel. Its owner steps it, and kills and parts whom it likes."""

    def __init__(
        self,
        team: Team,
        places: dict[str, Point],
        method: Method,
        channel: Channel[TaskMessage],
        guards: Callable[[str], Guards] | None = None,
        user: str | None = None,
    ) -> None:
        """All robots at their places, p_common [m], at time 0; `user`: the channel has one, too."""
        self.team, self.method, self.channel = team, method, channel
        self._guards = guards or (lambda _: Guards())
        self.places = dict(places)
        self._workers: dict[str, Worker] = {}
        self.happened = Truth()
        self.members = {name: self._member(name, False) for name in sorted(team.members)}
        self.requests: Requests | None = None
        if user is not None:
            self._user = channel.port(user)
            self.requests = Requests(Follower(user, team, Guards(), channel.now()))

    def add(self, tasks: list[TaskAnnounce], manager: str | None = None) -> list[str]:
        """Give tasks to a manager, the first one unless named, which takes over at once."""
        member = self.members[manager or self.team.managers[0]]
        assert member.manager is not None
        said = member.manager.add(tasks)
        if not member.manager.on_duty:
            member.send(member.manager.take_over(self.channel.now()))
        return said

    def step(self, step_s: float) -> None:
        """Let time pass, and all that live act."""
        self.channel.advance(self.channel.now() + step_s)
        self._ask()
        for name, member in self.members.items():
            if not self.channel.is_up(name):
                continue
            member.spin()
            if member.robot is not None:
                self._move(member, step_s)

    def _ask(self) -> None:
        """The user acts."""
        if self.requests is None:
            return
        for envelope in self._user.receive():
            self.requests.on_message(envelope.source, envelope.message, self._user.now())
        for sent in self.requests.on_time(self._user.now()):
            self._user.send(sent.message, sent.destination)

    def kill(self, name: str) -> None:
        """A member dies, with its robot."""
        self.channel.crash(name)

    def restart(self, name: str) -> None:
        """A member is there again, where it was, and has forgotten everything."""
        self.channel.restart(name)
        self.members[name] = self._member(name, True)

    def manager(self) -> Member | None:
        """The living manager of the newest epoch."""
        on_duty = [
            member
            for name, member in self.members.items()
            if self.channel.is_up(name) and member.manager is not None and member.manager.on_duty
        ]
        return max(on_duty, key=lambda member: member.follower.epoch, default=None)

    def open_tasks(self) -> list[str]:
        """Of which the manager neither knows that they are done, nor has said why not."""
        member = self.manager()
        if member is None or member.manager is None:
            return ["there is no manager"]
        reasons = member.manager.ledger.reasons
        records = member.follower.book.records
        return [name for name, record in records.items() if not record.over and name not in reasons]

    def _member(self, name: str, restarted: bool) -> Member:
        plan = None
        if name in self.team.robots:
            plan = Plan(name, self.team.robots[name], self.places[name])
        port = self.channel.port(name)
        made = Member(port, self.team, self.method, plan, self._guards(name), restarted)
        if made.robot is not None:
            self._workers[name] = Worker(made.robot)
        return made

    def _move(self, member: Member, step_s: float) -> None:
        now_s, worker = self.channel.now(), self._workers[member.name]
        goal = worker.goal(now_s)
        if goal is not None:
            most_m = self.team.robots[member.name].speed_m_s * step_s
            self.places[member.name] = _toward(self.places[member.name], goal, most_m)
        came = worker.at(self.places[member.name], now_s)
        if came.begun:
            self.happened.begun.append((now_s, came.begun, member.name))
        if came.done:
            self.happened.done.append((now_s, came.done, member.name))
            member.send(list(came.sent))


def _toward(place: Point, goal: Point, most_m: float) -> Point:
    distance_m = math.dist(place, goal)
    if distance_m <= most_m:
        return goal
    x, y, z = (a + (b - a) * most_m / distance_m for a, b in zip(place, goal, strict=True))
    return (x, y, z)
