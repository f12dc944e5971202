# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pose graphs of the literature: chi2 and CPU time next to those of GTSAM, measured by turns.

Every run is a process of its own on one core; the time is that of initialisation and optimiser,
from the file's own start. GTSAM is optional: without it its columns stay empty. It comes by
``.venv/bin/pip install -r tools/requirements-bench.txt``.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.pose_graph.program import optimize

from trident_benchmarks.posegraph import gtsam_timing

#: Least chi2 that anybody is known to have reached, as the sum of e' Omega e.
BEST_KNOWN = {
    "intel": 45.004,
    "M3500": 137.91,
    "sphere2500": 1351.4,
    "parking-garage": 1.26838,
    "torus3D": 24235.0,
}
TOLERANCE = 1e-3  #: relative, of chi2
GTSAM_METHODS = ("gn", "lm", "chordal")
#: Vertex by vertex, as a robot adds them; of these at most this part of iSAM2's time.
INCREMENTAL = "isam2"
MAX_RATIO_TO_ISAM2 = 0.5
GROWING = ("intel", "M3500", "sphere2500")
_LIMIT_S = 600.0


def one_core() -> list[str]:
    """What makes a command run on one core only."""
    return ["taskset", "-c", str(min(os.sched_getaffinity(0)))]


def gtsam_python(given: Path | None) -> str | None:
    """A Python that imports GTSAM: the one given, this one, or that of the clone's .venv."""
    clone = Path(__file__).resolve().parents[5]
    known = [str(given)] if given else [sys.executable, str(clone / ".venv/bin/python")]
    for python in known:
        try:
            done = subprocess.run([python, "-c", "import gtsam"], capture_output=True, check=False)
        except OSError:
            continue
        if done.returncode == 0:
            return python
    if given:
        raise EvalError(f"--gtsam-python {given}: it cannot import gtsam")
    return None


def run_gtsam(python: str, file: Path, method: str) -> dict[str, Any]:
    """One run of GTSAM; ``error`` instead of figures when it fails."""
    command = [*one_core(), python, gtsam_timing.__file__, str(file), method]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=_LIMIT_S
        )
    except subprocess.TimeoutExpired:
        return {"error": f"takes more than {_LIMIT_S:.0f} s"}
    if done.returncode != 0:
        return {"error": (done.stderr.strip().splitlines() or ["failed"])[-1]}
    result: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return result


def _by_turns(
    contestants: dict[str, Callable[[], dict[str, Any]]], runs: int
) -> dict[str, list[dict[str, Any]]]:
    """Results of each contestant; one that has failed is not called again."""
    results: dict[str, list[dict[str, Any]]] = {name: [] for name in contestants}
    for _ in range(runs):
        for name, run in contestants.items():
            if not _has_failed(results[name]):
                results[name].append(run())
    return results


def _has_failed(results: Iterable[dict[str, Any]]) -> bool:
    return any("error" in result for result in results)


def measure_file(file: Path, runs: int, python: str | None) -> dict[str, Any]:
    """The row of one file: all contestants by turns, medians of their times.

    Raises:
        EvalError: our own program refuses the file.
    """
    contestants: dict[str, Callable[[], dict[str, Any]]] = {
        "ours": lambda: optimize(file, [], one_core())
    }
    for method in GTSAM_METHODS if python else ():
        contestants[method] = partial(run_gtsam, str(python), file, method)
    results = _by_turns(contestants, runs)
    name = file.name.removesuffix(".gz").removesuffix(".g2o")
    ours = results.pop("ours")
    row: dict[str, Any] = {
        "name": name,
        "vertices": ours[0]["vertices"],
        "edges": ours[0]["edges"],
        "best_known": BEST_KNOWN.get(name),
        "ours": summary(ours),
        "gtsam": {method: summary(found) for method, found in results.items()},
    }
    return row | judgement(row)


def measure_growing(file: Path, runs: int, python: str | None) -> dict[str, Any]:
    """The row of one file whose vertices are added one after the other.

    Raises:
        EvalError: our own program refuses the file.
    """
    ours: list[dict[str, Any]] = []
    theirs: list[dict[str, Any]] = []
    for _ in range(runs):
        ours.append(optimize(file, ["--incremental"], one_core()))
        if python and not _has_failed(theirs):
            theirs.append(run_gtsam(python, file, INCREMENTAL))
    row: dict[str, Any] = {
        "name": file.name.removesuffix(".gz").removesuffix(".g2o"),
        "ours": summary(ours),
        INCREMENTAL: summary(theirs) if theirs else None,
    }
    return row | _growing_judgement(row)


def _growing_judgement(row: dict[str, Any]) -> dict[str, Any]:
    """Our share of the other's time, and whether that and chi2 are good."""
    other = row[INCREMENTAL]
    if other is None or "error" in other:
        return {"share": None, "is_good": True}
    share = row["ours"]["cpu_s"] / other["cpu_s"]
    is_equal = row["ours"]["chi2"] <= other["chi2"] * (1.0 + TOLERANCE)
    return {"share": share, "is_good": is_equal and share <= MAX_RATIO_TO_ISAM2}


