# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of programs that read a YAML file and print a line of JSON per run, several at a time."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

from trident_benchmarks.nav.trials import Robot

_LIMIT_S = 3600.0  # wall time of a process


def shares(items: Sequence[int], count: int) -> list[list[int]]:
    """Items dealt out to so many hands, none of them empty."""
    hands = [list(items[first::count]) for first in range(count)]
    return [hand for hand in hands if hand]


def job_count(jobs: int | None) -> int:
    """As many as are asked for, or as there are cores."""
    return jobs or len(os.sched_getaffinity(0))


def robot_keys(folder: Path, robot: Robot) -> dict[str, Any]:
    """What a trial says of its robot, whose description becomes a file in a folder."""
    file = folder / f"{robot.name}.urdf"
    file.write_text(robot.urdf(), encoding="utf-8")
    return robot.keys(file)


def run_documents(
    package: str, name: str, documents: Sequence[dict[str, Any]], jobs: int | None, *words: str
) -> list[list[dict[str, Any]]]:
    """What a program prints for each document, in their order.

    Args:
        package: of the program.
        name: of the program.
        documents: what its YAML files hold.
        jobs: processes at a time; None: as many as there are cores.
        words: what stands before the file on its command line.

    Raises:
        EvalError: it is not built, failed, or printed something else; with what it said.
    """
    command = program(package, name)

    def one(folder: Path, number: int) -> list[dict[str, Any]]:
        file = folder / f"{number}.yaml"  # JSON is YAML, too
        file.write_text(json.dumps(documents[number]), encoding="utf-8")
        return _lines(name, [command, *words, str(file)])

    with (
        tempfile.TemporaryDirectory(prefix="trident_bench_") as temporary,
        ThreadPoolExecutor(job_count(jobs)) as pool,
    ):
        waiting = [pool.submit(one, Path(temporary), i) for i in range(len(documents))]
        try:
            return [future.result() for future in waiting]
        finally:
            pool.shutdown(cancel_futures=True)


def _lines(name: str, command: list[str]) -> list[dict[str, Any]]:
    try:
        done = subprocess.run(
            ["setpriv", "--pdeathsig", "TERM", *command],
            capture_output=True,
            text=True,
            check=False,
            timeout=_LIMIT_S,
        )
    except subprocess.TimeoutExpired as error:
        raise EvalError(f"{name}: not ended after {_LIMIT_S:g} s") from error
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no output"])[-1]
        raise EvalError(f"{name}: exit code {done.returncode}: {last}")
    try:
        return [json.loads(line) for line in done.stdout.splitlines()]
    except ValueError as error:
        raise EvalError(f"{name}: a line is not JSON: {error}") from error
