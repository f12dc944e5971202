# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The node mavlink_vehicle_node as a process, and the odometry that its vehicles live by."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import rospy
from nav_msgs.msg import Odometry
from trident.testing import Process, Ros, eventually, program
from trident.testing.mavlink_vehicles import Entry, VehiclesFile, write_vehicles

PERIOD_S = 0.02


def start_fleet(ros: Ros, folder: Path, *vehicles: Entry) -> tuple[Process, VehiclesFile]:
    """The node with these vehicles, which may not be up yet."""
    file = write_vehicles(folder, *vehicles)
    ros.set_param("/fleet/vehicles_file", str(file.path))
    command = [program("trident_bridges", "mavlink_vehicle_node"), "__name:=fleet"]
    return ros.launch(command), file


@contextmanager
def standing_still(*topics: str) -> Iterator[None]:
    """Odometry of vehicles that stand at the origin, at 50 Hz, until the end."""
    publishers = [rospy.Publisher(topic, Odometry, queue_size=10) for topic in topics]
    over = threading.Event()

    def publish() -> None:
        message = Odometry()
        message.header.frame_id = "world"
        message.pose.pose.orientation.w = 1.0
        begin = time.monotonic()
        while not over.wait(PERIOD_S):
            message.header.stamp = rospy.Time(time.monotonic() - begin + 1.0)
            for publisher in publishers:
                publisher.publish(message)

    for publisher in publishers:
        eventually(lambda one=publisher: one.get_num_connections() > 0, "the node listens")  # type: ignore[misc]
    thread = threading.Thread(target=publish)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
        for publisher in publishers:
            publisher.unregister()
