# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The node mavlink_vehicle_node as a process, and the odometry that its vehicles live by."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import rospy
import yaml
from nav_msgs.msg import Odometry
from trident.testing import Process, Ros, eventually, program
from trident_base.ports import free_port

PORTS = ("offboard", "offboard_remote", "gcs", "tcp", "px4_simulator", "ardupilot_json")
PERIOD_S = 0.02
Entry = dict[str, Any]


@dataclass
class Ends:
    """Where the node is.

    Attributes:
        router: its TCP port that carries all vehicles.
        ground_station: the UDP port that all vehicles send to.
    """

    router: int
    ground_station: int


def entry(name: str, kind: str, **more: object) -> Entry:
    """A vehicle on ports that nobody has."""
    ports = {f"{part}_port": free_port() for part in PORTS}
    return {"vehicle": name, "kind": kind, "autopilot": "ardupilot", **ports, **more}


def start_fleet(ros: Ros, folder: Path, *vehicles: Entry) -> tuple[Process, Ends]:
    """The node with these vehicles."""
    ends = Ends(free_port(), free_port())
    path = folder / "vehicles.yaml"
    content = {
        "vehicles": list(vehicles),
        "gcs_remote_port": ends.ground_station,
        "router_port": ends.router,
    }
    path.write_text(yaml.safe_dump(content), encoding="utf-8")
    ros.set_param("/fleet/vehicles_file", str(path))
    command = [program("trident_bridges", "mavlink_vehicle_node"), "__name:=fleet"]
    return ros.launch(command), ends


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
