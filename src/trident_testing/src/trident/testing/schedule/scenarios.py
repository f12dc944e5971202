# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Launches whose state hash is promised, made short."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from trident.testing.programs import package

_WITHOUT_SENSORS = (
    "uav_camera:=false",
    "ugv_camera:=false",
    *(f"{kind}_lidar:=false" for kind in ("uav", "ugv", "usv")),
)


@dataclass(frozen=True)
class Scenario:
    """A launch file of trident_bringup with its arguments.

    Attributes:
        launch: its file.
        arguments: of the launch file, given a folder for files that they name.
        is_judged: whether it lasts long enough to be judged; else it must come to its end.
    """

    launch: str
    arguments: Callable[[Path], list[str]]
    is_judged: bool = True


def _rows(name: str, count: int, folder: Path) -> Path:
    """The first lines of a formation file that hold numbers, as a file of their own."""
    source = package("trident_bringup") / "config" / "formations" / name
    lines = source.read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines if line.strip() and not line.lstrip().startswith("%")]
    path = folder / f"first_{count}_of_{name}"
    path.write_text("\n".join(rows[:count]) + "\n", encoding="utf-8")
    return path


def _main(mode: str, vehicles: int, rows: int, *more: str) -> Callable[[Path], list[str]]:
    def arguments(folder: Path) -> list[str]:
        file = _rows("hexagon_translate_rotate.txt", 6 * rows, folder)
        words = [f"mode:={mode}", f"uavs:={vehicles}", f"formation_file:={file}"]
        return [*words, "vehicles_in_file:=6", *more]

    return arguments


def _follow(vehicles: int, rows: int) -> Callable[[Path], list[str]]:
    def arguments(folder: Path) -> list[str]:
        file = _rows("leader_path.txt", rows, folder)
        return [f"uavs:={vehicles}", f"formation_file:={file}", "end_when_still:=1.0"]

    return arguments


def _coast(duration_s: float, *counts: str) -> Callable[[Path], list[str]]:
    return lambda _: [f"duration:={duration_s:g}", *_WITHOUT_SENSORS, *counts]


def _tour(folder: Path) -> list[str]:
    """A short path there and back, mapped and then driven again in the map."""
    path = folder / "short_tour.yaml"
    text = "start: [0.0, 0.0, 0.0]\nwaypoints: [[1.5, 0.0], [1.5, -1.0], [0.3, -0.3]]\n"
    path.write_text(text + "lidar_height: 0.15\n", encoding="utf-8")
    return [f"tour:={path}"]


_MAIN, _CROSS, _FOLLOW = (
    "multi_uav_simulation.launch",
    "cross_domain.launch",
    "leader_follower.launch",
)

SCENARIOS = {
    "time": Scenario(_MAIN, _main("time", 6, 20)),
    "gate": Scenario(_MAIN, _main("gate", 6, 10)),
    "recorded": Scenario(_MAIN, _main("time", 4, 5, "record:=true")),
    "cross_domain": Scenario(_CROSS, _coast(8.0), is_judged=False),
    "leader_follower": Scenario(_FOLLOW, _follow(3, 30)),
    "radio_team": Scenario("radio_team.launch", lambda _: ["duration:=8"], is_judged=False),
    "slam_room": Scenario("slam_room.launch", _tour),
}
"""What the long campaign runs; each takes some seconds on a machine at rest."""

SMALL = {
    "time": Scenario(_MAIN, _main("time", 2, 3)),
    "gate": Scenario(_MAIN, _main("gate", 2, 2)),
    "cross_domain": Scenario(_CROSS, _coast(2.0), is_judged=False),
    "leader_follower": Scenario(_FOLLOW, _follow(2, 12)),
    "slam_room": SCENARIOS["slam_room"],
}
"""The same in a few seconds of simulated time."""
