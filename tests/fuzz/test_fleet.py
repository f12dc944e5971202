# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that command a fleet, under hostile messages while the simulator stands."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
import rospy
from hostile import SEED, messages, note_treated, odometry, started
from nav_msgs.msg import Odometry
from trident.testing import Gazebo, Launch, Ros, pose, program, vehicle_urdf
from trident.testing.fuzz import Campaign, CampaignOptions, Target
from trident.testing.waiting import eventually
from trident_worldgen.coast import CoastConfig, coast
from trident_worldgen.sdf import write_files

MISSIONS = Path(__file__).resolve().parents[2] / "config" / "missions"
LEADER = "/UAV1/odometry_sensor1/odometry"
#: Nodes that share the code of formation_node, each with a vehicle of its own: what they are, and
#: one in how many messages they get. The first one plans again whenever time goes back; the last
#: one answers each command that is not its own with all that it sent lately.
NODES = {
    "UAV1": ("trident_fleet", "formation_all.py", 5),
    "UAV2": ("trident_fleet", "waypoint_flight.py", 1),
    "UAV3": ("rotors_teleop", "rotors_formation_son.py", 100),
}

RADIO = '<plugin name="radio" filename="libtrident_radio.so"/>'
BOAT = f"""<sdf version="1.6"><model name="boat"><static>true</static><link name="link"/>
<plugin name="truth" filename="libgazebo_ros_p3d.so"><topicName>odom</topicName>
<bodyName>link</bodyName></plugin>{RADIO}</model></sdf>"""
RULES = "rules: [{topic: odom, from: [boat], to: [UAV1]}]\n"


def withstands(node: str, part: int = 1, words: tuple[str, ...] = ("UAV1", "UAV2")) -> None:
    """It lives, and commands nothing that is no number.

    Who takes the simulator's place, or the leader's, is obeyed: where it flies is not asked.

    Args:
        node: its full name.
        part: see `messages`: each of them may have it command minutes of a flight.
        words: that texts are made of, among others.
    """
    count = messages(part)
    settings = CampaignOptions(messages=count, seed=SEED, batch=20, words=words)
    target = Target(node)
    note_treated(target)
    found = Campaign(target, settings).run()
    print(node, found.text())
    assert not found.problems, found.text()
    assert sum(found.sent.values()) == count


def has_no_traceback(name: str, log: str) -> None:
    # rospy itself logs one where a topic is given up while it is being connected.
    own = [line for line in log.splitlines() if "[rospy.internal]" not in line]
    assert not any("Traceback" in line for line in own), f"{name}: {log[:5000]}"


def has_stood_it(run: Launch) -> None:
    for name, log in run.logs():
        has_no_traceback(name, log)
    assert not run.died()


@pytest.mark.fuzzes("trident_fleet/formation_node.py")
def test_a_formation_node(ros: Ros) -> None:
    file = "multi_uav_simulation.launch"
    with Launch(ros, "trident_bringup", file, uavs=2, mode="gate", paused=True) as run:
        run.ready()
        run.step_to(1.0)
        withstands("/UAV1/formation_node")
        has_stood_it(run)


@pytest.mark.fuzzes("trident_fleet/leader_follower.py")
def test_a_follower(ros: Ros) -> None:
    file = "leader_follower.launch"
    with Launch(ros, "trident_bringup", file, uavs=2, leader_topic=LEADER, paused=True) as run:
        run.ready()
        run.step_to(1.0)
        withstands("/leader_follower")
        has_stood_it(run)


@pytest.mark.fuzzes("trident_fleet/search_and_rescue.py")
def test_a_team_that_searches(ros: Ros, tmp_path: Path) -> None:
    """It hears the states of all robots and the odometry of those on wheels."""
    write_files(coast(CoastConfig(covers=1, casualties=1)), tmp_path)
    simulation = Gazebo(ros, wait_for_sources=1).ready()
    simulation.spawn("ugv1", BOAT.replace("<static>true</static>", ""), pose(z=1.0))
    files = {
        "scene": tmp_path / "coast.scene.yaml",
        "numbers": MISSIONS / "search_and_rescue.yaml",
        "tree": MISSIONS / "search_and_rescue_tree.yaml",
    }
    words = [f"_{name}:={file}" for name, file in files.items()]
    node = [program("trident_fleet", "search_and_rescue.py"), "__name:=search_and_rescue"]
    process = started(ros, "/search_and_rescue", [*node, "_mode:=ugv", *words])
    target = Target("/search_and_rescue")
    eventually(lambda: "/ugv1/odom" in str(target.subscriptions()), "it hears the robot")
    withstands("/search_and_rescue", words=("ugv1", "usv1"))
    assert process.running
    has_no_traceback("search_and_rescue", process.log)


