# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of missions: a sweep over coasts, each mode on the same ones."""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from trident_eval.core.sweep.jobs import jobs_of
from trident_eval.core.sweep.rows import DONE, RunRow
from trident_eval.core.sweep.scenario import read_scenario
from trident_eval.core.sweep.statistics import Estimate, estimate
from trident_eval.mission.goals import GOALS
from trident_eval.sweep.code_version import code_version
from trident_eval.sweep.local_engine import LocalEngine
from trident_eval.sweep.sweeping import Sweep

from trident_benchmarks.mission.picture import draw_coverage
from trident_benchmarks.results import check_folder, limits_code, new_document, write_document

_WORKERS = 2
_SUBJECT = "trident_benchmarks.mission.subjects:fly"
_SINGLES = ("uav", "ugv", "usv")
_TRIOS = ("three_uavs", "three_ugvs", "three_usvs")
_METRICS = (
    ("coverage", "", "higher"),
    ("found", "", "higher"),
    ("confirmed", "", "higher"),
    ("served", "", "higher"),
    ("sectors", "", "higher"),
    ("value", "", "higher"),
    ("end_s", "s", "lower"),
    ("efficiency", "1/min", "higher"),
    ("complete", "", "higher"),
    ("contacts", "", "lower"),
    ("find_s", "s", "lower"),
    ("path_m", "m", "lower"),
    ("messages", "", "lower"),
    *((f"curve_{60 * step}", "", "higher") for step in range(1, 16)),
)
# Value per minute of the kinematic sketch; a mode below 90 % of it makes its row fail, as a gain
# over a weak rival counts nothing.
_SKETCH = {
    "uav": 1.7,
    "ugv": 1.9,
    "usv": 2.8,
    "three_uavs": 1.9,
    "three_ugvs": 3.3,
    "three_usvs": 3.0,
}
_SHARE_OF_SKETCH = 0.9
# What the joint mission over the network has to reach, at least.
_GOALS = {
    **GOALS,
    "coverage_low": 0.96,
    "efficiency_gain": 2.5,
    "efficiency_gain_low": 2.2,
    "efficiency_gain_trio": 1.3,
}
DEFINITIONS = """\
coverage: share of the cells of 2 m that were seen with a cumulative probability of detection of 0.9
value: 1 for each of 40 sectors with 95 % of its cells covered, 2 for each person confirmed, 4 for
  each served
efficiency: value per minute until all are served and 97 % is covered, or 900 s
efficiency_gain: efficiency over that of the best single robot on the same coast, less 1
efficiency_gain_trio: the same over the best three of a kind
_low: lower end of the 95 % interval of the mean (Student's t over coasts, paired)"""


class Case(NamedTuple):
    """A row: mode, method, links, and the day (fair, or what befalls whom)."""

    mode: str
    method: str = "improved"
    links: str = "network"
    day: str = "fair"


SHORT = tuple(Case(mode) for mode in (*_SINGLES, "joint"))
FULL = (
    *SHORT,
    *(Case(mode) for mode in _TRIOS),
    *(Case("joint", method) for method in ("plain", "fixed")),
    Case("joint", links="perfect"),
    *(Case("joint", day=f"kill {name}") for name in ("uav1", "ugv1", "usv1")),
    Case("joint", day="silent uav1"),
    Case("joint", day="dark"),
)


def scenario_text(case: Case, seeds: int) -> str:
    """The sweep of one case."""
    lines = [f"function: {_SUBJECT}", f"seeds: {seeds}", "parameters:"]
    lines += [f"  {name}: {value}" for name, value in case._asdict().items()]
    lines += ["limits: {time_s: 600}", "metrics:"]
    lines += [f"  {name}: {{unit: '{unit}', better: {better}}}" for name, unit, better in _METRICS]
    return "\n".join(lines) + "\n"


def fly_case(case: Case, seeds: int, folder: Path) -> list[RunRow]:
    """All coasts of one case.

    Raises:
        EvalError: the sweep cannot be run.
    """
    file = folder / "mission.yaml"
    file.write_text(scenario_text(case, seeds), encoding="utf-8")
    scenario = read_scenario(file)
    code = code_version(_SUBJECT)
    sweep = Sweep(scenario, jobs_of(scenario, code), folder, code)
    engine = LocalEngine(folder, _SUBJECT, _WORKERS)
    try:
        sweep.run(engine)
    finally:
        engine.close()
    return sweep.rows()


def by_seed(rows: Sequence[RunRow], metric: str) -> dict[int, float]:
    """A metric of the runs that have ended well."""
    return {row.seed: row.metrics[metric] for row in _done(rows)}


def _done(rows: Sequence[RunRow]) -> list[RunRow]:
    """The runs that have ended well."""
    return [row for row in rows if row.status == DONE]


def gains(own: dict[int, float], rivals: Sequence[dict[int, float]]) -> list[float]:
    """Of each coast, over the best rival there, less 1."""
    if not rivals:
        return []
    common = set(own).intersection(*rivals)
    best = {seed: max(rival[seed] for rival in rivals) for seed in common}
    return [own[seed] / best[seed] - 1.0 for seed in own if best.get(seed, 0.0) > 0.0]


