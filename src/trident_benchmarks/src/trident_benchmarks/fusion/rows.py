# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of fusion: what runs of the filter have printed, judged by limits."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

DOFS = 48  # of three robots
GAIN_LIMIT = 0.40  # of the error, below that of the best single source
OUTLIERS_LIMIT = 0.10  # of the error, above that without outliers
DELAY_LIMIT = 1e-6  # of any number of state or covariance
OUTAGE_LIMIT_M = 0.5
CPU_LIMIT = 0.01  # per simulated second
_TWO_SIDED_95 = 1.96

Run = dict[str, Any]
Row = dict[str, Any]


def _chosen(runs: Sequence[Run], **wanted: str) -> list[Run]:
    return [run for run in runs if all(run.get(key) == value for key, value in wanted.items())]


def rms(runs: Sequence[Run]) -> list[float]:
    """Of each robot's position over all runs [m]."""
    return [
        math.sqrt(sum(run["rms_m"][robot] ** 2 for run in runs) / len(runs)) for robot in range(3)
    ]


def _whole(errors: Sequence[float]) -> float:
    return math.sqrt(sum(error**2 for error in errors) / len(errors))


def _band(dofs: float, samples: float) -> tuple[float, float]:
    """Of 95 %, of the mean of `samples` chi-squared numbers; normal approximation."""
    half = _TWO_SIDED_95 * math.sqrt(2.0 * dofs / samples)
    return dofs - half, dofs + half


def _inside(value: float, band: tuple[float, float]) -> bool:
    return band[0] <= value <= band[1]


def consistency_rows(runs: Sequence[Run]) -> list[Row]:
    """NEES and NIS of both filters, and the error next to that of each source alone."""
    rows: list[Row] = []
    for kind in ("ekf", "ukf"):
        own = _chosen(runs, kind=kind, what="all")
        nees = sum(run["nees_end"] for run in own) / len(own)
        size = sum(run["nis_size"] for run in own)
        nis = sum(run["nis"] for run in own) / size
        nees_band, nis_band = _band(DOFS, len(own)), _band(1.0, size)
        rows.append(
            {
                "suite": "consistency",
                "kind": kind,
                "seeds": len(own),
                "nees": nees,
                "nees_band": nees_band,
                "nis": nis,
                "nis_band": nis_band,
                "rms_m": rms(own),
                "passed": _inside(nees, nees_band) and _inside(nis, nis_band),
            }
        )
    rows.append(_gain_row(runs))
    return rows


def _gain_row(runs: Sequence[Run]) -> Row:
    """The error of all sources next to that of the better single one of each robot."""
    fused = rms(_chosen(runs, kind="ekf", what="all"))
    alone = {what: rms(_chosen(runs, what=what)) for what in ("/pose", "/gnss")}
    best = [min(errors[robot] for errors in alone.values()) for robot in range(3)]
    gain = 1.0 - _whole(fused) / _whole(best)
    return {
        "suite": "gain",
        "rms_m": fused,
        "best_single_m": best,
        "gain": gain,
        "limit": GAIN_LIMIT,
        "passed": gain >= GAIN_LIMIT,
    }


def outliers_row(runs: Sequence[Run]) -> Row:
    """The error with a fifth of all measurements 5 m off, next to that without."""
    without = _whole(rms(_chosen(runs, what="without")))
    with_them = _whole(rms(_chosen(runs, what="with")))
    worse = with_them / without - 1.0
    return {
        "suite": "outliers",
        "seeds": len(runs) // 2,
        "without_m": without,
        "with_m": with_them,
        "worse": worse,
        "accused": sum(run["accused"] for run in runs),
        "limit": OUTLIERS_LIMIT,
        "passed": worse <= OUTLIERS_LIMIT,
    }


def outage_row(runs: Sequence[Run]) -> Row:
    """The UGV's error in a minute without GNSS, seen by the UAV and not."""
    seen, unseen = (rms(_chosen(runs, what=what))[1] for what in ("seen", "unseen"))
    return {
        "suite": "outage",
        "seeds": len(runs) // 2,
        "seen_m": seen,
        "worst_seed_m": max(run["rms_m"][1] for run in _chosen(runs, what="seen")),
        "unseen_m": unseen,
        "limit": OUTAGE_LIMIT_M,
        "passed": seen <= OUTAGE_LIMIT_M,
    }


