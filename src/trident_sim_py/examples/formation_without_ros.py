#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Flies the formation of multi_uav_simulation.launch in this process, without ROS.

Same world, vehicles, controllers and set-points, so the flight ends in the same state to the bit:

    ./trident shell
    ./trident run multi_uav_simulation.launch
    src/trident_sim_py/examples/formation_without_ros.py --compare out/latest
"""

from __future__ import annotations

import argparse
import csv
import json
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from trident_fleet.core.errors import FormationError
from trident_fleet.core.feeders import end_of_plan_ns
from trident_fleet.core.files.formation_file import FormationSource, flying_rows, read_formation
from trident_fleet.core.plan import FormationPlan, plan_formation
from trident_fleet.core.settings import FleetSettings

import trident_sim

NS_PER_S = 1_000_000_000
FORMATION = "package://trident_bringup/config/formations/hexagon_translate_rotate.txt"
WORLD = "package://rotors_gazebo/worlds/{}.world"
SPAWN_Y_M = (4.0, 2.4, 0.8, -0.8, -2.4, -4.0)
SPAWN_Z_M = 0.1
RECORD_NS = 50_000_000

AtPeriod = Callable[[trident_sim.World], None]


@dataclass(frozen=True)
class Flight:
    """A world with its vehicles on the ground, and what they are going to fly.

    Attributes:
        world: at time zero.
        plan: motion of all vehicles.
        settings: how the plan is fed.
    """

    world: trident_sim.World
    plan: FormationPlan
    settings: FleetSettings

    @property
    def start_ns(self) -> int:
        """When the plan begins: with the first period after time zero, as under ROS [ns].

        A set-point stamped zero would be one without a stamp.
        """
        return self.settings.feed.period_ns

    @property
    def end_ns(self) -> int:
        """When the flight is over [ns]."""
        return end_of_plan_ns(self.start_ns, self.plan.duration, self.settings.feed)


def spawn_vehicle(world: trident_sim.World, name: str, y_m: float, mav_name: str) -> None:
    """One vehicle with its controller, as launch/robot/uav.launch starts them."""
    urdf = trident_sim.multirotor(name, mav_name)
    world.spawn(name, urdf=urdf, pose=(0.0, y_m, SPAWN_Z_M))


def prepare(args: argparse.Namespace) -> Flight:
    """Build the world and plan the flight.

    Raises:
        trident_sim.Error: a file is missing or bad.
        FormationError: the formation cannot be flown.
    """
    file = args.formation_file or trident_sim.find_resource(FORMATION)
    settings = FleetSettings(FormationSource(file, uavs=args.uavs))
    rows = flying_rows(read_formation(settings.source), args.uavs)
    world = trident_sim.World(WORLD.format(args.world_name), seed=args.seed)
    names = [f"UAV{number + 1}" for number in range(rows.shape[1])]
    if len(names) > len(SPAWN_Y_M):
        raise FormationError(f"uavs: {len(names)}; legal: 1 to {len(SPAWN_Y_M)}")
    for name, y_m in zip(names, SPAWN_Y_M, strict=False):
        spawn_vehicle(world, name, y_m, args.mav_name)
    spawn = np.array([world.model(name).position for name in names])
    return Flight(world, plan_formation(rows, spawn, settings.plan), settings)


def set_points(flight: Flight) -> Iterator[list[trident_sim.TrajectorySample]]:
    """The set-points of each period, one trajectory per vehicle, those of the formation nodes."""
    feed, plan = flight.settings.feed, flight.plan
    periods = (flight.end_ns - flight.start_ns) // feed.period_ns + 1
    per_period = feed.period_ns // feed.point_ns
    stamps_ns = np.arange(periods * per_period, dtype=np.int64) * feed.point_ns
    motion = plan.sample(stamps_ns / NS_PER_S)
    position, velocity, acceleration = (
        np.ascontiguousarray(array.swapaxes(0, 1))  # vehicle by vehicle, as they are handed over
        for array in (motion.position, motion.velocity, motion.acceleration)
    )
    times = stamps_ns[:per_period] / NS_PER_S
    for period in range(periods):
        points = slice(period * per_period, (period + 1) * per_period)
        yield [
            trident_sim.TrajectorySample(
                position[vehicle, points],
                times,
                velocity[vehicle, points],
                acceleration[vehicle, points],
                yaw=plan.yaw_rad,
                stamp=(flight.start_ns + period * feed.period_ns) / NS_PER_S,
            )
            for vehicle in range(plan.rows.shape[1])
        ]


def fly(flight: Flight, watch: AtPeriod | None = None) -> None:
    """Fly to the end of the plan.

    A set-point acts at the state of its stamp, which is measured in the step that leads there; so
    each period is fed one period ahead.

    Args:
        flight: what `prepare` has made.
        watch: called every `RECORD_NS` of simulated time.
    """
    world, feed = flight.world, flight.settings.feed
    names = [f"UAV{number + 1}" for number in range(flight.plan.rows.shape[1])]
    inputs = [world.ports[f"{name}/command/trajectory"] for name in names]
    for period, samples in enumerate(set_points(flight)):
        for port, sample in zip(inputs, samples, strict=True):
            port.write(sample)
        end_ns = flight.start_ns + period * feed.period_ns
        while watch and world.time_ns + RECORD_NS < end_ns:
            world.step_until((world.time_ns + RECORD_NS) / NS_PER_S)
            watch(world)
        world.step_until(end_ns / NS_PER_S)
        if watch:
            watch(world)


State = tuple[float, str, tuple[float, ...]]


def states_of(world: trident_sim.World) -> Iterator[State]:
    """Time, name and numbers of every vehicle, as a row of the simulator's states.csv has them."""
    for name, model in world.models.items():
        if not model.is_static:
            numbers = np.concatenate(
                [model.position, model.orientation, model.linear_velocity, model.angular_velocity]
            )
            yield world.time, name, tuple(map(float, numbers))


