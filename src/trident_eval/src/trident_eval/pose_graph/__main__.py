# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Optimise a pose graph of a g2o file, report how it went, and draw it before and after."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.core.exit_codes import exit_code_of
from trident_eval.options import SOLVER_OPTIONS, add_pose_graph
from trident_eval.pose_graph.g2o import read_layout
from trident_eval.pose_graph.picture import draw
from trident_eval.pose_graph.program import optimize


def make_parser() -> argparse.ArgumentParser:
    """The command line."""
    parser = argparse.ArgumentParser(prog="trident posegraph", description=__doc__)
    add_pose_graph(parser)
    return parser


def text_of(file: Path, report: dict[str, Any]) -> str:
    """The report as lines for people."""
    start = "averaged rotations" if report["start"] == "chordal" else "the file's vertices"
    lines = [
        f"{file.name}: {report['kind']}, {report['vertices']} vertices, {report['edges']} edges",
        f"chi2 before  {report['chi2_before']:.8g}",
        f"chi2 start   {report['chi2_start']:.8g}  ({start})",
        f"chi2 after   {report['chi2_after']:.8g}",
        f"iterations   {report['iterations']}"
        + ("" if report["converged"] else "  (NOT converged)"),
        f"CPU time     {report['cpu_s']:.4f} s, and {report['read_cpu_s']:.4f} s to read the file",
    ]
    if report["chi2_given_up"]:
        lines.insert(
            3, f"given up     {report['chi2_given_up']:.8g}  (where the file's vertices led)"
        )
    if report["parts"] > 1:
        lines.append(
            f"parts        {report['parts']}, not joined: each is held by its first vertex"
            " unless one is fixed"
        )
    if report["cost_after"] != report["chi2_after"]:
        lines.insert(4, f"robust cost  {report['cost_before']:.8g} -> {report['cost_after']:.8g}")
    if outliers := report["outliers"]:
        shown = ", ".join(f"{a}-{b}" for a, b in outliers[:8])
        lines.append(f"outliers     {len(outliers)}: {shown}{' …' if len(outliers) > 8 else ''}")
    return "\n".join(lines)


def _title_after(report: dict[str, Any]) -> str:
    if not report["outliers"]:
        return f"after: chi2 {report['chi2_after']:.6g}"
    # chi2 counts what was rejected, too: it says nothing of the rest.
    return f"after: robust cost {report['cost_after']:.6g}"


def _solver_words(options: argparse.Namespace) -> list[str]:
    words = ["--strict"] if options.strict else []
    for name in SOLVER_OPTIONS:
        if (value := getattr(options, name)) is not None:
            words += [f"--{name}", str(value)]
    return words


def run(options: argparse.Namespace, rest: list[str]) -> int:
    """Optimises, prints, draws.

    Returns:
        0: converged; 1: not.

    Raises:
        EvalError: bad input.
    """
    words = [*rest, *_solver_words(options)]
    name = options.file.name.removesuffix(".gz").removesuffix(".g2o")
    picture = options.picture or Path(f"{name}.png")
    with tempfile.TemporaryDirectory() as folder:
        out = options.out or Path(folder) / "after.g2o"
        start = Path(folder) / "before.g2o"  # a file without vertices has no places of its own
        report = optimize(options.file, [*words, "--out", str(out), "--before", str(start)])
        print(text_of(options.file, report))
        panels = [
            (f"{name}, before: chi2 {report['chi2_before']:.6g}", read_layout(start)),
            (_title_after(report), read_layout(out)),
        ]
    draw(panels, report["outliers"], picture)
    print(f"picture      {picture}")
    return 0 if report["converged"] else 1


def main() -> int:
    """Command line; what is not known here is left to the program."""
    options, rest = make_parser().parse_known_args()
    try:
        return run(options, rest)
    except EvalError as error:
        print(f"trident: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
