# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where the robots of a team are, instant by instant, as the simulator says."""

from __future__ import annotations

import math
import queue
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
import rospy
from geometry_msgs.msg import Pose, Twist

from trident_fleet.core.missions.guided import Motion
from trident_fleet.core.quintic import Array
from trident_fleet.nodes.world_link import SIMULATOR, foreign_problem
from trident_msgs.msg import FleetState
from trident_ros import Refusals, point_problem, stamp_problem


@dataclass(frozen=True)
class TeamState:
    """All robots at one instant.

    Attributes:
        stamp_ns: of it, simulated [ns].
        motion: of each by name.
        position: p_world of each [m], shape (3,).
    """

    stamp_ns: int
    motion: dict[str, Motion]
    position: dict[str, Array]


class TeamStates:
    """The states of a team in the order of time, each once, as soon as all robots are there."""

    def __init__(self, names: Collection[str]) -> None:
        """Subscribe, after rospy.init_node()."""
        self._names, self._newest_ns = list(names), -1
        self._states: queue.SimpleQueue[TeamState] = queue.SimpleQueue()
        self._refusals: Refusals | None = None  # made when there is one
        self.missing = list(names)
        self._subscriber = rospy.Subscriber(
            f"{SIMULATOR}/fleet_state", FleetState, self._take, tcp_nodelay=True
        )

    @property
    def has_simulator(self) -> bool:
        """Whether somebody publishes the states."""
        return bool(self._subscriber.get_num_connections())

    def next(self, wait_s: float) -> TeamState | None:
        """The next one; None: none comes within so much wall time [s]."""
        try:
            return self._states.get(timeout=wait_s)
        except queue.Empty:
            return None

    def _take(self, state: FleetState) -> None:
        problem = _problem(state)
        number = dict(zip(state.name, range(len(state.name)), strict=True))
        self.missing = [name for name in self._names if name not in number]
        if not problem and not self.missing:
            problem = self._use(state, number)
        if problem:
            self._refuse(problem)

    def _refuse(self, problem: str) -> None:
        if self._refusals is None:
            self._refusals = Refusals()
        self._refusals.note("fleet_state refused", f"fleet_state refused: {problem}")

    def _use(self, state: FleetState, number: dict[str, int]) -> str:
        """Hand a state on; returns what is wrong with it."""
        stamp_ns = state.header.stamp.to_nsec()
        motion, position = {}, {}
        for name in self._names:
            pose, twist = state.pose[number[name]], state.twist[number[name]]
            if problem := point_problem(name, pose.position):
                return problem
            motion[name] = motion_of(pose, twist)
            position[name] = np.array([pose.position.x, pose.position.y, pose.position.z])
        if stamp_ns > self._newest_ns:
            self._newest_ns = stamp_ns
            self._states.put(TeamState(stamp_ns, motion, position))
        return ""


def _problem(state: FleetState) -> str:
    """What is wrong with a state as a whole; "": nothing."""
    problem = foreign_problem(state) or stamp_problem(state.header.stamp)
    if not problem and not len(state.name) == len(state.pose) == len(state.twist):
        return "names, poses and twists are not equally many"
    return problem


def motion_of(pose: Pose, twist: Twist) -> Motion:
    """Of a robot from its pose and its velocity in the world's frame."""
    q = pose.orientation
    yaw_rad = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    place = (float(pose.position.x), float(pose.position.y))
    speed_m_s = math.hypot(twist.linear.x, twist.linear.y)
    return Motion(place, float(pose.position.z), yaw_rad, speed_m_s)
