# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A whole mission in one process: robots, network, sea and people, step by step."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from py_trees.behaviour import Behaviour

from trident_fleet.core.missions.duties import ONLY, Duties
from trident_fleet.core.missions.fixed import fixed_owners
from trident_fleet.core.missions.kinds import Kind, MissionConfig
from trident_fleet.core.missions.knowledge import LOOK_S, Knowledge, SharedEyes
from trident_fleet.core.missions.nodes.base import STEP_S
from trident_fleet.core.missions.pieces import Lanes, pieces_of
from trident_fleet.core.missions.reports import Fix, TeamMessage, TeamPort
from trident_fleet.core.missions.robot import Ground, MissionRobot
from trident_fleet.core.missions.routes import Routes
from trident_fleet.core.missions.scene import Scene
from trident_fleet.core.missions.tour import shorten
from trident_fleet.core.missions.tree_file import TreePlan
from trident_fleet.core.missions.truth import Presence, Truth
from trident_fleet.core.missions.vehicle import KinematicVehicle
from trident_fleet.core.network import Channel, LinkModel
from trident_fleet.core.search.area import SearchError
from trident_fleet.core.search.detection import View
from trident_fleet.core.search.sightings import Look
from trident_fleet.core.tasks.member import Member
from trident_fleet.core.tasks.methods import method_named
from trident_fleet.core.tasks.plan import Objective, Plan
from trident_fleet.core.tasks.protocol import Team, Times

MODES: dict[str, tuple[str, ...]] = {
    "joint": ("uav", "ugv", "usv"),
    "uav": ("uav",),
    "ugv": ("ugv",),
    "usv": ("usv",),
    "three_uavs": ("uav",) * 3,
    "three_ugvs": ("ugv",) * 3,
    "three_usvs": ("usv",) * 3,
}
"""Kinds of the robots by mode."""

FIXED = "fixed"
"""The method that is none: pieces are shared out before the mission, by time."""

LINKS = ("network", "perfect")

_TIMES = Times(step_s=1.0, retry_s=1.0, lease_s=20.0, digest_s=0.5, silence_s=2.3, stagger_s=0.3)
_CURVE_S = 10.0
_ORDER_STEPS = 8  # between two looks at the order of a robot's tasks
_AT_BASE_M, _CONTACT_M = 8.0, 1.0
_SPACING_M = 3.0  # of robots of a kind at their base
_RESCUE_M = 50.0  # of detours that are expected for one who is not found yet


@dataclass(frozen=True)
class Setup:
    """What is flown.

    Attributes:
        mode: of the team, by name.
        method: of allocation, by name, or `fixed`.
        links: network or perfect.
        seed: of all that is random but the scene.
        deaths: when robots die, by name [s].
        silences: robots whose link is out: name, from, to [s].
    """

    mode: str = "joint"
    method: str = "improved"
    links: str = "network"
    seed: int = 1
    deaths: tuple[tuple[str, float], ...] = ()
    silences: tuple[tuple[str, float, float], ...] = ()

    def __post_init__(self) -> None:
        """Refuse unknown names.

        Raises:
            SearchError: names field, value and what is legal.
        """
        if self.mode not in MODES:
            raise SearchError(f"mission: mode is {self.mode!r}, legal: {', '.join(MODES)}")
        if self.links not in LINKS:
            raise SearchError(f"mission: links is {self.links!r}, legal: {', '.join(LINKS)}")
        names = names_of(self.mode)
        for name in [name for name, *_ in (*self.deaths, *self.silences)]:
            if name not in names:
                raise SearchError(f"mission: robot is {name!r}, legal: {', '.join(names)}")


