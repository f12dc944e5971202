# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What `./trident links` prints of a master on which a simulation with radios is registered."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("rospy", reason="ROS is not installed")
pytest.importorskip("trident_msgs.msg", reason="the workspace is not built, or not sourced")

from trident.testing.master import RosProcesses
from trident.testing.waiting import eventually

LINKS = [sys.executable, "-m", "trident_viewer.links"]
# The part of the simulator that publishes links.
PUBLISHER = """
import math, rospy
from trident_msgs.msg import LinkStatus, LinkStatusArray
rospy.init_node("links_publisher")
publisher = rospy.Publisher("/radio/links", LinkStatusArray, queue_size=1)
link = LinkStatus(source="uav1", destination="usv1", distance=60.04, snr_db=21.34, mcs=7)
link.delivered, link.dropped_air = 59, 1
deaf = LinkStatus(source="usv1", destination="uav1", distance=60.04, snr_db=-math.inf)
message = LinkStatusArray(links=[link, deaf])
message.header.stamp = rospy.Time(12, 500000000)
while not rospy.is_shutdown():
    publisher.publish(message)
    rospy.rostime.wallsleep(0.1)
"""


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[RosProcesses]:
    processes = RosProcesses(tmp_path)
    yield processes
    processes.close()


def is_published(ros: RosProcesses, topic: str) -> bool:
    _, _, (publishers, _, _) = ros.master.getSystemState("/test")
    return topic in dict(publishers)


def register(ros: RosProcesses) -> None:
    """Two robots with radios, a relayed topic and service, and a node that reads past them."""
    nowhere = "http://127.0.0.1:1"
    for robot in ("uav1", "usv1"):
        kind = "trident_msgs/LinkStatusArray"
        ros.master.registerPublisher("/gazebo", f"/{robot}/link_status", kind, nowhere)
    odometry = "nav_msgs/Odometry"
    ros.master.registerPublisher("/gazebo", "/usv1/from/uav1/odometry", odometry, nowhere)
    ros.master.registerSubscriber("/usv1/planner", "/usv1/from/uav1/odometry", odometry, nowhere)
    ros.master.registerSubscriber("/usv1/spy", "/uav1/odometry", odometry, nowhere)
    for service in ("/usv1/to/uav1/arm", "/uav1/arm"):
        ros.master.registerService("/gazebo", service, "rosrpc://127.0.0.1:1", nowhere)


TOPICS = [
    "radios: uav1, usv1",
    "relayed topics:",
    "  /usv1/from/uav1/odometry  nav_msgs/Odometry  read by /usv1/planner",
    "services by radio:",
    "  /usv1/to/uav1/arm",
    "read past the radio:",
    "  /usv1/spy  reads /uav1/odometry",
]


def test_topics_and_the_newest_links_are_listed(ros: RosProcesses) -> None:
    ros.start([sys.executable, "-c", PUBLISHER])
    eventually(lambda: is_published(ros, "/radio/links"), "a publisher of links")
    register(ros)
    code, output = ros.run(LINKS)
    assert code == 0, output
    assert output.splitlines() == [
        *TOPICS,
        "links at t = 12.500 s:",
        "  source  destination  distance [m]  SNR [dB]  MCS  delivered  lost",
        "  uav1    usv1                 60.0      21.3    7         59     1",
        "  usv1    uav1                 60.0      -inf    0          0     0",
    ]


def test_a_world_that_stands_has_topics_alone(ros: RosProcesses) -> None:
    register(ros)
    nowhere, kind = "http://127.0.0.1:1", "trident_msgs/LinkStatusArray"
    ros.master.registerPublisher("/gazebo", "/radio/links", kind, nowhere)
    code, output = ros.run(LINKS)
    assert code == 0, output
    assert output.splitlines()[: len(TOPICS)] == TOPICS
    assert "links: no message on /radio/links within 2 s; does the world stand?" in output


def test_without_radios_there_is_little_to_list(ros: RosProcesses) -> None:
    assert ros.run(LINKS) == (
        0,
        "radios: none\nrelayed topics: none\nservices by radio: none\n"
        "read past the radio: nothing\n",
    )


def test_a_master_that_does_not_answer_is_one_line(ros: RosProcesses) -> None:
    uri = "http://127.0.0.1:1"
    code, output = ros.run(LINKS, env={"ROS_MASTER_URI": uri})
    assert code == 1
    assert output.startswith(f"links: the roscore at {uri} does not answer: ")
    assert output.count("\n") == 1
