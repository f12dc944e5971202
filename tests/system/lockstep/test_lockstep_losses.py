# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Lockstep over ROS: a lost controller is named, and the policy decides how the world continues."""

from __future__ import annotations

import signal
import time
from pathlib import Path

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from gazebo_msgs.msg import ModelState
from geometry_msgs.msg import Twist
from harness import (
    Gazebo,
    Process,
    Ros,
    eventually,
    fresh_folder,
    logged_problems,
    pilot_of,
    pose,
    recorder,
)
from lockstep_pair import VEHICLES, Y_OF, StartGazebo, hover, hovers, send_route, start_pair
from mav_msgs.msg import Actuators
from nav_msgs.msg import Odometry


def test_a_killed_controller_is_named_the_other_flies_on_and_a_new_one_is_enrolled(
    start_gazebo: StartGazebo,
) -> None:
    gazebo, controllers = start_pair(start_gazebo, real_time_factor=2.0)
    with pilot_of(*VEHICLES) as pilot, recorder("/diagnostics", DiagnosticArray) as diagnostics:
        hover(gazebo, pilot)
        controllers["UAV1"].stop(signal.SIGKILL)
        gazebo.process.eventually_logs("the controller of UAV1 has disconnected")
        assert "the world continues without it" in gazebo.log
        after = gazebo.time()
        gazebo.until(after + 2.0)
        assert hovers(gazebo, "UAV2")
        eventually(
            lambda: any(
                "controller of UAV1 has disconnected" in status.message and status.level == 1
                for message in diagnostics.messages
                for status in message.status
            ),
            "the loss in /diagnostics",
        )
        enrolled = gazebo.log.count("UAV1: controller enrolled")
        gazebo.controller("UAV1")
        eventually(
            lambda: gazebo.log.count("UAV1: controller enrolled") > enrolled, "the new enrolment"
        )
        gazebo.ask("pause_physics")
        start = ModelState("UAV1", pose(0.0, Y_OF["UAV1"], 1.0), Twist(), "world")
        gazebo.ask("set_model_state", model_state=start)
        pilot.send("UAV1", 0.0, Y_OF["UAV1"], 1.0, gazebo.time())
        gazebo.ask("unpause_physics")
        gazebo.until(gazebo.time() + 4.0)
        assert hovers(gazebo, "UAV1")
        assert hovers(gazebo, "UAV2")
    losses = [line for line in logged_problems(gazebo.log) if "controller of" in line]
    assert len(losses) == 1, losses


def test_a_stopped_controller_is_timed_out_by_name_and_comes_back(
    start_gazebo: StartGazebo,
) -> None:
    gazebo, controllers = start_pair(start_gazebo, real_time_factor=2.0, lockstep_timeout=0.5)
    with pilot_of(*VEHICLES) as pilot:
        hover(gazebo, pilot)
        controllers["UAV2"].send(signal.SIGSTOP)
        gazebo.process.eventually_logs("the controller of UAV2 has not answered for 0.5")
        gazebo.until(gazebo.time() + 1.0)
        assert hovers(gazebo, "UAV1")
        enrolled = gazebo.log.count("UAV2: controller enrolled")
        controllers["UAV2"].send(signal.SIGCONT)
        eventually(
            lambda: gazebo.log.count("UAV2: controller enrolled") > enrolled, "the new enrolment"
        )
        gazebo.until(gazebo.time() + 4.0)
        assert hovers(gazebo, "UAV1")


def waits_for_one(gazebo: Gazebo, name: str) -> float:
    """Time at which the world stands still [s], with a few words about one lost controller."""
    stands_at = gazebo.time()
    assert [gazebo.time() for _ in range(200)] == [stands_at] * 200
    warnings = [line for line in logged_problems(gazebo.log) if name in line]
    assert len(warnings) <= 3, f"{len(warnings)} warnings about one loss"
    return stands_at


def test_policy_wait_stands_still_until_a_new_controller_comes(start_gazebo: StartGazebo) -> None:
    gazebo, controllers = start_pair(
        start_gazebo, real_time_factor=2.0, lockstep_policy="wait", lockstep_timeout=0.3
    )
    with pilot_of(*VEHICLES) as pilot:
        hover(gazebo, pilot)
        controllers["UAV1"].stop(signal.SIGKILL)
        gazebo.process.eventually_logs("the controller of UAV1 has disconnected; the world waits")
        stands_at = waits_for_one(gazebo, "UAV1")
        gazebo.controller("UAV1")
        gazebo.until(stands_at + 0.5)


def test_a_new_controller_whose_first_answer_is_lost_is_asked_again(
    start_gazebo: StartGazebo,
) -> None:
    """It reads the odometry before the world reads its commands: what it says then is not heard."""
    gazebo, controllers = start_pair(start_gazebo, real_time_factor=2.0, lockstep_policy="wait")
    heard: list[int] = []

    def answer(state: Odometry) -> None:
        heard.append(state.header.stamp.to_nsec())
        if heard.count(heard[0]) > 1:
            commands.publish(Actuators(header=state.header, angular_velocities=[545.0] * 6))

    with pilot_of(*VEHICLES) as pilot:
        hover(gazebo, pilot)
        controllers["UAV1"].stop(signal.SIGKILL)
        gazebo.process.eventually_logs("the controller of UAV1 has disconnected; the world waits")
        stands_at = gazebo.time()
        commands = rospy.Publisher("/UAV1/command/motor_speed", Actuators, queue_size=10)
        odometry = rospy.Subscriber("/UAV1/odometry_sensor1/odometry", Odometry, answer)
        try:
            gazebo.until(stands_at + 0.5)
        finally:
            odometry.unregister()
            commands.unregister()
        assert heard.count(heard[0]) > 1


