# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a mission: the map with all tracks, coverage over time, tasks over time, a tree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from trident_fleet.core.missions.record import Record, Work
from trident_fleet.core.missions.scene import Scene
from trident_fleet.core.missions.tree_file import TreePlan
from trident_fleet.core.missions.truth import PersonState
from trident_fleet.core.search.area import Array

_COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
_LAND, _WATER, _COVERED = (0.93, 0.91, 0.84), (0.80, 0.89, 0.95), (0.62, 0.72, 0.58)


def _pyplot() -> Any:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    return pyplot


class Ending(Protocol):
    """The end of a mission: its `Truth`, or what a file has of it."""

    @property
    def scene(self) -> Scene:
        """What was searched."""
        ...

    @property
    def people(self) -> list[PersonState]:
        """What became of those who were to be found."""
        ...

    @property
    def places(self) -> Array:
        """Where they are, p_common [m], shape (N, 2)."""
        ...


@dataclass(frozen=True)
class MapEnd:
    """An `Ending`."""

    scene: Scene
    people: list[PersonState]
    places: Array


def draw_map(path: Path, record: Record, truth: Ending) -> None:
    """Land and water, darker where nobody looked well enough, tracks, and what became of people.

    Args:
        path: of the PNG.
        record: of the mission.
        truth: at its end.
    """
    plt = _pyplot()
    area = truth.scene.area
    left, low = area.lattice.origin
    length, width = area.lattice.size
    image = np.where(area.land[..., None], _LAND, _WATER)
    image[area.covered] = _COVERED
    if record.covered is not None:
        image[~record.covered] *= 0.75
    figure, axes = plt.subplots(figsize=(11.0, 8.5), layout="constrained")
    axes.imshow(image, origin="lower", extent=(left, left + length, low, low + width))
    for color, (name, track) in zip(_COLORS, record.tracks.items(), strict=False):
        axes.plot(*np.array(track).T, color=color, linewidth=1.0, label=name)
        axes.plot(*track[-1], "s", color=color, markersize=7)
    looks = {"not found": ("x", "#b00000"), "found": ("o", "#b06000"), "served": ("o", "#007030")}
    for state, (marker, color) in looks.items():
        places = truth.places[[_state(one) == state for one in truth.people]]
        if len(places):
            axes.plot(*places.T, marker, color=color, label=f"{state}: {len(places)}")
    axes.set(xlabel="x [m]", ylabel="y [m]", title="dark: not covered")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.07), ncols=6)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _state(person: PersonState) -> str:
    if person.served_s is not None:
        return "served"
    return "not found" if person.found_s is None else "found"


def _draw_work(axes: Any, done: Sequence[Work], robots: Sequence[str], color: str) -> None:
    """Bars of one kind of task."""
    axes.barh(
        [robots.index(work.robot) for work in done],
        [work.end_s - work.begin_s for work in done],
        left=[work.begin_s for work in done],
        color=color,
        edgecolor="white",
        linewidth=0.5,
        label=done[0].kind,
    )


def draw_times(path: Path, record: Record) -> None:
    """Coverage over time, and below it which robot was at which kind of task."""
    plt = _pyplot()
    figure, (upper, lower) = plt.subplots(
        2, 1, figsize=(11.0, 7.0), sharex=True, height_ratios=(3, 2), layout="constrained"
    )
    times, shares = np.array(record.coverage).reshape(-1, 2).T
    upper.plot(times, 100.0 * shares, color=_COLORS[0])
    upper.set(ylabel="cells covered [%]", ylim=(0, 100))
    upper.grid(alpha=0.3)
    names, kinds = list(record.tracks), sorted({work.kind for work in record.work})
    for color, kind in zip(_COLORS, kinds, strict=False):
        done = [work for work in record.work if work.kind == kind]
        _draw_work(lower, done, names, color)
    lower.set(xlabel="time [s]", yticks=range(len(names)), yticklabels=names)
    lower.invert_yaxis()
    if kinds:
        lower.legend(loc="upper center", bbox_to_anchor=(0.5, -0.25), ncols=len(kinds))
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_tree(path: Path, plan: TreePlan) -> None:
    """A behavior tree from left to right; selectors are marked ?, sequences ->."""
    plt = _pyplot()
    leaves: list[TreePlan] = []
    figure, axes = plt.subplots(layout="constrained")

    def place(node: TreePlan, depth: int) -> float:
        if not node.children:
            leaves.append(node)
            row = float(len(leaves) - 1)
        else:
            rows = [place(child, depth + 1) for child in node.children]
            row = 0.5 * (rows[0] + rows[-1])
            for one in rows:
                axes.plot([depth, depth + 0.5, depth + 1], [row, one, one], color="0.6", zorder=0)
        mark = {"selector": "?  selector", "sequence": "\u2192  sequence"}.get(node.kind, node.kind)
        box = {"boxstyle": "round", "facecolor": "white" if node.children else "#dceaf5"}
        axes.text(depth, row, mark, ha="left", va="center", bbox=box)
        return row

    place(plan, 0)
    depth = _depth(plan)
    figure.set_size_inches(2.2 * (depth + 1), 0.55 * len(leaves) + 0.6)
    axes.set(xlim=(-0.1, depth + 1), ylim=(len(leaves) - 0.5, -0.5))
    axes.axis("off")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _depth(plan: TreePlan) -> int:
    return 1 + max(map(_depth, plan.children)) if plan.children else 0
