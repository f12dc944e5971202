# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The vessels as they ship load, float at their waterline and go where they are pushed."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt
import pytest

trident_sim = pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

URDF = Path(__file__).resolve().parents[1] / "urdf"
NOTHING = '<sdf version="1.6"><world name="nothing"><gravity>0 0 0</gravity></world></sdf>'
OCEAN = "package://trident_bringup/worlds/ocean.world"

#: z of base_link at rest [m], thruster command, the speed that it gives [m/s].
FIGURES = {
    "otter": (0.0, 60.0, 1.029),
    "wamv": (-0.0796, 0.5, 1.179),
    "heron": (0.0, 0.5, 1.480),
    "small_catamaran": (0.0, 0.5, 1.236),
}

#: VRX' configurations of thrusters.
LAYOUTS = {
    "H": {"left", "right"},
    "T": {"left", "right", "lateral"},
    "X": {"left_rear", "right_rear", "left_front", "right_front"},
}


def world_of(vessel: str, world_file: str, **args: object) -> trident_sim.World:
    world = trident_sim.World(world_file, seed=3)
    world.spawn(vessel, urdf=trident_sim.expand_xacro(URDF / f"{vessel}.urdf.xacro", **args))
    return world


@pytest.mark.parametrize("vessel", FIGURES)
def test_nothing_in_its_description_is_without_effect(vessel: str) -> None:
    world = world_of(vessel, OCEAN)
    world.step(10)
    assert not [message.text for message in world.messages]


@pytest.mark.parametrize(("layout", "names"), LAYOUTS.items())
def test_a_wamv_has_the_thrusters_of_its_layout(layout: str, names: set[str]) -> None:
    world = world_of("wamv", OCEAN, thrusters=layout)
    world.step(10)
    assert not [message.text for message in world.messages]
    ends = [port.removeprefix("wamv/thrusters/") for port in world.ports if "_thrust_cmd" in port]
    assert {end.removesuffix("_thrust_cmd") for end in ends} == names


def place_of(urdf: str, link: str) -> list[float]:
    """Where a link of a fixed joint is, in its parent's axes [m]."""
    (origin,) = (
        joint.find("origin")
        for joint in ElementTree.fromstring(urdf).iter("joint")
        if joint.find(f"child[@link='{link}']") is not None
    )
    assert origin is not None
    return [float(word) for word in origin.attrib["xyz"].split()]


def seen_from_port(
    world: trident_sim.World, x: npt.ArrayLike, z: npt.ArrayLike, as_far_as_y: float
) -> npt.NDArray[np.bool_]:
    """Whether a ray from port hits something of the vessel, at each of x and z [m]."""
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    origins = np.column_stack([x, np.full(x.shape, 3.0), z])
    along = np.tile([0.0, -1.0, 0.0], (len(origins), 1))
    hits = world.cast_rays(origins, along, max_distance=3.0 - as_far_as_y, visual=True)
    return np.isfinite(hits.distance)


@pytest.mark.parametrize("vessel", FIGURES)
def test_its_sensors_stand_on_its_deck(vessel: str) -> None:
    world = trident_sim.World(NOTHING)
    urdf = trident_sim.expand_xacro(URDF / f"{vessel}.urdf.xacro", camera_enabled="true")
    world.spawn(vessel, urdf=urdf)
    for link in ("gnss_link", "wind_link", "velodyne", "front_camera_link"):
        x, y, z = place_of(urdf, link)
        down = world.cast_rays([[x, y, z]], [[0.0, 0.0, -1.0]], max_distance=2.0)
        deck = z - float(down.distance[0])
        heights = np.linspace(z - 0.01, deck + 1e-3, 40)  # at the face itself rays may miss both
        assert seen_from_port(world, np.full(40, x), heights, -0.1).all(), link


def test_a_wamvs_deck_stands_on_its_pontoons() -> None:
    world = trident_sim.World(NOTHING)
    world.spawn("wamv", urdf=trident_sim.expand_xacro(URDF / "wamv.urdf.xacro"))
    for ends in (np.linspace(0.6, 1.4, 80), np.linspace(-1.4, -0.6, 80)):
        for z in np.linspace(0.3, 1.25, 30):
            assert seen_from_port(world, ends, z, 0.3).any(), z


