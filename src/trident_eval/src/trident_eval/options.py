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
_KERNELS = ("none", "huber", "cauchy", "dcs", "geman_mcclure", "gnc")


class Command(NamedTuple):
    """A command of ./trident that a module of this package carries out.

    Attributes:
        name: of the command.
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
    parser.add_argument("--out", type=Path, metavar="DIR", help="default: the trajectory's folder")
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


def add_latency(parser: argparse.ArgumentParser) -> None:
    """Of `./trident latency`."""
    parser.add_argument(
        "topic",
        metavar="TOPIC",
        help="of a running system: by its stamps; one that nobody publishes: messages of our own",
    )
    parser.add_argument(
        "--against",
        metavar="ECHO_TOPIC",
        help="publish on TOPIC, and measure until the same message comes back here",
    )
    parser.add_argument("--rate", type=_rate, default=500.0, metavar="HZ", help="default: 500")
    parser.add_argument("--count", type=_count, default=5000, metavar="N", help="messages: 5000")
    parser.add_argument("--size", type=_size, default=280, metavar="BYTES", help="of `bytes`: 280")
    parser.add_argument(
        "--message",
        choices=["bytes", "float32", "float64", "odometry", "nav_sat_fix"],
        default="bytes",
        help="what is published; default: bytes, std_msgs/UInt8MultiArray",
    )
    parser.add_argument("--out", type=Path, metavar="FILE.png", help="a histogram")


def _rate(text: str) -> float:
    value = float(text)
    if not 0.0 < value <= 1e6:
        raise argparse.ArgumentTypeError(f"{text} is not legal; legal: above 0, up to 1e6")
    return value


def _count(text: str) -> int:
    return _whole(text, 1, 10_000_000)


def _size(text: str) -> int:
    return _whole(text, 8, 100_000_000)


def _whole(text: str, low: int, high: int) -> int:
    value = int(text)
    if not low <= value <= high:
        raise argparse.ArgumentTypeError(f"{text} is not legal; legal: {low} to {high}")
    return value


def add_sweep(parser: argparse.ArgumentParser) -> None:
    """Of `./trident sweep`."""
    parser.add_argument(
        "scenario", nargs="?", type=Path, metavar="SCENARIO.yaml", help="what to run"
    )
    parser.add_argument(
        "--engine",
        type=_engine,
        default="local",
        metavar="NAME",
        help="local (default), dask: a cluster of this machine, or dask:tcp://HOST:8786",
    )
    parser.add_argument("--workers", type=_workers, metavar="N", help="default: the cores")
    parser.add_argument("--out", type=Path, metavar="DIR", help="default: NAME_sweep, here")
    parser.add_argument("--only", default="", metavar="KEY", help="repeat this run alone")
    parser.add_argument(
        "--plan", action="store_true", help="say which runs there are, and make none (or --dry-run)"
    )
    parser.add_argument(
        "--serve", action="store_true", help="a Dask scheduler and workers, on loopback"
    )


def add_mission(parser: argparse.ArgumentParser) -> None:
    """Of `./trident mission`."""
    parser.add_argument("action", choices=["fly", "check", "draw"], help="what to do")
    parser.add_argument(
        "file", nargs="?", type=Path, metavar="TREE.yaml", help="a behavior tree; default: ours"
    )
    parser.add_argument("--numbers", type=Path, metavar="FILE.yaml", help="of robots and rules")
    parser.add_argument("--scene", type=Path, metavar="COAST.scene.yaml", help="default: by seed")
    parser.add_argument(
        "--seed", type=_seed, default=1, metavar="N", help="of the coast, and of all"
    )
    parser.add_argument(
        "--mode", default="joint", metavar="NAME", help="joint (default), uav, three_ugvs …"
    )
    parser.add_argument(
        "--method", default="improved", metavar="NAME", help="of allocation; default: %(default)s"
    )
    parser.add_argument(
        "--links", default="network", metavar="NAME", help="network (default), or perfect"
    )
    parser.add_argument(
        "--kill", action="append", default=[], metavar="ROBOT@S", help="it dies; may be repeated"
    )
    parser.add_argument(
        "--until", type=_time, default=float("inf"), metavar="S", help="end earlier"
    )
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="of fly: default mission; of draw: a PNG"
    )


def _seed(text: str) -> int:
    return _whole(text, 0, 2**32 - 1)


def _time(text: str) -> float:
    value = float(text)
    if not value > 0.0:
        raise argparse.ArgumentTypeError(f"{text} is not legal; legal: above 0 s")
    return value


def _engine(text: str) -> str:
    if text not in ("local", "dask") and not text.startswith("dask:tcp://"):
        raise argparse.ArgumentTypeError(f"{text}; legal: local, dask, dask:tcp://HOST:PORT")
    return text


def _workers(text: str) -> int:
    return _whole(text, 1, 1024)


_SLAM = "trident_eval.slam"
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
        "latency",
        ("trident_eval.latency",),
        "how long the messages of a topic take, next to those of a bare one",
        add_latency,
    ),
    Command(
        "sweep",
        ("trident_eval.sweep",),
        "many seeded runs of a function or a launch file: table, intervals, report",
        add_sweep,
    ),
    Command(
        "mission",
        ("trident_eval.mission",),
        "fly a search and rescue without ROS, check or draw its behavior tree",
        add_mission,
    ),
    Command(
        "posegraph",
        ("trident_eval.pose_graph",),
        "optimise a pose graph of a g2o file, and draw it",
        add_pose_graph,
    ),
)
