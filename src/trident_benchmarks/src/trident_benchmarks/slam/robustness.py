# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How much worse maps become when odometry errs or the scans are worse: changed public logs."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from trident_eval.core.errors import EvalError
from trident_eval.options import DEFAULT_METHOD
from trident_eval.slam.offline import Run, run_log
from trident_eval.slam.relations import Relations, nearest, read_relations, relation_errors
from trident_eval.slam.trajectory import Trajectory, read_tum

from trident_benchmarks.slam.changed_log import Change, as_true_base, write_changed
from trident_benchmarks.slam.public_logs import logs_of

PLAIN = "plain"
#: Relations count whose stamps the changed log has itself: the nearest scan is elsewhere [s].
_SAME_STAMP_S = 1e-3
#: Of the mean translation error, as a multiple of the plain log's over the same relations.
MAX_BY_ODOMETRY = 1.3
MAX_BY_SCANS = 1.5
MAX_CAUSAL_BY_SCANS = 3.0

_LASER = (0.10, 0.05, 0.05)
_MIRRORED = (-0.10, -0.05, -0.05)


def _signed(scale: int, turn: int, drift: int, laser: tuple[float, float, float]) -> Change:
    return Change(1.0 + 0.05 * scale, 1.0 + 0.05 * turn, 0.03 * drift, laser)


def _odometry_changes() -> dict[str, Change]:
    none = (0.0, 0.0, 0.0)
    signs = {1: "+", -1: "-", 0: ""}

    def name(scale: int, turn: int, drift: int) -> str:
        parts = zip(("distance", "turn", "drift"), (scale, turn, drift), strict=True)
        return " ".join(part + signs[sign] for part, sign in parts if sign)

    chosen = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    chosen += list(product((1, -1), (1, -1), (1, -1)))
    changes = {name(*one): _signed(*one, none) for one in chosen}
    changes |= {"laser x": _signed(0, 0, 0, (0.10, 0.0, 0.0))}
    changes |= {"laser y": _signed(0, 0, 0, (0.0, 0.05, 0.0))}
    changes |= {"laser yaw": _signed(0, 0, 0, (0.0, 0.0, 0.05))}
    changes |= {"distance+ turn+ drift+ laser": _signed(1, 1, 1, _LASER)}
    changes |= {"distance- turn- drift- laser": _signed(-1, -1, -1, _MIRRORED)}
    return changes | {"distance+ turn- drift+ laser": _signed(1, -1, 1, _LASER)}


#: 5 % of distance and turn, 0.03 rad/m, a laser 10 cm, 5 cm and 0.05 rad off its nominal mount.
ODOMETRY_CHANGES = _odometry_changes()
SCAN_CHANGES = {
    "half of the beams": Change(every_beam=2),
    "5.6 m of range": Change(farthest=5.6),
    "3 cm of noise": Change(noise=0.03),
    "half of the scans": Change(every_scan=2),
}
#: Of --quick: all errors at once, and the worse scans.
QUICK = (PLAIN, "distance+ turn+ drift+", "distance- turn- drift- laser", *SCAN_CHANGES)


def measure(
    folder: Path, is_quick: bool, config: Path | None, say: Callable[[str], None]
) -> list[dict[str, Any]]:
    """A row for each log with relations and each change.

    Raises:
        EvalError: no log has relations, or one cannot be read or run.
    """
    changes = {PLAIN: Change()} | ODOMETRY_CHANGES | SCAN_CHANGES
    names = QUICK if is_quick else tuple(changes)
    rows = []
    for log_name, log in logs_of(folder).items():
        file = folder / f"{log_name}.relations"
        if not file.is_file():
            continue
        relations = read_relations(file)
        plain: dict[str, Trajectory] = {}
        for name in names:
            found, cost = _run(log, changes[name], config)
            if name == PLAIN:
                plain = found
            row = {"log": log_name, "change": name, "cpu_s": cost}
            rows.append(row | _errors(found, plain, relations))
            say(_line(_cells(rows[-1])))
    if not rows:
        raise EvalError(
            f"{folder}: no log has relations; legal: NAME.relations next to NAME.clf.bz2"
        )
    return rows


def _run(log: Path, change: Change, config: Path | None) -> tuple[dict[str, Trajectory], float]:
    with tempfile.TemporaryDirectory(prefix="trident_robustness_") as folder:
        changed, out = Path(folder) / "changed.clf", Path(folder) / "out"
        T_nominal_true = write_changed(log, change, changed)
        timing = run_log(Run(changed, DEFAULT_METHOD, out, config), show=False)
        files = {"final": "trajectory.tum", "causal": "causal.tum"}
        found = {
            kind: as_true_base(read_tum(out / file), T_nominal_true) for kind, file in files.items()
        }
    return found, float(timing["cpu_s"])


def _errors(
    found: dict[str, Trajectory], plain: dict[str, Trajectory], relations: Relations
) -> dict[str, Any]:
    """Errors over the relations whose stamps the changed log has, and the plain log's over them."""
    stamps = found["final"].stamp
    gaps = [nearest(stamps, wanted)[1] for wanted in (relations.begin, relations.to)]
    kept = np.maximum(*gaps) <= _SAME_STAMP_S
    if not kept.any():
        raise EvalError("the changed log has no stamp of any relation")
    same = Relations(
        relations.begin[kept], relations.to[kept], relations.p[kept], relations.R[kept]
    )
    row: dict[str, Any] = {"relations": int(kept.sum())}
    for kind in ("final", "causal"):
        errors = relation_errors(found[kind], same)
        plain_mean = relation_errors(plain[kind], same).translation_m.mean()
        row[kind] = errors.summary() | {"of_plain": float(errors.translation_m.mean() / plain_mean)}
    return row


def reasons(rows: Sequence[dict[str, Any]]) -> list[str]:
    """A sentence for each limit that is missed."""
    missed = []
    for row in rows:
        limits = {"final": MAX_BY_ODOMETRY}
        if row["change"] in SCAN_CHANGES:
            limits = {"final": MAX_BY_SCANS, "causal": MAX_CAUSAL_BY_SCANS}
        missed += [
            f"{row['log']}, {row['change']}: {kind} {row[kind]['translation_mean_m']:.4f} m is"
            f" {row[kind]['of_plain']:.2f} times the plain one, limit {most}"
            for kind, most in limits.items()
            if row[kind]["of_plain"] > most
        ]
    return missed


def table(rows: Sequence[dict[str, Any]]) -> str:
    """The rows in Markdown."""
    head = ["log", "change", "final [m]", "[deg]", "worst [m]", "x plain"]
    head += ["causal [m]", "[deg]", "x plain", "CPU s"]
    return "\n".join([_line(head), _line(["---"] * len(head)), *(_line(_cells(r)) for r in rows)])


def _cells(row: dict[str, Any]) -> list[str]:
    final, causal = row["final"], row["causal"]
    return [
        row["log"],
        row["change"],
        f"{final['translation_mean_m']:.4f}",
        f"{final['rotation_mean_deg']:.3f}",
        f"{final['translation_max_m']:.2f}",
        f"{final['of_plain']:.2f}",
        f"{causal['translation_mean_m']:.4f}",
        f"{causal['rotation_mean_deg']:.3f}",
        f"{causal['of_plain']:.2f}",
        f"{row['cpu_s']:.2f}",
    ]


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"
