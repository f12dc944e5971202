# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What all nodes are put through, and what keeps them at work meanwhile.

A test says by the mark `fuzzes("package/program", ...)` which programs it treats. conftest.py sees
to it that it does; test_coverage.py, that there is one for every program that is a node.
"""

from __future__ import annotations

import math
import os
import re
import shlex
import signal
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import genpy
import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from trident.testing import LIMIT_S, Process, Ros, eventually, logged_problems, recorder
from trident.testing.fuzz import Campaign, CampaignOptions, Target

MESSAGES = int(os.environ.get("TRIDENT_FUZZ_MESSAGES", "10000"))
#: The long form: slow nodes get all of them, too (minutes for some).
IS_LONG = os.environ.get("TRIDENT_FUZZ_LONG", "0") == "1"
SEED = int(os.environ.get("TRIDENT_FUZZ_SEED", "1"))
#: Warnings that a node may log about 10^4 messages, and more a second that they take, as it logs
#: each kind every few seconds.
MAX_PROBLEMS, MORE_PER_S = 300, 3.0
_ROOM_M = (4.0, 3.0)  # half of its sides
_BEAMS = 180
#: Of 5 cm: the room, and half a meter about it.
MAP_CELLS = (180, 140)
_PROGRAM = re.compile(r"/lib/([^/]+/[^/]+)$")

#: "package/program" of what has been treated in the test that runs.
TREATED: set[str] = set()


def messages(part: int) -> int:
    """To a node that needs long for each: one part in so many of what others get."""
    return MESSAGES if IS_LONG else max(MESSAGES // part, 100)


def note_treated(target: Target | Process) -> None:
    """Remember which program has been treated."""
    if isinstance(target, Target):
        words = Path(f"/proc/{target.pid}/cmdline").read_bytes().decode().split("\0")
    else:
        words = shlex.split(target.command)
    named = [found[1] for word in words if (found := _PROGRAM.search(word))]
    assert named, f"no program of a package: {words}"
    TREATED.add(named[0])


def started(ros: Ros, node: str, command: list[str], **env: str) -> Process:
    """A node that the master knows, by its full name."""
    folder = ros.folder / "cwd"
    folder.mkdir(exist_ok=True)
    words = ["env", "-C", str(folder), *os.environ.get("TRIDENT_FUZZ_UNDER", "").split(), *command]
    process = ros.launch(words, node, **env)

    def is_known() -> bool:
        assert process.running, process.log
        return bool(ros.master.lookupNode("/fuzz", node)[0] == 1)

    eventually(is_known, node)
    return process


def service(name: str, kind: Any) -> rospy.ServiceProxy:
    """A service that is there: a node is known to the master before it serves."""
    rospy.wait_for_service(name, LIMIT_S)
    return rospy.ServiceProxy(name, kind)


def withstands(
    process: Process,
    node: str,
    sane: Callable[[], None],
    examples: Mapping[str, genpy.Message] | None = None,
    meanwhile: Callable[[], None] | None = None,
    skip: tuple[str, ...] = (),
    **options: Any,
) -> None:
    """The node lives, sends only finite numbers, warns seldom, and still does its work.

    Args:
        process: that the node is in.
        node: its full name.
        sane: asks it for something that it must still do; asserts that it does.
        examples: see `Campaign`.
        meanwhile: see `Campaign`.
        skip: topics and services that are left alone.
        options: of the campaign, but for messages and seed.
    """
    sane()
    settings = CampaignOptions(messages=MESSAGES, seed=SEED, **options)
    target = Target(node, skip)
    note_treated(target)
    found = Campaign(target, settings, examples, meanwhile).run()
    print(node, found.text())
    assert not found.problems, f"{found.text()}\nits log ends:\n{process.log[-3000:]}"
    refusals = sum(found.refused.values())  # each has its answer, and a line in the log
    count = len(logged_problems(process.log)) - refusals
    most = MAX_PROBLEMS + MORE_PER_S * found.seconds
    assert count < most, f"{count} problems:\n{process.log[:5000]}"
    assert "Traceback" not in process.log
    sane()
    assert process.stop(signal.SIGINT) == 0, process.log[-3000:]


def endures(
    target: Target, count: int, step: Callable[[], None] | None = None, batch: int = 20
) -> None:
    """It lives through so many messages."""
    note_treated(target)
    settings = CampaignOptions(messages=count, seed=SEED, batch=batch)
    found = Campaign(target, settings, None, step).run()
    print(target.name, found.text())
    assert not found.problems, found.text()
    assert sum(found.sent.values()) == count


class Asked:
    """One sane topic to a node, and what it must answer.

    Attributes:
        topic: that the node listens to.
        make: a sane message of now.
    """

    def __init__(self, topic: str, make: Callable[[], Any], answer: str, kind: Any) -> None:
        """Advertise it.

        Args:
            topic: that the node listens to.
            make: a sane message of now.
            answer: topic that the node answers on.
            kind: of the answers.
        """
        self.topic, self.make = topic, make
        self._answer, self._kind = answer, kind
        self._publisher = rospy.Publisher(topic, type(make()), queue_size=10, tcp_nodelay=True)

    def send(self) -> None:
        """Ask once."""
        self._publisher.publish(self.make())

    def is_answered(self) -> None:
        """Ask until some answers have come."""
        with recorder(self._answer, self._kind) as answers:

            def has_come() -> bool:
                self.send()
                return len(answers.messages) > 3

            eventually(has_come, f"answers on {self._answer}")

    def close(self) -> None:
        """End the topic."""
        self._publisher.unregister()


def answers_on(
    process: Process,
    node: str,
    asked: Asked,
    examples: Mapping[str, genpy.Message] | None = None,
) -> None:
    """`withstands` of a node that answers one topic on another, which it is asked all the while.

    Args:
        process: that the node is in.
        node: its full name.
        asked: that topic, whose sane messages are an example, too.
        examples: of other topics.
    """
    sane = {asked.topic: asked.make()}
    withstands(process, node, asked.is_answered, {**(examples or {}), **sane}, asked.send)
    asked.close()


def odometry() -> Odometry:
    """Of a vehicle that stands, now."""
    message = Odometry()
    message.header.stamp, message.header.frame_id = rospy.Time.now(), "odom"
    message.pose.pose.orientation.w = 1.0
    return message


def transform(parent: str, child: str, x: float = 0.0) -> TransformStamped:
    """A transform of now."""
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id, message.header.stamp = parent, rospy.Time.now()
    message.transform.translation.x, message.transform.rotation.w = x, 1.0
    return message


def room_scan(x: float = 0.0) -> LaserScan:
    """What a laser in the middle of an empty room sees now, moved by `x` [m] along it."""
    message = LaserScan(angle_min=-math.pi, angle_max=math.pi, range_min=0.1, range_max=12.0)
    message.header.frame_id, message.header.stamp = "laser", rospy.Time.now()
    message.angle_increment = 2.0 * math.pi / _BEAMS
    message.time_increment = 1e-4
    ranges = []
    for beam in range(_BEAMS):
        angle = message.angle_min + beam * message.angle_increment
        c, s = math.cos(angle), math.sin(angle)
        to_x = (math.copysign(_ROOM_M[0], c) - x) / c if abs(c) > 1e-9 else math.inf
        to_y = math.copysign(_ROOM_M[1], s) / s if abs(s) > 1e-9 else math.inf
        ranges.append(min(to_x, to_y))
    message.ranges = ranges
    return message


class Robot:
    """A robot with a laser that drives to and fro in a room: its transforms and scans."""

    def __init__(self, base: str) -> None:
        """`base`: frame of the robot."""
        self._base = base
        self._steps = 0
        self._scans = rospy.Publisher("/scan", LaserScan, queue_size=100, tcp_nodelay=True)
        self._transforms = rospy.Publisher("/tf", TFMessage, queue_size=100, tcp_nodelay=True)
        self._mounts = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        self._mounts.publish(TFMessage([transform(base, "laser")]))

    def connected(self) -> Robot:
        """Return when the node under test listens to it."""
        for topic in (self._scans, self._transforms, self._mounts):
            eventually(lambda t=topic: t.get_num_connections() > 0, topic.name)  # type: ignore[misc]
        return self

    def step(self) -> None:
        """One scan later."""
        self._steps += 1
        x = math.sin(0.05 * self._steps)
        self._transforms.publish(TFMessage([transform("odom", self._base, x)]))
        self._scans.publish(room_scan(x))

    def drives_until(self, condition: Callable[[], bool], what: str) -> None:
        """Return once a condition holds."""

        def step() -> bool:
            self.step()
            return condition()

        eventually(step, what)

    def close(self) -> None:
        """End its topics."""
        for topic in (self._scans, self._transforms, self._mounts):
            topic.unregister()
