# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A formation flight from patterns: moved, turned, resized, changed; as rows of positions."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field

import numpy as np

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import Vector
from trident_fleet.core.patterns import FARTHEST_M, Pattern, places
from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import min_separation
from trident_fleet.core.transition import (
    Transition,
    check_apart,
    closest_pair,
    plan_transition,
)

MAX_VEHICLES = 500
# Between two rows the flight bends: turns are cut into pieces that are nearly straight.
_MAX_TURN_PER_ROW_DEG = 4.0
_MAX_TURN_DEG = 3600.0
_STEEPEST_BLEND = 1.5
_SLACK_M = 1e-6


@dataclass(frozen=True)
class Step:
    """What happens at once, from rest to rest.

    Attributes:
        pattern: to change into, each vehicle straight to its place; None: the shape stays.
        translate_m: translation of the center [m, world].
        rotate_deg: turn about the vertical axis through the center, counter-clockwise [deg].
        rescale: factor of all distances from the center.
        where: the step's place in its file, for messages.
    """

    pattern: Pattern | None = None
    translate_m: Vector = (0.0, 0.0, 0.0)
    rotate_deg: float = 0.0
    rescale: float = 1.0
    where: str = "step"

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        _check_vector("translate_m", self.translate_m)
        if not abs(self.rotate_deg) <= _MAX_TURN_DEG:
            raise FormationError(
                f"rotate_deg: {self.rotate_deg}; legal: -{_MAX_TURN_DEG:g} to {_MAX_TURN_DEG:g}"
            )
        if not 0.01 <= self.rescale <= 100.0:
            raise FormationError(f"rescale: {self.rescale}; legal: 0.01 to 100")
        if self.pattern is not None and self.rescale != 1.0:
            raise FormationError(
                f"rescale: {self.rescale} together with a new pattern; legal: 1, the pattern has"
                " its own size"
            )


@dataclass(frozen=True)
class Choreography:
    """A whole flight.

    Attributes:
        vehicles: how many.
        begin: the first pattern.
        steps: what happens then.
        position_m: of the center at the beginning [m, world].
        heading_deg: of the formation at the beginning [deg, world, counter-clockwise from x].
        min_separation_m: that any two vehicles keep at every instant [m].
        row_spacing_m: longest distance of a vehicle between two rows [m].
    """

    vehicles: int
    begin: Pattern
    steps: tuple[Step, ...] = ()
    position_m: Vector = (0.0, 0.0, 1.2)
    heading_deg: float = 0.0
    min_separation_m: float = 1.0
    row_spacing_m: float = 0.15

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        if not 1 <= self.vehicles <= MAX_VEHICLES:
            raise FormationError(f"vehicles: {self.vehicles}; legal: 1 to {MAX_VEHICLES}")
        for name, least, most in (("min_separation_m", 0.0, 100.0), ("row_spacing_m", 0.01, 10.0)):
            value = getattr(self, name)
            if not least <= value <= most:
                raise FormationError(f"{name}: {value}; legal: {least:g} to {most:g}")
        _check_vector("position_m", self.position_m)
        if not math.isfinite(self.heading_deg):
            raise FormationError(f"heading_deg: {self.heading_deg}; legal: finite")
        for step in self.steps:
            _validate_step(step)


def _validate_step(step: Step) -> None:
    try:
        step.validate()
    except FormationError as error:
        raise FormationError(f"{step.where}: {error}") from error


@dataclass(frozen=True)
class StepResult:
    """How a step is flown.

    Attributes:
        step: which.
        rows: its first and last row, from 0.
        separation_m: smallest distance of any two vehicles [m].
        transition: how places are changed, if they are.
    """

    step: Step
    rows: tuple[int, int]
    separation_m: float
    transition: Transition | None


@dataclass(frozen=True)
class Performance:
    """A choreography as rows.

    Attributes:
        rows: p_world of each row and vehicle [m], shape (T, N, 3).
        steps: how each step is flown.
    """

    rows: Array
    steps: tuple[StepResult, ...]


@dataclass
class _Stage:
    """Where the formation is while its rows are made."""

    center: Array
    heading_deg: float
    shape: Array  # p_formation of each vehicle, (N, 3)
    rows: list[Array] = field(default_factory=list)

    def positions(self) -> Array:
        return self.center + _turned(self.shape, self.heading_deg)


