# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Launch files as their users start them: roslaunch, a look around, Ctrl-C."""

from __future__ import annotations

import math
import re
import time
from itertools import combinations

import pytest
from gazebo_msgs.msg import ModelStates
from harness import Launch, Ros, eventually, recorder, topic_rate

FLEET = [f"UAV{number}" for number in range(1, 7)]
SHUTDOWN_LIMIT_S = 5.0


def interrupt(run: Launch) -> None:
    """Ctrl-C, and what must be true of the end."""
    assert len(run.process.family()) > 1
    unclean = run.end()
    # Debian's joint_state_publisher can lock up in rospy's signal handler; that is not ours.
    assert all("joint_state_publisher" in text for text in unclean), f"{unclean}:\n{run.log}"
    took = run.shutdown_s
    assert unclean or took < SHUTDOWN_LIMIT_S, f"the shutdown took {took:.1f} s:\n{run.log}"
    for name, text in run.logs():
        # rospy's own sockets, closed while it connects them, are noted in its log file only.
        reported = [line for line in text.splitlines() if "[rospy.internal]" not in line]
        assert not any("Traceback" in line for line in reported), f"{name}:\n{text[-3000:]}"
        assert "Segmentation fault" not in text, f"{name}:\n{text[-3000:]}"


def separation(states: ModelStates) -> float:
    points = [
        (pose.position.x, pose.position.y, pose.position.z)
        for name, pose in zip(states.name, states.pose, strict=True)
        if name in FLEET
    ]
    return min(math.dist(a, b) for a, b in combinations(points, 2))


def test_the_headline_launch_runs_in_real_time_until_ctrl_c(ros: Ros) -> None:
    run = Launch(
        ros, "trident_bringup", "multi_uav_simulation.launch", real_time_factor=None
    ).spawned(*FLEET)
    run.until(1.0)
    wall, simulated = time.monotonic(), run.time()
    assert topic_rate(ros, "/UAV3/odometry_sensor1/odometry") == pytest.approx(100.0, rel=0.2)
    run.until(simulated + 4.0)
    factor = (run.time() - simulated) / (time.monotonic() - wall)
    assert factor == pytest.approx(1.0, abs=0.2)
    info = ros.call("rosnode", "info", "/gazebo")
    assert "/UAV6/odometry_sensor1/odometry [nav_msgs/Odometry]" in info
    state = ros.call("rosservice", "call", "/gazebo/get_model_state", "UAV1", "world")
    assert "success: True" in state
    assert re.search(r"status_message: \S+", state)
    assert "/UAV2/command/motor_speed" in ros.call("rostopic", "list")
    interrupt(run)


def test_the_tutorial_form_flies_the_formation_and_not_the_hovering_example(ros: Ros) -> None:
    # In real time, as its users start it: after five seconds the hovering examples send all
    # vehicles to one place, and by then six of them and their formation nodes have to be there.
    # A formation node that is late is waited for: on a slow machine, too, its set-points follow.
    ros.set_param("/gazebo/lockstep_policy", "wait")
    run = Launch(
        ros,
        "rotors_gazebo",
        "multi_uav_simulation.launch",
        gui=True,
        real_time_factor=1.0,
    ).spawned(*FLEET)
    with recorder("/gazebo/model_states", ModelStates) as states:
        run.until(15.0)
        closest = min(states.messages, key=separation)
        assert separation(closest) > 0.5, closest
    heights = [run.position(name)[2] for name in FLEET]
    assert min(heights) > 0.3, "all have taken off"
    places = [run.position(name)[:2] for name in FLEET]
    assert all(math.dist(a, b) > 0.5 for a, b in combinations(places, 2)), "not all at (0, 0, 1)"
    assert run.log.count("Publishing 1 waypoint(s)") == len(FLEET), "the examples have run"
    assert "there is no display" in run.log
    assert "rviz" in run.log
    topics = set(ros.call("rostopic", "list").split())
    assert {f"/{name}/joint_states" for name in FLEET} <= topics
    interrupt(run)


def test_the_hovering_example_as_it_stands_paused_with_a_viewer(ros: Ros) -> None:
    run = Launch(
        ros, "rotors_gazebo", "mav_hovering_example.launch", real_time_factor=10.0
    ).spawned("firefly")
    eventually(
        lambda: run.position("firefly") == pytest.approx((0.0, 0.0, 1.04), abs=0.02),
        "hovering at 1.04 m",
    )
    interrupt(run)


def test_the_swarm_example_takes_nine_to_their_places(ros: Ros) -> None:
    run = Launch(
        ros, "rotors_gazebo", "firefly_swarm_hovering_example.launch", real_time_factor=4.0
    ).spawned(*(f"firefly{number}" for number in range(1, 10)))
    goals = [(0, -1), (1, -1), (1, 0), (1, -2), (-1, 0), (-2, 0), (-3, 0), (-4, 0), (0, 0)]

    def all_there() -> bool:
        return all(
            run.position(f"firefly{number}") == pytest.approx((x, y, 1.04), abs=0.05)
            for number, (x, y) in enumerate(goals, 1)
        )

    eventually(all_there, "all nine at their places", limit_s=120.0)
    interrupt(run)


def test_empty_world_takes_the_arguments_of_the_original(ros: Ros) -> None:
    words = (
        "paused:=true use_sim_time:=true gui:=false headless:=true recording:=false debug:=false "
        "physics:=ode verbose:=true output:=screen respawn_gazebo:=false server_required:=true "
        "use_clock_frequency:=true pub_clock_frequency:=50 world_name:=worlds/empty.world"
    )
    run = Launch(
        ros, "gazebo_ros", "empty_world.launch", *words.split(), real_time_factor=None
    ).spawned("ground_plane")
    assert run.time() == 0.0
    assert ros.master.getParam("/system_tests", "/use_sim_time")[2] is True
    run.step(10)
    interrupt(run)
