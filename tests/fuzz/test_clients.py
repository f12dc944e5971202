# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that only ask others, under hostile answers; one-shot nodes under what they wait for."""

from __future__ import annotations

import math
import os
import pty
import signal
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import pytest
import rospy
from gazebo_msgs.srv import (
    DeleteModel,
    GetLinkProperties,
    GetLinkState,
    GetModelProperties,
    GetModelState,
    GetPhysicsProperties,
    GetPhysicsPropertiesResponse,
    GetWorldProperties,
    GetWorldPropertiesResponse,
    SetModelConfiguration,
    SpawnModel,
    SpawnModelResponse,
)
from geometry_msgs.msg import Twist
from hostile import IS_LONG, MESSAGES, SEED, messages, note_treated, started
from nav_msgs.msg import MapMetaData, OccupancyGrid
from nav_msgs.msg import Path as PathMessage
from std_srvs.srv import Empty
from trajectory_msgs.msg import MultiDOFJointTrajectory
from trident.testing import Process, Ros, eventually, program, recorder
from trident.testing.fuzz import (
    Campaign,
    CampaignOptions,
    Generator,
    HostileServer,
    Target,
    non_finite,
)
from trident.testing.fuzz.generator import serialized
from trident_eval.core.errors import EvalError
from trident_fleet.core.errors import FormationError
from trident_fleet.nodes.spawn_fleet import read_positions, spawn_all
from trident_nav.nodes.waypoint_path import enroll
from trident_viewer.census import models_in_the_world
from trident_viewer.hold import Held
from trident_viewer.observer_camera import place_of

from trident_msgs.srv import EnrollSource, EnrollSourceResponse, Step, StepResponse

#: They end at the first answer that they refuse, and a start takes tenths of a second.
STARTS = 100 if IS_LONG else 3
#: To functions of those nodes that need no start for each refusal.
ANSWERS = messages(10)
HOLDING = {
    "/gazebo/pause_physics": Empty,
    "/gazebo/step": Step,
    "/gazebo/get_world_properties": GetWorldProperties,
    "/gazebo/get_physics_properties": GetPhysicsProperties,
}
SHOWING = {
    "/gazebo/get_world_properties": GetWorldProperties,
    "/gazebo/get_model_properties": GetModelProperties,
    "/gazebo/get_model_state": GetModelState,
    "/gazebo/get_link_state": GetLinkState,
    "/gazebo/get_link_properties": GetLinkProperties,
    "/gazebo/spawn_sdf_model": SpawnModel,
    "/gazebo/delete_model": DeleteModel,
}
SPAWNING = {
    "/gazebo/get_world_properties": GetWorldProperties,
    "/gazebo/spawn_urdf_model": SpawnModel,
    "/gazebo/set_model_configuration": SetModelConfiguration,
    "/gazebo/unpause_physics": Empty,
}
WORLD = GetWorldPropertiesResponse(sim_time=1.0, model_names=["box"], success=True)


def server(services: dict[str, Any], **examples: Any) -> HostileServer:
    named = {f"/gazebo/{name}": answer for name, answer in examples.items()}
    return HostileServer(services, SEED, named, words=("box", "UAV1"))


def ends(process: Process, *codes: int) -> None:
    """By itself, with one of these exit codes and without a traceback."""
    assert process.wait() in codes, process.log[-3000:]
    assert "Traceback" not in process.log, process.log[-3000:]
    assert "terminate called" not in process.log, process.log[-3000:]


def treat_starts(ros: Ros, package: str, name: str, *words: str, starts: int = STARTS) -> None:
    """Start it some times, to its end."""
    for number in range(starts):
        process = ros.launch([program(package, name), *words], f"{name}-{number}")
        note_treated(process)
        ends(process, 0, 1)


@pytest.mark.fuzzes("trident_viewer/hold_at.py")
def test_hold_at(ros: Ros) -> None:
    examples = {
        "step": StepResponse(success=True, sim_time=rospy.Time(1, 500_000_000)),
        "get_world_properties": WORLD,
        "get_physics_properties": GetPhysicsPropertiesResponse(time_step=0.01, success=True),
    }
    with server(HOLDING, **examples) as answers:
        while answers.answered.total() < ANSWERS:
            with suppress(rospy.ROSException):
                Held().advance_to(2.0, math.inf)
        treat_starts(ros, "trident_viewer", "hold_at.py", "1.5")
    assert not answers.problems, answers.problems


