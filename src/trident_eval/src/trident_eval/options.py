# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The command lines of this package: its modules parse them, and ./trident shows their help.

Imports nothing but the standard library, so that ./trident can load it before anything is built.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

DEFAULT_METHOD = "graph_slam_2d"
SOLVER_OPTIONS = ("robust", "scale", "init", "strategy", "solver", "iterations", "tolerance")
VESSEL_CHECKS = (
    "static",
    "decay",
    "rao",
    "spectrum",
    "speed",
    "circle",
    "zigzag",
    "current",
    "guidance",
    "course",
    "station",
    "energy",
    "legacy_vrx",
    "random",
)
_KERNELS = ("none", "huber", "cauchy", "dcs", "geman_mcclure", "gnc")


class Command(NamedTuple):
    """A command of ./trident that a module of this package carries out.

    Attributes:
        name: of the command, or of what `./trident bench` measures.
        call: the module, and the words that come before the user's own.
        help: one line.
        add_options: adds its options to a parser.
        passes_on: whether options that are unknown here go to a program behind the module.
    """

    name: str
    call: tuple[str, ...]
    help: str
    add_options: Callable[[argparse.ArgumentParser], None]
    passes_on: bool = False


def positive(text: str) -> int:
    """A whole number of 1 or more, as argparse's ``type``."""
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text} is not legal; legal: >= 1")
    return value


def add_sim(parser: argparse.ArgumentParser) -> None:
    """Of `./trident bench sim`."""
    parser.add_argument(
        "--quick", action="store_true", help="N <= 6, one run each, no launch files"
    )
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument("--profile", action="store_true", help="time per stage of a step")
    parser.add_argument("--markdown", action="store_true", help="a Markdown table on stdout")
    parser.add_argument("--runs", type=positive, metavar="N", help="runs per row (3; --quick: 1)")
    parser.add_argument(
        "--mode", action="append", default=[], help="only this mode; may be repeated"
    )
    parser.add_argument(
        "--controller",
        type=Path,
        metavar="PROGRAM",
        help="for lockstep_external: another build of lee_position_controller_node",
    )
    parser.add_argument(
        "--world",
        choices=["coast"],
        help="measure UAVs, UGVs and USVs together instead, --mode being one of their fleets",
    )


def add_sensors(parser: argparse.ArgumentParser) -> None:
    """Of `./trident bench sensors`."""
    parser.add_argument("--quick", action="store_true", help="a fifth of the time, one run each")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument("--runs", type=positive, metavar="N", help="runs per row (3; --quick: 1)")
    parser.add_argument(
        "--mode", action="append", default=[], help="only this row; may be repeated"
    )


def add_amcl(parser: argparse.ArgumentParser) -> None:
    """Of `./trident bench amcl`."""
    parser.add_argument("--quick", action="store_true", help="4 trials instead of 100")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the figures go")


def add_table(parser: argparse.ArgumentParser) -> None:
    """Of `./trident bench table`."""
    parser.add_argument("source", type=Path, metavar="FILE.json")


def add_vessels(parser: argparse.ArgumentParser) -> None:
    """Of `./trident bench vessels`."""
    parser.add_argument("--out", type=Path, metavar="DIR", help="where the pictures go")
    parser.add_argument("--quick", action="store_true", help="without the million random steps")
    parser.add_argument(
        "--only", action="append", choices=VESSEL_CHECKS, help="this check; may be repeated"
    )


def add_pose_graph_bench(parser: argparse.ArgumentParser) -> None:
    """Of `./trident bench posegraph`."""
    parser.add_argument(
        "files", nargs="*", type=Path, metavar="FILE", help="default: $TRIDENT_DATA/pose_graph"
    )
    parser.add_argument("--runs", type=int, default=5, metavar="N", help="of each; default 5")
    parser.add_argument("--quick", action="store_true", help="one run of each")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument(
        "--gtsam-python", type=Path, metavar="PYTHON", help="the Python that has GTSAM"
    )


def add_slam_bench(parser: argparse.ArgumentParser) -> None:
    """Of `./trident bench slam`."""
    parser.add_argument(
        "--quick", action="store_true", help="default method, logs with relations, one run each"
    )
    parser.add_argument("--runs", type=int, metavar="N", help="runs per row (5; --quick: 1)")
    parser.add_argument(
        "--method", action="append", default=[], help="may be repeated; default: all"
    )
    parser.add_argument("--config", type=Path, metavar="FILE.yaml")
    parser.add_argument("--data", type=Path, metavar="DIR", help="other logs, and their .relations")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")
    parser.add_argument(
        "--live",
        action="store_true",
        help="instead: how long scans wait while a graph of 5,000 nodes is optimised",
    )
    parser.add_argument(
        "--robustness",
        action="store_true",
        help="instead: logs with odometry that errs, a laser that sits elsewhere, worse scans",
    )
    parser.add_argument("--world", metavar="NAME", help="drives through it instead of logs: office")
    parser.add_argument("--seeds", type=int, metavar="N", help="of drives (20; --quick: 2)")
    parser.add_argument(
        "--keep", type=Path, metavar="DIR", help="keeps logs and maps of the drives"
    )
    parser.add_argument("--pictures", type=Path, metavar="DIR", help="maps and reports of all logs")


