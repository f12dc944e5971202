# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Lockstep over ROS: the world waits for the set-points of enrolled sources."""

from __future__ import annotations

import signal
from typing import Any

import pytest
import rospy
from geometry_msgs.msg import PoseStamped
from harness import (
    Gazebo,
    Pilot,
    Ros,
    eventually,
    fresh_folder,
    logged_problems,
    pilot_of,
    pose,
    program,
)
from lockstep_pair import StartGazebo


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
    assert "the world continues without it" in line


@pytest.mark.parametrize("fields", [{"period": rospy.Duration(0)}, {"vehicles": []}])
def test_a_source_without_period_or_vehicles_is_reported(
    gazebo: Gazebo, fields: dict[str, Any]
) -> None:
    request = {"node": "/odd", "vehicles": ["UAV1"], "period": rospy.Duration(0.1), "enroll": True}
    response = gazebo.call("enroll_source", **{**request, **fields})
    # A period of zero stands for the default.
    assert response.success == ("period" in fields)
    assert response.success or "/odd" in response.message


def test_a_source_that_died_ends_a_run_that_waits_and_a_stopped_one_does_not(
    ros: Ros, start_gazebo: StartGazebo
) -> None:
    out_dir = fresh_folder(ros.folder / "source-died")
    gazebo = start_gazebo(
        wait_for=1,
        wait_for_sources=1,
        real_time_factor=1.0,
        lockstep_policy="wait",
        out_dir=out_dir,
        end_time=1000.0,
        lockstep_timeout=0.03,
        restart_patience=0.5,
    )
    gazebo.spawn("UAV1")
    gazebo.controller("UAV1")
    # Longer than the test takes: nobody misses a source whose flight has ended.
    words = ["_vehicle:=UAV1", "_waypoints:=[[0, 0, 1], [200, 0, 1]]"]
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
