# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of radios over ROS: latched topics, and what a user may get wrong."""

from __future__ import annotations

from pathlib import Path

import pytest
import rospy
from gazebo_msgs.srv import SpawnModel
from harness import Ros, eventually, logged_problems, pose, recorder
from meadow import ROBOT, Meadow
from std_msgs.msg import String

from trident_msgs.srv import SetOutage

RULES = """
model: {path: free_space}
rules:
  - {topic: map, from: [rover], reliability: reliable, deadline: 5.0, priority: 0}
  - {topic: name, from: [rover]}
  - {topic: film, from: [rover], depth: 3}
  - {topic: x, from: [ship]}
  - {topic: silence, from: [rover]}
"""


def test_who_comes_late_has_the_newest_of_latched_topics(
    ros: Ros, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    world = Meadow(ros, tmp_path, RULES)
    for topic in ("map", "name"):
        publisher = rospy.Publisher(f"/rover/{topic}", String, queue_size=10, latch=True)
        request.addfinalizer(publisher.unregister)
        publisher.publish(f"the first {topic}")
        publisher.publish(f"the {topic}")
    # A subscriber that is there before the first message, and one that comes after the last.
    with recorder("/boat/from/rover/map", String) as early:
        world.step_until(lambda: len(early.messages) > 0, "the map by radio")
        with recorder("/boat/from/rover/map", String) as late:
            eventually(lambda: len(late.messages) > 0, "the latched map")
        assert late.messages[-1].data == early.messages[-1].data == "the map"
    with recorder("/boat/from/rover/name", String) as late:
        eventually(lambda: len(late.messages) > 0, "the latched name")
    # A robot that comes after the last message.
    world.gazebo.step(1000)
    world.gazebo.spawn("plane", ROBOT, pose(y=60.0, z=1.0))
    for topic in ("map", "name"):
        with recorder(f"/plane/from/rover/{topic}", String) as own:
            world.step_until(lambda own=own: len(own.messages) > 0, f"the {topic} by radio")
            assert [message.data for message in own.messages] == [f"the {topic}"]


def test_what_a_user_gets_wrong_is_reported_once_and_the_rest_works(
    ros: Ros, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    world = Meadow(ros, tmp_path, RULES)
    spawned = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)(
        "twin", ROBOT, "/rover", pose(y=20.0, z=1.0), "world"
    )
    assert not spawned.success
    assert "'rover/radio' is already taken" in spawned.status_message
    outage = rospy.ServiceProxy("/radio/outage", SetOutage)
    for source, destination in (("ship", ""), ("rover", "ship")):
        refused = outage(source, destination, rospy.Duration(1))
        assert not refused.success
        assert "radio 'ship'" in refused.message
        assert "known: boat, rover" in refused.message
    film = rospy.Publisher("/rover/film", String, queue_size=10)
    chart = rospy.Publisher("/rover/map", String, queue_size=10)
    for publisher in (film, chart):
        request.addfinalizer(publisher.unregister)
        eventually(lambda p=publisher: p.get_num_connections() == 1, "the world as a reader")
    # A radio broadcasts 6 Mbit/s.
    picture = "x" * 50_000

    def film_is_reported() -> bool:
        for _ in range(4):
            film.publish(picture)
        return "legal is less than its radio carries" in world.gazebo.log

    world.step_until(film_is_reported, "the rate", steps=50)
    world.step_until(lambda: "on its silence after 5 s" in world.gazebo.log, "silence", steps=500)
    with recorder("/boat/from/rover/map", String) as heard:
        chart.publish("still there")
        world.step_until(lambda: len(heard.messages) > 0, "the map by radio")
    problems = logged_problems(world.gazebo.log)
    for text, count in (
        ("rule 3 (film): rover/film has ", 1),
        ("rule 4 (x): there is no radio 'ship' after 5 s, radios: boat, rover", 1),
        ("rule 5 (silence): no robot of rover has sent a message on its silence after 5 s", 1),
        ("already taken", 1),
        ("SetOutage: ", 2),
    ):
        assert len([line for line in problems if text in line]) == count, text
