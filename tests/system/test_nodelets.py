# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Simulator and controllers as nodelets of one manager: the same flights, in one process."""

from __future__ import annotations

import threading
from contextlib import AbstractContextManager
from typing import Any

import pytest
import rospy
from bond.msg import Status
from geometry_msgs.msg import PoseStamped
from harness import (
    Gazebo,
    Pilot,
    Process,
    Ros,
    eventually,
    fresh_folder,
    logged_problems,
    package,
    pilot_of,
    pose,
    recorder,
    vehicle_urdf,
)
from meadow import RADIO, ROBOT
from std_msgs.msg import Header

MANAGER = "/nodelets"
VEHICLES = ("UAV1", "UAV2")
Y_OF = {"UAV1": 0.0, "UAV2": 2.0}


class Processes(Gazebo):
    """The server and its controllers, a process each."""

    def pilot(self) -> AbstractContextManager[Pilot]:
        return pilot_of(*VEHICLES)


class Nodelets(Gazebo):
    """The server in a nodelet manager, which is its process, and controllers loaded into it."""

    def pilot(self) -> AbstractContextManager[Pilot]:
        return pilot_of(*VEHICLES, node=MANAGER)

    def _start_server(self, arguments: list[str]) -> Process:
        manager = self.ros.launch(
            ["rosrun", "nodelet", "nodelet", "manager", f"__name:={MANAGER[1:]}"], "manager"
        )
        self.loader = self.load("gazebo_ros/gzserver", [*arguments, "__name:=gazebo"])
        return manager

    def _start_controller(self, vehicle: str, arguments: list[str]) -> Process:
        return self.load("rotors_control/lee_position_controller", arguments)

    def load(self, kind: str, arguments: list[str]) -> Process:
        """Starts what roslaunch starts for a nodelet: it ends when the nodelet is unloaded."""
        command = ["rosrun", "nodelet", "nodelet", "load", kind, MANAGER, *arguments]
        return self.ros.launch(command, kind)

    def bound(self, loaders: int) -> None:
        """Return when manager and loaders have heard of each other.

        A flight of milliseconds could end before: then the manager, which ends with it, aborts in
        nodelet::Loader's destructor (bond::Bond's calls back into it).
        """
        with recorder(f"{MANAGER}/bond", Status) as statuses:
            statuses.connected(1 + loaders)

            def is_bound(bond: str) -> bool:
                """The manager has spoken after the loader has."""
                senders = [
                    message._connection_header["callerid"]
                    for message in statuses.messages
                    if message.id == bond
                ]
                loader_spoke = [sender != MANAGER for sender in senders]
                return True in loader_spoke and MANAGER in senders[loader_spoke.index(True) :]

            def all_bound() -> bool:
                return sum(map(is_bound, {message.id for message in statuses.messages})) == loaders

            eventually(all_bound, f"{loaders} bonds")


def fly(ros: Ros, kind: type[Processes | Nodelets], label: str, **params: Any) -> dict[str, Any]:
    """Two vehicles take off and fly a metre aside; the results."""
    gazebo = kind(ros, wait_for=2, out_dir=fresh_folder(ros.folder / label), end_time=4.0, **params)
    gazebo.ready()
    for name in VEHICLES:
        gazebo.spawn(name, at=pose(0.0, Y_OF[name], 0.1))
        gazebo.controller(name)
    if isinstance(gazebo, Nodelets):
        gazebo.bound(1 + len(VEHICLES))
    with gazebo.pilot() as pilot:
        for name in VEHICLES:
            pilot.send(name, 0.0, Y_OF[name], 1.0, 0.01)
            pilot.send(name, 1.0, Y_OF[name], 1.0, 2.0)
        gazebo.ask("unpause_physics")
        results = gazebo.ended()
    assert not logged_problems(gazebo.log), gazebo.log
    ros.clean()
    return results


def test_nodelets_fly_as_processes_do_to_the_bit(ros: Ros) -> None:
    processes = fly(ros, Processes, "processes")
    nodelets = fly(ros, Nodelets, "nodelets")
    paced = fly(ros, Nodelets, "paced", real_time_factor=10.0)
    assert processes["sim_s"] == pytest.approx(4.0)
    assert nodelets["state_hash"] == processes["state_hash"]
    assert paced["state_hash"] == processes["state_hash"]
    assert (ros.folder / "nodelets" / "states.csv").read_bytes() == (
        ros.folder / "processes" / "states.csv"
    ).read_bytes()