def perform(choreography: Choreography) -> Performance:
    """Make the rows of a choreography.

    Raises:
        FormationError: an illegal field, or a step in which vehicles would come too close; names
            the step, the vehicles and the distance.
    """
    choreography.validate()
    stage = _Stage(
        center=np.array(choreography.position_m, dtype=np.float64),
        heading_deg=choreography.heading_deg,
        shape=places(choreography.begin, choreography.vehicles),
    )
    check_apart(stage.shape, choreography.min_separation_m, "begin: vehicles")
    stage.rows.append(stage.positions())
    results = []
    for step in choreography.steps:
        first = len(stage.rows) - 1
        transition = _move(stage, step, choreography)
        flown = np.stack(stage.rows[first:])
        _check_step(flown, step, choreography.min_separation_m)
        last = len(stage.rows) - 1
        results.append(StepResult(step, (first, last), min_separation(flown), transition))
    return Performance(np.stack(stage.rows), tuple(results))


def _move(stage: _Stage, step: Step, choreography: Choreography) -> Transition | None:
    center = stage.center + np.array(step.translate_m)
    heading_deg = stage.heading_deg + step.rotate_deg
    if step.pattern is None:
        _move_shape(stage, step, choreography.row_spacing_m)
        stage.center, stage.heading_deg = center, heading_deg
        stage.shape = step.rescale * stage.shape
        return None
    shape = places(step.pattern, choreography.vehicles)
    targets = center + _turned(shape, heading_deg)
    try:
        transition = plan_transition(stage.positions(), targets, choreography.min_separation_m)
    except FormationError as error:
        raise FormationError(f"{step.where}: {error}") from error
    corners = transition.points()
    for begin, end in itertools.pairwise(corners):
        count = _row_count(_longest(end - begin), choreography.row_spacing_m)
        stage.rows += [begin + part * (end - begin) for part in _blend(count)]
    stage.center, stage.heading_deg = center, heading_deg
    stage.shape = shape[list(transition.place)]
    return transition


def _move_shape(stage: _Stage, step: Step, row_spacing_m: float) -> None:
    """Rows of a step that keeps the shape, up to its size."""
    translation = np.array(step.translate_m)
    size = _longest(stage.shape) * max(1.0, step.rescale)
    arc = size * math.radians(abs(step.rotate_deg)) + size * abs(step.rescale - 1.0)
    turns = math.ceil(_STEEPEST_BLEND * abs(step.rotate_deg) / _MAX_TURN_PER_ROW_DEG)
    count = max(_row_count(float(np.linalg.norm(translation)) + arc, row_spacing_m), turns)
    for part in _blend(count):
        shape = (1.0 + part * (step.rescale - 1.0)) * stage.shape
        turned = _turned(shape, stage.heading_deg + part * step.rotate_deg)
        stage.rows.append(stage.center + part * translation + turned)


def _check_step(flown: Array, step: Step, required_m: float) -> None:
    if min_separation(flown) < required_m - _SLACK_M:
        i, j, distance = closest_pair(flown)
        raise FormationError(
            f"{step.where}: vehicles {i + 1} and {j + 1} would come within {distance:.3f} m; legal:"
            f" min_separation_m {required_m:g} or more"
        )


def _check_vector(name: str, value: Vector) -> None:
    if not all(abs(part) <= FARTHEST_M for part in value):
        raise FormationError(f"{name}: {list(value)}; legal: each at most {FARTHEST_M:g} m")


def _row_count(length_m: float, row_spacing_m: float) -> int:
    return max(1, math.ceil(_STEEPEST_BLEND * length_m / row_spacing_m - _SLACK_M))


def _blend(count: int) -> Array:
    """Shares of a step that are done after each of its rows, dense at its beginning and end."""
    part = np.arange(1, count + 1) / count
    return np.asarray(part * part * (3.0 - 2.0 * part))


def _longest(vectors: Array) -> float:
    return float(np.sqrt((vectors**2).sum(axis=-1)).max())


def _turned(points: Array, angle_deg: float) -> Array:
    angle = math.radians(angle_deg)
    cos, sin = math.cos(angle), math.sin(angle)
    x, y, z = points[..., 0], points[..., 1], points[..., 2]
    return np.stack([x * cos - y * sin, x * sin + y * cos, z], axis=-1)
