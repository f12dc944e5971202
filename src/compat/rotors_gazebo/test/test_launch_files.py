# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Every launch file loads with its defaults, finds its nodes, and wires what users expect."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
import roslaunch.arg_dump
import roslib.packages
from launch_files import LAUNCH, PACKAGE, arguments_of, load, nodes, parameters

EMPTY_WORLD = PACKAGE.parent / "gazebo_ros" / "launch" / "empty_world.launch"
# Files that are only meant to be included have arguments without defaults.
NEEDED = {"swarm_member.launch": ("number:=1", "mav_name:=firefly", "y:=0", "waypoint:=0 0 1 0 2")}
FILES = [EMPTY_WORLD, *sorted(LAUNCH.rglob("*.launch"))]
EMPTY_WORLD_ARGUMENTS = {
    "paused": "false",
    "use_sim_time": "true",
    "extra_gazebo_args": "",
    "gui": "true",
    "recording": "false",
    "headless": "false",
    "debug": "false",
    "physics": "ode",
    "verbose": "false",
    "output": "screen",
    "world_name": "worlds/empty.world",
    "respawn_gazebo": "false",
    "use_clock_frequency": "false",
    "pub_clock_frequency": "100",
    "enable_ros_network": "true",
    "server_required": "false",
    "gui_required": "false",
    "strict": "false",
}
SIX = [f"UAV{i}" for i in range(1, 7)]


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_launch_file_loads_with_its_defaults(file: Path) -> None:
    assert load(file, *NEEDED.get(file.name, ())).nodes


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_every_node_of_a_launch_file_exists(file: Path) -> None:
    missing = [
        f"{node.package}/{node.type}"
        for node in load(file, *NEEDED.get(file.name, ())).nodes
        if not roslib.packages.find_node(node.package, node.type)
    ]
    assert missing == []


@pytest.mark.parametrize("vehicle", ["firefly", "hummingbird", "iris"])
@pytest.mark.parametrize(
    "name", ["mav.launch", "mav_hovering_example.launch", "mav_with_waypoint_publisher.launch"]
)
def test_single_vehicle_files_take_every_vehicle(name: str, vehicle: str) -> None:
    config = load(LAUNCH / name, f"mav_name:={vehicle}", "gui:=false")
    description = ET.fromstring(str(parameters(config)[f"/{vehicle}/robot_description"]))
    assert description.get("name") == vehicle
    spawn = arguments_of(nodes(config)[f"/{vehicle}/spawn_{vehicle}"])
    assert spawn[spawn.index("-model") + 1] == vehicle


