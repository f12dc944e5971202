# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A whole mission in one process: robots, network, sea and people, step by step."""

from __future__ import annotations

import math
from collections.abc import Sequence

from trident_fleet.core.missions.building import Builder, Crew, kind_named
from trident_fleet.core.missions.kinds import MissionConfig
from trident_fleet.core.missions.knowledge import LOOK_S
from trident_fleet.core.missions.nodes.base import STEP_S
from trident_fleet.core.missions.reports import Fix, TeamMessage
from trident_fleet.core.missions.robot import MissionRobot
from trident_fleet.core.missions.scene import Place, Scene
from trident_fleet.core.missions.setup import MODES, Outcome, Setup, names_of
from trident_fleet.core.missions.tour import shorten
from trident_fleet.core.missions.tree_file import TreePlan
from trident_fleet.core.missions.truth import Presence, Truth
from trident_fleet.core.missions.vehicle import VehicleMaker, kinematic
from trident_fleet.core.network import Channel, LinkModel
from trident_fleet.core.search.detection import NOTHING, View
from trident_fleet.core.search.sightings import Look

__all__ = ["MODES", "Mission", "Outcome", "Setup", "names_of"]

_CURVE_S = 10.0
_ORDER_STEPS = 8  # between two looks at the order of a robot's tasks
_AT_BASE_M, _CONTACT_M = 8.0, 1.0
_RESCUE_M = 50.0  # of detours that are expected for one who is not found yet