@dataclass(frozen=True)
class Outcome:
    """How a mission ended; times in s, lengths in m, shares 0 ... 1.

    Attributes:
        end_s: all was done, or time was up.
        complete: all was done.
        coverage: share of the cells that have been seen well enough.
        people: how many there are.
        found: how many of them were found.
        confirmed: a robot has stood near how many.
        served: how many.
        sectors: that are covered.
        value: of all that.
        find_s: when each was found.
        way_m: of each robot.
        contacts: instants at which two of a medium touched, away from the base.
        messages: that were sent.
        curve: coverage every ten seconds.
        lost: what was not achieved, and who was lost, by name.
    """

    end_s: float
    complete: bool
    coverage: float
    people: int
    found: int
    confirmed: int
    served: int
    sectors: int
    value: float
    find_s: tuple[float, ...]
    way_m: dict[str, float]
    contacts: int
    messages: int
    curve: tuple[float, ...]
    lost: tuple[str, ...]

    @property
    def efficiency(self) -> float:
        """Value per minute [1/min]."""
        return 60.0 * self.value / self.end_s


def names_of(mode: str) -> list[str]:
    """Of the robots: the kind and a number."""
    kinds = MODES[mode]
    return [f"{kind}{kinds[: index + 1].count(kind)}" for index, kind in enumerate(kinds)]


@dataclass
class _Crew:
    """One robot with what simulates it."""

    robot: MissionRobot
    vehicle: KinematicVehicle
    tree: Behaviour
    port: TeamPort
    alive: bool = True
    cause: str = ""


