# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the benchmark of outside autopilots: measured, written, printed."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

import trident_sim
from trident_benchmarks.processes import Processes
from trident_benchmarks.results import (
    FAILED,
    MEASURED,
    check_folder,
    new_document,
    say,
    write_document,
)

_MODEL = "package://trident_description/sdf/sitl_iris.sdf.xacro"
_FLIGHT_S, _QUICK_S = 17.0, 6.0
_WARM_UP_S = 1.0  # until the programs have started


class SitlRow(NamedTuple):
    """What is measured.

    Attributes:
        autopilot: `px4` or `ardupilot`.
        rate: steps, sensors and answers a simulated second [Hz].
        n: number of vehicles.
    """

    autopilot: str
    rate: int
    n: int


ROWS = (
    SitlRow("px4", 250, 1),
    SitlRow("px4", 250, 6),
    SitlRow("ardupilot", 400, 1),
    SitlRow("ardupilot", 400, 6),
)


@contextmanager
def _flying(row: SitlRow) -> Iterator[trident_sim.World]:
    """A world with the row's vehicles, and a process for each of them."""
    world_file = trident_sim.find_resource(
        f"package://trident_bringup/worlds/{row.autopilot}.world"
    )
    world = trident_sim.World(world_file, timing="direct")
    for i in range(row.n):
        sdf = trident_sim.expand_xacro(_MODEL, autopilot=row.autopilot, instance=i)
        world.spawn(f"iris{i}", sdf=sdf, pose=(2.0 * i, 0.0, 0.06))
    with Processes() as processes:
        for i in range(row.n):
            words = ["--autopilot", row.autopilot, "--instance", str(i), "--stand-in"]
            processes.start(f"stand_in{i}", [program("trident_bridges", "sitl_program.py"), *words])
        yield world
        processes.check_running()


def measure_row(row: SitlRow, until_s: float) -> dict[str, Any]:
    """Fly, and time it.

    Raises:
        EvalError: the vehicles do not fly.
    """
    try:
        with _flying(row) as world:
            world.step_until(_WARM_UP_S)
            begin = time.perf_counter()
            world.step_until(5.0)
            heights = [float(model.position[2]) for model in world.models.values()]
            world.step_until(until_s)
            wall_s = time.perf_counter() - begin
            state_hash = world.state_hash()
    except trident_sim.Error as error:
        raise EvalError(str(error)) from error
    if not all(height > 1.0 for height in heights):
        raise EvalError(f"heights at 5 s are {heights} m; legal: above 1 m")
    rtf = (until_s - _WARM_UP_S) / wall_s
    exchange_us = 1e6 * wall_s / (row.rate * (until_s - _WARM_UP_S))
    return row._asdict() | {"rtf": rtf, "step_us": exchange_us, "state_hash": state_hash}


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    document = new_document() | {"rows": []}
    is_whole = True
    for row in ROWS:
        try:
            result = measure_row(row, _QUICK_S if options.quick else _FLIGHT_S)
        except EvalError as error:
            say(str(error))
            is_whole = False
            result = row._asdict() | {"error": str(error).splitlines()[0]}
        else:
            print(
                f"{row.autopilot}, {row.rate} Hz, {row.n} vehicles:"
                f" {result['rtf']:.1f} times real time, {result['step_us']:.0f} us a step",
                flush=True,
            )
        document["rows"].append(result)
        write_document(options.out, document)
    return MEASURED if is_whole else FAILED
