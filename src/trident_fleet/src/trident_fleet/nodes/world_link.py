# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator as a formation node sees it: lockstep enrolment, clock and measured states."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import rospy
from geometry_msgs.msg import Pose
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array
from trident_fleet.core.settings import FleetSettings, Vehicle
from trident_msgs.msg import FleetState
from trident_msgs.srv import EnrollSource
from trident_ros import Refusals, is_offered, point_problem, quoted, stamp_problem

SIMULATOR = "/gazebo"
_ENROLL = SIMULATOR + "/enroll_source"
_SPAWN = SIMULATOR + "/spawn_urdf_model"
_MODEL_STATE = SIMULATOR + "/get_model_state"
_CONFESSION = SIMULATOR + "/not_repeatable"
_POLL_S = 0.05
_ASK_S = 1.0
_REPORT_S = 10.0
LONGEST_JUMP_NS = 600 * NS_PER_S  # commanding a flight through it takes seconds
_JUMP_PATIENCE = 20
_UNEQUAL = "names, poses and twists are not equally many"

StateCallback = Callable[[int, Array], None]
ClockCallback = Callable[[int], None]


def foreign_problem(message: Any) -> str:
    """What is wrong with a message that is not the simulator's; "": it is."""
    sender = message._connection_header["callerid"]
    if sender == SIMULATOR:
        return ""
    return f"it is from {quoted(sender)}, legal: from {SIMULATOR}, which waits for this node"


@dataclass(frozen=True)
class SpawnState:
    """Where the vehicles stood when the last one was there.

    Attributes:
        stamp_ns: simulated time of the newest state [ns]; 0 where states have no stamp.
        position: p_world [m], shape (N, 3).
    """

    stamp_ns: int
    position: Array


