# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Teams, tasks and hard days, by seed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random

from trident_fleet.core.network import Channel, LinkModel
from trident_fleet.core.tasks.fields import Capabilities, Requirements
from trident_fleet.core.tasks.messages import TaskAnnounce, TaskMessage
from trident_fleet.core.tasks.methods import method_named
from trident_fleet.core.tasks.protocol import Guards, Team
from trident_fleet.core.tasks.rehearsal import Rehearsal
from trident_fleet.core.tasks.trials.invariants import Watch

PERFECT = LinkModel()
SHUFFLED = LinkModel(loss=0.3, double=0.4, late=0.3, late_s=4.0)
LOSSY = LinkModel(loss=0.3, double=0.1, late=0.05, late_s=1.0)
STEP_S = 0.2
USER = "user"


def capabilities(index: int) -> Capabilities:
    """Two of three robots can dig."""
    return Capabilities("ground", ("dig",) if index % 3 else (), speed_m_s=8.0)


def some_tasks(random: Random, count: int, work_s: float = 1.0) -> list[TaskAnnounce]:
    """Of all kinds: repeatable or not, alone or together, one after the other, with skills."""
    return [
        TaskAnnounce(
            0.0,
            f"t{index}",
            "",
            0,
            "visit",
            Requirements(skills=("dig",) if index % 4 == 1 else ()).to_json(),
            (random.uniform(0.0, 60.0), random.uniform(0.0, 60.0), 0.0),
            work_s,
            after=("t0",) if index == 3 else (),
            robots_needed=2 if index == 4 else 1,
            repeatable=index % 2 == 0,
        )
        for index in range(count)
    ]


@dataclass
class Scene:
    """A rehearsal with what will happen to it."""

    rehearsal: Rehearsal
    watch: Watch
    events: list[tuple[float, Callable[[], None]]] = field(default_factory=list)

    def run(self, until_s: float = 240.0) -> float:
        """Until nothing is open and everything has happened; returns when [s]."""
        channel = self.rehearsal.channel
        self.events.sort(key=lambda event: event[0])
        while channel.now() < until_s:
            self.rehearsal.step(STEP_S)
            while self.events and self.events[0][0] <= channel.now():
                self.events.pop(0)[1]()
            self.watch.check()
            if not self.events and not self.rehearsal.open_tasks() and not self._asked():
                break
        return channel.now()

    def _asked(self) -> list[str]:
        """What no manager has heard."""
        requests = self.rehearsal.requests
        return [] if requests is None else requests.pending()


def scene(
    seed: int,
    model: LinkModel = PERFECT,
    method: str = "plain",
    robots: int = 5,
    tasks: int = 6,
    guards: Callable[[str], Guards] | None = None,
) -> Scene:
    """A team somewhere on 60 x 60 m whose first manager has tasks, all healthy."""
    random = Random(seed)
    rehearsal = _rehearsal(random, seed, model, method, robots, guards)
    work = some_tasks(random, tasks)
    rehearsal.add(work)
    return Scene(rehearsal, Watch(rehearsal, work))


def asked_scene(
    seed: int,
    model: LinkModel = PERFECT,
    method: str = "plain",
    robots: int = 5,
    tasks: int = 6,
    guards: Callable[[str], Guards] | None = None,
    work_s: float = 1.0,
) -> Scene:
    """The same where a user asks for the tasks over the network, and nobody has heard it yet."""
    random = Random(seed)
    rehearsal = _rehearsal(random, seed, model, method, robots, guards)
    work = some_tasks(random, tasks, work_s)
    assert rehearsal.requests is not None
    rehearsal.requests.add(work)
    return Scene(rehearsal, Watch(rehearsal, work))


def _rehearsal(
    random: Random,
    seed: int,
    model: LinkModel,
    method: str,
    robots: int,
    guards: Callable[[str], Guards] | None,
) -> Rehearsal:
    names = [f"r{index}" for index in range(robots)]
    team = Team({name: capabilities(index) for index, name in enumerate(names)}, tuple(names))
    places = {name: (random.uniform(0.0, 60.0), random.uniform(0.0, 60.0), 0.0) for name in names}
    channel: Channel[TaskMessage] = Channel([*names, USER], model, seed)
    return Rehearsal(team, places, method_named(method), channel, guards, USER)


def hard_day(
    seed: int,
    method: str = "plain",
    guards: Callable[[str], Guards] | None = None,
    model: LinkModel = LOSSY,
    robots: int = 5,
    tasks: int = 6,
    work_s: float = 1.0,
) -> Scene:
    """Loss, doubles, late ones, one partition, the death of the manager and of a robot."""
    made = asked_scene(seed, model, method, robots, tasks, guards, work_s)
    random, rehearsal = Random(f"hard {seed}"), made.rehearsal
    names = sorted(rehearsal.members)
    part = random.sample(names, 2)
    start_s = random.uniform(2.0, 12.0)
    rest = [*(name for name in names if name not in part), USER]

    def kill_manager() -> None:
        manager = rehearsal.manager()
        if manager is not None:
            rehearsal.kill(manager.name)

    def kill_robot() -> None:
        up = [name for name in names if rehearsal.channel.is_up(name)]
        rehearsal.kill(random.choice(up))

    made.events += [
        (start_s, lambda: rehearsal.channel.split(part, rest)),
        (start_s + random.uniform(4.0, 12.0), rehearsal.channel.heal),
        (random.uniform(3.0, 15.0), kill_manager),
        (random.uniform(2.0, 15.0), kill_robot),
    ]
    return made
