# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Every ground robot expands into one tree of links, with bodies that can exist and its figures."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
import xacro

URDF = Path(__file__).resolve().parents[1] / "urdf"
#: test_vessels.py is the test of those that float.
VESSELS = {"heron", "otter", "small_catamaran", "wamv"}
ROBOTS = sorted(
    {path.name.removesuffix(".urdf.xacro") for path in URDF.glob("*.urdf.xacro")} - VESSELS
)


def expand(robot: str, **args: str) -> ET.Element:
    document = xacro.process_file(str(URDF / f"{robot}.urdf.xacro"), mappings=args)
    return ET.fromstring(document.toxml())


def numbers(element: ET.Element | None, name: str) -> list[float]:
    return [] if element is None else [float(word) for word in element.get(name, "").split()]


def joint(model: ET.Element, name: str) -> ET.Element:
    found = model.find(f"joint[@name='{name}']")
    assert found is not None, name
    return found


def origin(model: ET.Element, joint_name: str) -> list[float]:
    return numbers(joint(model, joint_name).find("origin"), "xyz")


def drive(model: ET.Element, key: str) -> str:
    found = model.find(f".//plugin[@filename='libgazebo_ros_diff_drive.so']/{key}")
    assert found is not None, key
    return found.text or ""


def test_there_are_robots() -> None:
    known = {"ackermann_car", "my_nav_robot", "tutorial_ugv"}
    assert known | {"turtlebot3_burger", "turtlebot3_waffle"} <= set(ROBOTS)


@pytest.mark.parametrize("robot", ROBOTS)
def test_links_are_one_tree_from_base_footprint(robot: str) -> None:
    model = expand(robot)
    links = {link.get("name") for link in model.findall("link")}
    parents = {
        j.find("child").get("link"): j.find("parent").get("link")  # type: ignore[union-attr]
        for j in model.findall("joint")
    }
    assert links - set(parents) == {"base_footprint"}
    assert set(parents.values()) <= links


@pytest.mark.parametrize("robot", ROBOTS)
def test_bodies_can_exist(robot: str) -> None:
    for inertial in expand(robot).findall(".//inertial"):
        mass = numbers(inertial.find("mass"), "value")[0]
        inertia = inertial.find("inertia")
        xx, yy, zz = (numbers(inertia, key)[0] for key in ("ixx", "iyy", "izz"))
        assert mass > 0
        assert min(xx, yy, zz) > 0
        assert max(xx, yy, zz) <= 0.5 * (xx + yy + zz)


@pytest.mark.parametrize("robot", sorted(set(ROBOTS) - {"ackermann_car", "jackal"}))
def test_the_drive_fits_the_wheels(robot: str) -> None:
    model = expand(robot)
    left, right = origin(model, "wheel_left_joint"), origin(model, "wheel_right_joint")
    # TurtleBot3's own figures of the Waffle differ by 1 mm.
    slack = 0.0011 if robot == "turtlebot3_waffle" else 1e-9
    assert left[1] - right[1] == pytest.approx(float(drive(model, "wheelSeparation")), abs=slack)
    shape = model.find("link[@name='wheel_left_link']/collision/geometry/cylinder")
    radius = numbers(shape, "radius")[0]
    assert 2 * radius == pytest.approx(float(drive(model, "wheelDiameter")))
    # Wheel and caster stand on the ground.
    height = origin(model, "base_joint")[2]
    assert height + left[2] == pytest.approx(radius)


@pytest.mark.parametrize("source", ["encoder", "world"])
def test_the_source_of_odometry_is_an_argument(source: str) -> None:
    assert drive(expand("my_nav_robot", odometry_source=source), "odometrySource") == source


def test_figures_of_the_navigation_robot() -> None:
    model = expand("my_nav_robot")
    box = model.find("link[@name='base_link']/collision/geometry/box")
    assert numbers(box, "size") == [0.25, 0.20, 0.07]
    assert numbers(model.find("link[@name='base_link']/inertial/mass"), "value") == [2.0]
    assert float(drive(model, "wheelSeparation")) == pytest.approx(0.22)
    assert float(drive(model, "wheelDiameter")) == pytest.approx(0.066)
    assert origin(model, "laser_link_joint")[2] == pytest.approx(0.06)
    assert origin(model, "camera_link_joint")[0] == pytest.approx(0.12)
    assert model.find("link[@name='camera_optical_frame']") is not None


