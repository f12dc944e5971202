# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""MAVProxy, unchanged, leads UAV, UGV and USV at once: parameters, modes, a mission, the return."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from mavproxy import MavProxy, mavproxy
from trident.testing import Launch, eventually
from trident.testing.clients import clients_python
from trident.testing.mavlink_vehicles import KINDS, write_fleet

#: Ten times real time is what MAVProxy keeps up with.
FACTOR = 10
ORIGIN = (63.4389, 10.399)  # of the world
LEG_M = 5.0
ITEMS = 20  # besides home, which is item 0
METERS_PER_DEGREE = 111_480.0  # of latitude, at the origin
ROUNDED_DEG = 1e-6  # in files of MAVProxy
TAKE_OFF, WAYPOINT = 22, 16
Place = tuple[float, float, float]


@dataclass(frozen=True)
class Craft:
    """What is asked of a vehicle. Places are x, y, z from where it starts [m].

    Attributes:
        speed: a parameter, and what it is set to.
        goal: where it goes first.
        route: of the mission.
        tolerance_m: around a place.
        height_m: of its take-off; 0: it does not fly.
    """

    speed: tuple[str, float]
    goal: Place
    route: list[Place]
    tolerance_m: float
    height_m: float = 0.0


def ring(heading: float, heights: tuple[float, ...]) -> list[Place]:
    """Legs along a polygon that begins with this heading [rad], and does not quite end."""
    places, x, y = [], 0.0, 0.0
    for i in range(ITEMS):
        direction = heading + 2.0 * math.pi * i / (ITEMS + 2)
        x, y = x + LEG_M * math.cos(direction), y + LEG_M * math.sin(direction)
        places.append((x, y, heights[i % len(heights)]))
    return places


def road() -> list[Place]:
    """Legs ahead and back, which do not quite end where they began."""
    ahead = [LEG_M * i for i in (1, 2, 3, 4, 5, 4, 3)]
    return [(ahead[i % len(ahead)], 0.0, 0.0) for i in range(ITEMS)]


CRAFTS = {
    "uav1": Craft(("WPNAV_SPEED", 450.0), (0.0, -5.0, 8.0), ring(0.0, (6.0, 8.0)), 1.0, 6.0),
    "ugv1": Craft(("WP_SPEED", 1.75), (5.0, 0.0, 0.0), road(), 2.5),
    "usv1": Craft(("WP_SPEED", 2.5), (0.0, -5.0, 0.0), ring(-math.pi / 2, (0.0,)), 3.0),
}


def on_earth(start: Place, offset: Place) -> tuple[float, float]:
    """Latitude and longitude of a place next to one in the world [deg]."""
    across = METERS_PER_DEGREE * math.cos(math.radians(ORIGIN[0]))
    x, y = start[0] + offset[0], start[1] + offset[1]
    return ORIGIN[0] + y / METERS_PER_DEGREE, ORIGIN[1] + x / across


