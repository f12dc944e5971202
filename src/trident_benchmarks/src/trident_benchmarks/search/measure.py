# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of searches: each planner on 200 maps, shares, drift, and detection."""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from trident_fleet.core.search.area import Array, Lattice, SearchArea
from trident_fleet.core.search.belief import Belief
from trident_fleet.core.search.detection import chance
from trident_fleet.core.search.drift import LEEWAYS, Flow, Sea, leeway_named, random_leeways
from trident_fleet.core.search.planners import PLANNERS, planner_named
from trident_fleet.core.search.planners.base import lower_bound
from trident_fleet.core.search.samples import of_three_kinds, random_map
from trident_fleet.core.search.shares import balanced_shares

from trident_benchmarks.results import check_folder, keep_rows, limits_code, new_document

_TRIALS = 20_000  # fewer are farther from the model than the limit by chance
_MAPS = 200
# Limits: mean length over the lower bound, imbalance, divergence, and error of the detection curve.
_LENGTH = {"boustrophedon": 1.10, "tree": 1.10}
_IMBALANCE, _DIVERGENCE, _CURVE = 0.05, 0.02, 0.01
_PEOPLE = 100_000


def planner_row(name: str, maps: int) -> dict[str, Any]:
    """A planner on random maps: how many it covers, and how long its paths are."""
    whole, ratios, begin = 0, [], time.process_time()
    for seed in range(maps):
        problem = random_map(seed)
        path = planner_named(name).plan(problem)
        visited = np.zeros(problem.free.shape, dtype=bool)
        visited[tuple(np.array(path).T)] = True
        whole += bool((visited == problem.reachable).all())
        ratios.append((len(path) - 1) / lower_bound(problem))
    mean = float(np.mean(ratios))
    return {
        "row": f"planner {name}",
        "maps": maps,
        "covered": whole,
        "length_over_bound": mean,
        "worst": max(ratios),
        "cpu_ms": 1e3 * (time.process_time() - begin) / maps,
        "passed": whole == maps and mean <= _LENGTH.get(name, math.inf),
    }


def shares_row(maps: int) -> dict[str, Any]:
    """Three kinds of robots on random shores: how far apart they are done."""
    begin = time.process_time()
    found = [balanced_shares(of_three_kinds(seed)).imbalance for seed in range(maps)]
    return {
        "row": "shares of three kinds",
        "maps": maps,
        "imbalance": float(np.mean(found)),
        "worst": max(found),
        "cpu_ms": 1e3 * (time.process_time() - begin) / maps,
        "passed": max(found) <= _IMBALANCE,
    }


def _bay() -> tuple[SearchArea, Array]:
    """Water with land in the north, and where somebody was seen last."""
    lattice = Lattice(120, 160, 2.0, (-160.0, -120.0))
    land = np.zeros(lattice.shape, dtype=bool)
    land[80:] = True
    area = SearchArea(lattice, land, np.zeros_like(land), land, ~land, np.where(land, 1.5, -8.0))
    x, y = lattice.middle(*np.indices(lattice.shape))
    prior: Array = np.exp(-((x + 60.0) ** 2 + (y + 60.0) ** 2) / (2.0 * 30.0**2)) * ~land
    return area, prior


def drift_row(kind: str) -> dict[str, Any]:
    """The belief against 10^5 random people after ten minutes, in cells of 10 m."""
    area, prior = _bay()
    lattice = area.lattice
    sea = Sea((0.1, 0.0), (4.4, -2.4), leeway_named(kind))
    belief, random = Belief(area, prior, sea), np.random.default_rng(2)
    cells = random.choice(prior.size, _PEOPLE, p=prior.ravel() / prior.sum())
    places = np.column_stack(lattice.middle(*np.divmod(cells, lattice.columns)))
    places = places + random.uniform(-1.0, 1.0, places.shape)
    leeways, flow = random_leeways(sea, _PEOPLE, random), Flow(area, sea)
    begin, used_s = time.process_time(), 0.0
    for time_s in range(10, 601, 10):
        begin = time.process_time()
        belief.drift(float(time_s))
        used_s += time.process_time() - begin
        places = flow.moved(places, leeways, 10.0)
    counts = np.zeros(lattice.shape)
    np.add.at(counts, lattice.cell(*places.T), 1.0 / _PEOPLE)
    people, grid = _coarse(counts), _coarse(belief.grid())
    there = people > 0.0
    divergence = float((people[there] * np.log(people[there] / grid[there].clip(1e-12))).sum())
    return {
        "row": f"drift of {kind}",
        "divergence": divergence,
        "sum_error": abs(float(belief.grid().sum()) - 1.0),
        "cpu_ms": 1e3 * used_s / 60,
        "passed": divergence <= _DIVERGENCE,
    }


def _coarse(grid: Array) -> Array:
    rows, columns = grid.shape
    return np.asarray(grid.reshape(rows // 5, 5, columns // 5, 5).sum(axis=(1, 3)))


def detection_row(trials: int) -> dict[str, Any]:
    """How often people are detected within some seconds in view, against the model."""
    worst = 0.0
    for detect in (0.5, 0.4, 0.25):
        missed_each = (1.0 - detect) ** 0.5
        first = np.array([_first_detection(detect, one, missed_each) for one in range(trials)])
        for seconds in (0.5, 1.0, 2.0, 4.0, 8.0):
            hits = float((first <= seconds).mean())
            worst = max(worst, abs(hits - (1.0 - (1.0 - detect) ** seconds)))
    return {
        "row": "detection curve",
        "trials": trials,
        "worst": worst,
        "passed": worst <= _CURVE,
    }


def _first_detection(detect: float, one: int, missed: float) -> float:
    for tick in range(1, 17):
        if chance(7, f"sensor {detect}", f"casualty_{one}", tick) >= missed:
            return 0.5 * tick
    return math.inf


def line(row: dict[str, Any]) -> str:
    """A row as one line."""
    parts = [
        f"{key} {value:.4g}" if isinstance(value, float) else f"{key} {value}"
        for key, value in row.items()
        if key not in ("row", "passed")
    ]
    return f"{row['row']}: {', '.join(parts)}" + ("" if row["passed"] else " (limit missed)")


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    maps = _MAPS // 20 if options.quick else _MAPS
    rows: list[Callable[[], dict[str, Any]]] = [
        *(lambda name=name: planner_row(name, maps) for name in PLANNERS),
        lambda: shares_row(maps),
        *(lambda kind=kind: drift_row(kind) for kind in LEEWAYS),
        lambda: detection_row(_TRIALS),
    ]
    document = new_document() | {"rows": []}
    keep_rows((make() for make in rows), line, options.out, document)
    return limits_code(document)
