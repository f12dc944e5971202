# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures as arrays, from SDF text to numpy."""

from __future__ import annotations

import numpy as np
import pytest

import trident_sim

WIDTH, HEIGHT = 64, 48
WALL_M = 2.0
MODEL = f"""<?xml version="1.0"?>
<sdf version="1.6">
  <model name="robot">
    <link name="link">
      <gravity>false</gravity>
      <inertial><mass>1</mass></inertial>
      <sensor name="eye" type="camera">
        <update_rate>10</update_rate>
        <camera>
          <horizontal_fov>1.2</horizontal_fov>
          <image><width>{WIDTH}</width><height>{HEIGHT}</height></image>
        </camera>
        <plugin name="eye" filename="libtrident_camera.so"/>
      </sensor>
    </link>
  </model>
</sdf>
"""
#: Fills the left half of the picture: +y is left.
WALL = """<?xml version="1.0"?>
<sdf version="1.6">
  <model name="wall">
    <static>true</static>
    <link name="link">
      <visual name="visual">
        <geometry><box><size>1 10 10</size></box></geometry>
        <material><emissive>1 0 0 1</emissive></material>
      </visual>
    </link>
  </model>
</sdf>
"""


@pytest.fixture
def ports(world: trident_sim.World) -> dict[str, trident_sim.Port]:
    """The ports of a camera that looks at the edge of a wall, after its first picture."""
    world.spawn("robot", sdf=MODEL)
    world.spawn("wall", sdf=WALL, pose=(WALL_M + 0.5, 5.0, 0.0))
    found = {name.removeprefix("robot/eye/"): port for name, port in world.ports.items()}
    for port in found.values():
        if port.is_output:
            port.subscribe()
    world.step(10)
    return found


def test_colors(ports: dict[str, trident_sim.Port]) -> None:
    image = ports["image_raw"].value
    assert isinstance(image, trident_sim.ImageSample)
    assert (image.encoding, image.frame, image.stamp) == ("rgb8", "robot/link", pytest.approx(0.1))
    assert image.pixels.shape == (HEIGHT, WIDTH, 3)
    assert image.pixels.dtype == np.uint8
    left, right = image.pixels[:, : WIDTH // 2], image.pixels[:, WIDTH // 2 :]
    assert np.all(left[..., 0] == 255)
    assert len(np.unique(right)) == 1, "the background"
    assert right[0, 0, 0] != 255


def test_depths_and_points(ports: dict[str, trident_sim.Port]) -> None:
    depth, cloud = ports["depth/image_raw"].value, ports["points"].value
    assert isinstance(depth, trident_sim.ImageSample)
    assert isinstance(cloud, trident_sim.ImageCloudSample)
    assert (depth.encoding, depth.pixels.dtype) == ("32FC1", np.float32)
    assert depth.pixels[:, : WIDTH // 2] == pytest.approx(WALL_M, abs=1e-5)
    assert np.all(np.isinf(depth.pixels[:, WIDTH // 2 :]))
    assert cloud.points.shape == cloud.colors.shape == (HEIGHT, WIDTH, 3)
    assert cloud.points[5, 5, 2] == depth.pixels[5, 5]
    assert cloud.points[5, 5, 0] < 0.0, "left"
    assert cloud.points[5, 5, 1] < 0.0, "up"
    assert np.all(np.isnan(cloud.points[5, -1]))


def test_camera_info_projects_points_to_their_pixels(ports: dict[str, trident_sim.Port]) -> None:
    info, cloud = ports["camera_info"].value, ports["points"].value
    assert isinstance(info, trident_sim.CameraInfoSample)
    assert isinstance(cloud, trident_sim.ImageCloudSample)
    assert (info.width, info.height) == (WIDTH, HEIGHT)
    assert np.all(info.d == 0.0)
    assert np.array_equal(info.r, np.eye(3))
    assert np.array_equal(info.p[:, :3], info.k)
    projected = info.k @ cloud.points[7, 3].astype(np.float64)
    assert projected[:2] / projected[2] == pytest.approx([3.0, 7.0], abs=1e-3)


def test_labels_and_boxes(ports: dict[str, trident_sim.Port]) -> None:
    labels, sample = ports["segmentation/image_raw"].value, ports["segmentation/boxes"].value
    assert isinstance(labels, trident_sim.ImageSample)
    assert isinstance(sample, trident_sim.BoundingBoxesSample)
    (box,) = sample.boxes
    assert box.name == "wall"
    assert np.array_equal(np.unique(labels.pixels), [0, box.label])
    assert (box.x_min, box.x_max) == (0, WIDTH // 2 - 1)
    assert (box.y_min, box.y_max) == (0, HEIGHT - 1)
    assert box.pixels == np.count_nonzero(labels.pixels)


def test_a_camera_of_no_pixels_is_refused(world: trident_sim.World) -> None:
    with pytest.raises(trident_sim.Error, match=r"<width> is '0', expected"):
        world.spawn("robot", sdf=MODEL.replace(f"<width>{WIDTH}", "<width>0"))


def test_the_angle_of_view_can_be_set(
    world: trident_sim.World, ports: dict[str, trident_sim.Port]
) -> None:
    ports["set_hfov"].write(0.5)
    world.step(10)
    info = ports["camera_info"].value
    assert isinstance(info, trident_sim.CameraInfoSample)
    assert info.k[0, 0] == pytest.approx(WIDTH / 2 / np.tan(0.25))