def delays_row(runs: Sequence[Run]) -> Row:
    """How much a delay of up to 1 s, which shuffles all, changes what is believed at the end."""
    worst = max(run["difference"] for run in runs)
    refused = sum(run["refused"] for run in runs)
    return {
        "suite": "delays",
        "runs": len(runs),
        "difference": worst,
        "refused": refused,
        "limit": DELAY_LIMIT,
        "passed": worst <= DELAY_LIMIT and refused == 0,
    }


def sharing_row(runs: Sequence[Run]) -> Row:
    """NEES where two stations send each other what each has made of the same measurements."""
    own, naive = (_chosen(runs, what=what) for what in ("intersection", "naive"))
    band = _band(DOFS, len(own))
    nees = sum(run["nees_end"] for run in own) / len(own)
    naive_nees = sum(run["nees_end"] for run in naive) / len(naive)
    return {
        "suite": "sharing",
        "seeds": len(own),
        "nees": nees,
        "nees_band": band,
        "naive_nees": naive_nees,
        "passed": _inside(nees, band) and naive_nees > band[1],
    }


def lies_row(runs: Sequence[Run]) -> Row:
    """Whether the one source whose covariances are too small is named, and no other."""
    named = sum(run["what"] == "uav/gnss" for run in runs)
    nees = sum(run["nees_end"] for run in runs) / len(runs)
    return {
        "suite": "lies",
        "seeds": len(runs),
        "named": named,
        "nees": nees,
        "passed": named == len(runs),
    }


def speed_rows(runs: Sequence[Run]) -> list[Row]:
    """CPU time of ten sources that measure 30 times a second."""
    return [
        {
            "suite": "speed",
            "kind": run["kind"],
            "cpu_s_per_s": run["cpu_s_per_s"],
            "limit": CPU_LIMIT,
            "passed": run["cpu_s_per_s"] <= CPU_LIMIT,
        }
        for run in runs
    ]


def _meters(values: Sequence[float]) -> str:
    return ", ".join(f"{value:.3f}" for value in values)


_LINES: dict[str, Callable[[Row], str]] = {
    "consistency": lambda row: (
        f"{row['kind']}, {row['seeds']} seeds: NEES {row['nees']:.2f} (band"
        f" {row['nees_band'][0]:.2f} - {row['nees_band'][1]:.2f}), NIS {row['nis']:.4f} (band"
        f" {row['nis_band'][0]:.4f} - {row['nis_band'][1]:.4f}), RMS {_meters(row['rms_m'])} m"
    ),
    "gain": lambda row: (
        f"RMS of uav, ugv, usv {_meters(row['rms_m'])} m, by the best single source"
        f" {_meters(row['best_single_m'])} m: {100.0 * row['gain']:.1f} % less (limit"
        f" {100.0 * row['limit']:g} %)"
    ),
    "outliers": lambda row: (
        f"a fifth 5 m off, {row['seeds']} seeds: RMS {row['with_m']:.3f} m, without"
        f" {row['without_m']:.3f} m: {100.0 * row['worse']:+.1f} % (limit"
        f" {100.0 * row['limit']:g} %), {row['accused']} sources wrongly named"
    ),
    "outage": lambda row: (
        f"UGV without GNSS for 60 s, {row['seeds']} seeds: RMS {row['seen_m']:.3f} m seen by the"
        f" UAV (limit {row['limit']:g} m; worst seed {row['worst_seed_m']:.3f}),"
        f" {row['unseen_m']:.3f} m unseen"
    ),
    "delays": lambda row: (
        f"up to 1 s late, {row['runs']} runs: differs by {row['difference']:.1e} (limit"
        f" {row['limit']:g}), {row['refused']} refused"
    ),
    "sharing": lambda row: (
        f"double counting, {row['seeds']} seeds: NEES {row['nees']:.2f} by intersection (band"
        f" {row['nees_band'][0]:.2f} - {row['nees_band'][1]:.2f}), {row['naive_nees']:.3g} without"
    ),
    "lies": lambda row: (
        f"a fifth of the true deviation claimed: named alone in {row['named']} of {row['seeds']}"
        f" runs, NEES {row['nees']:.2f}"
    ),
    "speed": lambda row: (
        f"three robots, 10 sources at 30 Hz, {row['kind']}: {row['cpu_s_per_s']:.4f} CPU s per s"
        f" (limit {row['limit']:g})"
    ),
}


def line(row: Row) -> str:
    """A row as one line."""
    return _LINES[row["suite"]](row) + ("" if row["passed"] else " (limit missed)")
