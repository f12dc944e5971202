# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Services that robots call of each other by radio."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from harness import Ros, eventually, logged_problems, recorder
from meadow import ROBOT, Meadow
from nav_msgs.msg import Odometry
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse

from trident_msgs.srv import SetOutage

NODE = Path(__file__).with_name("radio_services_node.py")
RULES = """
model: {path: free_space}
rules:
  - {service: arm, from: [boat], to: [rover], deadline: 2.0, priority: 0}
  - {service: refuse, from: [boat], to: [rover], deadline: 2.0}
  - {service: die, from: [boat], to: [rover], deadline: 2.0}
  - {service: hang, from: [boat], to: [rover], deadline: 2.0}
  - {service: ask_the_boat, from: [boat], to: [rover], deadline: 2.0}
  - {service: depth, from: [rover], to: [boat], deadline: 2.0}
  - {service: step, from: [boat], to: [rover], deadline: 2.0}
  - {service: nobodys, deadline: 2.0}
"""


class Services(Meadow):
    """A meadow with the rover's services, and calls of this process."""

    def __init__(self, ros: Ros, folder: Path, **options: Any) -> None:
        """Start all of it."""
        super().__init__(ros, folder, RULES, **options)
        self.node = ros.launch(["/usr/bin/python3", NODE], "rover_services")
        self._pool = ThreadPoolExecutor()

    def call(self, service: str, data: bool = True) -> Future[str]:
        """The text that a service answers, or its error."""
        name = f"/boat/to/rover/{service}"
        rospy.wait_for_service(name, 20.0)
        proxy = rospy.ServiceProxy(name, SetBool)

        def ask() -> str:
            try:
                return str(proxy(data).message)
            except rospy.ServiceException as error:
                return str(error)

        return self._pool.submit(ask)

    def answer(self, service: str, data: bool = True, steps: int = 1) -> str:
        """The same, stepping until it is there; many steps at a time where a deadline ends it."""
        future = self.call(service, data)
        self.step_until(future.done, f"an end of {service}", steps=steps)
        return future.result()


@pytest.fixture
def services(ros: Ros, tmp_path: Path) -> Iterator[Callable[..., Services]]:
    def make(**options: Any) -> Services:
        return Services(ros, tmp_path, **options)

    yield make
    ros.clean()


def is_noted(messages: list[DiagnosticArray], text: str) -> bool:
    return any(text in status.message for array in messages for status in array.status)


def test_answers_and_errors_come_by_radio(services: Callable[..., Services], ros: Ros) -> None:
    world = services()
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        assert world.answer("arm") == "armed"
        assert world.answer("arm", data=False) == "disarmed"
        begin = "service [/boat/to/rover/{0}] responded with an error: b'rule {1} ({0}): "
        begin += "the call of boat to rover/{0} "
        assert world.answer("refuse") == begin.format("refuse", 2) + (
            "has failed: the server of /rover/refuse reports: "
            "service cannot process request: the arm is folded'"
        )
        outage = rospy.ServiceProxy("/radio/outage", SetOutage)
        assert outage("boat", "", rospy.Duration(3600)).success
        before = world.gazebo.time()
        assert world.answer("arm", steps=50) == begin.format("arm", 1) + (
            "has no answer after 2 s: its request has not arrived'"
        )
        assert world.gazebo.time() - before > 1.999
        killed = ros.launch(["rosservice", "call", "/boat/to/rover/arm", "true"])
        eventually(lambda: is_noted(diagnostics.messages, "1 wait for the next"), "its call")
        world.gazebo.step(1)
        ros.kill(killed)
        world.gazebo.step(2100)
        assert outage("boat", "", rospy.Duration(0)).success
        assert "the world waits for /rover_services" in world.answer("step")
        assert world.answer("die") == begin.format("die", 3) + (
            "has failed: the server of /rover/die has ended during the call'"
        )
        world.node.wait()
        assert world.answer("arm") == begin.format("arm", 1) + (
            "has failed: there is no service /rover/arm: its server has ended'"
        )
        warning = "rule 8 (nobodys): no node serves /rover/nobodys, /boat/nobodys after 5.00 s"
        world.step_until(lambda: warning in world.gazebo.log, "the warning", steps=100)

        def notes() -> dict[str, str]:
            return {s.name: s.message for a in diagnostics.messages for s in a.status}

        name = "gazebo: radio: rule 1 (arm): calls of boat to rover"
        text = "called 5, answered 2, failed 1, refused 0, expired 2, aborted 0"
        eventually(lambda: notes().get(name) == text, "the counts")
    unserved = [line for line in logged_problems(world.gazebo.log) if "no node serves" in line]
    assert unserved == logged_problems(world.gazebo.log)
    assert len(unserved) == 2  # nobody serves the boat's depth either
    calls = {entry["rule"]: entry for entry in world.gazebo.finish()["calls"]}
    assert calls["rule 1 (arm)"]["answered"] == 2
    assert calls["rule 1 (arm)"]["deadline_s"] == 2.0
    assert 0.0 < calls["rule 1 (arm)"]["delay_max_s"] < 0.1


