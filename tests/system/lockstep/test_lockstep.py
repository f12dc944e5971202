# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Lockstep over ROS: the start, equal hashes with any listeners, and inputs from outside."""

from __future__ import annotations

import csv
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from gazebo_msgs.msg import ModelState, ModelStates
from geometry_msgs.msg import Twist
from harness import (
    Gazebo,
    Pilot,
    Ros,
    eventually,
    fresh_folder,
    logged_problems,
    pilot_of,
    pose,
    recorder,
)
from lockstep_pair import ROUTE, VEHICLES, Y_OF, StartGazebo, send_route, start_pair
from nav_msgs.msg import Odometry
from std_msgs.msg import Bool

END_S = 6.0


def fly(
    ros: Ros,
    start_gazebo: StartGazebo,
    label: str,
    real_time_factor: float = 0.0,
    listen: Callable[[ExitStack], None] | None = None,
) -> dict[str, Any]:
    """Both vehicles fly the route to its end; the results of the run."""
    out_dir = fresh_folder(ros.folder / label)
    gazebo, _ = start_pair(
        start_gazebo, out_dir=out_dir, end_time=END_S, real_time_factor=real_time_factor
    )
    with ExitStack() as stack:
        pilot = stack.enter_context(pilot_of(*VEHICLES))
        send_route(pilot)
        if listen is not None:
            listen(stack)
        gazebo.ask("unpause_physics")
        results = gazebo.ended()
    assert not logged_problems(gazebo.log), gazebo.log
    ros.clean()
    return results


def all_kinds_of_listeners(ros: Ros) -> Callable[[ExitStack], None]:
    def listen(stack: ExitStack) -> None:
        bag = ros.folder / "listened.bag"
        record = ros.launch(["rosbag", "record", "-O", bag, "-a", "__name:=recorder"])
        echo = ros.launch(["rostopic", "echo", "/UAV1/odometry_sensor1/odometry"])
        # An echo without messages yet says nothing: the master knows when it listens.
        eventually(lambda: listens(ros, "/UAV1/odometry_sensor1/odometry", "rostopic"), "rostopic")
        eventually(lambda: listens(ros, "/UAV2/imu", "recorder"), "rosbag record")
        stack.enter_context(recorder("/gazebo/model_states", ModelStates))
        assert record.running
        assert echo.running

    return listen


def listens(ros: Ros, topic: str, node_part: str) -> bool:
    subscribers = ros.master.getSystemState("/system_tests")[2][1]
    return any(
        name == topic and any(node_part in node for node in nodes) for name, nodes in subscribers
    )


def test_ready_is_latched_and_turns_true_with_the_last_declared_part(
    start_gazebo: StartGazebo,
) -> None:
    gazebo = start_gazebo(wait_for=len(VEHICLES))
    with recorder("/gazebo/ready", Bool) as ready:
        assert not ready.received(1)[-1].data
        for name in VEHICLES:
            assert not ready.received(1)[-1].data
            gazebo.spawn(name, at=pose(0.0, Y_OF[name], 0.1))
            gazebo.controller(name)
        assert ready.received(2)[-1].data
    with recorder("/gazebo/ready", Bool) as late:
        assert late.received(1)[-1].data


