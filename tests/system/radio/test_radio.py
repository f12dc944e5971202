# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Robots talk by radio over topics, see their links, and lose them; topics cross by rules."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from harness import Gazebo, eventually, logged_problems, pose, recorder
from nav_msgs.msg import Odometry
from std_msgs.msg import String

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


RULES = """
model: {path: free_space}
rules:
  - {topic: odom, depth: 1, deadline: 0.5, max_rate: 10.0}
  - {topic: chatter, from: [rover], to: [boat], reliability: reliable, depth: 100, priority: 0}
"""

WITH_ODOMETRY = ROBOT.replace(
    "</robot>",
    """<gazebo><plugin name="truth" filename="libgazebo_ros_p3d.so"><topicName>odom</topicName>
<bodyName>base_link</bodyName><updateRate>50</updateRate></plugin></gazebo></robot>""",
)


def test_topics_cross_by_rules(
    start_gazebo: Callable[..., Gazebo], tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    (tmp_path / "team.yaml").write_text(RULES, encoding="utf-8")
    (tmp_path / "meadow.world").write_text(re.sub("<plugin.*</plugin>", "", WORLD), "utf-8")
    gazebo = start_gazebo(
        tmp_path / "meadow.world",
        radio_rules=str(tmp_path / "team.yaml"),
        out_dir=str(tmp_path),
    )
    gazebo.spawn("rover", WITH_ODOMETRY, pose(z=1.0))
    gazebo.spawn("boat", WITH_ODOMETRY, pose(x=60.0, z=1.0))
    talk = rospy.Publisher("/rover/chatter", String, queue_size=10)
    request.addfinalizer(talk.unregister)
    outage = rospy.ServiceProxy("/radio/outage", SetOutage)
    eventually(lambda: talk.get_num_connections() == 1, "a reader of the topic")
    with (
        recorder("/rover/odom", Odometry) as own,
        recorder("/boat/from/rover/odom", Odometry) as relayed,
        recorder("/boat/from/rover/chatter", String) as heard,
        recorder("/diagnostics", DiagnosticArray) as diagnostics,
    ):

        def step_until(is_so: Callable[[], bool], what: str) -> None:
            eventually(lambda: gazebo.step(10) > 0.0 and is_so(), what)

        step_until(lambda: len(relayed.messages) > 3, "odometry by radio")
        sent = {message.header.stamp: message for message in own.messages}
        step_until(lambda: relayed.messages[-1].header.stamp in sent, "the same odometry")
        for message in relayed.messages:
            if message.header.stamp in sent:
                assert message.pose == sent[message.header.stamp].pose
                assert message.child_frame_id == sent[message.header.stamp].child_frame_id
        assert ["/boat/from/rover/odom", "nav_msgs/Odometry"] in rospy.get_published_topics()
        talk.publish("first")
        step_until(lambda: bool(heard.messages), "a message by radio")
        assert outage("boat", "", rospy.Duration(1)).success
        for text in ("second", "third", "fourth"):
            talk.publish(text)
        step_until(lambda: heard.messages[-1].data == "fourth", "what was sent in the outage")
        texts = [message.data for message in heard.messages]
        assert texts == ["first", "second", "third", "fourth"]

        def is_counted() -> bool:
            names = [status.name for array in diagnostics.messages for status in array.status]
            return "gazebo: radio: rule 2 (chatter): rover to boat" in names

        step_until(is_counted, "counts in /diagnostics")
    relay = gazebo.finish()["relay"]
    (chatter,) = [flow for flow in relay if flow["rule"] == "rule 2 (chatter)"]
    assert chatter["delivered"] == chatter["offered"]
    assert chatter["reliable"]
    lines = (tmp_path / "links.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("t,source,destination,distance,snr_db")
    assert any(",boat,rover," in line for line in lines)
