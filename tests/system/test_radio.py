# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Robots talk by radio over topics, see their links, and lose them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import rospy
from harness import Gazebo, eventually, logged_problems, pose, recorder

from trident_msgs.msg import LinkStatusArray, RadioPacket
from trident_msgs.srv import SetOutage

WORLD = """<sdf version="1.6"><world name="meadow"><gravity>0 0 0</gravity>
<plugin name="air" filename="libtrident_radio_medium.so"><path>free_space</path></plugin>
</world></sdf>"""

ROBOT = """<robot name="robot"><link name="base_link"><inertial><mass value="1"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<gazebo><plugin name="radio" filename="libtrident_radio.so"/></gazebo></robot>"""


def test_packets_links_and_outages(
    start_gazebo: Callable[..., Gazebo], tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    world = tmp_path / "meadow.world"
    world.write_text(WORLD, encoding="utf-8")
    gazebo = start_gazebo(world).ready()
    gazebo.spawn("rover", ROBOT, pose(z=1.0))
    gazebo.spawn("boat", ROBOT, pose(x=60.0, z=1.0))
    send = rospy.Publisher("/rover/radio/send", RadioPacket, queue_size=10)
    request.addfinalizer(send.unregister)
    outage = rospy.ServiceProxy("/radio/outage", SetOutage)
    with (
        recorder("/boat/radio/receive", RadioPacket) as received,
        recorder("/radio/links", LinkStatusArray) as links,
        recorder("/rover/link_status", LinkStatusArray) as status,
    ):
        eventually(lambda: send.get_num_connections() == 1, "a reader of packets")

        def step_until(is_so: Callable[[], bool], what: str) -> None:
            eventually(lambda: gazebo.step(10) > 0.0 and is_so(), what)

        send.publish(RadioPacket(destination="boat", topic="pose", id=7, data=b"\x00\x01\xff"))
        step_until(lambda: bool(received.messages), "the packet")
        packet = received.messages[0]
        assert (packet.source, packet.destination, packet.topic) == ("rover", "boat", "pose")
        assert (packet.id, bytes(packet.data)) == (7, b"\x00\x01\xff")
        step_until(lambda: bool(links.messages) and bool(status.messages), "the links")
        assert [(link.source, link.destination) for link in links.messages[-1].links] == [
            ("boat", "rover"),
            ("rover", "boat"),
        ]
        (link,) = status.messages[-1].links
        assert link.up
        assert link.distance == pytest.approx(60.0, abs=0.01)
        assert list(link.route) == ["rover", "boat"]
        answer = outage("boat", "", rospy.Duration(3600))
        assert answer.success, answer.message
        step_until(lambda: not status.messages[-1].links[0].up, "the outage")
        refused = outage("ship", "", rospy.Duration(1))
        assert not refused.success
        assert "radio 'ship'" in refused.message
        assert outage("boat", "", rospy.Duration(0)).success
        send.publish(RadioPacket(destination="ship", data=b"x"))
        send.publish(RadioPacket(destination="", topic="all", data=b"here"))
        step_until(lambda: len(received.messages) > 1, "the broadcast")
        assert received.messages[1].topic == "all"
    assert len([line for line in logged_problems(gazebo.log) if "radio/send" in line]) == 1