@pytest.mark.fuzzes("trident_viewer/overview.py")
def test_overview_asks(ros: Ros, tmp_path: Path) -> None:
    """Of what it hears: test_viewing.py."""
    with server(SHOWING, get_world_properties=WORLD) as answers:
        while answers.answered.total() < ANSWERS:
            with suppress(EvalError):
                for sphere in models_in_the_world():
                    assert all(map(math.isfinite, (*sphere.center, sphere.radius_m)))
            with suppress(EvalError):
                assert all(map(math.isfinite, place_of("box")))
    with server({**SHOWING, **HOLDING}, get_world_properties=WORLD) as answers:
        # Once: it is the slowest of them.
        words = ("--hold", f"--out={tmp_path / 'all.png'}")
        treat_starts(ros, "trident_viewer", "overview.py", *words, starts=1)
    assert not answers.problems, answers.problems


@pytest.mark.fuzzes("gazebo_ros/spawn_model")
def test_spawn_model(ros: Ros) -> None:
    ros.set_param("/robot_description", "<robot name='r'/>")
    words = "-urdf -param robot_description -model UAV1 -J joint 0.5 -unpause -wait box"
    with server(SPAWNING, spawn_urdf_model=SpawnModelResponse(True, "")) as answers:
        treat_starts(ros, "gazebo_ros", "spawn_model", *words.split())
    assert answers.answered["/gazebo/get_world_properties"] >= STARTS
    assert not answers.problems, answers.problems


@pytest.mark.fuzzes("trident_fleet/spawn_fleet.py")
def test_spawn_fleet(ros: Ros) -> None:
    positions = {f"UAV{number}": [2.0 * number, 0.0, 0.1] for number in range(10)}
    parameters = {"robot_description": "<robot name='NAME'/>", "namespace_token": "NAME"}
    ros.set_param("/spawn_fleet", {**parameters, "positions": positions})
    with server(SPAWNING, spawn_urdf_model=SpawnModelResponse(True, "")) as answers:
        while answers.answered.total() < ANSWERS:
            with suppress(FormationError, rospy.ServiceException):
                spawn_all("<robot name='NAME'/>", "NAME", read_positions(positions, None))
        treat_starts(ros, "trident_fleet", "spawn_fleet.py")
    assert not answers.problems, answers.problems


@pytest.mark.fuzzes("trident_nav/waypoint_path.py")
def test_waypoint_path(ros: Ros) -> None:
    ros.set_param("/use_sim_time", True)
    parameters = {"start": [1.0, 2.0, 0.5], "waypoints": [[0, 0], [10, 0]], "vehicle": "USV1"}
    ros.set_param("/waypoint_path", parameters)
    sane = EnrollSourceResponse(success=True, start_time=rospy.Time(100))
    with server({"/gazebo/enroll_source": EnrollSource}, enroll_source=sane) as answers:
        while answers.answered.total() < ANSWERS:
            start = enroll("USV1")
            assert start is None or 0.0 <= start.to_sec() < 2**31
        process = started(ros, "/waypoint_path", [program("trident_nav", "waypoint_path.py")])
        note_treated(process)
        with recorder("/path", PathMessage) as paths:
            eventually(lambda: bool(paths.messages), "a path")
        assert not non_finite(paths.messages[0])
        assert process.stop(signal.SIGINT) == 0, process.log
        assert "Traceback" not in process.log, process.log
    assert not answers.problems, answers.problems


@pytest.mark.fuzzes(
    "rotors_gazebo/hovering_example",
    "rotors_gazebo/waypoint_publisher",
    "rotors_gazebo/waypoint_publisher_file",
)
@pytest.mark.parametrize(
    "name", ["hovering_example", "waypoint_publisher", "waypoint_publisher_file"]
)
def test_rotors_examples(ros: Ros, tmp_path: Path, name: str) -> None:
    """A strange clock, and strange first words of an IMU, do not end them before their work."""
    file = tmp_path / "waypoints.txt"
    file.write_text("1 2 3 4 90\n")
    words = {
        "waypoint_publisher": ["0", "0", "1", "90", "3"],
        "waypoint_publisher_file": [str(file)],
    }
    ros.set_param("/use_sim_time", True)
    with server({"/gazebo/unpause_physics": Empty}):
        command = [program("rotors_gazebo", name), "__name:=sender", *words.get(name, [])]
        process = started(ros, "/sender", command)
        withstands_until_it_sends(process, "/imu" if name.endswith("_file") else "/clock")