def growing_table(rows: list[dict[str, Any]]) -> str:
    """The rows of graphs that grow in Markdown."""
    lines = [
        "| graph, a vertex at a time | chi2 | CPU s | optimisations | iSAM2: chi2, CPU s"
        " | ours / iSAM2 |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        ours, share = row["ours"], row["share"]
        cells = [row["name"], f"{ours['chi2']:.7g}", f"{ours['cpu_s']:.3f}"]
        cells += [str(ours["iterations"]), _gtsam_cell(row[INCREMENTAL])]
        cells += [
            "" if share is None else f"{share:.2f}" + ("" if row["is_good"] else " **missed**")
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def summary(results: list[dict[str, Any]]) -> dict[str, Any]:
    """chi2, iterations and the median CPU time of equal runs."""
    for result in results:
        if "error" in result:
            return {"error": result["error"]}
    return {
        "chi2": results[-1]["chi2_after"],
        "iterations": results[-1]["iterations"],
        "cpu_s": statistics.median(result["cpu_s"] for result in results),
        "all_cpu_s": [result["cpu_s"] for result in results],
    }


def judgement(row: dict[str, Any]) -> dict[str, Any]:
    """Whether chi2 is the best known one, and which right row of GTSAM is the fastest."""
    reached = [entry for entry in row["gtsam"].values() if "error" not in entry]
    best = min(
        [row["ours"]["chi2"], *(entry["chi2"] for entry in reached)]
        + ([row["best_known"]] if row["best_known"] else [])
    )

    def is_right(entry: dict[str, Any]) -> bool:
        return "error" not in entry and bool(entry["chi2"] <= best * (1.0 + TOLERANCE))

    right = {method: entry["cpu_s"] for method, entry in row["gtsam"].items() if is_right(entry)}
    fastest = min(right, key=lambda method: right[method], default=None)
    return {
        "is_chi2_best": is_right(row["ours"]),
        "gtsam_best": fastest,
        "speed_up": right[fastest] / row["ours"]["cpu_s"] if fastest else None,
    }


def table(rows: list[dict[str, Any]]) -> str:
    """The rows in Markdown."""
    lines = [
        "| graph (vertices/edges) | best known chi2 | chi2 | CPU s | "
        + " | ".join(f"GTSAM {method}: chi2, CPU s" for method in GTSAM_METHODS)
        + " | GTSAM's best / ours |",
        "|---|---|---|---|" + "---|" * len(GTSAM_METHODS) + "---|",
    ]
    for row in rows:
        known = f"{row['best_known']:.6g}" if row["best_known"] else ""
        mark = "" if row["is_chi2_best"] else " **not best**"
        cells = [
            f"{row['name']} ({row['vertices']}/{row['edges']})",
            known,
            f"{row['ours']['chi2']:.7g}{mark}",
            f"{row['ours']['cpu_s']:.4f}",
            *(_gtsam_cell(row["gtsam"].get(method)) for method in GTSAM_METHODS),
            f"{row['speed_up']:.1f}" if row["speed_up"] else "",
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _gtsam_cell(entry: dict[str, Any] | None) -> str:
    if entry is None:
        return "not installed"
    if "error" in entry:
        return "fails"
    return f"{entry['chi2']:.6g}, {entry['cpu_s']:.3f}"


def chosen_files(given: list[Path]) -> list[Path]:
    """The files to be measured.

    Raises:
        EvalError: the folder has none.
    """
    return given or _known_files()


def _known_files() -> list[Path]:
    """Those of the folder of data."""
    data = os.environ.get("TRIDENT_DATA")
    if not data:
        raise EvalError("bench posegraph: name g2o files, or the folder of data in TRIDENT_DATA")
    folder = Path(data) / "pose_graph"
    files = [folder / f"{name}.g2o.gz" for name in BEST_KNOWN]
    if missing := [file for file in files if not file.is_file()]:
        raise EvalError(f"bench posegraph: {missing[0]} does not exist")
    return files


def measure(options: argparse.Namespace) -> int:
    """Measures and prints.

    Returns:
        0: every chi2 is the best, no time above GTSAM's best, and none of a graph that grows above
        half of iSAM2's; 1: not.
    """
    files = chosen_files(options.files)
    python = gtsam_python(options.gtsam_python)
    if python is None:
        print("GTSAM is not installed: .venv/bin/pip install -r tools/requirements-bench.txt")
    runs = 1 if options.quick else max(1, options.runs)
    rows = _measure_files(files, runs, python)
    growing = [measure_growing(file, runs, python) for file in options.files or _grown(files)]
    print(table(rows))
    print(growing_table(growing))
    print(
        "chi2: sum of e' Omega e, e = log(Z^-1 T_i^-1 T_j) in the tangent of SE(2) or SE(3);"
        " from the file's start, initialisation included, on one core"
    )
    if options.out:
        options.out.write_text(
            json.dumps({"rows": rows, "growing": growing}, indent=1) + "\n", encoding="utf-8"
        )
    return 0 if _are_good(rows, growing) else 1


def _measure_files(files: list[Path], runs: int, python: str | None) -> list[dict[str, Any]]:
    rows = []
    for file in files:
        rows.append(measure_file(file, runs, python))
        print(f"{rows[-1]['name']}: done", file=sys.stderr, flush=True)
    return rows


def _grown(files: list[Path]) -> list[Path]:
    """Those whose vertices are added one after the other, too."""
    return [file for file in files if file.name.partition(".")[0] in GROWING]


def _are_good(rows: list[dict[str, Any]], growing: list[dict[str, Any]]) -> bool:
    return all(map(_is_good, rows)) and all(row["is_good"] for row in growing)


def _is_good(row: dict[str, Any]) -> bool:
    return bool(row["is_chi2_best"]) and (row["speed_up"] or 1.0) >= 1.0