def add_slam(parser: argparse.ArgumentParser) -> None:
    """Of `./trident slam`."""
    parser.add_argument("log", type=Path, metavar="FILE", help=".log, .clf (.gz, .bz2) or .bag")
    parser.add_argument(
        "--method", default=DEFAULT_METHOD, metavar="NAME", help="default: %(default)s"
    )
    parser.add_argument("--config", type=Path, metavar="FILE.yaml", help="default: the method's")
    parser.add_argument("--out", type=Path, metavar="DIR", help="default: NAME_slam, here")
    parser.add_argument("--relations", type=Path, metavar="FILE.relations", help="to judge it by")
    parser.add_argument("--truth", type=Path, metavar="FILE.tum", help="to judge it by")
    parser.add_argument("--no-pictures", action="store_true", help="no report.html")


def add_evaluate(parser: argparse.ArgumentParser) -> None:
    """Of `./trident evaluate`."""
    parser.add_argument(
        "source", type=Path, metavar="DIR_OR_TUM", help="what `slam` has written, or a trajectory"
    )
    parser.add_argument("--relations", type=Path, metavar="FILE.relations", help="to judge it by")
    parser.add_argument("--truth", type=Path, metavar="FILE.tum", help="the true trajectory")
    parser.add_argument(
        "--align", choices=["SE2", "SE3", "none"], default="SE2", help="default: %(default)s"
    )
    parser.add_argument("--map", type=Path, metavar="FILE.yaml", help="default: the folder's")
    parser.add_argument("--true-map", type=Path, metavar="FILE.yaml", help="to judge it by")
    parser.add_argument("--out", type=Path, metavar="DIR", help="default: beside the trajectory")
    parser.add_argument("--no-pictures", action="store_true", help="only evaluation.json")


def add_report(parser: argparse.ArgumentParser) -> None:
    """Of `./trident report`."""
    parser.add_argument("source", type=Path, metavar="RUN_OR_BAG", help="folder of a run, or a bag")
    parser.add_argument("--out", type=Path, metavar="DIR", help="folder of the pictures")
    parser.add_argument("--animate", action="store_true", help="a moving plan view, too (GIF)")


def add_pose_graph(parser: argparse.ArgumentParser) -> None:
    """Of `./trident posegraph`."""
    parser.add_argument("file", type=Path, metavar="FILE.g2o", help="plain or .gz; SE2 or SE3")
    parser.add_argument("--out", type=Path, metavar="FILE", help="the optimised graph")
    parser.add_argument("--picture", type=Path, metavar="FILE.png", help="default: NAME.png, here")
    parser.add_argument(
        "--robust",
        choices=_KERNELS,
        help="kernel of edges that are not odometry; gnc: graduated non-convexity",
    )
    parser.add_argument(
        "--scale", type=float, metavar="SIGMAS", help="of the kernel; default: 1 in 1000 exceeds"
    )
    parser.add_argument(
        "--init",
        choices=["auto", "file", "chordal"],
        help="start: the better (default), the file's vertices, or averaged rotations",
    )
    parser.add_argument("--strategy", choices=["gauss_newton", "levenberg_marquardt", "dogleg"])
    parser.add_argument("--solver", choices=["trident", "ceres"], help="default: our own")
    parser.add_argument("--iterations", type=int, metavar="N", help="at most")
    parser.add_argument("--tolerance", type=float, metavar="R", help="relative, of the cost")
    parser.add_argument(
        "--strict",
        action="store_true",
        help="refuse information matrices that are not positive semidefinite; default: the nearest"
        " one that is stands for each, with a warning",
    )


_BENCH, _SLAM = "trident_eval.bench", "trident_eval.slam"
#: What `./trident bench` measures.
BENCHMARKS = (
    Command("sim", (_BENCH, "sim"), "measure the simulator", add_sim),
    Command("sensors", (_BENCH, "sensors"), "measure lidars and cameras", add_sensors),
    Command("amcl", (_BENCH, "amcl"), "measure localisation in a known map", add_amcl),
    Command("vessels", ("trident_eval.vessels",), "check vessels and sea", add_vessels),
    Command(
        "slam",
        (_SLAM, "bench"),
        "measure SLAM on the public logs, or in a simulated world",
        add_slam_bench,
    ),
    Command(
        "posegraph",
        ("trident_eval.pose_graph.bench",),
        "measure pose-graph optimisation beside GTSAM",
        add_pose_graph_bench,
    ),
    Command("table", (_BENCH, "table"), "the Markdown table of a saved benchmark", add_table),
)
#: Commands of ./trident.
COMMANDS = (
    Command(
        "report",
        ("trident_eval", "report"),
        "one page about a run or a bag: plots, what went in",
        add_report,
    ),
    Command(
        "slam",
        (_SLAM, "slam"),
        "run a CARMEN log or a rosbag through SLAM: map, trajectory, report",
        add_slam,
        passes_on=True,
    ),
    Command(
        "evaluate",
        (_SLAM, "evaluate"),
        "judge a trajectory and a map by relations or by the truth",
        add_evaluate,
    ),
    Command(
        "posegraph",
        ("trident_eval.pose_graph",),
        "optimise a pose graph of a g2o file, and draw it",
        add_pose_graph,
    ),
)
