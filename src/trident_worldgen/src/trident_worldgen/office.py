# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""An office floor: rooms along corridors that form two loops, furnished by a seed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from trident_worldgen.checks import require, require_seed
from trident_worldgen.placing import free_place
from trident_worldgen.sdf import Files, Material, StaticModel, world_text

WALL = Material("Gazebo/White")
FRAME = Material("Gazebo/DarkGrey")
WOOD = Material("Gazebo/Wood")
CABINET = Material("Gazebo/Grey")
CHAIR = Material("Gazebo/Blue")

_DESK = (1.4, 0.7, 0.74)  # x, y, z [m]; the top is 3 cm thick
_CABINET = (0.9, 0.45, 1.8)
_CHAIR_RADIUS, _CHAIR_HEIGHT = 0.25, 0.45
_LINTEL_M = 2.1
_DOOR_CLEARANCE_M = 1.0
_GAP_M = 0.8  # kept between furniture, for a robot
_TRIES = 30


@dataclass(frozen=True)
class OfficeConfig:
    """Sizes of the floor [m].

    Attributes:
        seed: decides the widths of rooms, their doors and their furniture.
        length: along x, between the outer walls.
        width: along y, between the outer walls.
        corridor: width of the corridors.
        door: width of the doors.
        wall: thickness of the walls.
        height: of the walls.
    """

    seed: int = 1
    length: float = 40.0
    width: float = 25.0
    corridor: float = 2.4
    door: float = 1.0
    wall: float = 0.15
    height: float = 2.5

    def validate(self) -> None:
        """Raises Error naming the field, its value and what is legal."""
        require_seed(self.seed)
        require("corridor", self.corridor, 1.0, 6.0)
        require("length", self.length, 20.0 + 3.0 * self.corridor, 200.0)
        require("width", self.width, 13.0 + 2.0 * self.corridor, 100.0)
        require("door", self.door, 0.6, 2.5)
        require("wall", self.wall, 0.05, 0.5)
        require("height", self.height, 2.2, 10.0)


@dataclass(frozen=True)
class Room:
    """A rectangle between walls, with one door.

    Attributes:
        x: from and to, between the walls' middles [m].
        y: as x [m].
        door_x: middle of the door [m].
        door_north: whether the door is in the wall at the larger y.
        is_last: whether no other room follows along x.
    """

    x: tuple[float, float]
    y: tuple[float, float]
    door_x: float
    door_north: bool
    is_last: bool


def office(config: OfficeConfig | None = None) -> Files:
    """`office.world`.

    Raises:
        Error: an illegal configuration.
    """
    config = config or OfficeConfig()
    config.validate()
    random = np.random.default_rng([config.seed, 0x0FF1CE])
    rooms = _rooms(config, random)
    building = StaticModel("building")
    _outer_walls(building, config)
    for number, room in enumerate(rooms):
        _front_wall(building, f"room{number}", room, config)
        _other_walls(building, f"room{number}", room, config)
    furniture = StaticModel("furniture")
    for number, room in enumerate(rooms):
        _furnish(furniture, f"room{number}", room, config, random)
    comment = (
        f"An office of {config.length:g} m x {config.width:g} m: {len(rooms)} rooms along "
        f"corridors of {config.corridor:g} m that form two loops. "
        f"Made by ./trident worldgen office, seed {config.seed}"
    )
    return {"office.world": world_text(comment, [building, furniture])}


def rooms_of(config: OfficeConfig) -> list[Room]:
    """The rooms that `office` builds."""
    config.validate()
    return _rooms(config, np.random.default_rng([config.seed, 0x0FF1CE]))


def _rooms(config: OfficeConfig, random: np.random.Generator) -> list[Room]:
    """Two outer rows over the whole length, and two blocks between the corridors."""
    x, y, c = config.length / 2, config.width / 2, config.corridor
    inner = y - (config.width - 2 * c) / 3  # where the outer rows end
    rows = [
        ((-x, x), (inner, y), False),
        ((-x, x), (-y, -inner), True),
    ]
    for begin, end in ((-x + c, -c / 2), (c / 2, x - c)):
        middle = float(random.uniform(-0.6, 0.6))
        rows.append(((begin, end), (middle, inner - c), True))
        rows.append(((begin, end), (-inner + c, middle), False))
    rooms = []
    for (begin, end), across, door_north in rows:
        edges = _divided(begin, end, random)
        for left, right in pairwise(edges):
            margin = config.wall + config.door / 2 + 0.2
            door = float(random.uniform(left + margin, right - margin))
            rooms.append(Room((left, right), across, door, door_north, right == edges[-1]))
    return rooms


def _divided(begin: float, end: float, random: np.random.Generator) -> list[float]:
    """From begin to end in parts of about 5 m, 3.5 m at least."""
    count = max(1, round((end - begin) / 5.0))
    parts = random.uniform(0.8, 1.25, count)
    edges = begin + np.concatenate([[0.0], np.cumsum(parts / parts.sum())]) * (end - begin)
    return [begin, *map(float, edges[1:-1]), end]