def test_figures_of_the_jackal() -> None:
    model = expand("jackal")
    box = model.find("link[@name='base_link']/collision/geometry/box")
    assert numbers(box, "size") == [0.42, 0.31, 0.184]
    for end, x in (("front", 0.131), ("rear", -0.131)):
        for side, y in (("left", 0.187795), ("right", -0.187795)):
            assert origin(model, f"{end}_{side}_wheel_joint") == pytest.approx([x, y, 0.0])
    plugin = model.find(".//plugin[@filename='libgazebo_ros_skid_steer_drive.so']")
    assert plugin is not None
    assert float(plugin.findtext("wheelSeparation", "")) == pytest.approx(1.5 * 0.37559)
    assert float(plugin.findtext("wheelDiameter", "")) == pytest.approx(0.196)
    scan = model.find(".//sensor[@name='front_laser']/ray/scan/horizontal")
    assert scan is not None
    assert scan.findtext("samples") == "720"
    assert origin(model, "base_joint")[2] == pytest.approx(0.098)


def test_figures_of_the_car() -> None:
    model = expand("ackermann_car")
    wheelbase, track = 0.32, 0.24
    for side, y in (("left", track / 2), ("right", -track / 2)):
        assert origin(model, f"wheel_rear_{side}_joint") == [0, y, 0]
        assert origin(model, f"wheel_front_{side}_steering_joint") == [wheelbase, y, 0]
        assert origin(model, f"wheel_front_{side}_joint") == [0, 0, 0]
    plugin = model.find(".//plugin[@filename='libgazebo_ros_ackermann_drive.so']")
    assert plugin is not None
    max_steer = float(plugin.findtext("max_steer", ""))
    # The inner wheel turns more than the bicycle, and its joint lets it.
    inner = math.atan2(math.tan(max_steer), 1 - track / 2 / wheelbase * math.tan(max_steer))
    stop = numbers(joint(model, "wheel_front_left_steering_joint").find("limit"), "upper")[0]
    assert max_steer < inner < stop
    limit = numbers(joint(model, "wheel_rear_left_joint").find("limit"), "velocity")[0]
    # The outer rear wheel runs ahead of the axle's middle.
    outer = 1 + track / 2 / wheelbase * math.tan(max_steer)
    assert 0.05 * limit > float(plugin.findtext("max_speed", "")) * outer


def test_figures_of_the_rover() -> None:
    model = expand("tutorial_ugv")
    assert float(drive(model, "wheelSeparation")) == pytest.approx(0.4)
    assert float(drive(model, "wheelDiameter")) == pytest.approx(0.2)
    limit = numbers(joint(model, "wheel_left_joint").find("limit"), "velocity")[0]
    assert 0.1 * limit == pytest.approx(2.0)
    camera = joint(model, "stereo_link_joint").find("origin")
    assert numbers(camera, "xyz") == [0.3, 0.0, 0.2]
    assert numbers(camera, "rpy") == [0.0, 0.2, 0.0]


def test_figures_of_the_burger() -> None:
    model = expand("turtlebot3_burger")
    assert origin(model, "base_joint") == [0, 0, 0.01]
    assert origin(model, "wheel_left_joint") == [0, 0.08, 0.023]
    assert origin(model, "caster_back_joint") == [-0.081, 0, -0.004]
    assert origin(model, "imu_joint") == [-0.032, 0, 0.068]
    assert origin(model, "base_scan_joint") == [-0.032, 0, 0.172]
    assert numbers(model.find("link[@name='base_link']/inertial/mass"), "value") == [0.8257]
    assert float(drive(model, "updateRate")) == 30
    assert drive(model, "odometrySource") == "world"


def test_figures_of_the_waffle() -> None:
    model = expand("turtlebot3_waffle")
    assert origin(model, "base_joint") == [0, 0, 0.01]
    assert origin(model, "wheel_left_joint") == [0, 0.144, 0.023]
    assert origin(model, "caster_back_left_joint") == [-0.177, 0.064, -0.004]
    assert origin(model, "imu_joint") == [0, 0, 0.068]
    assert origin(model, "base_scan_joint") == [-0.064, 0, 0.122]
    assert origin(model, "camera_link_joint") == [0.064, -0.065, 0.094]
    assert origin(model, "camera_rgb_joint") == [0.005, 0.018, 0.013]
    assert model.find(".//plugin[@filename='libgazebo_ros_openni_kinect.so']") is not None
    assert numbers(model.find("link[@name='base_link']/inertial/mass"), "value") == [1.3729]
    assert float(drive(model, "wheelSeparation")) == pytest.approx(0.287)


def test_a_waffle_can_do_without_its_camera() -> None:
    model = expand("turtlebot3_waffle", camera="false")
    assert model.find("link[@name='camera_rgb_optical_frame']") is not None
    assert model.find(".//sensor[@type='depth']") is None
