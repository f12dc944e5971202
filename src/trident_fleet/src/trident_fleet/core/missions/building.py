# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the robots of a mission, and what they have in common."""

from __future__ import annotations

from dataclasses import dataclass, field

from trident_fleet.core.missions.duties import ONLY, Duties
from trident_fleet.core.missions.fixed import fixed_owners
from trident_fleet.core.missions.kinds import Kind, MissionConfig
from trident_fleet.core.missions.knowledge import Knowledge, SharedEyes
from trident_fleet.core.missions.pieces import Lanes, pieces_of
from trident_fleet.core.missions.reports import TeamMessage, TeamPort
from trident_fleet.core.missions.robot import Ground, MissionRobot
from trident_fleet.core.missions.routes import Routes
from trident_fleet.core.missions.scene import Scene
from trident_fleet.core.missions.setup import FIXED, Setup
from trident_fleet.core.missions.tree_file import Tree, TreePlan
from trident_fleet.core.missions.vehicle import SteppedVehicle, VehicleMaker, kinematic
from trident_fleet.core.network import Channel
from trident_fleet.core.search.area import SearchError
from trident_fleet.core.tasks.fields import Capabilities
from trident_fleet.core.tasks.member import Member
from trident_fleet.core.tasks.methods import method_named
from trident_fleet.core.tasks.plan import Objective, Plan
from trident_fleet.core.tasks.protocol import Team, Times

_TIMES = Times(step_s=1.0, retry_s=1.0, lease_s=20.0, digest_s=0.5, silence_s=2.3, stagger_s=0.3)
# Who flies loses more by turns than by sectors that are covered in part when time is up.
_AIR_PIECE_M, _PIECE_M = 134.0, 100.0
_SPACING_M = 3.0  # of robots of a kind at their base


@dataclass
class Crew:
    """One robot with what simulates it.

    Attributes:
        robot: it.
        vehicle: that carries it.
        tree: that decides.
        port: its network.
        alive: whether it works.
        cause: why it does not.
    """

    robot: MissionRobot
    vehicle: SteppedVehicle
    tree: Tree
    port: TeamPort
    alive: bool = True
    cause: str = ""


@dataclass
class Builder:
    """Makes what the robots of a mission have in common, and the robots."""

    scene: Scene
    config: MissionConfig
    tree: TreePlan
    setup: Setup
    kinds: dict[str, Kind]
    make_vehicle: VehicleMaker = kinematic
    grounds: dict[str, Ground] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Routes, lanes and pieces."""
        scene, config, setup = self.scene, self.config, self.setup
        kinds = {kind.name: kind for kind in self.kinds.values()}
        self._eyes = SharedEyes(scene.area, config)
        bands_m = _band_m(kinds, False), _band_m(kinds, True)
        pieces = pieces_of(scene.area, *bands_m, _length_m(kinds))
        self._pieces = {piece.name: piece for piece in pieces}
        for name, kind in kinds.items():
            self.grounds[name] = self._ground(kind)
        self._owners: dict[str, str] = {}
        if setup.method == FIXED:
            self._owners = fixed_owners(pieces, self.kinds, self.grounds)
        self._method = method_named("plain" if setup.method == FIXED else setup.method)
        self._team = Team(_capabilities(self.kinds), tuple(self.kinds), _TIMES)

    def _ground(self, kind: Kind) -> Ground:
        """What the robots of a kind share of the area."""
        routes = Routes(self.scene.area, kind.domain)
        lanes = Lanes(self.scene.area, kind, routes)
        work_m = {piece.place: lanes.work_m(piece) for piece in self._pieces.values()}
        return Ground(routes, lanes, self._pieces, work_m)

    def crew(self, name: str, channel: Channel[TeamMessage]) -> Crew:
        """A robot at its base, and what simulates it."""
        kind = self.kinds[name]
        x, y = self.scene.bases[kind.domain]
        fellows = [other for other, one in self.kinds.items() if one.domain == kind.domain]
        place = (x + _SPACING_M * fellows.index(name), y)
        vehicle = self.make_vehicle(name, kind, place)
        port = TeamPort(channel.port(name))
        ground = self.grounds[kind.name]
        plan = Plan(
            name,
            self._team.robots[name],
            (*vehicle.place, 0.0),
            ground.travel,
            Objective.MAKESPAN,
        )
        member = Member(port.tasks, self._team, self._method, plan)
        names = {other: one.name for other, one in self.kinds.items()}
        knowledge = Knowledge(self._eyes, self.config, names, name)
        expected = len(self.scene.people)
        robot = MissionRobot(kind, vehicle, ground, knowledge, member, self.config.rules, expected)
        return Crew(robot, vehicle, self.tree.grow(robot), port)

    def duties(self) -> Duties:
        """Of each robot that may manage."""
        return Duties(
            self._pieces.values(),
            self.scene.covers,
            self.kinds,
            self.config.rules,
            self._owners,
        )


def _capabilities(kinds: dict[str, Kind]) -> dict[str, Capabilities]:
    """What the robots can do, and the skill that each has alone."""
    robots = {}
    for name, kind in kinds.items():
        can = kind.capabilities()
        robots[name] = type(can)(can.domain, (*can.skills, ONLY + name), speed_m_s=can.speed_m_s)
    return robots


def kind_named(config: MissionConfig, name: str) -> Kind:
    """A kind of robot.

    Raises:
        SearchError: the name is unknown.
    """
    if name not in config.kinds:
        raise SearchError(f"mission: kind {name!r} is unknown, legal: {', '.join(config.kinds)}")
    return config.kinds[name]


def _length_m(kinds: dict[str, Kind]) -> float:
    """Length of pieces [m]."""
    return _AIR_PIECE_M if any(kind.domain == "air" for kind in kinds.values()) else _PIECE_M


def _band_m(kinds: dict[str, Kind], wet: bool) -> float:
    """Height of bands: what the widest of those that search there covers in one pass [m]."""
    domains = ("air", "water" if wet else "ground")
    lanes = [
        kind.lane_water_m if wet else kind.lane_land_m
        for kind in kinds.values()
        if kind.domain in domains
    ]
    return max(lanes, default=60.0)
