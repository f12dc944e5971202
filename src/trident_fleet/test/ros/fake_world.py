#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A world of points that follow their set-points with a lag: what the nodes are tested against.

Usage: fake_world.py RESULT.json VEHICLES SOURCES KIND

KIND `lockstep` speaks the lockstep protocol and ends when all sources have ended; `plain` is like
Gazebo: it offers model states and a spawn service, waits for nobody, and ends when the vehicles
have moved along x and come to rest.
"""

from __future__ import annotations

import hashlib
import json
import struct
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import rospy
from gazebo_msgs.msg import ModelStates
from gazebo_msgs.srv import GetModelState, GetModelStateResponse
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Empty
from trajectory_msgs.msg import MultiDOFJointTrajectory

from trident_msgs.msg import FleetState
from trident_msgs.srv import EnrollSource, EnrollSourceRequest, EnrollSourceResponse

PERIOD_NS = 100_000_000
STEPS = 10
FOLLOW = 0.35
PLAIN_PERIOD_WALL_S = 0.02


class World:
    """Positions of the vehicles, and the set-points that came for them."""

    def __init__(self, vehicles: int) -> None:
        self.names = [f"UAV{i + 1}" for i in range(vehicles)]
        self.position = np.array([[0.0, 4.0 - 1.6 * i, 0.1] for i in range(vehicles)])
        self.velocity = np.zeros((vehicles, 3))
        self.changed = threading.Condition()
        self.inbox: list[deque[bytes]] = [deque() for _ in self.names]
        self.newest = [-1] * vehicles
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10, tcp_nodelay=True)
        for index, name in enumerate(self.names):
            topic = f"/{name}/command/trajectory"
            rospy.Subscriber(topic, rospy.AnyMsg, self.on_setpoint, index, tcp_nodelay=True)

    def on_setpoint(self, message: rospy.AnyMsg, index: int) -> None:
        with self.changed:
            self.inbox[index].append(message._buff)
            self.newest[index] = stamp_ns(message._buff)
            self.changed.notify_all()

    def publish_clock(self, time_ns: int) -> None:
        self.clock.publish(rospy.Time(*divmod(time_ns, 1_000_000_000)))

    def poses(self) -> list[Pose]:
        return [Pose(Point(*p), Quaternion(0, 0, 0, 1)) for p in self.position.tolist()]

    def twists(self) -> list[Twist]:
        return [Twist(linear=Vector3(*v)) for v in self.velocity.tolist()]

    def follow(self, index: int, raw: bytes) -> None:
        message = MultiDOFJointTrajectory()
        message.deserialize(raw)
        assert len(message.points) == STEPS
        before = self.position[index].copy()
        for point in message.points:
            target = point.transforms[0].translation
            error = np.array([target.x, target.y, target.z]) - self.position[index]
            self.position[index] += FOLLOW * error
        self.velocity[index] = (self.position[index] - before) / (PERIOD_NS / 1e9)


class LockstepWorld(World):
    """Does not pass a period before every vehicle has a set-point for it."""

    def __init__(self, vehicles: int, sources: int) -> None:
        super().__init__(vehicles)
        self.sources = sources
        self.ends: dict[str, int] = {}
        self.waits_beyond_end: dict[str, bool] = {}  # is waited for beyond its end
        self.source_of: dict[str, str] = {}
        self.flown = [hashlib.sha256() for _ in self.names]
        self.fleet = rospy.Publisher("/gazebo/fleet_state", FleetState, queue_size=50, latch=True)
        self.publish_state(0)
        rospy.Service("/gazebo/enroll_source", EnrollSource, self.on_enroll)

    def on_enroll(self, request: EnrollSourceRequest) -> EnrollSourceResponse:
        with self.changed:
            self.ends[request.node] = request.end_time.to_nsec()
            self.waits_beyond_end[request.node] = request.waits_beyond_end
            self.source_of.update(dict.fromkeys(request.vehicles, request.node))
            self.changed.notify_all()
        return EnrollSourceResponse(True, rospy.Time(0), "")

    def publish_state(self, time_ns: int) -> None:
        state = FleetState()
        state.header.stamp = rospy.Time(*divmod(time_ns, 1_000_000_000))
        state.header.frame_id = "world"
        state.name = self.names
        state.pose = self.poses()
        state.twist = self.twists()
        self.fleet.publish(state)

    def wait_until(self, condition: Callable[[], bool], what: str) -> None:
        """However long it takes: the test that has started this knows for how long."""
        print(f"fake_world: waits for {what}", flush=True)
        with self.changed:
            self.changed.wait_for(condition)

    def run(self) -> dict[str, Any]:
        self.wait_until(lambda: len(self.ends) == self.sources, f"{self.sources} sources")
        began, time_ns = time.monotonic(), 0
        while True:
            self.publish_clock(time_ns)
            if time_ns:
                self.publish_state(time_ns)
            self.wait_until(lambda now=time_ns: self.may_pass(now), f"set-points for {time_ns} ns")
            if self.is_over(time_ns):
                break
            for index in self.fed_at(time_ns):
                self.follow(index, self.take(index, time_ns))
            time_ns += PERIOD_NS
        wall_s = time.monotonic() - began
        return {
            "sim_s": time_ns / 1e9,
            "wall_s": wall_s,
            "digest": [digest.hexdigest() for digest in self.flown],
        }

    def may_pass(self, time_ns: int) -> bool:
        fed = self.fed_at(time_ns)
        return all(self.newest[index] >= time_ns for index in fed) or self.is_over(time_ns)

    def fed_at(self, time_ns: int) -> list[int]:
        """Vehicles whose source has not ended before the others."""
        sources = [self.source_of[name] for name in self.names]
        last = max(self.ends.values())
        early = [
            not self.waits_beyond_end[source] and 0 < self.ends[source] < min(time_ns + 1, last)
            for source in sources
        ]
        return [index for index, is_early in enumerate(early) if not is_early]

    def is_over(self, time_ns: int) -> bool:
        ends = list(self.ends.values())
        # A source that ends before the first period does not fly at all.
        return all(ends) and time_ns + PERIOD_NS > max(ends)

    def take(self, index: int, time_ns: int) -> bytes:
        while True:
            raw = self.inbox[index].popleft()
            if stamp_ns(raw) == time_ns:
                self.flown[index].update(raw)
                return raw


class PlainWorld(World):
    """Runs at its own pace, like Gazebo: nobody is waited for."""

    def __init__(self, vehicles: int) -> None:
        super().__init__(vehicles)
        self.states = rospy.Publisher("/gazebo/model_states", ModelStates, queue_size=10)
        rospy.Service("/gazebo/spawn_urdf_model", Empty, lambda _: None)
        rospy.Service("/gazebo/get_model_state", GetModelState, self.on_get)

    def on_get(self, request: Any) -> GetModelStateResponse:
        response = GetModelStateResponse()
        response.success = request.model_name in self.names
        if response.success:
            response.pose = self.poses()[self.names.index(request.model_name)]
        return response

    def run(self) -> dict[str, Any]:
        time_ns, early, resting = 0, 0, 0
        begin = self.position.copy()
        while resting < 20:
            self.publish_clock(time_ns)
            self.states.publish(ModelStates(self.names, self.poses(), [Twist()] * len(self.names)))
            time.sleep(PLAIN_PERIOD_WALL_S)
            before = self.position.copy()
            with self.changed:
                early += sum(newest > time_ns for newest in self.newest)
                for index, inbox in enumerate(self.inbox):
                    if inbox:
                        self.follow(index, inbox.pop())
                        inbox.clear()
            has_left = np.abs(self.position - begin)[:, 0].min() > 0.5
            is_still = np.abs(self.position - before).max() < 1e-4
            resting = resting + 1 if has_left and is_still else 0
            time_ns += PERIOD_NS
        return {"sim_s": time_ns / 1e9, "early": early}


def stamp_ns(raw: bytes) -> int:
    seconds, nanoseconds = struct.unpack_from("<II", raw, 4)
    return int(seconds) * 1_000_000_000 + int(nanoseconds)


def main() -> None:
    result, vehicles, sources, kind = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
    rospy.init_node("gazebo", disable_signals=True)
    world = PlainWorld(vehicles) if kind == "plain" else LockstepWorld(vehicles, sources)
    outcome = world.run() | {"position": world.position.tolist()}
    Path(result).write_text(json.dumps(outcome), encoding="utf-8")


if __name__ == "__main__":
    main()