class Mission:
    """Robots on a scene. Its owner steps it, or runs it to the end."""

    def __init__(
        self,
        scene: Scene,
        config: MissionConfig,
        tree: TreePlan,
        setup: Setup,
        make_vehicle: VehicleMaker = kinematic,
    ) -> None:
        """At time 0.

        Args:
            scene: that is searched.
            config: numbers of the mission.
            tree: that each robot has.
            setup: team, method, links, seed and faults.
            make_vehicle: of each robot; models of vehicles unless somebody has real ones.

        Raises:
            FormationError: names field, value and legal range.
        """
        self.scene, self.config, self.setup = scene, config, setup
        self.truth = Truth(scene, config, setup.seed)
        names = names_of(setup.mode)
        self._kinds = {name: kind_named(config, name[:-1]) for name in names}
        model = config.links.model if setup.links == "network" else LinkModel(0.0, 0.0, 0.0, 0.0)
        reach = self._linked if setup.links == "network" or setup.silences else None
        self.channel: Channel[TeamMessage] = Channel(names, model, setup.seed, reach)
        builder = Builder(scene, config, tree, setup, self._kinds, make_vehicle)
        self.crews = {name: builder.crew(name, self.channel) for name in names}
        self.duties = builder.duties()
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
        """Half a second: all decide, move and look about."""
        self.decide()
        self.observe()

    def decide(self) -> None:
        """A step begins: messages come, robots die, and those alive set out."""
        self._step += 1
        self.now_s = self._step * STEP_S
        self.truth.now_s = self.now_s
        self.channel.advance(self.now_s)
        for name, death_s in self.setup.deaths:
            if death_s <= self.now_s and self.crews[name].alive:
                self._die(name, f"killed at {death_s:g} s")
        for crew in self.crews.values():
            if crew.alive:
                self._think(crew)

    def observe(self) -> None:
        """It ends: vehicles have moved, and see what they passed."""
        alive = [crew for crew in self.crews.values() if crew.alive]
        views = {crew.robot.name: self._move_and_look(crew) for crew in alive}
        self.truth.drift(STEP_S)
        self.truth.tend(_present(alive), views, STEP_S)
        self._contacts += _contacts(alive)
        if self._step % round(_CURVE_S / STEP_S) == 0:
            self._curve.append(self.truth.coverage.share())

    def _think(self, crew: Crew) -> None:
        robot = crew.robot
        robot.now_s = self.now_s
        self._hear_reports(crew)
        robot.knowledge.update(self.now_s)
        self._update_plan(robot)
        if self._step % 2 == 0:
            self.duties.see_to(robot)
        robot.member.spin()
        crew.tree.tick_once()
        if self._step % 2 == 0 and len(self.crews) > 1:
            _send_report(crew)

    def _hear_reports(self, crew: Crew) -> None:
        """A robot learns what others know, and for how long it has heard nobody."""
        reports = crew.port.reports()
        for report in reports:
            crew.robot.knowledge.hear(report)
        alone = not reports and len(self.crews) > 1
        crew.robot.alone_s = crew.robot.alone_s + STEP_S if alone else 0.0

    def _update_plan(self, robot: MissionRobot) -> None:
        """Where the robot is; a rescuer keeps time for those who are not found yet."""
        assert robot.member.robot is not None
        plan = robot.member.robot.plan
        plan.moved((*robot.vehicle.place, 0.0), self.now_s + self._reserve_s(robot))
        if robot.ordered != plan.version and self._step % _ORDER_STEPS == 0:
            fixed = sum(held.asked for held in robot.member.robot.holdings.values())
            shorten(plan, robot.ground.routes, fixed, robot.rank)
            robot.ordered = plan.version

    def _reserve_s(self, robot: MissionRobot) -> float:
        """The time that a rescuer keeps for those who are not found yet [s]."""
        if not robot.kind.serves:
            return 0.0
        unfound = robot.knowledge.unfound()
        afloat = robot.kind.domain == "water"
        left = unfound["water"] if afloat else unfound["open"] + unfound["cover"]
        each_s = self.config.rules.serve_s + _RESCUE_M / robot.kind.speed_m_s
        fellows = [k for k in self._kinds.values() if k.domain == robot.kind.domain]
        return left * each_s / len(fellows)

    def _use_battery(self, robot: MissionRobot) -> None:
        if robot.kind.domain != "air" or robot.in_air:
            robot.battery.use(STEP_S)
        if robot.battery.left_s <= 0.0 and robot.in_air:
            self._die(robot.name, f"battery empty at {self.now_s:g} s")

    def _move_and_look(self, crew: Crew) -> View:
        robot, before = crew.robot, crew.vehicle.place
        crew.vehicle.step(STEP_S)
        self._use_battery(robot)
        if not crew.vehicle.looks:
            return NOTHING
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
        if self._is_silent(source, time_s) or self._is_silent(destination, time_s):
            return False
        if self.setup.links == "perfect":
            return True
        ends = (self.crews[source].vehicle.place, self.crews[destination].vehicle.place)
        if math.dist(*ends) <= self.config.links.range_m:
            return True
        return any(self._may_relay(crew, ends, time_s) for crew in self.crews.values())

    def _may_relay(self, relay: Crew, ends: Sequence[Place], time_s: float) -> bool:
        """Whether a robot in the air passes on what is said between two places."""
        if not relay.alive or not relay.robot.in_air or self._is_silent(relay.robot.name, time_s):
            return False
        range_m = self.config.links.relay_range_m
        return all(math.dist(relay.vehicle.place, end) <= range_m for end in ends)

    def _is_silent(self, name: str, time_s: float) -> bool:
        return any(
            robot == name and begin_s <= time_s < end_s
            for robot, begin_s, end_s in self.setup.silences
        )

    def outcome(self) -> Outcome:
        """How it stands now."""
        truth = self.truth
        found = [one.found_s for one in truth.people if one.found_s is not None]
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
            {name: crew.vehicle.path_m for name, crew in self.crews.items()},
            self._contacts,
            self.channel.counts["sent"],
            tuple(self._curve),
            (*self._lost_robots(), *self._lost_people()),
        )

    def _lost_robots(self) -> list[str]:
        return [f"{name}: {crew.cause}" for name, crew in self.crews.items() if not crew.alive]

    def _lost_people(self) -> list[str]:
        """Whom nobody has found, and who was found and not served."""
        people = self.truth.people
        lost = [f"{one.name}: not found" for one in people if one.found_s is None]
        lost += [
            f"{one.name}: not served"
            for one in people
            if one.found_s is not None and one.served_s is None
        ]
        return lost


def _present(crews: Sequence[Crew]) -> dict[str, Presence]:
    """The robots that are still alive, as others see them."""
    return {
        crew.robot.name: Presence(crew.robot.kind, crew.vehicle.place, crew.vehicle.speed_m_s)
        for crew in crews
        if crew.alive
    }


def _send_report(crew: Crew) -> None:
    """The others get to know where a robot is, what it does, and what it knows."""
    robot = crew.robot
    report = robot.knowledge.report(
        robot.now_s, robot.vehicle.place, robot.doing, robot.battery.charge
    )
    crew.port.send(report)


def _contacts(crews: Sequence[Crew]) -> int:
    """Pairs in one medium that are closer than they may be, away from where they start."""
    count = 0
    for index, one in enumerate(crews):
        for other in crews[:index]:
            same = one.robot.kind.domain == other.robot.kind.domain
            near = math.dist(one.vehicle.place, other.vehicle.place) < _CONTACT_M
            away = math.dist(one.vehicle.place, one.robot.home) > _AT_BASE_M
            count += same and near and away
    return count
