# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the manager on duty has others do: tasks that follow from what is known of a search."""

from __future__ import annotations

from collections.abc import Iterable

from trident_fleet.core.missions.kinds import Kind, Rules
from trident_fleet.core.missions.pieces import Piece
from trident_fleet.core.missions.reports import Fix
from trident_fleet.core.missions.robot import MissionRobot
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.tasks.fields import Requirements
from trident_fleet.core.tasks.messages import TaskAnnounce

_ALIVE_S = 90.0  # since a robot was heard
ONLY = "only "
"""Begin of the skill that a robot alone has: shares that are fixed beforehand are asked by it."""


class Duties:
    """Adds tasks to the manager of one robot, while that is on duty."""

    def __init__(
        self,
        pieces: Iterable[Piece],
        covers: Iterable[Place],
        kinds: dict[str, Kind],
        rules: Rules,
        owners: dict[str, str],
    ) -> None:
        """Of a mission.

        Args:
            pieces: that are to be searched.
            covers: middles of what only the ground sees below, p_common [m].
            kinds: of all robots by name.
            rules: of the mission.
            owners: of pieces that are given to a robot beforehand, by task.
        """
        self._kinds, self._rules = kinds, rules
        self._flies = any(kind.domain == "air" for kind in kinds.values())
        self._search = [self._piece_task(piece, owners) for piece in pieces]
        # Who searches land on the ground looks below roofs and trees as it passes by.
        self._search += [
            _task(f"cover/{index}", "cover", place, Requirements(("ground",), ("search",)), 4.0)
            for index, place in enumerate(covers)
            if self._flies
        ]

    def _piece_task(self, piece: Piece, owners: dict[str, str]) -> TaskAnnounce:
        domains = searchers_of(piece, self._flies)
        owner = owners.get(piece.name)
        skills = ("search",) if owner is None else ("search", ONLY + owner)
        return _task(piece.name, "search", piece.place, Requirements(domains, skills), 0.0)

    def see_to(self, robot: MissionRobot) -> None:
        """Add what is missing, if this robot's manager is on duty."""
        member = robot.member
        if member.manager is None or not member.manager.on_duty:
            return
        known = member.follower.book.records
        missing = [task for task in self._wanted(robot) if task.task_id not in known]
        if missing:
            member.manager.add(missing)

    def _wanted(self, robot: MissionRobot) -> list[TaskAnnounce]:
        """All that should be done by what a robot knows."""
        wanted = list(self._search)
        for fix in robot.knowledge.people.values():
            wanted += self._for_person(robot, fix)
        return wanted

    def _has_rescuer(self, robot: MissionRobot, fix: Fix) -> bool:
        """Whether somebody who may serve a person is alive, by what a robot knows."""
        return any(
            kind.serves and kind.domain == fix.domain and self._is_alive(robot, name)
            for name, kind in self._kinds.items()
        )

    def _for_person(self, robot: MissionRobot, fix: Fix) -> list[TaskAnnounce]:
        place = robot.knowledge.place_of(fix, robot.now_s)
        if self._has_rescuer(robot, fix):
            asked = Requirements((fix.domain,), ("serve",))
            task = _task(f"serve/{fix.name}", "serve", place, asked, self._rules.serve_s)
            return [] if fix.served else [task]
        asked = Requirements(("air",), ("search",))
        task = _task(f"confirm/{fix.name}", "confirm", place, asked, self._rules.confirm_s)
        return [] if fix.confirmed else [task]

    @staticmethod
    def _is_alive(robot: MissionRobot, name: str) -> bool:
        if name == robot.name or robot.now_s < _ALIVE_S:
            return True
        report = robot.knowledge.reports.get(name)
        return report is not None and robot.now_s - report.stamp_s < _ALIVE_S


def searchers_of(piece: Piece, flies: bool) -> tuple[str, ...]:
    """Media from which a piece is searched: on land from the ground only if nobody flies."""
    if piece.wet:
        return ("air", "water")
    return ("air",) if flies else ("ground",)


def _task(
    name: str, kind: str, place: Place, asked: Requirements, duration_s: float
) -> TaskAnnounce:
    return TaskAnnounce(
        0.0,
        name,
        "",
        0,
        kind,
        asked.to_json(),
        (place[0], place[1], 0.0),
        duration_s,
        repeatable=True,
    )