class SimulatorClient:
    """One node's line to the simulator.

    Attributes:
        is_lockstep: whether the simulator waits for this node's set-points.
    """

    def __init__(
        self, vehicles: list[Vehicle], fed: list[Vehicle], settings: FleetSettings
    ) -> None:
        """Remember who is who; nothing is called yet.

        Args:
            vehicles: the whole formation.
            fed: those that this node commands.
            settings: of the formation.
        """
        self._vehicles = vehicles
        self._fed = fed
        self._settings = settings
        self._spawn_states: rospy.Subscriber | None = None
        self._refusals: Refusals | None = None  # made when there is one
        self._time_ns = -1  # that is believed; -1: none yet
        self._jumps = 0  # messages in a row that are far ahead of it
        self._confession: rospy.Publisher | None = None
        self.is_lockstep = False

    def enroll(self, end_ns: int = 0, waits_beyond_end: bool = False) -> int:
        """Enrol this node's vehicles in the lockstep, or announce when it ends.

        Args:
            end_ns: last instant at which the world has to wait [ns]; 0: not known yet.
            waits_beyond_end: the run may end at `end_ns`; while it continues because of others, the
                world waits for this node.

        Returns:
            Stamp of the first set-point [ns].

        Raises:
            FormationError: the simulator refuses.
        """
        wait_for_service(_ENROLL)
        answer = rospy.ServiceProxy(_ENROLL, EnrollSource)(
            node=rospy.get_name(),
            vehicles=[vehicle.name for vehicle in self._fed],
            period=rospy.Duration(0, self._settings.feed.period_ns),
            end_time=rospy.Time(*divmod(end_ns, NS_PER_S)),
            enroll=True,
            waits_beyond_end=waits_beyond_end,
        )
        if not answer.success:
            raise FormationError(f"{_ENROLL}: refused: {answer.message}")
        return int(answer.start_time.to_nsec())

    def withdraw(self) -> None:
        """Be there, so that a world that waits for all sources can start, but feed nothing.

        Errors are only logged: there is nothing left to save.
        """
        if self.is_lockstep:
            try:
                self.enroll(end_ns=max(self.enroll(), 1))
            except (FormationError, rospy.ServiceException, rospy.ROSException) as error:
                rospy.loginfo("withdrawing from the lockstep: %s", error)

    def wait_for_simulator(self) -> bool:
        """Wait for a simulator, and find out whether it offers lockstep.

        Returns:
            False if the node was shut down while waiting.
        """
        began = reported = time.monotonic()
        plain_since = None
        while not rospy.is_shutdown():
            if is_offered(_ENROLL):
                self.is_lockstep = True
                return True
            now = time.monotonic()
            if plain_since is None and is_offered(_SPAWN):
                # Ours offers lockstep before it offers this, so that it is never taken for another.
                plain_since = now
            if plain_since is not None and now - plain_since > self._settings.enroll_wait_s:
                rospy.logwarn("no service %s: this simulator does not wait for set-points", _ENROLL)
                self.is_lockstep = False
                return True
            if now - reported > _REPORT_S:
                rospy.logwarn("no simulator after %.0f s, still waiting", now - began)
                reported = now
            time.sleep(_POLL_S)
        return False

    def wait_for_spawn(self) -> SpawnState | None:
        """Wait until all vehicles are in the world.

        The subscription of the fleet's states stays open until `close_states`: the simulator
        notices a new one within milliseconds, in which a fast world makes many steps.

        Returns:
            None if the node was shut down while waiting.
        """
        found: dict[str, Array] = {}
        stamp_ns = [0]
        is_done: list[bool] = []
        names = [vehicle.name for vehicle in self._vehicles]

        def on_state(state: FleetState) -> None:
            if is_done or self._is_refused(state):
                return
            stamp_ns[0] = state.header.stamp.to_nsec()
            found.update(_positions_by_name(state.name, state.pose))

        topic = SIMULATOR + "/fleet_state"
        subscriber = rospy.Subscriber(topic, FleetState, on_state, tcp_nodelay=True)
        self.close_states()
        self._spawn_states = subscriber
        reported = asked = time.monotonic()
        known = 0
        while not rospy.is_shutdown():
            missing = [name for name in names if name not in found]
            if not missing:
                is_done.append(True)
                return SpawnState(stamp_ns[0], np.array([found[name] for name in names]))
            now = time.monotonic()
            if len(found) > known:
                known, asked = len(found), now
            if now - asked > _ASK_S:
                # A world that stands still may have nothing to publish.
                found.update(_ask_for_poses(missing))
                asked = now
            if now - reported > _REPORT_S:
                rospy.logwarn("not in the world yet: %s", ", ".join(missing))
                reported = now
            time.sleep(_POLL_S)
        return None

    def not_repeatable(self, why: str) -> None:
        """Have the run say that the wall clock has decided something here."""
        if self._confession is None:
            self._confession = rospy.Publisher(_CONFESSION, String, queue_size=10, latch=True)
        self._confession.publish(String(why))

    def close_states(self) -> None:
        """A flight that needs no states costs none."""
        if self._spawn_states is not None:
            self._spawn_states.unregister()
            self._spawn_states = None

    def wait_for_publisher(self, subscribers: list[rospy.Subscriber]) -> None:
        """Wait until these are connected: the first set-point may let the world run away.

        In lockstep without a limit, for the world stands meanwhile; else the flight continues
        after it. Both are logged.
        """
        limit_s = self._settings.connect_wait_s
        logged_s = time.monotonic()
        for subscriber in subscribers:
            while not subscriber.get_num_connections() and not rospy.is_shutdown():
                if time.monotonic() - logged_s > limit_s:
                    rospy.logwarn("%s: nobody publishes it yet", subscriber.resolved_name)
                    if not self.is_lockstep:
                        return
                    logged_s = time.monotonic()
                time.sleep(_POLL_S)

    def on_clock(self, callback: ClockCallback) -> rospy.Subscriber:
        """Call back with simulated time [ns], the newest there is."""

        def on_message(message: Clock) -> None:
            # Who answers the simulator's messages would end its flight by a stranger's reset.
            problem = foreign_problem(message) if self.is_lockstep else ""
            problem = problem or self._time_problem(message.clock)
            if problem:
                self.refuse("/clock", problem)
                return
            callback(message.clock.to_nsec())

        return rospy.Subscriber("/clock", Clock, on_message, queue_size=1, tcp_nodelay=True)

    def on_state(self, callback: StateCallback) -> list[rospy.Subscriber]:
        """Call back with stamp [ns] and positions [m, world], shape (N, 3), once per period."""

        def on_message(state: FleetState) -> None:
            if not self._is_refused(state):
                stamp_ns = state.header.stamp.to_nsec()
                callback(stamp_ns, self._in_order(state.name, state.pose))

        if self.is_lockstep:
            topic = SIMULATOR + "/fleet_state"
            return [rospy.Subscriber(topic, FleetState, on_message, tcp_nodelay=True)]
        return self._on_model_states(callback)

    def _on_model_states(self, callback: StateCallback) -> list[rospy.Subscriber]:
        """The same from gazebo_ros' unstamped states, at the first clock of each period."""
        # Imported here, as below: only a plain Gazebo pays for it.
        from gazebo_msgs.msg import ModelStates

        newest: list[ModelStates] = []
        period_ns = self._settings.feed.period_ns
        last_index = [-1]

        def keep(states: ModelStates) -> None:
            if len(states.name) == len(states.pose):
                newest[:] = [states]
            else:
                self.refuse("model_states", _UNEQUAL)

        def tick(now_ns: int) -> None:
            index = now_ns // period_ns
            if newest and index != last_index[0]:
                last_index[0] = index
                callback(index * period_ns, self._in_order(newest[0].name, newest[0].pose))

        states = rospy.Subscriber(SIMULATOR + "/model_states", ModelStates, keep, queue_size=1)
        return [states, self.on_clock(tick)]

    def _is_refused(self, state: FleetState) -> bool:
        problem = self._time_problem(state.header.stamp)
        if not problem and not len(state.name) == len(state.pose) == len(state.twist):
            problem = _UNEQUAL
        if problem:
            self.refuse("fleet_state", problem)
        return bool(problem)

    def _time_problem(self, stamp: rospy.Time) -> str:
        """What is wrong with a stamp of simulated time, if anything.

        A jump ahead, through which a flight would be commanded, does not count unless time
        continues from there.
        """
        problem = stamp_problem(stamp)
        if problem:
            return problem
        now_ns = stamp.to_nsec()
        is_jump = self._time_ns >= 0 and now_ns - self._time_ns > LONGEST_JUMP_NS
        self._jumps = self._jumps + 1 if is_jump else 0
        if is_jump and self._jumps < _JUMP_PATIENCE:
            return f"time jumps ahead by {(now_ns - self._time_ns) / NS_PER_S:g} s"
        self._time_ns = now_ns
        return ""

    def refuse(self, what: str, problem: str) -> None:
        """Say, and count, that a message is not believed."""
        if self._refusals is None:
            self._refusals = Refusals()
        self._refusals.note(f"{what} refused", f"{what} refused: {problem}")

    def _in_order(self, names: list[str], poses: list[Pose]) -> Array:
        by_name = _positions_by_name(names, poses)
        gone = np.full(3, np.nan)
        return np.array([by_name.get(vehicle.name, gone) for vehicle in self._vehicles])


def wait_for_service(name: str) -> None:
    """Return when a service is there, however long that takes; logs what it waits for.

    Raises:
        rospy.ROSInterruptException: the node is shut down.
    """
    while not rospy.is_shutdown():
        try:
            rospy.wait_for_service(name, timeout=_REPORT_S)
        except rospy.ROSInterruptException:
            raise
        except rospy.ROSException:
            rospy.logwarn("no answer from service %s yet, still waiting", name)
        else:
            return
    raise rospy.ROSInterruptException("rospy shutdown")


def _positions_by_name(names: list[str], poses: list[Pose]) -> dict[str, Array]:
    """Positions by name; an illegal position counts as a missing one."""
    return {
        name: np.array([pose.position.x, pose.position.y, pose.position.z])
        for name, pose in zip(names, poses, strict=True)
        if not point_problem(name, pose.position)
    }


def _ask_for_poses(names: list[str]) -> dict[str, Array]:
    from gazebo_msgs.srv import GetModelState

    found = {}
    for name in names:
        try:
            answer = rospy.ServiceProxy(_MODEL_STATE, GetModelState)(name, "")
        except (rospy.ServiceException, rospy.ROSException):
            break
        if answer.success:
            found.update(_positions_by_name([name], [answer.pose]))
    return found