def test_controllers_are_loaded_while_set_points_are_confirmed(ros: Ros) -> None:
    """Loading, delivering and stepping take locks of roscpp: none waits for the other."""
    names = [f"UAV{number + 1}" for number in range(8)]
    gazebo = Nodelets(ros, wait_for=1 + len(names)).ready()  # time zero is held to the end
    publishers = [
        rospy.Publisher(f"/{name}/command/pose", PoseStamped, queue_size=1) for name in names
    ]
    is_over = threading.Event()

    def send() -> None:
        while not is_over.wait(0.0005):
            for publisher in publishers:
                publisher.publish(PoseStamped(pose=pose(0.0, 0.0, 1.0)))

    sender = threading.Thread(target=send)
    sender.start()
    try:
        for index, name in enumerate(names):
            gazebo.spawn(name, at=pose(0.0, 2.0 * index, 0.1))
        for name in names:
            gazebo.controller(name)
        for publisher in publishers:
            eventually(
                lambda p=publisher: p.get_num_connections() > 0, f"a reader of {publisher.name}"
            )
        assert gazebo.ask("get_world_properties").success
    finally:
        is_over.set()
        sender.join()


def test_a_controller_that_is_unloaded_is_missed_and_a_process_may_take_its_place(
    ros: Ros,
) -> None:
    gazebo = Nodelets(ros, wait_for=2, lockstep_policy="wait", real_time_factor=20.0)
    gazebo.ready()
    loaders = {}
    for name in VEHICLES:
        gazebo.spawn(name, at=pose(0.0, Y_OF[name], 0.1))
        loaders[name] = gazebo.controller(name)
    with gazebo.pilot() as pilot:
        for name in VEHICLES:
            pilot.send(name, 0.0, Y_OF[name], 1.0, 0.01)
        gazebo.ask("unpause_physics")
        gazebo.until(3.0)
    loaders["UAV1"].stop()
    gazebo.process.eventually_logs("the controller of UAV1 has disconnected; the world waits")
    stands_at = gazebo.time()
    process = Gazebo._start_controller(
        gazebo,
        "UAV1",
        [
            "__ns:=/UAV1",
            "__name:=lee_position_controller_node",
            "odometry:=odometry_sensor1/odometry",
        ],
    )
    gazebo.until(stands_at + 1.0)
    assert process.running
    with pilot_of("UAV1") as pilot:
        pilot.send("UAV1", 0.0, 0.0, 1.0, gazebo.time() + 1.0)


def test_what_a_nodelet_of_the_same_process_publishes_crosses_by_radio(ros: Ros) -> None:
    rules = ros.folder / "team.yaml"
    rules.write_text("rules:\n  - {topic: command/accepted_setpoint, reliability: reliable}\n")
    gazebo = Nodelets(ros, radio_rules=str(rules)).ready()
    radio = f"<gazebo>{RADIO}</gazebo></robot>"
    gazebo.spawn("UAV1", vehicle_urdf("UAV1").replace("</robot>", radio))
    gazebo.spawn("boat", ROBOT, pose(x=60.0, z=1.0))
    gazebo.controller("UAV1")
    publisher = rospy.Publisher("/UAV1/command/pose", PoseStamped, queue_size=1)
    with recorder("/boat/from/UAV1/command/accepted_setpoint", Header) as heard:
        eventually(lambda: publisher.get_num_connections() > 0, "the controller")

        def is_heard() -> bool:
            publisher.publish(PoseStamped(pose=pose(0.0, 0.0, 1.0)))
            gazebo.step(10)
            return len(heard.messages) > 0

        eventually(is_heard, "the nodelet's message by radio")
    publisher.unregister()


def test_the_server_may_be_unloaded_and_loaded_again(ros: Ros) -> None:
    gazebo = Nodelets(ros).ready()
    gazebo.spawn("UAV1")
    gazebo.step(10)
    gazebo.loader.stop()

    def serves() -> bool:
        return bool(ros.master.lookupService("/system_tests", "/gazebo/step")[0] == 1)

    eventually(lambda: not serves(), "the services of an unloaded server go")
    assert gazebo.process.running
    world = package("rotors_gazebo") / "worlds" / "basic.world"
    gazebo.load("gazebo_ros/gzserver", ["-u", str(world), "__name:=gazebo"])
    gazebo.ready()
    assert gazebo.ask("get_world_properties").model_names == ["ground_plane"]
    assert gazebo.step(1) == pytest.approx(0.01)


def test_what_is_wrong_is_said_and_the_manager_continues(ros: Ros) -> None:
    gazebo = Nodelets(ros).ready()
    ros.set_param("/UAV1/lee/mass", -1.0)
    refused = gazebo.load("rotors_control/lee_position_controller", ["__name:=lee", "__ns:=/UAV1"])
    assert refused.wait() != 0
    lost = gazebo.load("gazebo_ros/gzserver", ["/no/such.world", "__name:=other"])
    assert lost.wait() != 0
    log = gazebo.log
    assert "/UAV1/lee/mass: -1 is out of range" in log
    assert "/no/such.world" in log
    assert gazebo.step(1) == pytest.approx(0.01)
