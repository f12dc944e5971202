# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs that were driven through a PLC: rows show what the verdict judged."""

from __future__ import annotations

from typing import Any

import numpy as np
from trident_eval.core.bridges.plc import PlcLog, Series, judge_plc, plc_rows
from trident_eval.core.tracks import tracks_of

TIMES = [float(second) for second in range(11)]
TRACKS = tracks_of(TIMES, ["otter"] * len(TIMES), [[time, 0.0, 0.0] for time in TIMES])


def said(*rows: tuple[float, float]) -> Series:
    """Values of a topic, each with its time."""
    return Series(*np.array(rows).T)


def record(**changed: Series) -> PlcLog:
    """Both propellers are commanded once, stop in silence, and their thrust is read back."""
    series: dict[str, Series] = {"vessel_lights": said((1, 1)), "client_lights": said((1, 1))}
    for side in ("left", "right"):
        series |= {
            f"pilot_{side}_command": said((1, 60), (2, 60)),
            f"vessel_{side}_command": said((1.1, 60), (3, 0)),
            f"vessel_{side}_thrust": said((1.5, 7)),
            f"client_{side}_thrust": said((1.6, 7)),
        }
    series |= changed
    keys = {name: tuple(name.split("_", 1)) for name in series}
    by_end: dict[Any, Series] = {keys[name]: one for name, one in series.items()}
    return PlcLog("otter", 1.0, (-100.0, 100.0), by_end)


def judged(log: PlcLog) -> tuple[list[str], list[bool | None]]:
    """Reasons against it, and whether each row is as it must be."""
    verdict = judge_plc(TRACKS, log, {})
    return verdict.reasons, [row.is_satisfied for row in plc_rows(verdict.to_json())]


def test_a_run_in_which_all_arrived_passes() -> None:
    assert judged(record()) == ([], [True, True, True])


def test_each_reason_is_one_of_the_rows() -> None:
    late = record(vessel_left_command=said((1.8, 60), (3, 0)))
    assert judged(late) == (["PLC: a command took 0.800 s, limit 0.5 s"], [False, True, True])
    turning = record(vessel_left_command=said((1.1, 60)))
    assert judged(turning) == (
        ["PLC: 1 of 2 silences stopped a propeller"],
        [True, False, True],
    )
    fast = record(vessel_left_command=said((1.1, 60), (1.2, 200), (3, 0)))
    assert judged(fast) == (
        ["PLC: 1 commands beyond the limits arrived"],
        [True, True, False],
    )
