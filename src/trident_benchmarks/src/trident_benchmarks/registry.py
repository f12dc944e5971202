# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmarks of `./trident bench`: one line each.

Imports nothing but the standard library, so that ./trident can show their help before anything is
built. So does the file of a benchmark at its top: what measures is imported when it runs.
"""

from __future__ import annotations

import argparse
import importlib
from typing import NamedTuple, Protocol, cast


class BenchmarkFile(Protocol):
    """What the file of a benchmark has."""

    def add_options(self, parser: argparse.ArgumentParser) -> None:
        """Adds its options to a parser."""

    def run(self, options: argparse.Namespace) -> int:
        """Measures.

        Returns:
            0: measured; 1: a row failed, or a limit was missed.

        Raises:
            EvalError: nothing can be measured.
        """


class Benchmark(NamedTuple):
    """A benchmark.

    Attributes:
        name: behind `./trident bench`.
        file: its module in this package.
        help: one line.
    """

    name: str
    file: str
    help: str

    def load(self) -> BenchmarkFile:
        """Its module."""
        return cast(BenchmarkFile, importlib.import_module(f"trident_benchmarks.{self.file}"))


BENCHMARKS = (
    Benchmark("sim", "sim.benchmark", "measure the simulator"),
    Benchmark("sensors", "sensors.benchmark", "measure lidars and cameras"),
    Benchmark("amcl", "amcl.benchmark", "measure localisation in a known map"),
    Benchmark("vessels", "vessels.benchmark", "check vessels and sea"),
    Benchmark("nav", "nav.benchmark", "drive robots to goals in worlds that are hard to cross"),
    Benchmark("slam", "slam.benchmark", "measure SLAM on the public logs, or in a simulated world"),
    Benchmark("posegraph", "posegraph.benchmark", "compare pose-graph optimisation with GTSAM"),
    Benchmark("links", "links.benchmark", "compare radios with ns-3, and measure what they cost"),
    Benchmark("bridges", "bridges.benchmark", "measure bridges between ROS and other protocols"),
    Benchmark("sitl", "sitl.benchmark", "fly with stand-ins for PX4 and ArduPilot in lockstep"),
    Benchmark("trajectories", "trajectories.benchmark", "plan teams in space and time"),
    Benchmark("fusion", "fusion.benchmark", "measure one belief about where a team is"),
    Benchmark("sweeps", "sweeps.benchmark", "measure what a sweep costs around its runs"),
    Benchmark(
        "tasks", "tasks.benchmark", "compare methods of sharing out tasks, and lose messages"
    ),
    Benchmark("search", "search.benchmark", "measure coverage planners, shares, drift, detection"),
    Benchmark("mission", "mission.benchmark", "measure what cooperation is worth in a search"),
    Benchmark("envs", "envs.benchmark", "measure environments of learners, and learn to hover"),
    Benchmark("table", "sim.saved_table", "the Markdown table of a saved benchmark"),
)