class Comparison:
    """Compares states with those that a run under ROS has recorded."""

    def __init__(self, run: Path) -> None:
        """Read the run.

        Args:
            run: its folder, with run.json and states.csv.

        Raises:
            OSError: it cannot be read.
            ValueError: it is not a finished run.
        """
        facts = json.loads((run / "run.json").read_text(encoding="utf-8"))
        if "state_hash" not in facts:
            raise ValueError(f"{run}/run.json: no state_hash, the run has not ended")
        self.state_hash = str(facts["state_hash"])
        with (run / "states.csv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))[1:]
        self._recorded: dict[tuple[float, str], tuple[float, ...]] = {
            (float(row[0]), row[1]): tuple(map(float, row[2:])) for row in rows
        }
        self.compared = 0
        self.first_difference: str | None = None

    def __call__(self, world: trident_sim.World) -> None:
        """Compare the present states, until the first difference."""
        for time_s, name, numbers in states_of(world):
            recorded = self._recorded.get((time_s, name))
            self.compared += 1
            if recorded != numbers and self.first_difference is None:
                self.first_difference = f"{name} at {time_s} s: here {numbers}, recorded {recorded}"


def parse_args(argv: list[str] | None) -> argparse.Namespace:
    """Arguments, named as those of the launch file."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--formation-file", default="", help="default: that of the launch file")
    parser.add_argument("--uavs", type=int, default=6, help="how many fly")
    parser.add_argument("--mav-name", default="firefly")
    parser.add_argument("--world-name", default="basic")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--compare", type=Path, metavar="RUN", help="folder of a run under ROS")
    return parser.parse_args(argv)


def main(argv: list[str] | None = None) -> int:
    """Fly, and print one JSON object. Exit code 1: it cannot be flown, or it differs."""
    args = parse_args(argv)
    try:
        comparison = Comparison(args.compare) if args.compare else None
        flight = prepare(args)
    except (trident_sim.Error, FormationError, OSError, ValueError) as error:
        print(f"formation_without_ros: {error}", file=sys.stderr)
        return 1
    begin = time.perf_counter()
    fly(flight, comparison)
    wall_s = time.perf_counter() - begin
    world = flight.world
    result = {
        "state_hash": world.state_hash(),
        "sim_s": world.time,
        "wall_s": round(wall_s, 6),
        "rtf": round(world.time / wall_s, 1),
    }
    if comparison:
        result["states_compared"] = comparison.compared
        result["equal"] = (
            comparison.first_difference is None and comparison.state_hash == result["state_hash"]
        )
    print(json.dumps(result))
    if comparison and comparison.first_difference:
        print(f"first difference: {comparison.first_difference}", file=sys.stderr)
    return 0 if result.get("equal", True) else 1


if __name__ == "__main__":
    sys.exit(main())
