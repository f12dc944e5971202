# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node hold_at: takes a simulation to a simulated time, to the step, and leaves it paused there."""

from __future__ import annotations

import argparse
import math
import sys
import time
import xmlrpc.client
from collections.abc import Iterator
from typing import Any

import rosgraph
import rospy
from gazebo_msgs.srv import GetPhysicsProperties, GetWorldProperties
from std_srvs.srv import Empty

from trident_msgs.srv import Step
from trident_ros import LATEST_STAMP_S, init_node
from trident_viewer.launch_nodes import wait_for_nodes

_START_LIMIT_S = 300.0  # on a loaded machine; the user who has started it sees it end
_NODES_LIMIT_S = 300.0
_TRIES = 20
_POLL_S = 0.1
_CHUNK_S = 0.05  # of simulated time, so that a viewer can follow
_PACE = 5.0
_SHORTEST_STEP_S = 1e-6


def _checked(name: str, value_s: float, least_s: float) -> float:
    """A time of a service's answer [s].

    Raises:
        rospy.ROSException: it is not one.
    """
    if not least_s <= value_s <= LATEST_STAMP_S:
        legal = f"{least_s:g} to {LATEST_STAMP_S:g} s"
        raise rospy.ROSException(f"the simulator's {name} is {value_s:g} s, legal: {legal}")
    return value_s


class Held:
    """A simulation that is stepped by this node."""

    def __init__(self) -> None:
        """Wait for the simulator.

        Raises:
            rospy.ROSException: it does not exist, or reports an invalid time.
        """
        rospy.wait_for_service("/gazebo/step", _START_LIMIT_S)
        self._pause = rospy.ServiceProxy("/gazebo/pause_physics", Empty)
        self._step = rospy.ServiceProxy("/gazebo/step", Step)
        self._world = rospy.ServiceProxy("/gazebo/get_world_properties", GetWorldProperties)
        physics = rospy.ServiceProxy("/gazebo/get_physics_properties", GetPhysicsProperties)
        self.pause()
        self.dt_s = _checked("time_step", float(physics().time_step), _SHORTEST_STEP_S)

    def pause(self) -> None:
        """Pause it, also if somebody else has unpaused it, and note where it stands."""
        self._pause()
        self.time_s = _checked("sim_time", float(self._world().sim_time), 0.0)

    def step_once(self) -> None:
        """Continue by a step; errors as `advance_to`."""
        self.advance_to(self.time_s + self.dt_s, math.inf)

    def advance_to(self, time_s: float, pace: float) -> None:
        """Go there step by step; a node of the launch may unpause the world meanwhile.

        Args:
            time_s: simulated time [s].
            pace: how many times faster than real time, at most; inf: as fast as it goes.

        Raises:
            rospy.ROSException: it is past that; it refuses, or stands still, however often it is
                paused.
        """
        refused = 0
        begin, begin_s = time.monotonic(), self.time_s
        while not rospy.is_shutdown():
            left = round((time_s - self.time_s) / self.dt_s)
            if left < 0:
                raise rospy.ROSException(f"it is {self.time_s:.3f} s already, past {time_s:.3f} s")
            due = begin + (self.time_s - begin_s) / pace
            time.sleep(max(0.0, due - time.monotonic()))
            if left == 0:
                return
            response = self._step(n=min(left, max(1, round(_CHUNK_S / self.dt_s))))
            time_after_s = response.sim_time.to_sec()
            if response.success and time_after_s > self.time_s:
                self.time_s, refused = time_after_s, 0
                continue
            refused += 1
            if refused == _TRIES:
                raise rospy.ROSException(
                    f"it stands at {self.time_s:.3f} s: {response.message or 'it does not step'}"
                )
            self.pause()
        raise rospy.ROSInterruptException("interrupted")


def wait_for_viewer() -> None:
    """Wait until an rviz listens to transforms, and everyone whose topics it shows sends to it.

    Raises:
        rospy.ROSException: none comes within the limit.
    """
    give_up = time.monotonic() + _START_LIMIT_S
    while not rospy.is_shutdown():
        unsent = _topics_not_sent_to_viewer()
        if unsent is not None and not unsent:
            return
        if time.monotonic() > give_up:
            if unsent is None:
                raise rospy.ROSException(f"no rviz within {_START_LIMIT_S:g} s")
            rospy.logwarn("rviz does not receive %s", ", ".join(sorted(unsent)))
            return
        time.sleep(_POLL_S)


def _topics_not_sent_to_viewer() -> set[str] | None:
    """Topics that an rviz has subscribed to and a publisher does not send to it yet.

    Returns:
        None: no rviz listens to transforms.
    """
    master = rosgraph.Master(rospy.get_name())
    publishers, subscribers, _ = master.getSystemState()
    readers = dict(subscribers)
    viewers = {node for node in readers.get("/tf", []) if node.startswith("/rviz")}
    if not viewers:
        return None
    wanted = {topic: viewers.intersection(nodes) for topic, nodes in readers.items()}
    return set(_unsent(master, publishers, wanted))


def _unsent(
    master: rosgraph.Master, publishers: list[tuple[str, list[str]]], wanted: dict[str, set[str]]
) -> Iterator[str]:
    """Topics that a publisher does not send to all nodes that want them."""
    sent = {node: _sent_by(master, node) for _, nodes in publishers for node in nodes}
    for topic, nodes in publishers:
        if not all((topic, one) in sent[node] for one in wanted.get(topic, ()) for node in nodes):
            yield topic


def _sent_by(master: rosgraph.Master, node: str) -> set[tuple[str, str]]:
    """Topics that a node sends and to whom, by its own account; nothing if it has ended."""
    try:
        server: Any = xmlrpc.client.ServerProxy(master.lookupNode(node))
        links = server.getBusInfo(rospy.get_name())[2]
    except (OSError, xmlrpc.client.Error, rosgraph.MasterException):
        return set()
    return {(link[4], link[1]) for link in links if link[2] == "o"}


def main(arguments: list[str] | None = None) -> int:
    """Run to the end.

    Returns:
        0: the world stands at the time; 1: it cannot, because it is past it or not there.
    """
    parser = argparse.ArgumentParser(prog="hold_at", description=__doc__)
    parser.add_argument("time_s", type=float, metavar="SECONDS", help="simulated time")
    parser.add_argument(
        "--viewer",
        action="store_true",
        help="first wait for an rviz, which then sees the steps until then",
    )
    parser.add_argument(
        "--nodes",
        type=int,
        default=0,
        metavar="N",
        help="first wait until so many nodes of roslaunch are up, so that none acts too late",
    )
    parser.add_argument(
        "--pace",
        type=float,
        default=_PACE,
        metavar="FACTOR",
        help="times real time, at most, so that nodes that are not waited for keep up; 0: any",
    )
    options = parser.parse_args(rospy.myargv(arguments or sys.argv)[1:])
    init_node("hold_at", anonymous=True)
    try:
        held = Held()
        if options.nodes:
            wait_for_nodes(options.nodes, _NODES_LIMIT_S, held.pause)
        if options.viewer:
            wait_for_viewer()
        held.advance_to(options.time_s, options.pace or math.inf)
        return 0
    except (rospy.ROSException, rospy.ServiceException) as error:
        rospy.logerr("the simulation cannot be held: %s", error)
    return 1