def row_of(
    case: Case, rows: Sequence[RunRow], flown: dict[Case, Sequence[RunRow]]
) -> dict[str, Any]:
    """What a case has shown.

    Args:
        case: it.
        rows: its runs.
        flown: runs of the cases before it.
    """
    done = _done(rows)
    row: dict[str, Any] = case._asdict() | {"runs": len(rows), "failed": len(rows) - len(done)}
    if not done:
        return row | {"passed": False, "reason": rows[0].reason if rows else "no run"}
    row |= _means(rows)
    if case.mode == "joint":
        row |= _gains(rows, flown)
    row["cpu_s"] = estimate([one.cpu_s for one in done]).mean
    row["missed"] = _missed(case, row)
    return row | {"passed": not row["failed"] and not row["missed"]}


def _means(rows: Sequence[RunRow]) -> dict[str, Any]:
    """Of all metrics; of some also the lower ends of their intervals."""
    means: dict[str, Any] = {}
    for name, _, _ in _METRICS:
        found = estimate(list(by_seed(rows, name).values()))
        means[name] = found.mean
        if name in ("coverage", "efficiency", "found", "served"):
            means[f"{name}_low"] = _low(found)
    return means


def _gains(rows: Sequence[RunRow], flown: dict[Case, Sequence[RunRow]]) -> dict[str, Any]:
    """What several kinds of robots gain over one kind, where all modes of that were flown."""
    found: dict[str, Any] = {}
    for key, modes in (("efficiency_gain", _SINGLES), ("efficiency_gain_trio", _TRIOS)):
        gained = gains(by_seed(rows, "efficiency"), _rivals(modes, flown))
        if gained:
            gain = estimate(gained)
            found |= {key: gain.mean, f"{key}_low": _low(gain)}
    return found


def _rivals(modes: Sequence[str], flown: dict[Case, Sequence[RunRow]]) -> list[dict[int, float]]:
    """The efficiency of each mode by coast; empty unless all were flown."""
    cases = [Case(mode) for mode in modes]
    if not all(case in flown for case in cases):
        return []
    return [by_seed(flown[case], "efficiency") for case in cases]


def _low(found: Estimate) -> float:
    return found.t_low if found.count > 1 else found.mean


def _missed(case: Case, row: dict[str, Any]) -> list[str]:
    """Which limits a row does not keep, with their values."""
    least = _limits_of(case, row)
    missed = [f"{key} at least {least[key]:g}" for key in least if not row[key] >= least[key]]
    if case == Case("joint") and row["contacts"] > 0.0:
        missed.append("contacts 0")
    return missed


def _limits_of(case: Case, row: dict[str, Any]) -> dict[str, float]:
    """What the figures of a row are at least."""
    least: dict[str, float] = {}
    if case.mode in _SKETCH:
        least["efficiency"] = _SHARE_OF_SKETCH * _SKETCH[case.mode]
    if case == Case("joint"):
        least |= {key: goal for key, goal in _GOALS.items() if key in row}
    return least


def line(row: dict[str, Any]) -> str:
    """A row as one line."""
    name = " ".join(row[key] for key in Case._fields)
    if "coverage" not in row:
        return f"{name}: {row['reason']}"
    text = (
        f"{name}: coverage {100 * row['coverage']:.1f} % (from {100 * row['coverage_low']:.1f}), "
        f"found {100 * row['found']:.1f} %, served {100 * row['served']:.1f} %, "
        f"value {row['value']:.1f} in {row['end_s']:.0f} s, {row['efficiency']:.2f} a minute"
    )
    text += f"{_gains_text(row)}; {row['cpu_s']:.1f} CPU s a run"
    missed = row["missed"] or ([] if row["passed"] else ["no failed run"])
    return text + (f" (missed: {', '.join(missed)})" if missed else "")


def _gains_text(row: dict[str, Any]) -> str:
    rivals = (("efficiency_gain", "best single"), ("efficiency_gain_trio", "best trio"))
    return "".join(
        f", {100 * row[key]:+.0f} % (from {100 * row[f'{key}_low']:+.0f}) over the {rival}"
        for key, rival in rivals
        if key in row
    )


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    check_folder(options.picture)
    print(DEFINITIONS, flush=True)
    document = new_document() | {"definitions": DEFINITIONS.splitlines(), "rows": []}
    flown: dict[Case, Sequence[RunRow]] = {}
    for case in FULL if options.full else SHORT:
        with tempfile.TemporaryDirectory() as folder:
            flown[case] = fly_case(case, options.seeds, Path(folder))
        row = row_of(case, flown[case], flown)
        print(line(row), flush=True)
        document["rows"].append(row)
        write_document(options.out, document)
    if options.picture:
        curves = {case.mode: flown[case] for case in flown if case == Case(case.mode)}
        draw_coverage(options.picture, curves)
    return limits_code(document)
