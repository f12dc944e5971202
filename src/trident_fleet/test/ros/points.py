#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Robots that are points and go to their goals, and a user of their team.

Usage: points.py RESULT.json KIND

KIND `topics`: all talk on common topics; `relay`: this carries what each says to /B/from/A/T. Ends
when all tasks are done, with who has done them, and what the members have refused.
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from trident_fleet.core.tasks.fields import Requirements
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.messages import TaskAnnounce
from trident_fleet.core.tasks.protocol import Guards, Team
from trident_fleet.core.tasks.requests import Requests
from trident_fleet.nodes.tasks.settings import read_settings
from trident_fleet.nodes.tasks.topic_port import TOPICS, TopicPort, Wiring

import trident_msgs.msg as ros
from trident_ros import Refusals

STEP_S = 0.1
SPEED_M_S = 5.0
USER = "gcs"
PLACES = {"rover": [0.0, 0.0], "boat": [60.0, 0.0]}
ROBOTS = {
    "rover": {"role": "ugv", "speed_m_s": SPEED_M_S},
    "boat": {"role": "usv", "speed_m_s": SPEED_M_S},
}
LIMIT_S = 600.0


def tasks() -> list[TaskAnnounce]:
    """Three on land, one of them last, and one on the water."""
    land, water = (Requirements((domain,)).to_json() for domain in ("ground", "water"))
    return [
        TaskAnnounce(0.0, "a", "", 0, "visit", land, (10.0, 0.0, 0.0), 0.5),
        TaskAnnounce(0.0, "b", "", 0, "visit", "", (12.0, 5.0, 0.0), 0.5),
        TaskAnnounce(0.0, "c", "", 0, "visit", land, (5.0, 0.0, 0.0), 0.5, after=("a", "b")),
        TaskAnnounce(0.0, "d", "", 0, "visit", water, (50.0, 0.0, 0.0), 0.5),
    ]


class Points:
    """Where the robots are, and where they should be."""

    def __init__(self) -> None:
        self.places = {name: list(place) for name, place in PLACES.items()}
        self.goals: dict[str, tuple[float, float]] = {}
        self.odom = {
            name: rospy.Publisher(f"/{name}/odom", Odometry, queue_size=1) for name in PLACES
        }
        for name in PLACES:
            rospy.Subscriber(f"/{name}/task_goal", PoseStamped, self.take, name)

    def take(self, goal: PoseStamped, name: str) -> None:
        self.goals[name] = (goal.pose.position.x, goal.pose.position.y)

    def step(self, stamp: rospy.Time) -> None:
        for name, place in self.places.items():
            goal = self.goals.get(name, place)
            distance = math.dist(place, goal)
            share = min(SPEED_M_S * STEP_S / distance, 1.0) if distance > 0.0 else 0.0
            place[:] = [a + share * (b - a) for a, b in zip(place, goal, strict=True)]
            message = Odometry()
            message.header.stamp, message.pose.pose.orientation.w = stamp, 1.0
            message.pose.pose.position.x, message.pose.pose.position.y = place
            self.odom[name].publish(message)


def relay(names: list[str]) -> None:
    """Carry every topic of each to each other one."""
    for source in names:
        for kind, topic in TOPICS.items():
            outs = [
                rospy.Publisher(f"/{other}/from/{source}/{topic}", kind, queue_size=100)
                for other in names
                if other != source
            ]

            def carry(message: Any, outs: list[rospy.Publisher] = outs) -> None:
                for out in outs:
                    out.publish(message)

            rospy.Subscriber(f"/{source}/{topic}", kind, carry)


def main() -> None:
    kind = sys.argv[2]
    rospy.set_param("/use_sim_time", True)
    rospy.set_param("/team", {"robots": ROBOTS, "network": kind, "users": [USER]})
    Path(sys.argv[1]).with_suffix(".ready").touch()
    rospy.init_node("points")
    refused: dict[str, str] = {}

    def note(array: DiagnosticArray) -> None:
        refused.update({status.name: status.message for status in array.status})

    rospy.Subscriber("/diagnostics", DiagnosticArray, note)
    clock = rospy.Publisher("/clock", Clock, queue_size=10)
    points = Points()
    if kind == "relay":
        relay([*PLACES, USER])
    settings = read_settings(lambda name: rospy.get_param(f"/team/{name}", None), "rover")
    requests, port = user(settings.team, kind)
    strange = rospy.Publisher("/bid_submit", ros.TaskBid, queue_size=1)
    requests.add(tasks())
    end, now_s = time.monotonic() + LIMIT_S, 0.0
    done: dict[str, str] = {}
    while (len(done) < 5 or (kind == "topics" and not refused)) and time.monotonic() < end:
        now_s += STEP_S
        stamp = rospy.Time.from_sec(now_s)
        clock.publish(stamp)
        points.step(stamp)
        serve(requests, port)
        strange.publish(ros.TaskBid(task_id="a", robot_id="pirate"))
        records = requests.follower.book.records
        done = {name: one.done_by[0] for name, one in records.items() if one.done_by}
        time.sleep(0.5 * STEP_S)
    result = {"done": done, "refused": refused, "pending": requests.pending()}
    Path(sys.argv[1]).write_text(json.dumps(result))


def user(team: Team, kind: str) -> tuple[Requests, TopicPort]:
    wiring = Wiring.relayed(USER, PLACES) if kind == "relay" else Wiring.common("")
    port = TopicPort(USER, team.members, "world", wiring, Refusals())
    return Requests(Follower(USER, team, Guards(), 0.0)), port


def serve(requests: Requests, port: TopicPort) -> None:
    send: Callable[..., None] = port.send
    for envelope in port.receive():
        requests.on_message(envelope.source, envelope.message, port.now())
    for sent in requests.on_time(port.now()):
        send(sent.message, sent.destination)


if __name__ == "__main__":
    main()