def run_with_calls_within_calls(world: Services) -> dict[str, Any]:
    def depth(request: SetBoolRequest) -> SetBoolResponse:
        return SetBoolResponse(request.data, "3 m")

    server = rospy.Service("/boat/depth", SetBool, depth)
    try:
        rospy.wait_for_service("/rover/to/boat/depth", 20.0)
        with recorder("/diagnostics", DiagnosticArray) as diagnostics:
            future = world.call("ask_the_boat")
            eventually(lambda: is_noted(diagnostics.messages, "1 wait for the next"), "the call")
        world.gazebo.ask("unpause_physics")
        assert future.result(30.0) == "the boat says: 3 m"
        return world.gazebo.ended()
    finally:
        server.shutdown()


def test_a_call_within_a_call_is_repeatable_as_fast_as_possible(
    services: Callable[..., Services], ros: Ros
) -> None:
    results = []
    for _ in range(2):
        results.append(run_with_calls_within_calls(services(end_time=2.0, lockstep_timeout=60.0)))
        ros.clean()
    assert results[0]["repeatable"], results[0]
    assert results[0]["state_hash"] == results[1]["state_hash"]
    assert [entry["delay_max_s"] for entry in results[0]["calls"]] == [
        entry["delay_max_s"] for entry in results[1]["calls"]
    ]


def test_a_server_that_is_silent_does_not_hold_the_world_for_ever(
    services: Callable[..., Services],
) -> None:
    world = services(lockstep_timeout=0.05)
    assert "has no answer after 2 s: its server has not answered" in world.answer("hang", steps=50)
    assert "the server of /rover/hang has not answered a call of boat" in world.gazebo.log
    results = world.gazebo.finish()
    assert not results["repeatable"]
    assert results["not_repeatable"][0]["who"] == "the server of /rover/hang"


def test_a_reset_and_the_end_of_the_run_end_calls(services: Callable[..., Services]) -> None:
    world = services()
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        waiting = world.call("arm")
        eventually(lambda: is_noted(diagnostics.messages, "1 wait for the next"), "a call")
        world.gazebo.ask("reset_simulation")
        assert "the world was reset" in waiting.result(30.0)
        hanging = world.call("hang")
        eventually(lambda: is_noted(diagnostics.messages[-1:], "1 wait for the next"), "a call")
    world.gazebo.finish()
    # Whether its text still crosses the connection that ends with the server is left to chance.
    assert "service" in hanging.result(30.0)


CART = ROBOT.replace(
    "</robot>",
    """<gazebo><plugin name="move" filename="libgazebo_ros_planar_move.so">
<robotNamespace>rover</robotNamespace><commandTopic>cmd_vel</commandTopic>
<odometryTopic>odom</odometryTopic><odometryFrame>odom</odometryFrame>
<odometryRate>10</odometryRate><robotBaseFrame>base_link</robotBaseFrame></plugin></gazebo></robot>""",
)
ANSWERS = {"state": "/rover/odom", "commands": ["/rover/cmd_vel"], "delay": 0.02}


def test_a_node_that_the_world_waits_for_and_that_waits_for_a_call_gets_an_error(
    services: Callable[..., Services], request: pytest.FixtureRequest
) -> None:
    world = services(rover=CART, answers={"rover": ANSWERS}, lockstep_timeout=0.5)
    publisher = rospy.Publisher("/rover/cmd_vel", Twist, queue_size=10)
    request.addfinalizer(publisher.unregister)
    rospy.wait_for_service("/boat/to/rover/arm", 20.0)
    proxy = rospy.ServiceProxy("/boat/to/rover/arm", SetBool)
    errors: list[str] = []

    def drive(odometry: Odometry) -> None:
        del odometry
        if not errors:
            try:
                proxy(True)
            except rospy.ServiceException as error:
                errors.append(str(error))
        publisher.publish(Twist())

    subscriber = rospy.Subscriber("/rover/odom", Odometry, drive, queue_size=10)
    request.addfinalizer(subscriber.unregister)
    with recorder("/rover/odom", Odometry):
        eventually(lambda: publisher.get_num_connections() > 0, "the world as a listener")
    assert world.gazebo.step_to(1.0) == pytest.approx(1.0)
    (error,) = errors
    assert "has ended: the world waits for the driver of rover, which has not answered" in error
    assert "legal: calls from a thread of their own" in error
