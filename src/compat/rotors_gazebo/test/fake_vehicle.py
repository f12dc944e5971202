# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A stand-in for simulator and controller: clock, unpause service, imu, trajectory subscriber.

Usage: fake_vehicle.py LOG. Time stands still until the service is called, then runs a hundred times
faster than the wall clock. Subscribes to ``command/trajectory`` late, when 20 s of simulated time
have passed, as a controller does that was started late. Writes one JSON object per event to LOG.
"""

import json
import sys
import threading
from typing import Any

import rospy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu
from std_srvs.srv import Empty, EmptyResponse
from trajectory_msgs.msg import MultiDOFJointTrajectory

STEP_S = 1.0  # simulated, per 10 ms of wall time
SUBSCRIBES_AT_S = 20.0


class FakeVehicle:
    """Runs the clock and writes down what it hears."""

    def __init__(self, log: str) -> None:
        self._log = log
        self._running = threading.Event()
        self._now_s = 0.0
        self._subscriber: Any = None
        self._clock = rospy.Publisher("/clock", Clock, queue_size=1)
        self._imu = rospy.Publisher("imu", Imu, queue_size=1)
        rospy.Service("/gazebo/unpause_physics", Empty, self._unpause)

    def run(self) -> None:
        """Sends clock and imu until the node is shut down."""
        stop = threading.Event()
        rospy.on_shutdown(stop.set)
        while not stop.wait(0.01):
            self._clock.publish(Clock(rospy.Time.from_sec(self._now_s)))
            if not self._running.is_set():
                continue
            self._imu.publish(Imu())
            if self._subscriber is None and self._now_s >= SUBSCRIBES_AT_S:
                self._subscriber = rospy.Subscriber(
                    "command/trajectory", MultiDOFJointTrajectory, self._heard
                )
            self._now_s += STEP_S

    def _note(self, **event: Any) -> None:
        with open(self._log, "a", encoding="utf-8") as log:
            log.write(json.dumps(event) + "\n")

    def _unpause(self, _request: Any) -> EmptyResponse:
        self._note(event="unpause")
        self._running.set()
        return EmptyResponse()

    def _heard(self, message: MultiDOFJointTrajectory) -> None:
        self._note(
            event="trajectory",
            stamp=message.header.stamp.to_sec(),
            points=[
                [
                    point.time_from_start.to_sec(),
                    point.transforms[0].translation.x,
                    point.transforms[0].translation.y,
                    point.transforms[0].translation.z,
                    point.transforms[0].rotation.z,
                    point.transforms[0].rotation.w,
                ]
                for point in message.points
            ],
        )


if __name__ == "__main__":
    rospy.init_node("fake_vehicle")
    FakeVehicle(sys.argv[1]).run()