@pytest.mark.parametrize("vessel", FIGURES)
def test_it_goes_where_its_controller_is_commanded(vessel: str) -> None:
    world = world_of(vessel, OCEAN, control="plugin", lidar="false")
    world.ports[f"{vessel}/command/pose"].write(trident_sim.PoseSample((20.0, 15.0, 0.0)))
    world.step(16000)
    assert not [message.text for message in world.messages]
    assert world.model(vessel).position[:2] == pytest.approx((20.0, 15.0), abs=2.0)


@pytest.mark.parametrize("vessel", FIGURES)
def test_it_stays_on_the_waves(vessel: str) -> None:
    world = world_of(vessel, OCEAN)
    z = []
    for _ in range(300):
        world.step(10)
        z.append(world.model(vessel).position[2])
    assert np.mean(z) == pytest.approx(FIGURES[vessel][0], abs=0.05)
    # Of waves of 0.3 m: eta has a standard deviation of 0.075 m.
    assert 0.02 < np.std(z) < 0.12


#: Where VRX has a WAM-V's sensors, below its namespace.
VRX_TOPICS = (
    "sensors/gps/gps/fix",
    "sensors/imu/imu/data",
    "sensors/lidars/lidar_wamv/points",
    "sensors/cameras/front_camera/image_raw",
    "sensors/position/p3d_wamv",
    "sensors/wind/wind",
)


@pytest.mark.parametrize("vessel", FIGURES)
def test_sensors_are_optional_and_may_have_their_topics_in_vrx(vessel: str) -> None:
    names = ("gps", "imu", "lidar", "camera", "wind", "ground_truth")
    for is_wanted in (True, False):
        options = {f"{name}_enabled": is_wanted for name in names}
        world = world_of(vessel, OCEAN, vrx_topics=True, **options)
        present = [topic for topic in VRX_TOPICS if f"{vessel}/{topic}" in world.ports]
        assert present == (list(VRX_TOPICS) if is_wanted else [])
        world.step(10)
        assert not [message.text for message in world.messages]


@pytest.mark.parametrize("vessel", FIGURES)
def test_its_sensors_measure_and_its_propellers_push(vessel: str) -> None:
    world = world_of(vessel, OCEAN)
    for port in ("fix", "imu/data", "velodyne_points", "ground_truth/odom", "wind"):
        world.ports[f"{vessel}/{port}"].subscribe()
    for side in ("left", "right"):
        command = trident_sim.ScalarSample(FIGURES[vessel][1])
        world.ports[f"{vessel}/thrusters/{side}_thrust_cmd"].write(command)
    world.step(100)
    world.ports[f"{vessel}/velodyne_points"].unsubscribe()  # it has sent enough, and costs most
    world.step(2900)
    for port in ("fix", "imu/data", "velodyne_points", "ground_truth/odom", "wind"):
        assert world.ports[f"{vessel}/{port}"].count > 0, port
    odometry = world.ports[f"{vessel}/ground_truth/odom"].value
    assert odometry.linear_velocity[0] == pytest.approx(FIGURES[vessel][2], abs=0.35)
    assert world.model(vessel).position[0] > 0.7 * 30.0 * FIGURES[vessel][2]
    # Still air comes from ahead, as fast as the boat goes.
    wind = world.ports[f"{vessel}/wind"].value.value
    assert wind[0] == pytest.approx(-odometry.linear_velocity[0], abs=0.6)