def withstands_until_it_sends(process: Process, last: str) -> None:
    """`last`: of the topics that it subscribes to."""
    target = Target("/sender", skip=("/command/trajectory",))  # with a listener its work is done
    note_treated(target)
    eventually(lambda: last in target.subscriptions(), f"a subscriber of {last}")
    found = Campaign(target, CampaignOptions(messages=MESSAGES, seed=SEED)).run()
    print(found.text())
    assert not found.problems, found.text()
    with recorder("/command/trajectory", MultiDOFJointTrajectory) as sent:
        ends(process, 0)
        eventually(lambda: bool(sent.messages), "the trajectory")
    assert not non_finite(sent.messages[0])


@pytest.mark.fuzzes("map_server/map_saver")
def test_map_saver(ros: Ros, tmp_path: Path) -> None:
    """It refuses what is no map, and keeps the first that is one."""
    generator = Generator(SEED, ("map",))
    topic = rospy.Publisher("/map", OccupancyGrid, queue_size=None, tcp_nodelay=True)
    command = [program("map_server", "map_saver"), "__name:=saver", "-f", str(tmp_path / "map")]
    process = started(ros, "/saver", command)
    for number in range(messages(20)):
        if not process.running:
            ends(process, 0)
            process = started(ros, "/saver", command)
        target = Target("/saver")
        eventually(partial(is_connected_or_ended, topic, process), "the saver's connection")
        generator.begin(number)
        with suppress(rospy.ROSException, OSError):
            topic.publish(hostile_map(generator, number))
            target.settle()
    if process.running:
        note_treated(process)
        topic.publish(sane_map())
    ends(process, 0)
    topic.unregister()
    assert (tmp_path / "map.pgm").read_bytes().startswith(b"P5")


def is_connected_or_ended(topic: rospy.Publisher, process: Process) -> bool:
    return topic.get_num_connections() > 0 or not process.running


def sane_map() -> OccupancyGrid:
    grid = OccupancyGrid(info=MapMetaData(resolution=0.05, width=3, height=2), data=[0] * 6)
    grid.info.origin.orientation.w = 1.0
    return grid


def hostile_map(generator: Generator, number: int) -> Any:
    if number % 100 == 1:  # larger than all memory, and empty
        return OccupancyGrid(info=MapMetaData(resolution=0.05, width=10**9, height=10**9))
    if generator.chance(0.99):
        return generator.message(OccupancyGrid)
    return generator.mutated(serialized(sane_map()), OccupancyGrid)


@pytest.mark.fuzzes("teleop_twist_keyboard/teleop_twist_keyboard.py")
def test_keyboard(ros: Ros, tmp_path: Path) -> None:
    """Whatever is typed: velocities are numbers, and Ctrl-C ends it with rest."""
    master, terminal = pty.openpty()
    name = program("teleop_twist_keyboard", "teleop_twist_keyboard.py")
    with (tmp_path / "screen").open("w") as screen:
        process = ros.start([name, "__name:=keys"], stdin=terminal, stdout=screen)
    os.close(terminal)
    keys = Generator(SEED).begin(0).randbytes(MESSAGES).replace(b"\x03", b"i")
    with recorder("/cmd_vel", Twist) as velocities:

        def drives() -> bool:
            os.write(master, b"i")
            return bool(velocities.messages) and velocities.messages[-1].linear.x > 0.0

        eventually(drives, "a velocity")
        note_treated(Target("/keys"))
        for begin in range(0, len(keys), 256):
            os.write(master, keys[begin : begin + 256])
        eventually(drives, "a velocity afterwards")
        os.write(master, b"\x03")
        eventually(lambda: process.poll() is not None, "its end")
        assert velocities.messages[-1] == Twist()
        assert not any(non_finite(velocity) for velocity in velocities.messages)
    os.close(master)
    assert process.returncode == 0, (tmp_path / "screen").read_text()
