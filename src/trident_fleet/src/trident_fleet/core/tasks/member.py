# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A member of a team on a network: a robot, a manager, or both."""

from __future__ import annotations

from trident_fleet.core.network import Port
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.manager import Manager
from trident_fleet.core.tasks.messages import NOBODY, TaskAnnounce, TaskMessage, TaskTable
from trident_fleet.core.tasks.methods.base import Method
from trident_fleet.core.tasks.plan import Plan
from trident_fleet.core.tasks.protocol import Guards, Sent, Team
from trident_fleet.core.tasks.robot import Robot


class Member:
    """Passes what comes to both halves, and what one half sends to all to the other half, too."""

    def __init__(
        self,
        port: Port[TaskMessage],
        team: Team,
        method: Method,
        plan: Plan | None,
        guards: Guards | None = None,
        restarted: bool = False,
    ) -> None:
        """A member as it starts.

        Args:
            port: its network.
            team: who there is.
            method: of allocation, the same for all.
            plan: empty, of a robot; None: the member is no robot.
            guards: what must hold; None: the usual.
            restarted: it was there before and has forgotten everything.
        """
        self.port, self.name = port, port.name
        now_s = port.now()
        self.follower = Follower(port.name, team, guards or Guards(), now_s, restarted)
        self.robot = Robot(plan, method, self.follower) if plan is not None else None
        manages = port.name in team.managers
        self.manager = Manager(port.name, method, self.follower, now_s) if manages else None

    def spin(self) -> None:
        """Take in what has come, and do what is due."""
        for envelope in self.port.receive():
            self._take(envelope.source, envelope.message)
        now_s = self.port.now()
        if self.manager is not None:
            self.send(self.manager.on_time(now_s))
        if self.robot is not None:
            self.send([sent for sent in self.robot.on_time(now_s) if not self._kept(sent)])

    def send(self, messages: list[Sent]) -> None:
        """Send what a half of this member would send."""
        for sent in messages:
            if sent.destination != self.name:
                self.port.send(sent.message, sent.destination)
            if sent.destination in (self.name, NOBODY):
                self._take(self.name, sent.message)

    def _kept(self, sent: Sent) -> bool:
        """Whether this is the robot's table while the member manages: its own word is the table."""
        manager, table = self.manager, sent.message
        if manager is None or not manager.on_duty or not isinstance(table, TaskTable):
            return False
        manager.hear_echo(self.name, table, self.port.now())
        return True

    def _take(self, source: str, message: TaskMessage) -> None:
        if isinstance(message, TaskAnnounce) and message.round == 0:
            self.follower.request(message)
            return
        now_s = self.port.now()
        for half in (self.robot, self.manager):
            if half is not None:
                self.send(half.on_message(source, message, now_s))
