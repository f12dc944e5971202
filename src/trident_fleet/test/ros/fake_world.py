#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A world of points that speaks the lockstep protocol: what the formation nodes are tested against.

Usage: fake_world.py RESULT.json VEHICLES SOURCES [SECONDS]. Vehicles UAV1.. stand 1.6 m apart and
follow their set-points with a lag. Ends when all sources have ended, or at SECONDS.
"""

from __future__ import annotations

import hashlib
import json
import struct
import sys
import threading
import time
from collections import deque
from pathlib import Path

import numpy as np
import rospy
from geometry_msgs.msg import Point, Pose, Quaternion, Twist
from rosgraph_msgs.msg import Clock
from trajectory_msgs.msg import MultiDOFJointTrajectory

from trident_msgs.msg import FleetState
from trident_msgs.srv import EnrollSource, EnrollSourceRequest, EnrollSourceResponse

PERIOD_NS = 100_000_000
STEPS = 10
FOLLOW = 0.35
WALL_LIMIT_S = 60.0


class FakeWorld:
    """Positions, the newest set-points, and who is enrolled."""

    def __init__(self, vehicles: int, sources: int) -> None:
        self.names = [f"UAV{i + 1}" for i in range(vehicles)]
        self.position = np.array([[0.0, 4.0 - 1.6 * i, 0.1] for i in range(vehicles)])
        self.sources = sources
        self.ends: dict[str, int] = {}
        self.changed = threading.Condition()
        self.inbox: list[deque[bytes]] = [deque() for _ in self.names]
        self.newest = [-1] * vehicles
        self.digest = [hashlib.sha256() for _ in self.names]
        self.messages = 0
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10, tcp_nodelay=True)
        self.fleet = rospy.Publisher("/gazebo/fleet_state", FleetState, queue_size=50, latch=True)
        for index, name in enumerate(self.names):
            rospy.Subscriber(
                f"/{name}/command/trajectory",
                rospy.AnyMsg,
                self.on_setpoint,
                callback_args=index,
                tcp_nodelay=True,
            )
        self.publish_state(0)
        rospy.Service("/gazebo/enroll_source", EnrollSource, self.on_enroll)

    def on_enroll(self, request: EnrollSourceRequest) -> EnrollSourceResponse:
        with self.changed:
            if request.enroll:
                self.ends[request.node] = request.end_time.to_nsec()
            else:
                self.ends[request.node] = min(1, self.ends.get(request.node, 1))
            self.changed.notify_all()
        return EnrollSourceResponse(True, rospy.Time(0), "")

    def on_setpoint(self, message: rospy.AnyMsg, index: int) -> None:
        seconds, nanoseconds = struct.unpack_from("<II", message._buff, 4)
        with self.changed:
            self.inbox[index].append(message._buff)
            self.newest[index] = seconds * 1_000_000_000 + nanoseconds
            self.digest[index].update(message._buff)
            self.messages += 1
            self.changed.notify_all()

    def publish_state(self, time_ns: int) -> None:
        state = FleetState()
        state.header.stamp = rospy.Time(*divmod(time_ns, 1_000_000_000))
        state.header.frame_id = "world"
        state.name = self.names
        state.pose = [Pose(Point(*p), Quaternion(0, 0, 0, 1)) for p in self.position.tolist()]
        state.twist = [Twist() for _ in self.names]
        self.fleet.publish(state)

    def wait_until(self, condition: object, what: str) -> None:
        with self.changed:
            if not self.changed.wait_for(condition, timeout=WALL_LIMIT_S):  # type: ignore[arg-type]
                raise SystemExit(f"fake_world: waited {WALL_LIMIT_S:g} s for {what}")

    def move(self, time_ns: int) -> None:
        for index, inbox in enumerate(self.inbox):
            setpoint = self.take(inbox, time_ns)
            for point in setpoint.points:
                target = point.transforms[0].translation
                error = np.array([target.x, target.y, target.z]) - self.position[index]
                self.position[index] += FOLLOW * error

    def take(self, inbox: deque[bytes], time_ns: int) -> MultiDOFJointTrajectory:
        while True:
            message = MultiDOFJointTrajectory()
            message.deserialize(inbox.popleft())
            if message.header.stamp.to_nsec() == time_ns:
                assert len(message.points) == STEPS
                return message

    def run(self, limit_ns: int) -> dict[str, object]:
        self.wait_until(lambda: len(self.ends) == self.sources, f"{self.sources} sources")
        began, time_ns = time.monotonic(), 0
        while time_ns < limit_ns and not self.is_over(time_ns) and not rospy.is_shutdown():
            self.clock.publish(rospy.Time(*divmod(time_ns, 1_000_000_000)))
            if time_ns:
                self.publish_state(time_ns)
            # Bound now: the lambda runs within this round.
            self.wait_until(lambda due=time_ns: min(self.newest) >= due, f"set-points {time_ns}")
            self.move(time_ns)
            time_ns += PERIOD_NS
        wall_s = time.monotonic() - began
        return {
            "sim_s": time_ns / 1e9,
            "wall_s": wall_s,
            "messages": self.messages,
            "position": self.position.tolist(),
            "ends": self.ends,
            "digest": [digest.hexdigest() for digest in self.digest],
        }

    def is_over(self, time_ns: int) -> bool:
        ends = list(self.ends.values())
        return all(ends) and time_ns >= max(ends)


def main() -> None:
    result, vehicles, sources = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    limit_s = float(sys.argv[4]) if len(sys.argv) > 4 else 600.0
    rospy.init_node("gazebo", disable_signals=True)
    outcome = FakeWorld(vehicles, sources).run(round(limit_s * 1e9))
    Path(result).write_text(json.dumps(outcome), encoding="utf-8")


if __name__ == "__main__":
    main()