def _outer_walls(model: StaticModel, config: OfficeConfig) -> None:
    x, y, t, z = config.length / 2, config.width / 2, config.wall, config.height
    for name, sign in (("north", 1), ("south", -1)):
        size = (config.length + 2 * t, t, z)
        model.box(f"{name}", size, (0.0, sign * (y + t / 2), z / 2), WALL)
    for name, sign in (("east", 1), ("west", -1)):
        model.box(f"{name}", (t, config.width, z), (sign * (x + t / 2), 0.0, z / 2), WALL)


def _front_wall(model: StaticModel, name: str, room: Room, config: OfficeConfig) -> None:
    """The wall with the door."""
    t, z = config.wall, config.height
    at = room.y[1] if room.door_north else room.y[0]
    begin, end = room.door_x - config.door / 2, room.door_x + config.door / 2
    # The ends touch the walls across.
    for side, low, high in (("a", room.x[0] - t / 2, begin), ("b", end, room.x[1] + t / 2)):
        model.box(f"{name}_{side}", (high - low, t, z), ((low + high) / 2, at, z / 2), WALL)
    above = z - _LINTEL_M
    center = (room.door_x, at, _LINTEL_M + above / 2)
    model.box(f"{name}_lintel", (config.door, t, above), center, FRAME)


def _other_walls(model: StaticModel, name: str, room: Room, config: OfficeConfig) -> None:
    """Those to the sides and the back that are neither outer ones nor another room's."""
    (left, right), (low, high) = room.x, room.y
    t, z = config.wall, config.height
    sides = [("west", left)] if abs(left) < config.length / 2 else []
    if room.is_last and right < config.length / 2:
        sides.append(("east", right))
    for side, x in sides:
        model.box(f"{name}_{side}", (t, high - low - t, z), (x, (low + high) / 2, z / 2), WALL)
    if room.door_north and abs(low) < config.width / 2:
        size = (right - left + t, t, z)
        model.box(f"{name}_back", size, ((left + right) / 2, low, z / 2), WALL)


def _furnish(
    model: StaticModel, name: str, room: Room, config: OfficeConfig, random: np.random.Generator
) -> None:
    """Desks with chairs, and cabinets along the walls, away from each other and from the door."""
    taken: list[tuple[float, float, float]] = []  # x, y, radius
    at = room.y[1] if room.door_north else room.y[0]
    taken.append((room.door_x, at, _DOOR_CLEARANCE_M))
    area = (room.x[1] - room.x[0]) * (room.y[1] - room.y[0])
    for number in range(max(1, round(area / 12.0))):
        yaw = float(random.integers(0, 2)) * math.pi / 2
        place = _free_place(room, 0.9, taken, config, random)
        if place is not None:
            _desk(model, f"{name}_desk{number}", place, yaw)
    for number in range(int(random.integers(1, 3))):
        place = _free_place(room, 0.55, taken, config, random)
        if place is not None:
            _cabinet(model, f"{name}_cabinet{number}", place, random)


def _cabinet(
    model: StaticModel, name: str, place: tuple[float, float], random: np.random.Generator
) -> None:
    """Along x or y, by chance."""
    size = _CABINET if random.integers(0, 2) else (_CABINET[1], _CABINET[0], _CABINET[2])
    model.box(name, size, (*place, size[2] / 2), CABINET)


def _free_place(
    room: Room,
    radius: float,
    taken: list[tuple[float, float, float]],
    config: OfficeConfig,
    random: np.random.Generator,
) -> tuple[float, float] | None:
    """A disc within the room that leaves a path around it; None: there is hardly any space."""
    inset = config.wall / 2 + radius + 0.05

    def is_free(x: float, y: float) -> bool:
        return all(math.hypot(x - u, y - v) > radius + r + _GAP_M for u, v, r in taken)

    x_range, y_range = ((side[0] + inset, side[1] - inset) for side in (room.x, room.y))
    place = free_place(random, x_range, y_range, is_free, _TRIES)
    if place is not None:
        taken.append((*place, radius))
    return place


def _desk(model: StaticModel, name: str, place: tuple[float, float], yaw: float) -> None:
    """A top on two side panels, and a chair before it."""
    x, y = place
    length, depth, height = _DESK
    c, s = math.cos(yaw), math.sin(yaw)
    top = 0.03
    model.box(f"{name}_top", (length, depth, top), (x, y, height - top / 2), WOOD, yaw=yaw)
    for side, sign in (("left", 1), ("right", -1)):
        along = sign * (length - top) / 2
        center = (x + c * along, y + s * along, (height - top) / 2)
        model.box(f"{name}_{side}", (top, depth, height - top), center, WOOD, yaw=yaw)
    ahead = depth / 2 + 0.15
    center = (x - s * ahead, y + c * ahead, _CHAIR_HEIGHT / 2)
    model.cylinder(f"{name}_chair", _CHAIR_RADIUS, _CHAIR_HEIGHT, center, CHAIR)
