# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A sweep's file: what is run, with which parameters and seeds, and what is asked of it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trident_fleet.core.files.strict_yaml import Section, load

from trident_eval.core.sweep.axes import LARGEST_COUNT, Axis, names_of, points_of, read_axes

_FUNCTION = re.compile(r"[A-Za-z_][\w.]*:[A-Za-z_]\w*")
_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}")
_BETTER = ("higher", "lower", "neither")
_LONGEST_S, _LARGEST_MB = 7 * 86400.0, 1_000_000.0


@dataclass(frozen=True)
class Metric:
    """A number that each run gives.

    Attributes:
        name: of the number; for a launch file its path in verdict.json, with dots.
        unit: for tables and plots.
        better: `higher`, `lower` or `neither`.
    """

    name: str
    unit: str
    better: str


@dataclass(frozen=True)
class Comparison:
    """Two values of a parameter, run by run with the same seed and other parameters.

    Attributes:
        parameter: which one differs.
        first: its value on one side.
        second: on the other; the difference is first - second.
        metric: of which.
    """

    parameter: str
    first: Any
    second: Any
    metric: str


@dataclass(frozen=True)
class Enough:
    """When a point needs no more seeds.

    Attributes:
        metric: whose interval counts.
        half_width: of its 95 % interval, in its unit; at most this is enough.
        least: seeds that are run in any case.
    """

    metric: str
    half_width: float
    least: int


@dataclass(frozen=True)
class Limits:
    """What one run may take: wall-clock time [s] and address space [MB]."""

    time_s: float
    memory_mb: float


@dataclass(frozen=True)
class Scenario:
    """A sweep.

    Attributes:
        name: of it; its folder has this name.
        function: `module:name`, or `` for a launch file.
        launch: words behind `./trident run`, or () for a function.
        parameters: that all runs share.
        axes: of the others.
        seeds: of each point, in the order in which they are run.
        limits: of each run.
        metrics: that a run has to give.
        comparisons: that are asked for.
        enough: the rule; None: all seeds.
    """

    name: str
    function: str
    launch: tuple[str, ...]
    parameters: dict[str, Any]
    axes: tuple[Axis, ...]
    seeds: tuple[int, ...]
    limits: Limits
    metrics: tuple[Metric, ...]
    comparisons: tuple[Comparison, ...]
    enough: Enough | None

    @property
    def subject(self) -> str:
        """What is run, in words that do not change while it is the same."""
        return self.function or " ".join(("launch", *self.launch))

    def points(self) -> list[dict[str, Any]]:
        """Parameters of each point, the fixed ones included."""
        return [{**self.parameters, **point} for point in points_of(self.axes)]


def read_scenario(path: Path) -> Scenario:
    """A scenario file.

    Raises:
        FormationError: what is wrong, with file, line, key, value and legal range.
    """
    file = load(path)
    name = file.text("name", path.stem)
    if not _NAME.fullmatch(name):
        raise file.error("name", f"{name!r}; legal: letters, digits, _ . - (up to 100)")
    function, launch = _read_subject(file)
    parameters = file.mapping("parameters")
    axes = _read_axes(file, parameters)
    seeds = _read_seeds(file)
    _check_size(file, axes, seeds)
    metrics = _read_metrics(file)
    scenario = Scenario(
        name,
        function,
        launch,
        parameters,
        axes,
        seeds,
        _read_limits(file),
        metrics,
        tuple(_read_comparison(part, metrics, axes) for part in file.sections("comparisons")),
        _read_enough(file, metrics, len(seeds)),
    )
    file.finish()
    return scenario


def _read_subject(file: Section) -> tuple[str, tuple[str, ...]]:
    function, launch = file.text("function", ""), file.text("launch", "")
    if bool(function) == bool(launch):
        raise file.error_here("legal: either `function: module:name` or `launch: FILE.launch`")
    if function and not _FUNCTION.fullmatch(function):
        raise file.error("function", f"{function!r}; legal: module:name")
    return function, tuple(launch.split())


def _read_axes(file: Section, parameters: dict[str, Any]) -> tuple[Axis, ...]:
    samples, seed = file.integer("samples", 0), file.integer("sampling_seed", 1)
    section = file.section("axes") if "axes" in file else None
    if section is None:
        file.skip("axes")
    axes = read_axes(section, samples, seed)
    _check_names(file, names_of(axes), parameters)
    return axes


