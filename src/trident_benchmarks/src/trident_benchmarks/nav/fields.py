# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of cylinders as the BARN data set has them: files, the task, its metric."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from trident_eval.core.errors import EvalError

Cylinder = tuple[float, float, float]  # x, y, radius [m]
Point = tuple[float, float]

START = (-2.25, 3.0, 1.57)  # of the task: x, y [m], yaw [rad]
GOAL_AHEAD_M = 10.0
GOAL_RADIUS_M = 1.0
TIME_LIMIT_S = 100.0
MOVED_M = 0.1  # from which on the time counts
_SPEED = 2.0  # of the optimal time [m/s]
_BEST, _WORST = 2.0, 8.0  # of optimal times: the metric changes between them
_OBSTACLES = re.compile(r"world_(\d+)\.obstacles\.csv")


@dataclass(frozen=True)
class Field:
    """One world.

    Attributes:
        number: of the world.
        cylinders: all obstacles.
        path: the reference path from the start to the goal.
    """

    number: int
    cylinders: tuple[Cylinder, ...]
    path: tuple[Point, ...]

    @property
    def optimal_s(self) -> float:
        """The reference path at full speed."""
        return sum(math.dist(a, b) for a, b in zip(self.path, self.path[1:], strict=False)) / _SPEED

    def sdf(self) -> str:
        """A world with a floor, and all cylinders as shapes of one static link."""
        shapes = "".join(
            f'<collision name="cylinder_{i}"><pose>{x} {y} 0 0 0 0</pose><geometry><cylinder>'
            f"<radius>{radius}</radius><length>1</length></cylinder></geometry></collision>"
            for i, (x, y, radius) in enumerate(self.cylinders)
        )
        return _WORLD.format(shapes=shapes)


_WORLD = (
    '<sdf version="1.6"><world name="field"><physics type="ode"><max_step_size>0.001'
    '</max_step_size></physics><model name="ground_plane"><static>1</static><link name="link">'
    '<collision name="floor"><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane>'
    "</geometry><surface><friction><ode><mu>100</mu><mu2>50</mu2></ode></friction></surface>"
    '</collision></link></model><model name="obstacles"><static>1</static><link name="link">'
    "{shapes}</link></model></world></sdf>"
)


def _rows(file: Path, columns: Sequence[str]) -> list[tuple[float, ...]]:
    try:
        with file.open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
    except OSError as error:
        raise EvalError(f"{file}: {error.strerror}") from error
    values = []
    for line, row in enumerate(rows, start=2):
        try:
            value = tuple(float(row[column]) for column in columns)
        except (KeyError, TypeError, ValueError) as error:
            raise EvalError(f"{file}:{line}: legal: numbers {', '.join(columns)}") from error
        if not all(map(math.isfinite, value)):
            raise EvalError(f"{file}:{line}: {value} is not finite")
        values.append(value)
    return values


def read_field(folder: Path, number: int) -> Field:
    """A world by its number.

    Raises:
        EvalError: a file is missing, or a line of it is not numbers.
    """
    name = f"world_{number}"
    cylinders = _rows(folder / f"{name}.obstacles.csv", ("x_m", "y_m", "radius_m"))
    path = _rows(folder / f"{name}.path.csv", ("x_m", "y_m"))
    if len(path) < 2:
        raise EvalError(f"{folder / name}.path.csv: {len(path)} points, legal: 2 or more")
    return Field(
        number,
        tuple((x, y, radius) for x, y, radius in cylinders),
        tuple((x, y) for x, y in path),
    )


def read_fields(folder: Path) -> list[Field]:
    """All worlds of a folder by their numbers.

    Raises:
        EvalError: it has no worlds, or one cannot be read.
    """
    found = (_OBSTACLES.fullmatch(file.name) for file in folder.glob("world_*.obstacles.csv"))
    numbers = sorted(int(match[1]) for match in found if match)
    if not numbers:
        raise EvalError(f"{folder}: no world_N.obstacles.csv in it")
    return [read_field(folder, number) for number in numbers]


def metric(field: Field, is_success: bool, time_s: float) -> float:
    """The challenge's score of a run, at most 0.5."""
    optimal_s = field.optimal_s
    return is_success * optimal_s / min(max(time_s, _BEST * optimal_s), _WORST * optimal_s)