class TestEmptyWorld:
    @pytest.fixture(autouse=True)
    def _of_a_user(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.delenv("TRIDENT_STRICT", raising=False)  # the tests themselves are strict

    def test_arguments_and_defaults_are_the_known_ones(self) -> None:
        declared = roslaunch.arg_dump.get_args([str(EMPTY_WORLD)])
        defaults = {name: default for name, (_, default) in declared.items()}
        internal = {"script_type", "paused_flag", "recording_flag", "verbose_flag"}
        assert {n: d for n, d in defaults.items() if n not in internal} == EMPTY_WORLD_ARGUMENTS

    def test_defaults_start_server_and_viewer(self) -> None:
        config = load(EMPTY_WORLD, "strict:=false")  # what was loaded without is kept
        assert set(nodes(config)) == {"/gazebo", "/gazebo_gui"}
        server = nodes(config)["/gazebo"]
        assert (server.package, server.type) == ("gazebo_ros", "gzserver")
        assert arguments_of(server) == ["-e", "ode", "worlds/empty.world"]
        assert not server.required
        assert not server.respawn
        assert parameters(config) == {
            "/use_sim_time": True,
            "/gazebo/use_sim_time": True,
            "/gazebo/enable_ros_network": True,
            "/gazebo/strict": False,
        }

    def test_every_argument_reaches_the_server(self) -> None:
        config = load(
            EMPTY_WORLD,
            "paused:=true",
            "recording:=true",
            "verbose:=true",
            "physics:=other",
            "extra_gazebo_args:=--seed 5",
            "world_name:=/a/b.world",
            "gui:=false",
            "server_required:=true",
            "respawn_gazebo:=false",
            "use_sim_time:=false",
            "use_clock_frequency:=true",
            "pub_clock_frequency:=20",
            "strict:=true",
        )
        assert set(nodes(config)) == {"/gazebo"}
        server = nodes(config)["/gazebo"]
        expected = ["-u", "-r", "--verbose", "-e", "other", "--seed", "5", "/a/b.world"]
        assert arguments_of(server) == expected
        assert server.required
        assert parameters(config) == {
            "/gazebo/use_sim_time": False,
            "/gazebo/enable_ros_network": True,
            "/gazebo/pub_clock_frequency": 20,
            "/gazebo/strict": True,
        }

    def test_debug_starts_the_debug_server(self) -> None:
        assert nodes(load(EMPTY_WORLD, "debug:=true"))["/gazebo"].type == "debug"


class TestSpawn:
    def test_position_and_namespace_reach_the_spawner(self) -> None:
        config = load(
            LAUNCH / "multi" / "multi_spawn_mav.launch",
            "namespace:=alpha",
            "mav_name:=iris",
            "x:=1",
            "y:=-2",
            "z:=3",
            "tf_prefix:=alpha",
        )
        spawner = nodes(config)["/spawn_alpha"]
        assert (spawner.package, spawner.type) == ("gazebo_ros", "spawn_model")
        words = arguments_of(spawner)
        pairs = dict(zip(words[1::2], words[2::2], strict=True))
        assert words[0] == "-urdf"
        assert pairs == {
            "-param": "robot_description",
            "-model": "alpha",
            "-x": "1",
            "-y": "-2",
            "-z": "3",
        }
        assert parameters(config)["/tf_prefix"] == "alpha"
        description = str(parameters(config)["/robot_description"])
        assert '<link name="alpha/base_link"/>' in description

    @pytest.mark.parametrize("name", ["spawn_mav.launch", "multi/multi_spawn_mav.launch"])
    def test_arguments_are_the_known_ones(self, name: str) -> None:
        declared = roslaunch.arg_dump.get_args([str(LAUNCH / name)])
        assert set(declared) == {
            "mav_name",
            "namespace",
            "model",
            "tf_prefix",
            "x",
            "y",
            "z",
            "enable_logging",
            "enable_ground_truth",
            "log_file",
            "wait_to_record_bag",
            "enable_mavlink_interface",
        }


class TestSixVehicles:
    def test_arguments_and_defaults_are_the_tutorials(self) -> None:
        declared = roslaunch.arg_dump.get_args([str(LAUNCH / "multi_uav_simulation.launch")])
        assert {name: default for name, (_, default) in declared.items()} == {
            "mav_name": "firefly",
            "world_name": "cloister",
            "enable_logging": "false",
            "enable_ground_truth": "true",
            "log_file": "firefly",
            "debug": "false",
            "gui": "true",
            "paused": "true",
            "verbose": "false",
        }

    def test_each_vehicle_has_its_six_nodes(self) -> None:
        found = set(nodes(load(LAUNCH / "multi_uav_simulation.launch")))
        per_vehicle = [
            "lee_position_controller_node",
            "rotors_formation_son",
            "hovering_example",
            "robot_state_publisher",
            "joint_state_publisher",
        ]
        expected = {f"/{uav}/{node}" for uav in SIX for node in [*per_vehicle, f"spawn_{uav}"]}
        assert found == expected | {"/gazebo", "/gazebo_gui"}

    def test_vehicles_stand_in_a_row(self) -> None:
        found = nodes(load(LAUNCH / "multi_uav_simulation.launch"))
        rows = [arguments_of(found[f"/{uav}/spawn_{uav}"]) for uav in SIX]
        places = [[row[row.index(flag) + 1] for flag in ("-x", "-y", "-z")] for row in rows]
        ys = ["4.0", "2.4", "0.8", "-0.8", "-2.4", "-4.0"]
        assert places == [["0.0", y, "0.1"] for y in ys]

    def test_controllers_and_formation_nodes_get_their_parameters(self) -> None:
        config = load(LAUNCH / "multi_uav_simulation.launch")
        values = parameters(config)
        for index, uav in enumerate(SIX):
            controller = f"/{uav}/lee_position_controller_node"
            assert values[f"{controller}/mass"] == 1.56779
            assert values[f"{controller}/position_gain/x"] == 6
            assert values[f"{controller}/rotor_configuration/5/direction"] == -1.0
            assert values[f"/{uav}/rotors_formation_son/UAV"] == f"/{uav}/"
            assert values[f"/{uav}/rotors_formation_son/seq"] == index
            remaps = nodes(config)[controller].remap_args
            assert ("odometry", "odometry_sensor1/odometry") in [tuple(r) for r in remaps]
            description = str(values[f"/{uav}/robot_description"])
            assert f'<link name="{uav}/odometry_sensor1_link">' in description

    def test_simulator_starts_paused_in_the_cloister(self) -> None:
        server = nodes(load(LAUNCH / "multi_uav_simulation.launch"))["/gazebo"]
        words = arguments_of(server)
        assert words[0] == "-u"
        assert Path(words[-1]).resolve() == PACKAGE / "worlds" / "cloister.world"


def test_swarm_has_nine_vehicles_with_a_waypoint_each() -> None:
    found = nodes(load(LAUNCH / "firefly_swarm_hovering_example.launch", "gui:=false"))
    publishers = [found[f"/firefly{i}/waypoint_publisher"] for i in range(1, 10)]
    targets = {tuple(map(float, arguments_of(p)[:3])) for p in publishers}
    assert len(targets) == 9
    spawns = [arguments_of(found[f"/firefly{i}/spawn_firefly{i}"]) for i in range(1, 10)]
    assert len({row[row.index("-y") + 1] for row in spawns}) == 9
