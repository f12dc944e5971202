# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""amcl: CPU time of an update, and whether a robot that was carried off finds itself again."""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

from trident_benchmarks.amcl import kidnap
from trident_benchmarks.results import (
    MEASURED,
    check_folder,
    new_document,
    say,
    write_document,
)
from trident_benchmarks.sim.rows import caption

#: navigation's amcl, noetic, on a machine of two cores [ms].
NAVIGATION_MS = {"likelihood_field_ms": "5.8 - 7.0", "beam_ms": "32 - 36"} | {
    "likelihood_field_5000_ms": "22 - 27"
}
_TITLES = {
    "likelihood_field_ms": "update, likelihood_field, 2000 particles",
    "likelihood_field_prob_ms": "update, likelihood_field_prob, 2000 particles",
    "beam_ms": "update, beam, 2000 particles",
    "likelihood_field_5000_ms": "update, likelihood_field, 5000 particles",
    "match_whole_map_ms": "search of a scan in 40 m x 40 m",
}
_TIMES = 10  # that the robot is carried off on one drive


def measure_updates(quick: bool) -> dict[str, float]:
    """Medians of CPU times over ten blocks of updates [ms].

    Raises:
        EvalError: the program fails.
    """
    command = [program("trident_estimation", "amcl_benchmark"), "20" if quick else "200"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise EvalError(f"amcl_benchmark: {done.stderr.strip()}")
    return dict(json.loads(done.stdout))


def measure_kidnaps(quick: bool, say: Callable[[str], None]) -> list[kidnap.Trial]:
    """A hundred trials on ten drives; quick: four on two.

    Raises:
        EvalError: a drive fails.
    """
    trials: list[kidnap.Trial] = []
    drives, times = (2, 2) if quick else (10, _TIMES)
    with tempfile.TemporaryDirectory() as folder:
        office = kidnap.Office(Path(folder))
        for seed in range(drives):
            trials += kidnap.run(office, seed, times)
            found = sum(trial.is_recovered for trial in trials)
            say(f"[{seed + 1}/{drives}] kidnapped robot: {found} of {len(trials)} recovered")
    return trials


def summarize(trials: Sequence[kidnap.Trial]) -> dict[str, Any]:
    """How many, and how soon."""
    recovered = [trial for trial in trials if trial.is_recovered]
    times = [trial.recovered_s for trial in recovered]
    return {
        "trials": len(trials),
        "recovered": len(recovered),
        "recovered_share": len(recovered) / len(trials),
        "recovered_s_median": _median(times),
        "recovered_s_max": max(times, default=None),
        "error_m_median": _median([trial.error_m for trial in recovered]),
        "lost": [f"seed {t.seed} at {t.carried_s:g} s" for t in trials if not t.is_recovered],
    }


def _median(values: Sequence[float]) -> float | None:
    return float(np.median(values)) if values else None


def markdown_table(updates: dict[str, float], kidnaps: dict[str, Any]) -> str:
    """Both measurements, with navigation's figures next to ours."""
    lines = ["| CPU time, 60 beams | ms | navigation's amcl |", "| --- | ---: | ---: |"]
    for key, title in _TITLES.items():
        lines.append(f"| {title} | {updates[key]:.2f} | {NAVIGATION_MS.get(key, '')} |")
    lines += [
        "",
        f"Kidnapped robot, {kidnap.WORLD} world, RPLidar A1, encoder odometry with drift: "
        f"{kidnaps['recovered']} of {kidnaps['trials']} recovered within {kidnap.LIMIT_S:g} s "
        f"(0.3 m and 10 degrees held for {kidnap.HELD_S:g} s)",
    ]
    if kidnaps["recovered"]:
        lines.append(
            f"in {kidnaps['recovered_s_median']:.1f} s at the median and "
            f"{kidnaps['recovered_s_max']:.1f} s at most, those {kidnap.HELD_S:g} s included; "
            f"median error {100 * kidnaps['error_m_median']:.1f} cm."
        )
    if kidnaps["lost"]:
        lines.append("Not: " + ", ".join(kidnaps["lost"]) + ".")
    return "\n".join(lines)


def measure(options: argparse.Namespace) -> int:
    """Measures, writes and prints; the exit code."""
    check_folder(options.out)
    document = new_document() | {"updates": measure_updates(options.quick)}
    kidnaps = summarize(measure_kidnaps(options.quick, say))
    write_document(options.out, document | {"kidnaps": kidnaps})
    print(markdown_table(document["updates"], kidnaps))
    print(f"\n{caption(document)}")
    return MEASURED
