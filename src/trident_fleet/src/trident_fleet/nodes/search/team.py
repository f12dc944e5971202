# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The node of a team: flies the mission core with the simulator's robots, on simulated time.

One node for all robots, as the network between them is the mission's own (`links:=network`): who
hears whom depends on where all of them are, and every loss and delay on the seed alone. So a run
comes out the same each time, and as in one process, but for the motion of the robots.

In each period of set-points the node says what holds for the next one. Every half second the
mission's robots look about from where they are now, and decide.
"""

from __future__ import annotations

import threading
from pathlib import Path

import rospy

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.missions.building import Crew
from trident_fleet.core.missions.guided import Garage, GuidedVehicle
from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.mission import Mission
from trident_fleet.core.missions.nodes.base import STEP_S
from trident_fleet.core.missions.record import Flown, Record, write_flown
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.missions.setup import RECORD, names_of
from trident_fleet.core.missions.vehicle import SteppedVehicle
from trident_fleet.core.schedule import FeedConfig
from trident_fleet.core.settings import FleetSettings, Vehicle
from trident_fleet.nodes.search.robots import AirRobot, GroundRobot, SeaRobot, TeamRobot
from trident_fleet.nodes.search.settings import TeamSettings
from trident_fleet.nodes.search.states import TeamState, TeamStates
from trident_fleet.nodes.world_link import SimulatorClient

PERIOD_NS = 100_000_000
_DECISION = round(STEP_S * NS_PER_S) // PERIOD_NS  # periods from decision to decision
_STANDS_S, _LONGEST_S, _REPORT_S, _POLL_S = 1.0, 16.0, 10.0, 0.1
_SAID_S = 60.0  # simulated, from one line about the mission to the next


class TeamNode:
    """One mission, from its beginning to its end."""

    def __init__(self, settings: TeamSettings, out_dir: Path | None) -> None:
        """Read who there is.

        Args:
            settings: of the mission.
            out_dir: where its record goes; None: nowhere.

        Raises:
            FormationError: a kind of robot is missing in the mission's numbers.
        """
        self._settings, self._out_dir = settings, out_dir
        names = names_of(settings.setup.mode)
        self._vehicles = [Vehicle(name, f"/{name}/", index) for index, name in enumerate(names)]
        self._states = TeamStates(names)
        self._robots: dict[str, TeamRobot] = {}
        self._record, self._doing = Record(), dict[str, str]()
        self._over = threading.Event()
        rospy.on_shutdown(self._over.set)

    def run(self) -> None:
        """Fly until the mission is over, or the node is shut down.

        Raises:
            FormationError: the simulator offers no lockstep, or the record cannot be written.
        """
        first = self._first_state()
        if first is None:
            return
        link = self._enroll()
        mission = self._mission(first)
        self._wait_for_controllers()
        state: TeamState | None = first
        while state is not None and not self._is_over_at(mission, state):
            state = self._next_state()
        if state is not None:
            self._end(mission, link, state)

    def _first_state(self) -> TeamState | None:
        """All robots in the world, which stands until this node has enrolled."""
        waited_s = 0.0
        while not self._over.is_set():
            if state := self._states.next(_STANDS_S):
                return state
            waited_s += _STANDS_S
            if waited_s % _REPORT_S == 0.0:
                rospy.logwarn("not in the world yet: %s", ", ".join(self._states.missing))
        return None

    def _next_state(self) -> TeamState | None:
        """The next one; while the world stands, what was said is said again."""
        wait_s = _STANDS_S
        while not self._over.is_set():
            if state := self._states.next(wait_s):
                return state
            wait_s = min(2.0 * wait_s, _LONGEST_S)
            for robot in self._robots.values():
                robot.repeat()
        return None

    def _enroll(self) -> SimulatorClient:
        """The world waits for the set-points of all but those on wheels, whose answers it counts.

        Raises:
            FormationError: it does not, or time runs already.
        """
        fed = self._fed()
        feed = FeedConfig(PERIOD_NS, PERIOD_NS)
        fleet = FleetSettings(FormationSource("search and rescue"), feed=feed)
        link = SimulatorClient(self._vehicles, fed or self._vehicles, fleet)
        if not link.wait_for_simulator() or not link.is_lockstep:
            raise FormationError("the simulator offers no lockstep; legal: one that does")
        start_ns = link.enroll()
        if not fed:
            link.withdraw()
        if start_ns != PERIOD_NS:
            raise FormationError(
                f"the world is at {start_ns / NS_PER_S:g} s; legal: at 0, wait_for_sources is 1"
            )
        return link

    def _fed(self) -> list[Vehicle]:
        """The robots that are commanded by set-points: all but those on wheels."""
        kinds = self._settings.config.kinds
        return [one for one in self._vehicles if kinds[one.name[:-1]].domain != "ground"]

    def _mission(self, first: TeamState) -> Mission:
        settings = self._settings
        garage = Garage(settings.scene.area)

        def make(name: str, kind: Kind, _base: Place) -> SteppedVehicle:
            vehicle = garage.guided(kind, first.motion[name].place)
            vehicle.measured(first.motion[name])
            self._robots[name] = _robot(name, kind, vehicle, first)
            return vehicle

        return Mission(settings.scene, settings.config, settings.tree, settings.setup, make)

    def _wait_for_controllers(self) -> None:
        """The world stands meanwhile."""
        waited = 0
        while not self._over.wait(0.02):
            silent = [name for name, robot in self._robots.items() if not robot.is_connected]
            if not silent:
                return
            waited += 1
            if waited % 500 == 0:
                rospy.logwarn("nobody takes the commands of %s yet", ", ".join(silent))

    def _is_over_at(self, mission: Mission, state: TeamState) -> bool:
        """Take in a state and say what follows; whether the mission has come to its end."""
        for name, robot in self._robots.items():
            robot.vehicle.measured(state.motion[name])
        period = state.stamp_ns // PERIOD_NS
        if period % _DECISION == 0:
            if period:
                mission.observe()
                self._record.note(mission)
                self._say(mission)
                if mission.is_over():
                    return True
            for name, robot in self._robots.items():
                robot.vehicle.people = _people_on_land(mission.crews[name])
            mission.decide()
        self._command(mission, state.stamp_ns + PERIOD_NS)
        return False

    def _command(self, mission: Mission, stamp_ns: int) -> None:
        for name, robot in self._robots.items():
            crew = mission.crews[name]
            robot.command(stamp_ns, crew.alive, crew.robot.in_air)

    def _say(self, mission: Mission) -> None:
        """What each robot is about, when that changes, and now and then how all stands."""
        for name, crew in mission.crews.items():
            doing = crew.robot.doing if crew.alive else crew.cause
            if doing and doing != self._doing.get(name):
                self._doing[name] = doing
                x, y = crew.vehicle.place
                rospy.loginfo("%.1f s: %s at (%.0f, %.0f): %s", mission.now_s, name, x, y, doing)
        if mission.now_s % _SAID_S:
            return
        now = mission.outcome()
        rospy.loginfo(
            "%.0f s: coverage %.1f %%, %d found, %d served of %d",
            now.end_s,
            100.0 * now.coverage,
            now.found,
            now.served,
            now.people,
        )

    def _end(self, mission: Mission, link: SimulatorClient, state: TeamState) -> None:
        """Leave the record, and let the world end when the last commands do."""
        self._record.end(mission)
        if self._out_dir is not None:
            write_flown(self._out_dir / RECORD, self._flown(mission))
        end_ns = state.stamp_ns + PERIOD_NS
        grounded = [one for one in self._robots.values() if isinstance(one, GroundRobot)]
        if len(grounded) < len(self._robots):
            link.enroll(end_ns)
            self._wait_for_end()
        for robot in grounded:
            # It stands at the question that is not answered, until this node has ended the launch.
            robot.wait_for_question(end_ns)

    def _flown(self, mission: Mission) -> Flown:
        settings, truth = self._settings, mission.truth
        return Flown(
            settings.scene_file,
            settings.setup,
            settings.whole,
            mission.outcome(),
            self._record,
            truth.people,
            truth.places,
        )

    def _wait_for_end(self) -> None:
        """Return when the simulator is gone, or this node ends."""
        while self._states.has_simulator and not self._over.wait(_POLL_S):
            pass


def _people_on_land(crew: Crew) -> list[Place]:
    """Of whom a robot knows."""
    people = crew.robot.knowledge.people.values()
    return [fix.place for fix in people if fix.domain == "ground"]


def _robot(name: str, kind: Kind, vehicle: GuidedVehicle, state: TeamState) -> TeamRobot:
    if kind.domain == "water":
        return SeaRobot(name, vehicle, kind)
    if kind.domain == "ground":
        return GroundRobot(name, vehicle, kind, PERIOD_NS)
    yaw_rad = state.motion[name].yaw_rad
    return AirRobot(name, vehicle, kind, state.position[name], yaw_rad, PERIOD_NS)