def test_equal_hashes_with_any_listeners_and_at_any_speed(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    first = fly(ros, start_gazebo, "first")
    assert first["steps"] == round(END_S / 0.01)
    assert first["end_reason"] == "end_time"
    with (ros.folder / "first" / "states.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["name"] == "UAV1"]
    assert max(float(row["x"]) for row in rows) > 0.9, "they have flown"
    runs = {
        "again": fly(ros, start_gazebo, "again"),
        "listened to": fly(ros, start_gazebo, "heard", listen=all_kinds_of_listeners(ros)),
        "at 5 times real time": fly(ros, start_gazebo, "paced", real_time_factor=5.0),
    }
    assert runs["at 5 times real time"]["rtf"] < 5.5, "no faster than asked"
    hashes = {label: run["state_hash"] for label, run in runs.items()}
    assert hashes == dict.fromkeys(runs, first["state_hash"])
    states = {
        label: (ros.folder / label / "states.csv").read_bytes()
        for label in ("first", "again", "heard", "paced")
    }
    assert len(set(states.values())) == 1


def test_time_zero_is_held_until_all_that_was_declared_is_there(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    gazebo = start_gazebo(paused=False, wait_for=2)
    gazebo.ask("unpause_physics")
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:

        def says(text: str) -> bool:
            return any(
                text in status.message
                for message in diagnostics.messages[-1:]
                for status in message.status
            )

        eventually(lambda: says("waiting for 2 more vehicle(s)"), "two vehicles are missed")
        gazebo.spawn("UAV1", at=pose(0.0, 2.0, 0.1))
        gazebo.spawn("UAV2", at=pose(0.0, 0.0, 0.1))
        gazebo.controller("UAV1")
        eventually(lambda: says("waiting for the controller of UAV2"), "one controller is missed")
        assert gazebo.time() == 0.0
        gazebo.controller("UAV2")
        gazebo.until(0.5)
        eventually(lambda: says("in lockstep"), "lockstep in the diagnostics")


def test_what_acts_on_a_running_world_from_outside_is_named(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    out_dir = fresh_folder(ros.folder / "outsiders")
    gazebo = start_gazebo(out_dir=out_dir, paused=False, real_time_factor=2.0)
    gazebo.ask("unpause_physics")
    gazebo.until(0.1)
    gazebo.spawn("UAV1")
    state = ModelState("UAV1", pose(z=0.5), Twist(), "world")
    gazebo.ask("set_model_state", model_state=state)
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        eventually(
            lambda: any(
                "not repeatable: the spawning of UAV1" in status.message
                for message in diagnostics.messages
                for status in message.status
            ),
            "the diagnostics name it",
        )
    results = gazebo.finish()
    found = {note["who"]: note["why"] for note in results["not_repeatable"]}
    assert found["the spawning of UAV1"] == "called outside of the lockstep"
    assert "/gazebo/set_model_state" in found
    assert found["the end of the run"] == "interrupted as time ran"


@pytest.mark.parametrize("sent", ["ahead", "in time"])
def test_reset_simulation_and_the_same_commands_give_the_first_hash(
    ros: Ros, start_gazebo: StartGazebo, sent: str
) -> None:
    def flown(gazebo: Gazebo, pilot: Pilot) -> None:
        done = 0
        for stamp, x, y, z in ROUTE[:2]:
            if sent == "in time":
                ahead = round(stamp / 0.01) - 1 - done
                done += ahead
                if ahead > 0:
                    gazebo.step(ahead)
            for name in VEHICLES:
                pilot.send(name, x, Y_OF[name] + y, z, stamp)
        assert gazebo.step(400 - done) == pytest.approx(4.0)

    hashes = []
    for flights_before in (0, 1):
        out_dir = fresh_folder(ros.folder / f"reset-{sent}-{flights_before}".replace(" ", "-"))
        gazebo, _ = start_pair(start_gazebo, out_dir=out_dir)
        with pilot_of(*VEHICLES) as pilot:
            if flights_before:
                for name in VEHICLES:
                    pilot.send(name, -2.0, Y_OF[name], 2.0, 0.01)
                gazebo.step(333)
                gazebo.ask("reset_simulation")
                assert gazebo.time() == 0.0
            flown(gazebo, pilot)
            assert gazebo.position("UAV1")[0] > 0.5, f"flown, after {flights_before} flights"
            hashes.append(gazebo.finish()["state_hash"])
        ros.clean()
    assert hashes[0] == hashes[1]


def test_states_come_once_each_and_in_order_to_a_controller(start_gazebo: StartGazebo) -> None:
    gazebo, _ = start_pair(start_gazebo)
    with pilot_of(*VEHICLES) as pilot:
        for name in VEHICLES:
            pilot.send(name, 0.0, Y_OF[name], 1.0, 0.01)
        with recorder("/UAV1/odometry_sensor1/odometry", Odometry, queue_size=10000) as odometry:
            gazebo.step(300)
            stamps = [
                message.header.stamp.to_nsec() // 10_000_000 for message in odometry.received(300)
            ]
    assert stamps == list(range(stamps[0], stamps[0] + len(stamps)))
