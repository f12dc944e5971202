# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What can be chosen of an environment: rewards, and what differs from episode to episode."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar, cast

from trident_sim._core import Error


class Terms(NamedTuple):
    """What rewards are made of: one number each, or an array with one for each environment.

    Attributes:
        distance: to the goal [m].
        progress: by which the last action made it shorter [m].
        speed: [m/s].
        turn_rate: [rad/s].
        up: cosine of the angle between the model's z axis and the vertical.
        heading: from the goal's, 0 to pi [rad].
        effort: mean square of the action's numbers.
        change: mean square of their changes since the last action.
        contact: 1 if anything touches the model, else 0.
        nearest: to what the lidar sees, or to another agent [m]; infinite: neither is there.
    """

    distance: Any
    progress: Any
    speed: Any
    turn_rate: Any
    up: Any
    heading: Any
    effort: Any
    change: Any
    contact: Any
    nearest: Any


@dataclass(frozen=True)
class Rewards:
    """Weights of what an action is rewarded for; see `Terms` for the units.

    Attributes:
        alive: for each action that does not end in a failure.
        distance: per m.
        progress: per m.
        speed: per m/s.
        turn_rate: per rad/s.
        heading: per rad.
        effort: of 1.
        change: of 1.
        contact: while anything touches the vehicle.
        arrival: for a goal that is reached.
        failure: once.
    """

    alive: float = 0.0
    distance: float = 0.0
    progress: float = 0.0
    speed: float = 0.0
    turn_rate: float = 0.0
    heading: float = 0.0
    effort: float = 0.0
    change: float = 0.0
    contact: float = 0.0
    arrival: float = 0.0
    failure: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is not finite."""
        _check_finite(self)

    def weights(self) -> tuple[tuple[int, float], ...]:
        """Index in `Terms` and weight, of those that count."""
        pairs = [
            (index, float(getattr(self, name, 0.0))) for index, name in enumerate(Terms._fields)
        ]
        return tuple((index, weight) for index, weight in pairs if weight)


Judge = Callable[[Terms], Any]
"""A reward of your own; it gets numbers, or arrays in the vector form."""


@dataclass(frozen=True)
class Randomization:
    """What differs from episode to episode, drawn from the environment's own seeded stream.

    Attributes:
        start: factor of the spread of where and how episodes begin; 0: always the same.
        mass: smallest and largest factor of the vehicle's mass and inertia.
        wind: largest speed of the wind, from any side [m/s].
    """

    start: float = 1.0
    mass: tuple[float, float] = (1.0, 1.0)
    wind: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what cannot be.

        Raises:
            Error: names field, value and legal range.
        """
        if not 0.0 <= self.start <= 10.0:
            raise Error(f"randomization: start is {self.start}, legal: 0 to 10")
        if not 0.0 <= self.wind <= 50.0:
            raise Error(f"randomization: wind is {self.wind} m/s, legal: 0 to 50")
        if len(self.mass) != 2 or not 0.1 <= self.mass[0] <= self.mass[1] <= 10.0:
            raise Error(f"randomization: mass is {self.mass}, legal: two factors, 0.1 to 10")


Choice = TypeVar("Choice", Rewards, Randomization)


def chosen(kind: type[Choice], value: Any, default: Choice) -> Choice:
    """An option that may be given as an object, as a mapping of its fields, or not at all.

    Raises:
        Error: a field is unknown, or its value is illegal.
    """
    if value is None:
        return default
    if isinstance(value, kind):
        return value
    legal = [field.name for field in dataclasses.fields(kind)]
    try:
        return cast(Choice, dataclasses.replace(default, **value))
    except TypeError as error:
        raise Error(f"{kind.__name__.lower()}: {value!r}, legal: {', '.join(legal)}") from error


def one_of(value: str, legal: Sequence[str], what: str) -> str:
    """A name that is known.

    Raises:
        Error: it is not; the text lists those that are.
    """
    if value not in legal:
        raise Error(f"{what} is {value!r}, legal: {', '.join(legal)}")
    return value


def _check_finite(rewards: Rewards) -> None:
    for field in dataclasses.fields(rewards):
        value = getattr(rewards, field.name)
        if not (isinstance(value, (int, float)) and math.isfinite(value)):
            raise Error(f"rewards: {field.name} is {value!r}, legal: finite numbers")
