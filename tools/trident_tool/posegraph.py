# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The subcommand about pose graphs."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from trident_tool.formation import Handler, option_words
from trident_tool.modules import run_module
from trident_tool.workspace import Runner, Workspace

_NAMES = ("out", "picture", "robust", "scale", "init", "strategy", "solver")
_KERNELS = ("none", "huber", "cauchy", "dcs", "geman_mcclure", "gnc")


def add_pose_graph_command(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``posegraph`` to the command line."""
    sub = add("posegraph", _cmd_posegraph, "optimise a pose graph of a g2o file, and draw it")
    sub.add_argument("file", type=Path, metavar="FILE.g2o", help="plain or .gz; SE2 or SE3")
    sub.add_argument("--out", type=Path, metavar="FILE", help="the optimised graph")
    sub.add_argument("--picture", type=Path, metavar="FILE.png", help="default: NAME.png, here")
    sub.add_argument(
        "--robust",
        choices=_KERNELS,
        help="kernel of edges that are not odometry; gnc: graduated non-convexity",
    )
    sub.add_argument(
        "--scale", type=float, metavar="SIGMAS", help="of the kernel; default: 1 in 1000 exceeds"
    )
    sub.add_argument(
        "--init",
        choices=["auto", "file", "chordal"],
        help="start: the better (default), the file's vertices, or averaged rotations",
    )
    sub.add_argument("--strategy", choices=["gauss_newton", "levenberg_marquardt", "dogleg"])
    sub.add_argument("--solver", choices=["trident", "ceres"], help="default: our own")


def _cmd_posegraph(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    words = [str(options.file), *option_words(options, _NAMES)]
    return run_module(workspace, runner, "trident_eval.pose_graph", words)