def test_policy_wait_continues_with_a_controller_that_was_only_stopped(
    start_gazebo: StartGazebo,
) -> None:
    gazebo, controllers = start_pair(
        start_gazebo, real_time_factor=2.0, lockstep_policy="wait", lockstep_timeout=0.3
    )
    with pilot_of(*VEHICLES) as pilot:
        hover(gazebo, pilot)
        controllers["UAV1"].send(signal.SIGSTOP)
        gazebo.process.eventually_logs("the controller of UAV1 has not answered for 0.3")
        stands_at = waits_for_one(gazebo, "UAV1")
        controllers["UAV1"].send(signal.SIGCONT)
        gazebo.until(stands_at + 4.0)
        assert hovers(gazebo, "UAV1"), "nothing was lost"


def stopped_for(gazebo: Gazebo, process: Process, seconds: float, at_s: float) -> None:
    """Stops a process when the world gets there, for so long."""
    gazebo.until(at_s)
    process.send(signal.SIGSTOP)
    began = time.monotonic()
    # As long as the world says: what the wall clock decides is what is looked at here.
    eventually(lambda: time.monotonic() - began > seconds, "the time to be over")
    process.send(signal.SIGCONT)


def test_as_fast_as_possible_one_that_lives_is_waited_for_and_named(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    hashes = {}
    for stops in (0, 2):
        out_dir = fresh_folder(ros.folder / f"stopped-{stops}")
        gazebo, controllers = start_pair(
            start_gazebo, out_dir=out_dir, end_time=30.0, lockstep_timeout=0.3
        )
        with pilot_of(*VEHICLES) as pilot, recorder("/diagnostics", DiagnosticArray) as heard:
            send_route(pilot)
            gazebo.ask("unpause_physics")
            for index in range(stops):
                stopped_for(gazebo, controllers["UAV2"], 2.5, 0.5 + 2.0 * index)
            results = gazebo.ended()
        assert results["repeatable"] is True, results
        hashes[stops] = results["state_hash"]
        reported = [status.message for array in heard.messages for status in array.status]
        named = [text for text in reported if "waiting for the controller of UAV2" in text]
        states = (Path(out_dir) / "progress.jsonl").read_text("utf-8")
        if stops:
            assert named, "the diagnostics name the controller"
            assert "waiting for the controller of UAV2" in states, "and so does the progress"
            assert "the controller of UAV2 has not answered for 0.3" in gazebo.log
        ros.clean()
    assert hashes[0] == hashes[2]


def test_where_the_policy_continues_the_run_says_who_when_and_why(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    out_dir = fresh_folder(ros.folder / "goes-on")
    gazebo, controllers = start_pair(
        start_gazebo,
        out_dir=out_dir,
        end_time=60.0,
        lockstep_timeout=0.3,
        lockstep_policy="free_run",
    )
    with pilot_of(*VEHICLES) as pilot:
        for name in VEHICLES:
            pilot.send(name, 0.0, Y_OF[name], 1.0, 0.01)
        gazebo.ask("unpause_physics")
        gazebo.until(0.5)
        controllers["UAV1"].send(signal.SIGSTOP)
        gazebo.process.eventually_logs("not repeatable: the controller of UAV1")
        controllers["UAV1"].send(signal.SIGCONT)
        results = gazebo.ended()
    assert results["repeatable"] is False
    note = results["not_repeatable"][0]
    assert note["who"] == "the controller of UAV1"
    assert note["t"] >= 0.5
    assert note["why"] == "has not answered in time"


def test_one_that_died_ends_a_run_that_waits_with_an_error(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    out_dir = fresh_folder(ros.folder / "died")
    gazebo, controllers = start_pair(
        start_gazebo, out_dir=out_dir, end_time=1000.0, restart_patience=0.5
    )
    with pilot_of(*VEHICLES) as pilot:
        for name in VEHICLES:
            pilot.send(name, 0.0, Y_OF[name], 1.0, 0.01)
        gazebo.ask("unpause_physics")
        gazebo.until(0.5)
        controllers["UAV2"].stop(signal.SIGKILL)
        assert gazebo.process.wait() == 1, "an error"
    results = gazebo.results()
    assert results["end_reason"] == "error"
    assert "the controller of UAV2 has died at t = " in results["error"]
    assert results["error"] in gazebo.log


def test_policy_pause_pauses_and_can_be_unpaused(start_gazebo: StartGazebo) -> None:
    gazebo, controllers = start_pair(start_gazebo, real_time_factor=2.0, lockstep_policy="pause")
    with pilot_of(*VEHICLES) as pilot:
        hover(gazebo, pilot)
        controllers["UAV1"].stop(signal.SIGKILL)
        gazebo.process.eventually_logs(
            "the controller of UAV1 has disconnected; the world is paused"
        )
        eventually(lambda: bool(gazebo.ask("get_physics_properties").pause), "the pause")
        stands_at = gazebo.time()
        gazebo.ask("unpause_physics")
        gazebo.until(stands_at + 1.0)
        assert hovers(gazebo, "UAV2")


def test_controllers_answer_a_simulator_that_was_killed_and_started_again(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    gazebo, controllers = start_pair(start_gazebo)
    with pilot_of(*VEHICLES) as pilot:
        hover(gazebo, pilot)
        gazebo.process.stop(signal.SIGKILL)
        again = start_gazebo(wait_for=len(VEHICLES))
        for name in VEHICLES:
            again.spawn(name, at=pose(0.0, Y_OF[name], 0.1))
        hover(again, pilot, 1.5)
        assert all(process.running for process in controllers.values())
        assert not logged_problems(again.log), again.log
