# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The SLAM benchmark: public logs, our methods, and the figures of other systems next to them."""

from __future__ import annotations

import os
import statistics
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.options import DEFAULT_METHOD
from trident_eval.slam import evaluation
from trident_eval.slam.offline import LANDMARK_METHOD, Run, run_log

DATA = "TRIDENT_DATA"
#: What is measured in addition to the default method; ekf_slam by the landmarks of Victoria Park.
OTHER_METHODS = ("particle_slam_2d", "hector_slam_2d", "odometry", LANDMARK_METHOD)
#: Those that are measured once more without odometry (`--no-odometry`).
BY_SCANS_ALONE = (DEFAULT_METHOD, "hector_slam_2d")
_FOLDER = "radish"
_LANDMARK_LOG = Path("landmark") / "victoria_park.txt"
_ENDINGS = (".clf", ".log", ".clf.gz", ".log.gz", ".clf.bz2", ".log.bz2")


@dataclass(frozen=True)
class Known:
    """What another system reached, as it was measured or published.

    Attributes:
        log: name of the log.
        system: and which of its poses.
        translation: mean relation error [m].
        rotation: mean relation error [deg].
        cpu_s: None where it is not known.
        rss_mb: None where it is not known.
    """

    log: str
    system: str
    translation: float
    rotation: float
    cpu_s: float | None = None
    rss_mb: float | None = None


#: Measured: their libraries driven directly over the whole raw log, on two cores of a Xeon server;
#: published: Kuemmerle et al. 2009 and Hess et al. 2016, as quoted there.
KNOWN = (
    Known("intel", "slam_toolbox, final", 0.302, 0.90, 23.5, 69),
    Known("intel", "gmapping, 30 particles, final", 0.0252, 1.00, 66.8, 142),
    Known("intel", "hector with odometry, causal", 0.0391, 0.396, 0.57, 98),
    Known("intel", "published: graph mapping", 0.031, 1.3),
    Known("intel", "published: Cartographer", 0.0229, 0.453),
    Known("fr079", "slam_toolbox, final", 0.561, 3.62, 19.6, 67),
    Known("fr079", "gmapping, best of three, final", 1.1, 5.9, 84, 94),
    Known("fr079", "hector with odometry, causal", 0.0352, 0.422, 0.46, 95),
    Known("fr079", "published: graph mapping", 0.056, 0.6),
    Known("fr079", "published: Cartographer", 0.0452, 0.538),
)


#: Of the final map, without a truth: how thick and how blurred its walls are.
MAP_HEAD = ("walls [m]", "entropy [nat]")


@dataclass(frozen=True)
class Plan:
    """One row of the benchmark."""

    log: Path
    name: str
    relations: Path | None
    method: str
    runs: int
    has_odometry: bool = True

    @property
    def system(self) -> str:
        """The method, and what it had to do without."""
        return self.method if self.has_odometry else f"{self.method}, no odometry"


def data_folder() -> Path | None:
    """The folder of the public logs, if there is one."""
    root = os.environ.get(DATA)
    folder = Path(root) / _FOLDER if root else None
    return folder if folder is not None and folder.is_dir() else None


def logs_of(folder: Path) -> dict[str, Path]:
    """All CARMEN logs of a folder by their names without endings.

    Raises:
        EvalError: none was found.
    """
    logs = {}
    for path in sorted(folder.iterdir()):
        for ending in _ENDINGS:
            if path.name.endswith(ending):
                logs[path.name.removesuffix(ending)] = path
    if not logs:
        raise EvalError(f"{folder}: has no log; legal: files ending with {', '.join(_ENDINGS)}")
    return logs


def _plans_with_odometry(
    log: Path, name: str, relations: Path | None, counts: dict[str, int]
) -> list[Plan]:
    return [
        Plan(log, name, relations, method, count)
        for method, count in counts.items()
        if method != LANDMARK_METHOD
    ]


def _plans_by_scans_alone(folder: Path) -> list[Plan]:
    return [
        Plan(log, name, _relations_of(folder, name), method, 1, has_odometry=False)
        for name, log in logs_of(folder).items()
        for method in BY_SCANS_ALONE
    ]


def plan(folder: Path, methods: Sequence[str], runs: int, quick: bool) -> list[Plan]:
    """The rows.

    Args:
        folder: of the logs; `landmark/victoria_park.txt` is searched for next to it.
        methods: which; none: the default one, and unless `quick` the others, each once.
        runs: of the methods that were named, or of the default one.
        quick: only logs that have relations.
    """
    has_others = not methods and not quick
    counts = dict.fromkeys(methods or [DEFAULT_METHOD], runs)
    counts |= dict.fromkeys(OTHER_METHODS if has_others else (), 1)
    plans = []
    for name, log in logs_of(folder).items():
        known = _relations_of(folder, name)
        if known or not quick:
            plans += _plans_with_odometry(log, name, known, counts)
    if has_others:
        plans += _plans_by_scans_alone(folder)
    return plans + _plans_with_landmarks(folder, counts)


