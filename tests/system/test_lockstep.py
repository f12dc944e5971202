# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Lockstep over ROS: equal hashes with any listeners, and what happens when a part dies."""

from __future__ import annotations

import csv
import signal
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from gazebo_msgs.msg import ModelState, ModelStates
from geometry_msgs.msg import PoseStamped, Twist
from harness import (
    Gazebo,
    Pilot,
    Process,
    Ros,
    eventually,
    fresh_folder,
    logged_problems,
    pilot_of,
    pose,
    program,
    recorder,
)
from mav_msgs.msg import Actuators
from nav_msgs.msg import Odometry
from std_msgs.msg import Bool

VEHICLES = ("UAV1", "UAV2")
END_S = 6.0
# Stamp [s] and target [m] of each set-point, y relative to where the vehicle stands.
ROUTE = ((0.01, 0.0, 0.0, 1.0), (2.5, 1.0, 0.3, 1.5), (4.0, 0.5, -0.3, 1.2))
Y_OF = {"UAV1": 2.0, "UAV2": 0.0}
StartGazebo = Callable[..., Gazebo]


def start_pair(start_gazebo: StartGazebo, **params: Any) -> tuple[Gazebo, dict[str, Process]]:
    """A paused server with two fireflies and their controllers."""
    gazebo = start_gazebo(wait_for=len(VEHICLES), **params)
    for name in VEHICLES:
        gazebo.spawn(name, at=pose(0.0, Y_OF[name], 0.1))
    return gazebo, {name: gazebo.controller(name) for name in VEHICLES}


def hover(gazebo: Gazebo, pilot: Pilot, z: float = 1.0) -> None:
    """Has both at ``z`` above where they started; the world runs afterwards."""
    for name in VEHICLES:
        pilot.send(name, 0.0, Y_OF[name], z, 0.01)
    gazebo.ask("unpause_physics")
    gazebo.until(4.0)
    for name in VEHICLES:
        assert gazebo.position(name) == pytest.approx((0.0, Y_OF[name], z + 0.04), abs=0.05)


def hovers(gazebo: Gazebo, name: str, z: float = 1.0) -> bool:
    return gazebo.position(name) == pytest.approx((0.0, Y_OF[name], z + 0.04), abs=0.05)


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
        for stamp, x, y, z in ROUTE:
            for name in VEHICLES:
                pilot.send(name, x, Y_OF[name] + y, z, stamp)
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