class Mission:
    """Robots on a scene. Its owner steps it, or runs it to the end."""

    def __init__(self, scene: Scene, config: MissionConfig, tree: TreePlan, setup: Setup) -> None:
        """At time 0.

        Args:
            scene: that is searched.
            config: numbers of the mission.
            tree: that each robot has.
            setup: team, method, links, seed and faults.

        Raises:
            FormationError: names field, value and legal range.
        """
        self.scene, self.config, self.setup = scene, config, setup
        self.truth = Truth(scene, config, setup.seed)
        names = names_of(setup.mode)
        self._kinds = {name: _kind_named(config, name[:-1]) for name in names}
        model = config.links.model if setup.links == "network" else LinkModel(0.0, 0.0, 0.0, 0.0)
        reach = self._linked if setup.links == "network" or setup.silences else None
        self.channel: Channel[TeamMessage] = Channel(names, model, setup.seed, reach)
        self._builder = _Builder(self, tree)
        self.crews = {name: self._builder.crew(name) for name in names}
        self.duties = self._builder.duties()
        self.now_s, self._step = 0.0, 0
        self._curve: list[float] = []
        self._contacts = 0
        first = self.crews[names[0]].robot.member
        assert first.manager is not None
        first.send(first.manager.take_over(0.0))

    def run(self) -> Outcome:
        """To the end."""
        while not self.is_over():
            self.step()
        return self.outcome()

    def is_over(self) -> bool:
        """Whether all is done, or time is up."""
        return self.now_s >= self.config.rules.until_s or self.truth.is_complete()

    def step(self) -> None:
        """Half a second."""
        self._step += 1
        self.now_s = self._step * STEP_S
        self.truth.now_s = self.now_s
        self.channel.advance(self.now_s)
        for name, death_s in self.setup.deaths:
            if death_s <= self.now_s and self.crews[name].alive:
                self._die(name, f"killed at {death_s:g} s")
        alive = [crew for crew in self.crews.values() if crew.alive]
        for crew in alive:
            self._think(crew)
        views = {crew.robot.name: self._move_and_look(crew) for crew in alive}
        self.truth.drift(STEP_S)
        present = {
            crew.robot.name: Presence(crew.robot.kind, crew.vehicle.place, crew.vehicle.speed_m_s)
            for crew in alive
            if crew.alive
        }
        self.truth.tend(present, views, STEP_S)
        self._contacts += _contacts(alive)
        if self._step % round(_CURVE_S / STEP_S) == 0:
            self._curve.append(self.truth.coverage.share())

    def _think(self, crew: _Crew) -> None:
        robot, now_s = crew.robot, self.now_s
        robot.now_s = now_s
        reports = crew.port.reports()
        for report in reports:
            robot.knowledge.hear(report)
        alone = not reports and len(self.crews) > 1
        robot.alone_s = robot.alone_s + STEP_S if alone else 0.0
        robot.knowledge.update(now_s)
        self._update_plan(robot)
        if self._step % 2 == 0:
            self.duties.see_to(robot)
        robot.member.spin()
        crew.tree.tick_once()
        if self._step % 2 == 0 and len(self.crews) > 1:
            report = robot.knowledge.report(
                now_s, robot.vehicle.place, robot.doing, robot.battery.charge
            )
            crew.port.send(report)

    def _update_plan(self, robot: MissionRobot) -> None:
        """Where the robot is; a rescuer keeps time for those who are not found yet."""
        assert robot.member.robot is not None
        reserve_s = 0.0
        if robot.kind.serves:
            prior = self.config.prior
            total = prior.open_land + prior.covered + prior.water
            expected = prior.water if robot.kind.domain == "water" else total - prior.water
            left = robot.knowledge.unfound({robot.kind.domain: expected})[robot.kind.domain]
            each_s = self.config.rules.serve_s + _RESCUE_M / robot.kind.speed_m_s
            fellows = [k for k in self._kinds.values() if k.domain == robot.kind.domain]
            reserve_s = left * each_s / len(fellows)
        plan = robot.member.robot.plan
        plan.moved((*robot.vehicle.place, 0.0), self.now_s + reserve_s)
        if robot.ordered != plan.version and self._step % _ORDER_STEPS == 0:
            fixed = sum(held.asked for held in robot.member.robot.holdings.values())
            shorten(plan, robot.ground.routes, fixed, robot.rank)
            robot.ordered = plan.version

    def _move_and_look(self, crew: _Crew) -> View:
        robot, before = crew.robot, crew.vehicle.place
        crew.vehicle.step(STEP_S)
        if robot.kind.domain != "air" or robot.in_air:
            robot.battery.use(STEP_S)
        if robot.battery.left_s <= 0.0 and robot.in_air:
            self._die(robot.name, f"battery empty at {self.now_s:g} s")
        middle = tuple((a + b) / 2 for a, b in zip(before, crew.vehicle.place, strict=True))
        look, view = robot.knowledge.look(Look(self.now_s, middle[0], middle[1]))
        eye = robot.knowledge.eyes.eyes[robot.kind.name]
        for name, place in self.truth.look(robot.name, eye, view, look.time_s, LOOK_S):
            domain = next(one.domain for one in self.truth.people if one.name == name)
            robot.knowledge.detected(Fix(name, self.now_s, place, domain))
        return view

    def _die(self, name: str, cause: str) -> None:
        self.crews[name].alive, self.crews[name].cause = False, cause
        self.channel.crash(name)

    def _linked(self, source: str, destination: str, time_s: float) -> bool:
        for name, begin_s, end_s in self.setup.silences:
            if name in (source, destination) and begin_s <= time_s < end_s:
                return False
        if self.setup.links == "perfect":
            return True
        links, one, other = self.config.links, self.crews[source], self.crews[destination]
        if math.dist(one.vehicle.place, other.vehicle.place) <= links.range_m:
            return True
        return any(
            relay.alive
            and relay.robot.in_air
            and not self._is_silent(relay.robot.name, time_s)
            and math.dist(relay.vehicle.place, one.vehicle.place) <= links.relay_range_m
            and math.dist(relay.vehicle.place, other.vehicle.place) <= links.relay_range_m
            for relay in self.crews.values()
        )

    def _is_silent(self, name: str, time_s: float) -> bool:
        return any(
            robot == name and begin_s <= time_s < end_s
            for robot, begin_s, end_s in self.setup.silences
        )

    def outcome(self) -> Outcome:
        """How it stands now."""
        truth = self.truth
        found = [one.found_s for one in truth.people if one.found_s is not None]
        lost = [f"{name}: {crew.cause}" for name, crew in self.crews.items() if not crew.alive]
        lost += [f"{one.name}: not found" for one in truth.people if one.found_s is None]
        lost += [
            f"{one.name}: not served"
            for one in truth.people
            if one.found_s is not None and one.served_s is None
        ]
        return Outcome(
            self.now_s,
            truth.is_complete(),
            truth.coverage.share(),
            len(truth.people),
            len(found),
            sum(one.confirmed_s is not None for one in truth.people),
            sum(one.served_s is not None for one in truth.people),
            truth.sectors_covered(),
            truth.value(),
            tuple(found),
            {name: crew.vehicle.way_m for name, crew in self.crews.items()},
            self._contacts,
            self.channel.counts["sent"],
            tuple(self._curve),
            tuple(lost),
        )