def _plans_with_landmarks(folder: Path, counts: dict[str, int]) -> list[Plan]:
    log = folder.parent / _LANDMARK_LOG
    if LANDMARK_METHOD not in counts or not log.is_file():
        return []
    name = log.name.removesuffix(".txt")
    return [Plan(log, name, None, LANDMARK_METHOD, counts[LANDMARK_METHOD])]


def _relations_of(folder: Path, name: str) -> Path | None:
    relations = folder / f"{name}.relations"
    return relations if relations.is_file() else None


def measure(
    one: Plan, config: Path | None, say: Callable[[str], None], pictures: Path | None = None
) -> dict[str, Any]:
    """All runs of a row: errors of its poses, what its map shows, medians of CPU time and memory.

    With `pictures`, its report goes into a folder of that one, named by log and method.
    """
    with tempfile.TemporaryDirectory(prefix="trident_bench_slam_") as folder:
        out = Path(folder)
        results = _run_all(one, config, out, say)
        row = _costs(one, results)
        if one.method == LANDMARK_METHOD:
            names = ("observations", "association_share", "true_landmarks", "landmarks")
            return row | {name: results[0][name] for name in names}
        paths = {"final": out / "trajectory.tum", "causal": out / "causal.tum"}
        found = evaluation.evaluate(evaluation.Task(paths, one.relations, map=out / "map.yaml"))
        if pictures is not None:
            folder_name = f"{one.name}_{one.system.replace(', no ', '_without_')}"
            evaluation.write(found, pictures / folder_name, f"{one.name}")
    return row | found.summary()


def _run_all(
    one: Plan, config: Path | None, out: Path, say: Callable[[str], None]
) -> list[dict[str, Any]]:
    """What all runs of a row have cost; the files are those of the last one."""
    results = []
    words = () if one.has_odometry else ("--no-odometry",)
    for number in range(1, one.runs + 1):
        timing = run_log(Run(one.log, one.method, out, config, words), show=False)
        results.append(timing)
        say(f"{one.name} {one.system} run {number}/{one.runs}: {timing['cpu_s']:.2f} CPU s")
    return results


def _costs(one: Plan, results: Sequence[dict[str, Any]]) -> dict[str, Any]:
    cpu_s = [result["cpu_s"] for result in results]
    return {
        "log": one.name,
        "method": one.method,
        "has_odometry": one.has_odometry,
        "system": one.system,
        "runs": one.runs,
        "scans": results[0]["scans"],
        "cpu_s": statistics.median(cpu_s),
        "cpu_s_range": [min(cpu_s), max(cpu_s)],
        "peak_rss_mb": statistics.median(result["peak_rss_mb"] for result in results),
    }


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Our rows and the known ones of the same logs as one Markdown table."""
    head = ("log", "system", "translation [m]", "rotation [deg]", *MAP_HEAD, "CPU s", "RSS MB")
    lines = [_line(head), _line(["---"] * len(head))]
    for log in dict.fromkeys(row["log"] for row in rows):
        for row in rows:
            if row["log"] == log:
                lines += [_line(cells) for cells in _our_cells(row)]
        lines += [_line(_known_cells(known)) for known in KNOWN if known.log == log]
    return "\n".join(lines)


def _our_cells(row: dict[str, Any]) -> list[list[str]]:
    cost = [f"{row['cpu_s']:.2f}", f"{row['peak_rss_mb']:.0f}"]
    system = f"**{row['system']}**"
    if row["method"] == LANDMARK_METHOD:
        share = f"{row['association_share']:.1%} of {row['observations']} associated as in the log"
        count = f"{row['landmarks']} landmarks, true {row['true_landmarks']}"
        return [[row["log"], system, share, count, "", "", *cost]]
    keys = ("wall_thickness_m", "mean_map_entropy_nat")
    walls = ["?" if row["map"][key] is None else f"{row['map'][key]:.3g}" for key in keys]
    if "translation_mean_m" not in row["final"]:
        return [[row["log"], system, "no truth", "", *walls, *cost]]
    cells = []
    for kind in ("final", "causal"):
        errors = row[kind]
        translation = f"{errors['translation_mean_m']:.4f} ± {errors['translation_std_m']:.4f}"
        rotation = f"{errors['rotation_mean_deg']:.3f} ± {errors['rotation_std_deg']:.3f}"
        shown = [*walls, *cost] if kind == "final" else [""] * 4
        cells.append([row["log"], f"**{row['system']}, {kind}**", translation, rotation, *shown])
    return cells


def _known_cells(known: Known) -> list[str]:
    cost = ["" if value is None else f"{value:g}" for value in (known.cpu_s, known.rss_mb)]
    return [known.log, known.system, f"{known.translation:g}", f"{known.rotation:g}", "", "", *cost]


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"