def test_set_points_sent_in_time_give_the_flight_of_set_points_sent_ahead(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    period = 0.5
    plan = [(max(0.01, k * period), 0.1 * k, 1.0 + 0.05 * k) for k in range(8)]
    hashes = []
    for fed in (False, True):
        gazebo = start_gazebo(
            wait_for=1, out_dir=fresh_folder(ros.folder / f"fed-{fed}"), end_time=len(plan) * period
        )
        gazebo.spawn("UAV1")
        gazebo.controller("UAV1")
        with pilot_of("UAV1") as pilot:
            if fed:
                feed(gazebo, pilot, plan, period)
            else:
                for stamp, x, z in plan:
                    pilot.send("UAV1", x, 0.0, z, stamp)
                gazebo.ask("unpause_physics")
            hashes.append(gazebo.ended()["state_hash"])
        ros.clean()
    assert hashes[0] == hashes[1]


def feed(
    gazebo: Gazebo, pilot: Pilot, plan: list[tuple[float, float, float]], period: float
) -> None:
    """Enrols as a source, and sends each set-point only when the world stands and waits for it."""
    first, *others = plan
    pilot.send("UAV1", first[1], 0.0, first[2], first[0])
    enrolled = gazebo.ask(
        "enroll_source",
        node="/feeder",
        vehicles=["UAV1"],
        period=rospy.Duration(period),
        end_time=rospy.Time(period * len(plan)),
        enroll=True,
    )
    assert enrolled.start_time.to_sec() in (0.0, period)
    gazebo.ask("unpause_physics")
    for stamp, x, z in others:
        stands_at = pytest.approx(stamp - 0.01, abs=1e-9)
        eventually(lambda at=stands_at: gazebo.time() == at, f"the world waits for {stamp} s")
        assert [gazebo.time() for _ in range(5)] == [stands_at] * 5
        pilot.send("UAV1", x, 0.0, z, stamp)


def test_a_source_that_falls_silent_is_named_and_released(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    gazebo = start_gazebo(wait_for=1, lockstep_timeout=0.1, lockstep_policy="free_run")
    gazebo.spawn("UAV1")
    gazebo.controller("UAV1")
    with pilot_of("UAV1") as pilot:
        pilot.send("UAV1", 0.0, 0.0, 1.0, 0.01)
        gazebo.ask(
            "enroll_source",
            node="/silent",
            vehicles=["UAV1"],
            period=rospy.Duration(0.2),
            enroll=True,
        )
        gazebo.ask("unpause_physics")
        gazebo.process.eventually_logs("set-point source /silent has sent nothing for")
        gazebo.until(1.0)
    line = next(line for line in logged_problems(gazebo.log) if "/silent" in line)
    assert "UAV1" in line
    assert "the world goes on without it" in line


@pytest.mark.parametrize("fields", [{"period": rospy.Duration(0)}, {"vehicles": []}])
def test_a_source_without_period_or_vehicles_is_reported(
    gazebo: Gazebo, fields: dict[str, Any]
) -> None:
    request = {"node": "/odd", "vehicles": ["UAV1"], "period": rospy.Duration(0.1), "enroll": True}
    response = gazebo.call("enroll_source", **{**request, **fields})
    # A period of zero stands for the default.
    assert response.success == ("period" in fields)
    assert response.success or "/odd" in response.message


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


def test_a_killed_controller_is_named_the_other_flies_on_and_a_new_one_is_enrolled(
    start_gazebo: StartGazebo,
) -> None:
    gazebo, controllers = start_pair(start_gazebo, real_time_factor=2.0)
    with pilot_of(*VEHICLES) as pilot, recorder("/diagnostics", DiagnosticArray) as diagnostics:
        hover(gazebo, pilot)
        controllers["UAV1"].stop(signal.SIGKILL)
        gazebo.process.eventually_logs("the controller of UAV1 has disconnected")
        assert "the world goes on without it" in gazebo.log
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
            for stamp, x, y, z in ROUTE:
                for name in VEHICLES:
                    pilot.send(name, x, Y_OF[name] + y, z, stamp)
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
            assert named, "the diagnostics name whom"
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


def test_a_source_that_died_ends_a_run_that_waits_and_a_stopped_one_does_not(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    out_dir = fresh_folder(ros.folder / "source-died")
    gazebo = start_gazebo(
        wait_for=1,
        wait_for_sources=1,
        out_dir=out_dir,
        end_time=1000.0,
        lockstep_timeout=0.03,
        restart_patience=0.5,
    )
    gazebo.spawn("UAV1")
    gazebo.controller("UAV1")
    words = ["_vehicle:=UAV1", "_waypoints:=[[0, 0, 1], [1, 0, 1], [0, 0, 1]]"]
    source = ros.launch([program("trident_fleet", "waypoint_flight.py"), *words], "source")
    gazebo.ask("unpause_physics")
    gazebo.until(0.3)
    source.send(signal.SIGSTOP)
    gazebo.process.eventually_logs("set-point source /waypoint_flight has sent nothing for UAV1")
    stands_at = gazebo.time()
    source.send(signal.SIGCONT)
    gazebo.until(stands_at + 0.2)
    source.stop(signal.SIGKILL)
    assert gazebo.process.wait() == 1
    assert "set-point source /waypoint_flight has died" in gazebo.results()["error"]


def test_a_set_point_counts_when_the_controller_has_it_not_when_it_is_sent(
    start_gazebo: StartGazebo,
) -> None:
    """The source is there first, so that the simulator has seen set-points that nobody has."""
    gazebo = start_gazebo(paused=False, wait_for=1, wait_for_sources=1)
    gazebo.spawn("UAV1")
    period = rospy.Duration(0.1)
    gazebo.ask("enroll_source", node="/early", vehicles=["UAV1"], period=period, enroll=True)
    publisher = rospy.Publisher("/UAV1/command/pose", PoseStamped, queue_size=10, latch=False)
    try:
        eventually(lambda: publisher.get_num_connections() == 1, "the simulator listens")
        message = PoseStamped(pose=pose(0.0, 0.0, 1.0))
        message.header.stamp = rospy.Time.from_sec(0.3)
        publisher.publish(message)
        gazebo.controller("UAV1")
        eventually(lambda: gazebo.time() > 0.0, "all parts are there")
        gazebo.process.eventually_logs("time runs")
        eventually(lambda: gazebo.time() == pytest.approx(0.09), "the world waits")
        assert [gazebo.time() for _ in range(50)] == [pytest.approx(0.09)] * 50
        eventually(lambda: publisher.get_num_connections() == 2, "the controller listens")
        publisher.publish(message)
        gazebo.until(0.2)
    finally:
        publisher.unregister()


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
