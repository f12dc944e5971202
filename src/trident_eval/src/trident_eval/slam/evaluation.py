# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Everything that can be said of one result of SLAM: numbers, pictures, one page."""

from __future__ import annotations

import base64
import html
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.page import PAGE_STYLE
from trident_eval.core.tracks import Array
from trident_eval.slam import pictures
from trident_eval.slam.alignment import AbsoluteErrors, absolute_errors, relative_summary
from trident_eval.slam.grid import Grid, mean_map_entropy, read_grid, wall_thickness
from trident_eval.slam.map_agreement import Agreement, agreement
from trident_eval.slam.relations import RelationErrors, read_relations, relation_errors
from trident_eval.slam.trajectory import Trajectory, read_tum


@dataclass(frozen=True)
class Task:
    """What is to be judged, and by what.

    Attributes:
        trajectories: by name, e.g. "final" and "causal".
        relations: a .relations file.
        truth: a TUM file.
        group: of motions to align with the truth by.
        map, true_map: YAML files.
    """

    trajectories: dict[str, Path]
    relations: Path | None = None
    truth: Path | None = None
    group: str = "SE2"
    map: Path | None = None
    true_map: Path | None = None


@dataclass
class Evaluation:
    """What was found; only what could be judged is there."""

    trajectories: dict[str, Trajectory] = field(default_factory=dict)
    relations: dict[str, RelationErrors] = field(default_factory=dict)
    absolute: dict[str, AbsoluteErrors] = field(default_factory=dict)
    grid: Grid | None = None
    true_grid: Grid | None = None
    agreement: Agreement | None = None

    def summary(self) -> dict[str, Any]:
        """All numbers, by trajectory and for the map; fit for JSON."""
        numbers: dict[str, Any] = {}
        for name, trajectory in self.trajectories.items():
            row: dict[str, Any] = {"poses": len(trajectory), "length_m": _length(trajectory)}
            if name in self.relations:
                row |= self.relations[name].summary()
            if name in self.absolute:
                row |= self.absolute[name].summary() | relative_summary(self.absolute[name])
            numbers[name] = row
        if self.agreement is not None:
            numbers["map"] = self.agreement.summary()
        elif self.grid is not None:
            numbers["map"] = _of_map_alone(self.grid)
        return numbers


def _of_map_alone(grid: Grid) -> dict[str, float | None]:
    found = {
        "wall_thickness_m": wall_thickness(grid),
        "mean_map_entropy_nat": mean_map_entropy(grid),
    }
    return {key: None if np.isnan(value) else value for key, value in found.items()}


def _length(trajectory: Trajectory) -> float:
    return float(np.linalg.norm(np.diff(trajectory.p, axis=0), axis=1).sum())


def evaluate(task: Task) -> Evaluation:
    """Judge all that the task names.

    Raises:
        EvalError: a file that cannot be read or does not fit the others.
    """
    found = Evaluation()
    for name, path in task.trajectories.items():
        found.trajectories[name] = read_tum(path)
        try:
            _judge_trajectory(found, name, task)
        except EvalError as error:
            raise EvalError(f"{path}: {error}") from error
    if task.map:
        found.grid = read_grid(task.map)
    if task.true_map:
        _compare_maps(found, task.true_map)
    return found


def _judge_trajectory(found: Evaluation, name: str, task: Task) -> None:
    trajectory = found.trajectories[name]
    if task.relations:
        found.relations[name] = relation_errors(trajectory, read_relations(task.relations))
    if task.truth:
        truth = read_tum(task.truth)
        found.absolute[name] = absolute_errors(trajectory, truth, task.group)


def _compare_maps(found: Evaluation, true_map: Path) -> None:
    if found.grid is None:
        raise EvalError("a true map needs a map to compare it with (--map)")
    found.true_grid = read_grid(true_map)
    found.agreement = agreement(found.grid, found.true_grid, _place_of_map(found))


def _place_of_map(found: Evaluation) -> Array | None:
    """Where the map lies in the true frame, by the trajectories."""
    if not found.absolute:
        return None
    T = next(iter(found.absolute.values())).T_truth_map
    place = np.eye(3)
    place[:2, :2], place[:2, 2] = T[:2, :2], T[:2, 3]
    return place


def write(found: Evaluation, folder: Path, title: str, draw: bool = True) -> list[Path]:
    """Write evaluation.json, and the pictures and report.html that show it.

    Returns:
        The files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    numbers = found.summary()
    path = folder / "evaluation.json"
    path.write_text(json.dumps(numbers, indent=2, allow_nan=False) + "\n", encoding="utf-8")
    if not draw:
        return [path]
    drawn = pictures.draw_all(found, folder)
    page = folder / "report.html"
    page.write_text(_page(title, numbers, drawn), encoding="utf-8")
    return [path, *drawn, page]


def table(numbers: dict[str, Any]) -> str:
    """The numbers as text, one line each."""
    lines = []
    for name, row in numbers.items():
        lines += [f"{name:10} {key:26} {_text(value)}" for key, value in row.items()]
    return "\n".join(lines)


def _text(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else "?" if value is None else str(value)


def _page(title: str, numbers: dict[str, Any], drawn: list[Path]) -> str:
    parts = [
        "<!doctype html><html lang='en'><meta charset='utf-8'>",
        f"<title>{html.escape(title)}</title><style>{PAGE_STYLE}</style>",
        f"<h1>{html.escape(title)}</h1>",
    ]
    for name, row in numbers.items():
        rows = "".join(f"<tr><th>{key}<td>{_text(value)}" for key, value in row.items())
        parts.append(f"<h2>{html.escape(name)}</h2><table>{rows}</table>")
    for picture in drawn:
        data = base64.b64encode(picture.read_bytes()).decode()
        caption = html.escape(pictures.CAPTIONS[picture.stem])
        parts.append(
            f"<figure><img alt='{picture.name}' src='data:image/png;base64,{data}'>"
            f"<figcaption>{caption}</figcaption></figure>"
        )
    return "\n".join(parts) + "\n"
