# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a task asks of a robot, what a robot can do, and both as JSON."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass, fields
from typing import Any

from trident_fleet.core.errors import FormationError

DOMAINS = ("air", "ground", "water")


class TaskError(FormationError):
    """Bad input about a task: the message names what it is of, field, value and what is legal."""


@dataclass(frozen=True)
class Requirements:
    """What a task asks of each robot that does it.

    Attributes:
        domains: it moves in one of these; empty: in any.
        skills: it has all of these.
        payload_kg: it carries this much [kg].
        speed_m_s: it is this fast [m/s].
        not_before_s: the work begins no earlier [s].
    """

    domains: tuple[str, ...] = ()
    skills: tuple[str, ...] = ()
    payload_kg: float = 0.0
    speed_m_s: float = 0.0
    not_before_s: float = 0.0

    def to_json(self) -> str:
        """What is asked; defaults are left out."""
        default = Requirements()
        asked = {
            name: value for name, value in asdict(self).items() if value != getattr(default, name)
        }
        return json.dumps(asked, sort_keys=True)

    @staticmethod
    def from_json(text: str, owner: str) -> Requirements:
        """Read the JSON form.

        Args:
            text: an object with some of the fields.
            owner: whose they are, for errors.

        Raises:
            TaskError: names field, value and legal range.
        """
        found = _object_of(text, owner)
        legal = [item.name for item in fields(Requirements)]
        for name in found:
            if name not in legal:
                raise TaskError(
                    f"{owner}: requirements.{name} is unknown, legal: {', '.join(legal)}"
                )
        return Requirements(**{name: _checked(owner, name, found[name]) for name in found})


def _object_of(text: str, owner: str) -> dict[str, Any]:
    """The object that a text is in JSON; empty: nothing."""
    try:
        found = json.loads(text) if text else {}
    except json.JSONDecodeError as error:
        raise TaskError(f"{owner}: requirements are no JSON: {error}: {text!r}") from None
    if not isinstance(found, dict):
        raise TaskError(f"{owner}: requirements are {text!r}, legal: a JSON object")
    return found


def _checked(owner: str, name: str, value: Any) -> Any:
    """A field of requirements as its type."""
    check = _checked_names if name in ("domains", "skills") else _checked_number
    return check(owner, name, value)


def _checked_names(owner: str, name: str, value: Any) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(one, str) and one for one in value):
        raise TaskError(f"{owner}: requirements.{name} is {value!r}, legal: a list of names")
    if name == "domains" and not set(value) <= set(DOMAINS):
        raise TaskError(
            f"{owner}: requirements.domains is {value!r}, legal: some of {', '.join(DOMAINS)}"
        )
    return tuple(value)


def _checked_number(owner: str, name: str, value: Any) -> float:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not 0.0 <= value < math.inf:
        raise TaskError(f"{owner}: requirements.{name} is {value!r}, legal: finite, from 0")
    return float(value)


@dataclass(frozen=True)
class Capabilities:
    """What a robot can do.

    Attributes:
        domain: it moves in: air, ground or water.
        skills: names of what it can do.
        payload_kg: that it carries at most [kg].
        speed_m_s: at which it travels [m/s].
        energy_j: that it has for tasks, at the start [J]; infinite: enough.
        travel_power_w: that it takes while it travels [W].
        work_power_w: that it takes while it works or waits at a place [W].
    """

    domain: str
    skills: tuple[str, ...] = ()
    payload_kg: float = 0.0
    speed_m_s: float = 1.0
    energy_j: float = math.inf
    travel_power_w: float = 0.0
    work_power_w: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a robot that cannot be.

        Raises:
            TaskError: names field, value and legal range.
        """
        if self.domain not in DOMAINS:
            raise TaskError(f"capabilities: domain is {self.domain!r}, legal: {', '.join(DOMAINS)}")
        if not 0.0 < self.speed_m_s < math.inf:
            raise TaskError(f"capabilities: speed_m_s is {self.speed_m_s}, legal: finite, above 0")
        for name in ("payload_kg", "energy_j", "travel_power_w", "work_power_w"):
            if not getattr(self, name) >= 0.0:
                raise TaskError(f"capabilities: {name} is {getattr(self, name)}, legal: from 0")

    def lacks(self, asked: Requirements) -> list[str]:
        """What a task asks and the robot has not, a phrase each; empty: it can do the task."""
        missing = [f"skill {skill}" for skill in asked.skills if skill not in self.skills]
        if asked.domains and self.domain not in asked.domains:
            missing.append(f"moves in {self.domain}, not {' or '.join(asked.domains)}")
        for name in ("payload_kg", "speed_m_s"):
            has, wants = getattr(self, name), getattr(asked, name)
            if has < wants:
                missing.append(f"{name} {has:g} of {wants:g}")
        return missing


def nobody_can(owner: str, asked: Requirements, team: dict[str, Capabilities]) -> str | None:
    """One sentence if no robot has what is asked, with the robot that lacks the fewest things."""
    lacks = {name: can.lacks(asked) for name, can in team.items()}
    if not lacks or not all(lacks.values()):
        return None if lacks else f"{owner}: there is no robot"
    nearest = min(lacks, key=lambda name: (len(lacks[name]), name))
    return (
        f"{owner}: no robot has requirements {asked.to_json()}; nearest: {nearest}, "
        f"lacks {', '.join(lacks[nearest])}"
    )
