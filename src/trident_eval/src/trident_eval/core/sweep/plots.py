# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a sweep: intervals of all points, curves along axes, maps of two axes."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.sweep.axes import names_of
from trident_eval.core.sweep.comparing import Compared
from trident_eval.core.sweep.rows import DONE, RunRow
from trident_eval.core.sweep.scenario import Metric, Scenario
from trident_eval.core.sweep.statistics import half_width
from trident_eval.core.sweep.tables import estimates

_MANY = 60  # points; more are no use as separate lines
_SIZE = (8.0, 4.5)  # of a picture [in]


def draw(
    scenario: Scenario, rows: Sequence[RunRow], compared: Sequence[Compared], folder: Path
) -> list[Path]:
    """Draws all pictures that the rows allow, and returns their files."""
    drawn: list[Path] = []
    done = [row for row in rows if row.status == DONE]
    if not done:
        return drawn
    for metric in scenario.metrics:
        drawn += _intervals(scenario, done, metric, folder)
        drawn += _curves(scenario, done, metric, folder)
        drawn += _maps(scenario, done, metric, folder)
    return drawn + _differences(compared, folder)


def point_label(scenario: Scenario, parameters: dict[str, Any]) -> str:
    """The values of a point in words; "all" where there is no axis."""
    names = names_of(scenario.axes)
    return ", ".join(f"{name} {_short(parameters[name])}" for name in names) or "all"


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _with_unit(metric: Metric) -> str:
    return f"{metric.name} [{metric.unit}]" if metric.unit else metric.name


def _intervals(
    scenario: Scenario, rows: Sequence[RunRow], metric: Metric, folder: Path
) -> list[Path]:
    """Mean and 95 % interval of each point, one line each."""
    found = estimates(rows, metric.name)
    if len(found) > _MANY:
        return []
    points = scenario.points()
    labels = [point_label(scenario, points[point]) for point in found]
    figure, axes = _figure(height=max(2.0, 0.3 * len(found) + 1.2))
    for line, one in enumerate(found.values()):
        axes.plot(one.mean, line, "o", color="tab:blue")
        if one.count > 1:
            axes.plot([one.t_low, one.t_high], [line, line], color="tab:blue")
            axes.plot(
                [one.bootstrap_low, one.bootstrap_high], [line, line], lw=5, color="tab:blue",
                alpha=0.25, solid_capstyle="butt",
            )  # fmt: skip
    axes.set_yticks(range(len(labels)), labels)
    axes.invert_yaxis()
    axes.set_xlabel(f"{_with_unit(metric)}: mean, 95 % by Student's t (line), bootstrap (band)")
    return [_save(figure, folder / f"intervals_{_file(metric.name)}.png")]


def _numeric_axes(scenario: Scenario, rows: Sequence[RunRow]) -> list[str]:
    """Parameters of axes that have numbers, at least two different ones."""
    values = {name: [row.parameters[name] for row in rows] for name in names_of(scenario.axes)}
    return [name for name in values if _are_different_numbers(values[name])]


def _are_different_numbers(values: Sequence[Any]) -> bool:
    return all(type(value) in (int, float) for value in values) and len(set(values)) > 1


def _curves(scenario: Scenario, rows: Sequence[RunRow], metric: Metric, folder: Path) -> list[Path]:
    """A metric along each axis of numbers, averaged over all others."""
    drawn = []
    for name in _numeric_axes(scenario, rows):
        groups: dict[float, list[float]] = {}
        for row in rows:
            groups.setdefault(row.parameters[name], []).append(row.metrics[metric.name])
        if len(groups) > _MANY:
            drawn.append(_scatter(rows, name, metric, folder))
            continue
        x = sorted(groups)
        means = np.array([np.mean(groups[value]) for value in x])
        widths = np.array([half_width(groups[value]) for value in x])
        widths[np.isinf(widths)] = 0.0  # of one value
        figure, axes = _figure()
        axes.plot(x, means, "o-")
        axes.fill_between(x, means - widths, means + widths, alpha=0.25, lw=0)
        axes.set_xlabel(name)
        axes.set_ylabel(f"{_with_unit(metric)}, mean and 95 %")
        drawn.append(_save(figure, folder / f"curve_{_file(metric.name)}_{_file(name)}.png"))
    return drawn


def _scatter(rows: Sequence[RunRow], name: str, metric: Metric, folder: Path) -> Path:
    figure, axes = _figure()
    x = [row.parameters[name] for row in rows]
    axes.plot(x, [row.metrics[metric.name] for row in rows], ".", alpha=0.6)
    axes.set_xlabel(name)
    axes.set_ylabel(_with_unit(metric))
    return _save(figure, folder / f"curve_{_file(metric.name)}_{_file(name)}.png")


def _maps(scenario: Scenario, rows: Sequence[RunRow], metric: Metric, folder: Path) -> list[Path]:
    """Means over pairs of axes whose values form a grid."""
    drawn = []
    for first, second in itertools.combinations(_numeric_axes(scenario, rows), 2):
        cells: dict[tuple[float, float], list[float]] = {}
        for row in rows:
            place = (row.parameters[first], row.parameters[second])
            cells.setdefault(place, []).append(row.metrics[metric.name])
        x, y = (sorted(set(values)) for values in zip(*cells, strict=True))
        if len(cells) == len(x) * len(y) and len(cells) <= _MANY * _MANY:
            drawn.append(_map((first, x), (second, y), cells, metric, folder))
    return drawn


def _map(
    across: tuple[str, list[float]],
    up: tuple[str, list[float]],
    cells: dict[tuple[float, float], list[float]],
    metric: Metric,
    folder: Path,
) -> Path:
    (first, x), (second, y) = across, up
    figure, axes = _figure()
    values = [[float(np.mean(cells[(column, line)])) for column in x] for line in y]
    image = axes.imshow(values, origin="lower", aspect="auto", cmap="viridis")
    axes.set_xticks(range(len(x)), [_short(value) for value in x], rotation=45)
    axes.set_yticks(range(len(y)), [_short(value) for value in y])
    axes.set_xlabel(first)
    axes.set_ylabel(second)
    figure.colorbar(image, label=_with_unit(metric))
    return _save(figure, folder / f"map_{_file(metric.name)}_{_file(first)}_{_file(second)}.png")


def _differences(compared: Sequence[Compared], folder: Path) -> list[Path]:
    known = [one for one in compared if one.difference is not None]
    if not known:
        return []
    figure, axes = _figure(height=max(2.0, 0.5 * len(known) + 1.2))
    labels = []
    for line, one in enumerate(known):
        assert one.difference is not None
        found, ask = one.difference.estimate, one.comparison
        axes.plot(found.mean, line, "o", color="tab:green")
        if found.count > 1:
            axes.plot([found.t_low, found.t_high], [line, line], color="tab:green")
        labels.append(f"{ask.metric}: {_short(ask.first)} - {_short(ask.second)}")
    axes.axvline(0.0, color="0.6", lw=1)
    axes.set_yticks(range(len(labels)), labels)
    axes.invert_yaxis()
    axes.set_xlabel("difference of pairs, mean and 95 % by Student's t")
    return [_save(figure, folder / "differences.png")]


def _figure(height: float = _SIZE[1]) -> tuple[Any, Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(_SIZE[0], height), layout="constrained")
    axes = figure.add_subplot()
    axes.grid(alpha=0.3)
    return figure, axes


def _save(figure: Any, path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=100)
    return path


def _file(name: str) -> str:
    return "".join(letter if letter.isalnum() else "_" for letter in name)