def _check_names(file: Section, names: list[str], parameters: dict[str, Any]) -> None:
    for name in names:
        if names.count(name) > 1 or name in parameters:
            raise file.error("axes", f"{name}: given twice; legal: one axis or one fixed value")
        if name == "seed":
            raise file.error("axes", "seed is no axis; legal: `seeds:`")


def _read_seeds(file: Section) -> tuple[int, ...]:
    """A count, or a list."""
    if file.is_list("seeds"):
        return _read_listed_seeds(file)
    count = file.integer("seeds", 1)
    if not 1 <= count <= LARGEST_COUNT:
        raise file.error("seeds", f"{count}; legal: 1 to {LARGEST_COUNT}, or a list of seeds")
    return tuple(range(1, count + 1))


def _read_listed_seeds(file: Section) -> tuple[int, ...]:
    values = file.items("seeds")
    if not values or not all(type(value) is int and 0 <= value < 2**32 for value in values):
        raise file.error("seeds", f"{values}; legal: whole numbers from 0 to 4294967295")
    if len(set(values)) < len(values):
        raise file.error("seeds", "a seed is given twice")
    return tuple(values)


def _check_size(file: Section, axes: Sequence[Axis], seeds: Sequence[int]) -> None:
    size = len(seeds)
    for axis in axes:
        size *= len(axis.points)
    if size > LARGEST_COUNT:
        raise file.error_here(f"{size} runs; legal: up to {LARGEST_COUNT}")


def _read_limits(file: Section) -> Limits:
    if "limits" not in file:
        file.skip("limits")
        return Limits(3600.0, 0.0)
    section = file.section("limits")
    time_s, memory_mb = section.number("time_s", 3600.0), section.number("memory_mb", 0.0)
    if not 0.0 < time_s <= _LONGEST_S:
        raise section.error("time_s", f"{time_s:g}; legal: above 0, up to {_LONGEST_S:g}")
    if not 0.0 <= memory_mb <= _LARGEST_MB:
        raise section.error("memory_mb", f"{memory_mb:g}; legal: 0 (no limit) to {_LARGEST_MB:g}")
    section.finish()
    return Limits(time_s, memory_mb)


def _read_metrics(file: Section) -> tuple[Metric, ...]:
    section = file.section("metrics")
    metrics = []
    for name in section.names():
        entry = section.section(name)
        better = entry.text("better", "neither")
        if better not in _BETTER:
            raise entry.error("better", f"{better!r}; legal: {', '.join(_BETTER)}")
        metrics.append(Metric(name, entry.text("unit", ""), better))
        entry.finish()
    if not metrics:
        raise file.error("metrics", "none; legal: names, each with `unit` and `better`")
    return tuple(metrics)


def _values_of(parameter: str, axes: Sequence[Axis]) -> list[Any]:
    """All that a parameter is on its axis."""
    return [
        point[axis.names.index(parameter)]
        for axis in axes
        if parameter in axis.names
        for point in axis.points
    ]


def _read_comparison(
    section: Section, metrics: Sequence[Metric], axes: Sequence[Axis]
) -> Comparison:
    parameter = section.choice("parameter", names_of(axes))
    values = _values_of(parameter, axes)
    sides = []
    for side in ("first", "second"):
        value = section.value(side)
        if value not in values:
            shown = ", ".join(map(repr, dict.fromkeys(map(str, values[:10]))))
            raise section.error(side, f"{value!r}: no value of {parameter}; legal: {shown}")
        sides.append(value)
    metric = section.choice("metric", [one.name for one in metrics])
    section.finish()
    return Comparison(parameter, sides[0], sides[1], metric)


def _read_enough(file: Section, metrics: Sequence[Metric], seeds: int) -> Enough | None:
    if "enough" not in file:
        file.skip("enough")
        return None
    section = file.section("enough")
    metric = section.choice("metric", [one.name for one in metrics])
    half_width = section.number("half_width", 0.0)
    if half_width <= 0.0:
        raise section.error_here(f"half_width {half_width:g}; legal: above 0")
    least = section.integer("least", min(5, seeds))
    if not 2 <= least <= max(2, seeds):
        raise section.error("least", f"{least}; legal: 2 to the number of seeds, {seeds}")
    section.finish()
    return Enough(metric, half_width, least)