@pytest.mark.parametrize("vessel", FIGURES)
def test_its_propellers_turn(vessel: str) -> None:
    """The direction of its thrust; both joints are published with the angles that tf needs."""
    world = world_of(vessel, OCEAN, lidar=False)
    world.ports[f"{vessel}/joint_states"].subscribe()
    for side, part in (("left", 1.0), ("right", -1.0)):
        value = trident_sim.ScalarSample(part * FIGURES[vessel][1])
        world.ports[f"{vessel}/thrusters/{side}_thrust_cmd"].write(value)
    world.step(500)
    states = world.ports[f"{vessel}/joint_states"].value
    assert sorted(states.names) == ["left_propeller_joint", "right_propeller_joint"]
    rates = dict(zip(states.names, states.velocities, strict=True))
    angles = dict(zip(states.names, states.positions, strict=True))
    assert rates["left_propeller_joint"] > 20.0
    assert rates["right_propeller_joint"] < -10.0
    assert angles["left_propeller_joint"] > 10.0


def test_propeller_of_the_otter_turns_as_fast_as_its_shaft() -> None:
    world = world_of("otter", OCEAN, lidar=False)
    world.ports["otter/thrusters/left_thrust_cmd"].write(trident_sim.ScalarSample(60.0))
    world.step(1000)
    rate = world.model("otter").joint("left_propeller_joint").velocity
    assert rate == pytest.approx(60.0, rel=1e-3)


def test_listeners_change_nothing() -> None:
    hashes = []
    for topic in ("", "otter/joint_states", "otter/thrusters/left_thrust"):
        world = world_of("otter", OCEAN, lidar=False)
        if topic:
            world.ports[topic].subscribe()
        world.ports["otter/thrusters/left_thrust_cmd"].write(trident_sim.ScalarSample(60.0))
        world.step(200)
        hashes.append(world.state_hash())
    assert len(set(hashes)) == 1


def test_heron_takes_drive_commands() -> None:
    world = world_of("heron", OCEAN, lidar=False)
    world.ports["heron/thrusters/left_thrust"].subscribe()
    world.ports["heron/thrusters/right_thrust"].subscribe()
    world.ports["heron/cmd_drive"].write(0.6, -1.0)
    world.step(500)
    world.ports["heron/cmd_drive"].write(float("nan"), 0.0)
    world.ports["heron/cmd_drive"].write(0.6, -3.0)
    world.step(500)
    assert world.ports["heron/thrusters/left_thrust"].value.value == pytest.approx(21.28)
    assert world.ports["heron/thrusters/right_thrust"].value.value == pytest.approx(-19.88)
    messages = "\n".join(message.text for message in world.messages)
    assert "cmd_drive: nan, 0 is refused, the last good one stays; legal is [-1, 1]" in messages
    assert "cmd_drive: 0.6, -3 is cut to the nearest; legal is [-1, 1]" in messages


def test_small_catamaran_is_driven_as_usv_sim_lsa_does() -> None:
    world = world_of("small_catamaran", OCEAN, lidar=False, freefloating=True)
    world.ports["small_catamaran/state"].subscribe()
    command = world.ports["small_catamaran/thruster_command"]
    command.write(["fwd_left", "fwd_right"], positions=[20.0, 10.0])
    command.write(["fwd_middle"], positions=[1.0])
    command.write(["fwd_left"], positions=[float("nan")])
    world.step(3000)
    state = world.ports["small_catamaran/state"].value
    # 20 N are cut to 11.5, and 10 N with them: as fast as 17.25 N make it, in a turn to starboard.
    assert 0.8 < state.linear_velocity[0] < 1.55
    assert state.angular_velocity[2] < -0.2
    messages = "\n".join(message.text for message in world.messages)
    assert "thruster_command: 'fwd_middle', which is no thruster, is refused" in messages


def test_its_odometry_is_a_transform_of_its_namespace() -> None:
    world = trident_sim.World(OCEAN)
    urdf = trident_sim.expand_xacro(URDF / "wamv.urdf.xacro")
    for index in range(2):
        world.spawn(f"usv{index}", urdf=urdf, pose=(0.0, 8.0 * index, 0.0))
        world.ports[f"tf/usv{index}/base_link"].subscribe()
    world.step(100)
    for index in range(2):
        name = f"usv{index}"
        frame = world.ports[f"tf/{name}/base_link"].value
        assert (frame.parent_frame, frame.child_frame) == (f"{name}/odom", f"{name}/base_link")
        assert frame.position == pytest.approx(world.model(name).position, abs=0.05)