def _kind_named(config: MissionConfig, name: str) -> Kind:
    if name not in config.kinds:
        raise SearchError(f"mission: kind {name!r} is unknown, legal: {', '.join(config.kinds)}")
    return config.kinds[name]


def _band_m(kinds: dict[str, Kind], wet: bool) -> float:
    """Height of bands: what the widest of those that search there covers in one pass [m]."""
    domains = ("air", "water" if wet else "ground")
    lanes = [
        kind.lane_water_m if wet else kind.lane_land_m
        for kind in kinds.values()
        if kind.domain in domains
    ]
    return max(lanes, default=60.0)


def _contacts(crews: Sequence[_Crew]) -> int:
    """Pairs in one medium that are closer than they may be, away from where they start."""
    count = 0
    for index, one in enumerate(crews):
        for other in crews[:index]:
            same = one.robot.kind.domain == other.robot.kind.domain
            near = math.dist(one.vehicle.place, other.vehicle.place) < _CONTACT_M
            away = math.dist(one.vehicle.place, one.robot.home) > _AT_BASE_M
            count += same and near and away
    return count


@dataclass
class _Builder:
    """Makes what the robots of a mission have in common, and the robots."""

    mission: Mission
    tree: TreePlan
    grounds: dict[str, Ground] = field(default_factory=dict)

    def __post_init__(self) -> None:
        mission = self.mission
        scene, config, setup = mission.scene, mission.config, mission.setup
        kinds = {kind.name: kind for kind in mission._kinds.values()}
        self._eyes = SharedEyes(scene.area, config)
        pieces = pieces_of(scene.area, _band_m(kinds, False), _band_m(kinds, True))
        self._pieces = {piece.name: piece for piece in pieces}
        for name, kind in kinds.items():
            routes = Routes(scene.area, kind.domain)
            lanes = Lanes(scene.area, kind, routes)
            work_m = {piece.place: lanes.work_m(piece) for piece in pieces}
            self.grounds[name] = Ground(routes, lanes, self._pieces, work_m)
        self._owners: dict[str, str] = {}
        if setup.method == FIXED:
            self._owners = fixed_owners(pieces, mission._kinds, self.grounds)
        self._method = method_named("plain" if setup.method == FIXED else setup.method)
        robots = {}
        for name, kind in mission._kinds.items():
            can = kind.capabilities()
            robots[name] = type(can)(
                can.domain, (*can.skills, ONLY + name), speed_m_s=can.speed_m_s
            )
        self._team = Team(robots, tuple(mission._kinds), _TIMES)

    def crew(self, name: str) -> _Crew:
        """A robot at its base, and what simulates it."""
        mission = self.mission
        kind = mission._kinds[name]
        x, y = mission.scene.bases[kind.domain]
        fellows = [other for other, one in mission._kinds.items() if one.domain == kind.domain]
        vehicle = KinematicVehicle((x + _SPACING_M * fellows.index(name), y), kind.speed_m_s)
        port = TeamPort(mission.channel.port(name))
        ground = self.grounds[kind.name]
        plan = Plan(
            name,
            self._team.robots[name],
            (*vehicle.place, 0.0),
            ground.travel,
            Objective.MAKESPAN,
        )
        member = Member(port.tasks, self._team, self._method, plan)
        names = {other: one.name for other, one in mission._kinds.items()}
        knowledge = Knowledge(self._eyes, mission.config, names, name)
        expected = len(mission.scene.people)
        robot = MissionRobot(
            kind, vehicle, ground, knowledge, member, mission.config.rules, expected
        )
        return _Crew(robot, vehicle, self.tree.grow(robot), port)

    def duties(self) -> Duties:
        """Of whoever manages."""
        mission = self.mission
        return Duties(
            self._pieces.values(),
            mission.scene.covers,
            mission._kinds,
            mission.config.rules,
            self._owners,
        )