class Errand:
    """One vehicle, its MAVProxy and what it is to do."""

    def __init__(self, run: Launch, name: str, client: MavProxy, folder: Path) -> None:
        self.run, self.name, self.client, self.folder = run, name, client, folder
        self.craft = CRAFTS[name]
        self.start = run.position(name)

    def _reach(self, offset: tuple[float, ...], what: str) -> None:
        """Its height counts where it flies and `offset` has one."""
        count = len(offset) if self.craft.height_m else 2

        def is_there() -> bool:
            here = self.run.position(self.name)
            moved = [a - b for a, b in zip(here, self.start, strict=True)]
            return math.dist(moved[:count], offset[:count]) < self.craft.tolerance_m

        eventually(is_there, f"{self.name}: {what}")

    def prepare(self) -> None:
        """Parameters, and the mode of what follows."""
        name, value = self.craft.speed

        def has_speed() -> bool:
            self.client.say(f"param set {name} {value:g}")
            return self.client.answers(f"param show {name}", f" {value}")

        self.client.expect("parameters")
        eventually(has_speed, f"{self.name}: another speed")
        self.client.command("mode GUIDED", "DO_SET_MODE: ACCEPTED")
        self.client.command("arm throttle", "COMPONENT_ARM_DISARM: ACCEPTED")

    def set_out(self) -> None:
        """Take-off of what flies, and a place to go to."""
        height = self.craft.height_m
        if height:
            self.client.command(f"takeoff {height:g}", "NAV_TAKEOFF: ACCEPTED")
            self._reach((0.0, 0.0, height), "take-off")
        latitude, longitude = on_earth(self.start, self.craft.goal)
        words = f"guided {latitude:.7f} {longitude:.7f} {self.craft.goal[2]:g}"
        self.client.command(words, "DO_REPOSITION: ACCEPTED")
        self._reach(self.craft.goal, "the goal")

    def _items(self) -> list[tuple[int, float, float, float]]:
        items = [(WAYPOINT, *on_earth(self.start, one), one[2]) for one in self.craft.route]
        if self.craft.height_m:
            items[0] = (TAKE_OFF, *items[0][1:])
        return items

    def carry_out_mission(self) -> None:
        """Up, down and along."""
        there, back = self.folder / "there.txt", self.folder / "back.txt"
        items = [(WAYPOINT, *ORIGIN, 0.0), *self._items()]
        lines = [
            "\t".join([str(i), "0", "3", str(command), *"0000", *map(str, place), "1"])
            for i, (command, *place) in enumerate(items)
        ]
        there.write_text("\n".join(["QGC WPL 110", *lines, ""]), encoding="utf-8")
        self.client.command(f"wp load {there}", "MISSION_ACK: TYPE_MISSION: ACCEPTED")
        self.client.command(f"wp save {back}", f"Saved {len(items)} ")
        saved = [line.split("\t") for line in back.read_text(encoding="utf-8").splitlines()[1:]]
        got = [(int(row[3]), *map(float, row[8:11])) for row in saved]
        assert [row[0] for row in got] == [item[0] for item in items]
        for row, item in zip(got[1:], items[1:], strict=True):  # home is the vehicle's own
            assert math.dist(row[1:], item[1:]) < ROUNDED_DEG, (row, item)
        since = len(self.client.lines)
        self.client.command("mode AUTO", "Mission is finished.")
        said = (re.search(r"waypoint (\d+)$", line) for line in self.client.lines[since:])
        # Where the first is, it may be already.
        assert {int(match[1]) for match in said if match} >= set(range(2, ITEMS + 1))
        self._reach(self.craft.route[-1], "the last place")

    def come_home(self) -> None:
        """Where it started, and switched off."""
        since = len(self.client.lines)
        self.client.command("mode RTL", "DO_SET_MODE: ACCEPTED")
        self._reach((0.0, 0.0), "home")
        if self.craft.height_m:
            self.client.command("mode LAND", "DO_SET_MODE: ACCEPTED")
            self.client.expect("Disarmed: landed.", since)
            self._reach((0.0, 0.0, 0.0), "the ground")
        else:
            self.client.command("disarm", "COMPONENT_ARM_DISARM: ACCEPTED")

    def do(self) -> None:
        """All of it."""
        self.prepare()
        self.set_out()
        self.carry_out_mission()
        self.come_home()
        assert not any("breach" in line or "denied" in line for line in self.client.lines)


def test_mavproxy_leads_three_vehicles_at_once(
    launch: Callable[..., Launch], tmp_path: Path
) -> None:
    clients_python("MAVProxy")  # before anything is started for it
    fleet = write_fleet(tmp_path)
    words = ("trident_bringup", "mavlink_fleet.launch")
    run = launch(*words, vehicles=str(fleet.path), real_time_factor=FACTOR)
    run.ready()

    def lead(name: str) -> None:
        folder = tmp_path / name
        with mavproxy(fleet.port(name, "tcp"), folder) as client:
            Errand(run, name, client, folder).do()

    with ThreadPoolExecutor() as pool:
        list(pool.map(lead, KINDS))
