# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of a coordinator's node from named parameters, checked by type and range."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from trident_base.params import Getter, Params, nearest, read

from trident_fleet.core.tasks.fields import Capabilities, TaskError
from trident_fleet.core.tasks.methods import DEFAULT, method_named
from trident_fleet.core.tasks.methods.base import Method
from trident_fleet.core.tasks.plan import Objective
from trident_fleet.core.tasks.protocol import Team, Times
from trident_fleet.nodes.tasks.topic_port import Wiring

#: What a platform of this role moves in.
ROLES = {"uav": "air", "ugv": "ground", "usv": "water"}
MANAGER = "manager"  # a member without a robot


@dataclass(frozen=True)
class CoordinatorSettings:
    """Everything a coordinator's node needs to know.

    Attributes:
        name: of this member.
        team: all members.
        method: of allocation, the same for all.
        objective: of the team.
        wiring: where it says and hears.
        frame: the common one, of places.
        pose_topic: where it hears of its own robot.
        goal_topic: where it says where its robot should be.
        reach_m: it is at a place when it is no farther away [m].
        step_s: between two looks at what is due, simulated [s].
    """

    name: str
    team: Team
    method: Method
    objective: Objective
    wiring: Wiring
    frame: str
    pose_topic: str
    goal_topic: str
    reach_m: float
    step_s: float

    @property
    def is_robot(self) -> bool:
        """Whether this member has a robot."""
        return self.name in self.team.robots


def read_settings(get: Getter, default_name: str) -> CoordinatorSettings:
    """Build settings from parameters.

    Args:
        get: value of a parameter, or None where it is not set.
        default_name: of the member.

    Raises:
        TaskError: a parameter of the wrong type or out of range, or one that is missing.
    """
    params = Params(get, TaskError)
    name = params.text("member", default_name)
    team = _team(params, read(Times(), params))
    _check_role(params.text("role", ""), name, team)
    reach_m, step_s = params.number("reach", 1.0), params.number("step", 0.1)
    for parameter, value in (("reach", reach_m), ("step", step_s)):
        if value <= 0.0:
            raise TaskError(f"{parameter}: {value:g}; legal: above 0")
    return CoordinatorSettings(
        name=name,
        team=team,
        method=method_named(params.text("method", DEFAULT)),
        objective=_objective(params.text("objective", Objective.SUM.value)),
        wiring=_wiring(params, name, team),
        frame=params.text("frame", "world"),
        pose_topic=params.text("pose_topic", "odom"),
        goal_topic=params.text("goal_topic", "task_goal"),
        reach_m=reach_m,
        step_s=step_s,
    )


def _team(params: Params, times: Times) -> Team:
    given = params.given("robots")
    if not isinstance(given, Mapping) or not given:
        raise TaskError(f"robots: {given!r}; legal: a map of names with role, skills, ...")
    robots = {str(name): _robot(str(name), fields) for name, fields in given.items()}
    managers = _managers(params, robots)
    attempts = params.integer("attempts", 3)
    if attempts < 1:
        raise TaskError(f"attempts: {attempts}; legal: 1 or more")
    return Team(robots, managers, times, attempts)


def _managers(params: Params, robots: Mapping[str, Capabilities]) -> tuple[str, ...]:
    """Who may manage, in the order of the succession; all robots unless it is given."""
    managers = params.given("managers") or list(robots)
    if not _are_names(managers):
        raise TaskError(f"managers: {managers!r}; legal: a list of names, first who manages first")
    if len(set(managers)) < len(managers):
        raise TaskError(f"managers: {managers!r}; legal: each name once")
    return tuple(managers)


def _are_names(given: Any) -> bool:
    return isinstance(given, list) and all(isinstance(one, str) for one in given)


_FIELDS = ("payload_kg", "speed_m_s", "energy_j", "travel_power_w", "work_power_w")


def _robot(name: str, given: Any) -> Capabilities:
    """What a robot can do, from its entry."""
    if not isinstance(given, Mapping):
        raise TaskError(f"robots/{name}: {given!r}; legal: a map with role, skills, ...")
    _check_keys(name, given)
    params = Params(given.get, TaskError, f"robots/{name}/")
    role = params.text("role", "")
    if role not in ROLES:
        raise TaskError(f"robots/{name}/role: {role!r}; legal: {', '.join(ROLES)}")
    skills = given.get("skills", [])
    if not _are_names(skills):
        raise TaskError(f"robots/{name}/skills: {skills!r}; legal: a list of names")
    numbers = {key: params.number(key, 0.0) for key in _FIELDS if key in given}
    return Capabilities(ROLES[role], tuple(skills), **numbers)


def _check_keys(name: str, given: Mapping[Any, Any]) -> None:
    legal = ("role", "skills", *_FIELDS)
    for key in given:
        if key not in legal:
            raise TaskError(f"robots/{name}/{key}: unknown{nearest(str(key), legal)}")


def _check_role(role: str, name: str, team: Team) -> None:
    """The role of this member, if it is given, must be that of its entry."""
    if name not in team.members:
        legal = ", ".join(sorted(team.members))
        raise TaskError(f"member: {name!r}; legal: {legal}, the names in robots and managers")
    robot = team.robots.get(name)
    own = MANAGER if robot is None else next(r for r, d in ROLES.items() if d == robot.domain)
    if role not in ("", own):
        raise TaskError(f"role: {role!r}; legal: {own}, as robots has it for {name}")


def _objective(text: str) -> Objective:
    try:
        return Objective(text)
    except ValueError:
        legal = ", ".join(one.value for one in Objective)
        raise TaskError(f"objective: {text!r}; legal: {legal}") from None


def _wiring(params: Params, name: str, team: Team) -> Wiring:
    network = params.text("network", "topics")
    users = params.given("users") or []
    if not _are_names(users):
        raise TaskError(f"users: {users!r}; legal: a list of names")
    if network == "relay":
        return Wiring.relayed(name, (team.members | set(users)) - {name})
    if network != "topics":
        raise TaskError(f"network: {network!r}; legal: topics, relay")
    return Wiring.common(params.text("team_namespace", "/"))