@pytest.mark.fuzzes("trident_fleet/base_station.py")
def test_a_base_station(ros: Ros, tmp_path: Path) -> None:
    """It decides at each status of its links, and takes none of a stranger."""
    rules = tmp_path / "rules.yaml"
    rules.write_text(RULES, encoding="utf-8")
    simulation = Gazebo(ros, radio_rules=str(rules), wait_for=1, wait_for_sources=1).ready()
    urdf = vehicle_urdf("UAV1").replace("</robot>", f"<gazebo>{RADIO}</gazebo></robot>")
    simulation.spawn("boat", BOAT, pose(x=40.0))
    simulation.spawn("UAV1", urdf, pose(z=0.1))
    simulation.controller("UAV1")
    words = ["_vehicle:=UAV1", "_links:=[boat]"]
    fence = "_fence:=[[-30, -30], [30, -30], [30, 30], [-30, 30]]"
    command = [program("trident_fleet", "base_station.py"), "__name:=base_station"]
    process = started(ros, "/base_station", [*command, *words, fence])
    simulation.step_to(2.0)
    withstands("/base_station", 5)
    has_no_traceback("base_station", process.log)
    assert process.running, process.log
    simulation.step_to(4.0)
    assert process.stop(signal.SIGINT) == 0


@pytest.mark.fuzzes("trident_fleet/cnp_coordinator.py")
def test_a_coordinator(ros: Ros) -> None:
    """It keeps to its own team, and says where its robot should be in finite numbers."""
    team = "_robots:={rover: {role: ugv}, boat: {role: usv}}"
    command = [program("trident_fleet", "cnp_coordinator.py"), "__name:=rover", team]
    process = started(ros, "/rover", [*command, "_pose_topic:=/rover/odom"])
    fed = rospy.Publisher("/rover/odom", Odometry, queue_size=1, latch=True)
    fed.publish(odometry())
    eventually(lambda: fed.get_num_connections() > 0, "/rover/odom")
    withstands("/rover", 5, words=("rover", "boat"))
    has_no_traceback("cnp_coordinator", process.log)
    assert process.running, process.log
    assert process.stop(signal.SIGINT) == 0


@pytest.fixture
def world(ros: Ros) -> Gazebo:
    """Vehicles with controllers, which wait for their set-points."""
    simulation = Gazebo(ros, wait_for=len(NODES), wait_for_sources=len(NODES)).ready()
    for number, name in enumerate(NODES):
        simulation.spawn(name, at=pose(x=3.0 * number, z=0.1))
        simulation.controller(name)
    return simulation


@pytest.mark.fuzzes(*(f"{package}/{name}" for package, name, _ in NODES.values()))
def test_its_kin(ros: Ros, world: Gazebo, tmp_path: Path) -> None:
    """Their common code is under more of them in `test_a_formation_node`."""
    file = tmp_path / "one.txt"
    file.write_text("1 0 0 1\n2 50 0 1\n")
    formation = [f"_formation_file:={file}", "_vehicles_in_file:=1"]
    words = {
        "UAV1": [*formation, "_vehicles:=[UAV1]", "_mode:=gate"],
        "UAV2": ["_vehicle:=UAV2", "_waypoints:=[[0, 0, 1], [50, 0, 1]]"],
        "UAV3": [*formation, "_UAV:=/UAV3/", "_seq:=0", "_mode:=time"],
    }
    processes = {
        name: started(
            ros,
            f"/source_{name}",
            [program(*NODES[name][:2]), f"__name:=source_{name}", *words[name]],
        )
        for name in NODES
    }
    world.step_to(1.0)
    for name, process in processes.items():
        withstands(f"/source_{name}", NODES[name][2])
        has_no_traceback(name, process.log)
        assert process.running, process.log
    assert {process.stop(signal.SIGINT) for process in processes.values()} == {0}
