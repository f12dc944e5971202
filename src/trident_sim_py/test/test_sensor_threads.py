# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Lidars and cameras measure the same, to the bit, whatever the number of threads."""

from __future__ import annotations

import hashlib

import numpy as np
import pytest

import trident_sim

_STEPS = 210


def _lidar(name: str, plugin: str, rolling: bool, beams: int) -> str:
    return f"""<sensor type="ray" name="{name}"><pose>0 0 0.5 0 0 0</pose>
      <update_rate>10</update_rate>
      <ray><scan>
        <horizontal><samples>{beams}</samples><min_angle>-3.14159</min_angle>
          <max_angle>3.1</max_angle></horizontal>
        <vertical><samples>16</samples><min_angle>-0.26</min_angle><max_angle>0.26</max_angle>
        </vertical></scan>
        <range><min>0.3</min><max>30</max></range></ray>
      <plugin name="{name}" filename="{plugin}"><topicName>{name}</topicName>
        <rolling>{str(rolling).lower()}</rolling><gaussianNoise>0.01</gaussianNoise>
      </plugin></sensor>"""


MODEL = f"""<?xml version="1.0"?>
<sdf version="1.6">
  <model name="robot">
    <link name="link">
      <gravity>false</gravity>
      <inertial><mass>1</mass></inertial>
      <visual name="hull"><geometry><box><size>0.4 0.4 0.4</size></box></geometry></visual>
      <collision name="hull"><geometry><box><size>0.4 0.4 0.4</size></box></geometry></collision>
      <sensor name="eye" type="depth">
        <pose>0.3 0 0.2 0 0 0</pose>
        <update_rate>10</update_rate>
        <camera>
          <horizontal_fov>1.2</horizontal_fov>
          <image><width>163</width><height>121</height></image>
          <noise><type>gaussian</type><stddev>0.02</stddev></noise>
        </camera>
        <plugin name="eye" filename="libtrident_camera.so">
          <depthNoiseModelName>Kinect</depthNoiseModelName>
        </plugin>
      </sensor>
      {_lidar("snapshot", "libgazebo_ros_velodyne_laser.so", False, 700)}
      {_lidar("rolling", "libtrident_lidar3d.so", True, 9000)}
    </link>
  </model>
</sdf>
"""


def _measured(threads: int) -> dict[str, str]:
    """Hash of all samples of each topic, of a robot that turns in the room."""
    world = trident_sim.World("worlds/room.world", seed=3, sensor_threads=threads)
    world.spawn("robot", sdf=MODEL, pose=(0.5, -1.0, 0.4))
    world.models["robot"].set_velocity((0.1, 0.0, 0.0), (0.0, 0.0, 1.0))
    ports = [world.ports[name] for name in sorted(world.ports) if name.startswith("robot/")]
    ports = [port for port in ports if port.is_output]
    hashes = {port.name: hashlib.sha256() for port in ports}
    for port in ports:
        port.subscribe()
    for _ in range(_STEPS):
        before = {port.name: port.count for port in ports}
        world.step(1)
        for port in ports:
            if port.count > before[port.name]:
                hashes[port.name].update(_bytes(port.value))
    assert all(port.count > 1 for port in ports), [(port.name, port.count) for port in ports]
    return {name: found.hexdigest() for name, found in hashes.items()}


def _bytes(value: object) -> bytes:
    """The arrays of a sample; of boxes and the like their text."""
    names = ("pixels", "points", "colors")
    arrays = [np.asarray(getattr(value, name)) for name in names if hasattr(value, name)]
    if arrays:
        return b"".join(array.tobytes() for array in arrays)
    boxes = getattr(value, "boxes", None)
    if boxes is not None:
        return repr(
            [(b.name, b.x_min, b.y_min, b.x_max, b.y_max, b.pixels) for b in boxes]
        ).encode()
    return b""


@pytest.fixture(scope="module")
def alone() -> dict[str, str]:
    return _measured(1)


@pytest.mark.parametrize("threads", [2, 5])
def test_measurements_do_not_depend_on_the_number_of_threads(
    alone: dict[str, str], threads: int
) -> None:
    assert len(alone) >= 8
    assert _measured(threads) == alone


@pytest.mark.parametrize("threads", [0, -1, 257])
def test_a_senseless_number_of_threads_is_refused(threads: int) -> None:
    with pytest.raises(trident_sim.Error, match=f"sensor_threads is {threads}, legal: 1 to 256"):
        trident_sim.World("worlds/room.world", sensor_threads=threads)
