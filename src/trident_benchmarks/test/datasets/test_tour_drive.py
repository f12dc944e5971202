# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The drive in lockstep, by a world that moves one odometry further with each answer."""

from __future__ import annotations

import signal
import time
from typing import Any
from xml.etree import ElementTree

import pytest
import rospy
import yaml
from geometry_msgs.msg import TransformStamped, Twist
from nav_msgs.msg import Odometry
from trident.testing import package
from trident_benchmarks.datasets import tour_drive
from trident_benchmarks.datasets.checked_buffer import transform_problem
from trident_benchmarks.datasets.tour_drive import LockstepDriver
from trident_benchmarks.datasets.tour_node import scan_stamp_problem
from trident_nav.core.velocity import Velocity

PERIOD_S = 0.1


class Refused:
    """The reported messages."""

    def __init__(self) -> None:
        self.texts: list[str] = []

    def note(self, _kind: str, text: str) -> None:
        self.texts.append(text)


class World:
    """Sends the next odometry when it comes to it, which is after the answer to the last one."""

    def __init__(self) -> None:
        self.answers: list[float] = []  # forward velocities
        self.refusals = Refused()
        self.heard: Any = None
        self.time_s = 0.0
        self.moves = False  # has been answered, and is not at the next odometry yet

    def publish(self, answer: Twist) -> None:
        assert not self.moves, "answered while it moves"
        self.answers.append(answer.linear.x)
        self.moves = True

    def come_to_the_next(self) -> None:
        """The wall clock decides when."""
        if self.moves:
            self.moves = False
            self.time_s += PERIOD_S
            self.send()

    def send(self) -> None:
        message = Odometry()
        message.header.stamp = rospy.Time.from_sec(self.time_s)
        message.pose.pose.orientation.w = 1.0
        self.heard(message)


class Follower:
    """Has arrived after some commands."""

    def __init__(self, commands: int) -> None:
        self.left = commands
        self.times: list[float] = []

    @property
    def is_done(self) -> bool:
        return self.left == 0

    def command(self, time_s: float, pose: tuple[float, float, float]) -> Velocity:
        self.left -= 1
        self.times.append(round(time_s, 6))
        return Velocity(0.5, 0.0)


@pytest.fixture
def world(monkeypatch: pytest.MonkeyPatch) -> World:
    """Behind rospy's names."""
    world = World()

    def subscribe(topic: str, kind: type, callback: Any, **_: Any) -> None:
        world.heard = callback

    monkeypatch.setattr(tour_drive.rospy, "Publisher", lambda *_, **__: world)
    monkeypatch.setattr(tour_drive, "Refusals", lambda: world.refusals)
    monkeypatch.setattr(tour_drive.rospy, "Subscriber", subscribe)
    return world


@pytest.fixture
def driver(world: World) -> LockstepDriver:
    driver = LockstepDriver(world.come_to_the_next, lambda: True)
    world.send()
    return driver


def test_what_is_done_between_two_drives_finds_a_world_that_stands(
    world: World, driver: LockstepDriver
) -> None:
    driver.stand(1.0)
    assert not world.moves
    assert world.time_s == pytest.approx(1.0 + PERIOD_S)
    follower = Follower(5)
    assert driver.drive(follower, 60.0)  # type: ignore[arg-type]
    assert not world.moves
    # No odometry is lost, and none is answered twice.
    assert follower.times == pytest.approx([1.1, 1.2, 1.3, 1.4, 1.5])
    driver.stand(0.2)
    assert world.answers == [0.0] * 11 + [0.5] * 5 + [0.0] * 3


class InterruptedWaitError(Exception):
    """What ends a wait."""


def test_a_signal_with_a_slow_handler_ends_the_wait_for_odometry(world: World) -> None:
    caught: list[int] = []

    def handle(number: int, _frame: object) -> None:
        end = time.monotonic() + 5 * tour_drive._POLL_S
        while time.monotonic() < end:
            pass
        caught.append(number)

    def check() -> None:
        if caught:
            raise InterruptedWaitError

    before = signal.signal(signal.SIGALRM, handle)
    signal.setitimer(signal.ITIMER_REAL, 0.5 * tour_drive._POLL_S)
    try:
        with pytest.raises(InterruptedWaitError):
            LockstepDriver(check, lambda: True).stand(1.0)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def test_a_drive_that_takes_too_long_ends(world: World, driver: LockstepDriver) -> None:
    assert not driver.drive(Follower(1000), 2.0)  # type: ignore[arg-type]
    assert not world.moves
    assert world.time_s == pytest.approx(2.0 + 2 * PERIOD_S)


def test_the_world_stands_at_the_odometry_that_the_tour_has_to_answer() -> None:
    """With a delay it runs for that long, and what ends the run finds it where chance says."""
    file = package("trident_bringup") / "launch" / "slam_room.launch"
    params = [one for one in ElementTree.parse(file).iter("rosparam") if one.get("param")]
    answers = {one.get("param"): yaml.safe_load(one.text or "") for one in params}
    assert answers["/gazebo/answers/slam_tour"]["delay"] == 0.0


def test_odometry_that_is_none_is_refused_and_not_answered(
    world: World, driver: LockstepDriver
) -> None:
    message = Odometry()
    message.pose.pose.orientation.w = 1.0
    message.pose.pose.position.x = float("nan")
    world.heard(message)
    driver.stand(0.1)
    assert world.answers == [0.0, 0.0]
    assert world.refusals.texts == [
        "odometry refused: position is (nan, 0, 0), legal: finite, up to +-1e+08"
    ]


@pytest.mark.parametrize(("stamp_s", "is_refused"), [(95, False), (105, False), (80, True)])
def test_scans_of_another_time_than_the_robots_are_refused(stamp_s: int, is_refused: bool) -> None:
    problem = scan_stamp_problem(rospy.Time(stamp_s), rospy.Time(100))
    assert bool(problem) == is_refused
    assert scan_stamp_problem(rospy.Time(4_000_000_000), rospy.Time(100)) != ""


def test_transforms_that_would_end_the_process_are_refused() -> None:
    transform = TransformStamped()
    transform.transform.rotation.w = 1.0
    assert transform_problem(transform) == ""
    transform.header.stamp.secs = 2**32 - 1
    assert transform_problem(transform) == "stamp is 4294967295 s, legal: below 2147000000"
    transform.header.stamp.secs, transform.transform.rotation.w = 1, float("inf")
    assert "legal: 1" in transform_problem(transform)
