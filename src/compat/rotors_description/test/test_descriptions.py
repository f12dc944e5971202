# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Every vehicle expands, has the published figures, and answers to its arguments."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from typing import Any

import pytest
from urdf_model import PACKAGE, expand, model

# Body mass [kg], Ixx Iyy Izz [kg m^2], rotor mass [kg], rotor positions [m] and turning
# directions in motor order, box edges [m], steady rotor speed that carries the weight [rad/s].
FIGURES: dict[str, dict[str, Any]] = {
    "firefly": {
        "mass": 1.5,
        "inertia": (0.0347563, 0.0458929, 0.0977),
        "rotor_mass": 0.005,
        "rotors": [
            (0.215 * math.cos(math.radians(a)), 0.215 * math.sin(math.radians(a)), 0.037)
            for a in (30, 90, 150, 210, 270, 330)
        ],
        "directions": ["ccw", "cw", "ccw", "cw", "ccw", "cw"],
        "box": (0.1, 0.1, 0.16),
        "hover_speed": 543.3,
    },
    "hummingbird": {
        "mass": 0.68,
        "inertia": (0.007, 0.007, 0.012),
        "rotor_mass": 0.009,
        "rotors": [(0.17, 0, 0.01), (0, 0.17, 0.01), (-0.17, 0, 0.01), (0, -0.17, 0.01)],
        "directions": ["cw", "ccw", "cw", "ccw"],
        "box": (0.1, 0.1, 0.12),
        "hover_speed": 457.7,
    },
    "iris": {
        "mass": 1.5,
        "inertia": (0.0347563, 0.0458929, 0.0977),
        "rotor_mass": 0.005,
        "rotors": [
            (0.13, -0.22, 0.023),
            (-0.13, 0.2, 0.023),
            (0.13, 0.22, 0.023),
            (-0.13, -0.2, 0.023),
        ],
        "directions": ["ccw", "ccw", "cw", "cw"],
        "box": (0.47, 0.47, 0.11),
        "hover_speed": 663.3,
    },
    "tutorial_iris": {
        "mass": 1.5,
        "inertia": (0.034, 0.034, 0.06),
        "rotor_mass": 0.005,
        "rotors": [
            (0.13, -0.22, 0.023),
            (-0.13, 0.2, 0.023),
            (0.13, 0.22, 0.023),
            (-0.13, -0.2, 0.023),
        ],
        "directions": ["ccw", "ccw", "cw", "cw"],
        "box": (0.47, 0.47, 0.11),
        "hover_speed": 663.3,
    },
    "pelican": {
        "mass": 1.0,
        "radius": 0.128,
        "inertia": (0.01, 0.01, 0.02),
        "rotor_mass": 0.01,
        "rotors": [(0.21, 0, 0.05), (0, 0.21, 0.05), (-0.21, 0, 0.05), (0, -0.21, 0.05)],
        "directions": ["cw", "ccw", "cw", "ccw"],
        "box": (0.1, 0.1, 0.2),
        "hover_speed": 508.8,
    },
    "ardrone": {
        "mass": 1.5,
        "inertia": (0.0347563, 0.0458929, 0.0977),
        "rotor_mass": 0.005,
        "rotors": [
            (0.12728, -0.12728, 0.023),
            (-0.12728, 0.12728, 0.023),
            (0.12728, 0.12728, 0.023),
            (-0.12728, -0.12728, 0.023),
        ],
        "directions": ["ccw", "ccw", "cw", "cw"],
        "box": (0.3, 0.3, 0.16),
        "hover_speed": 663.3,
    },
}
VEHICLES = sorted(FIGURES)
MODEL = "mav_generic_odometry_sensor.gazebo"


def parsed(mav_name: str, **arguments: str) -> dict[str, dict[str, Any]]:
    return model(expand(MODEL, mav_name=mav_name, namespace="v", **arguments))


def motor_plugins(description: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    motors = [
        plugin
        for plugin in description["plugins"].values()
        if plugin["filename"] == "librotors_gazebo_motor_model.so"
    ]
    return sorted(motors, key=lambda plugin: plugin["motorNumber"])


@pytest.mark.parametrize("vehicle", VEHICLES)
def test_body_has_the_published_figures(vehicle: str) -> None:
    figures = FIGURES[vehicle]
    body = parsed(vehicle)["links"]["v/base_link_inertia"]
    (mass,), _, inertia = body["inertial"]
    assert mass == figures["mass"]
    assert tuple(inertia[k][0] for k in ("ixx", "iyy", "izz")) == figures["inertia"]
    ((_, shape, attributes),) = body["collision"]
    assert shape == "box"
    assert attributes["size"] == figures["box"]


@pytest.mark.parametrize("vehicle", VEHICLES)
def test_rotors_sit_and_turn_as_published(vehicle: str) -> None:
    figures = FIGURES[vehicle]
    description = parsed(vehicle)
    motors = motor_plugins(description)
    assert [m["turningDirection"][0] for m in motors] == figures["directions"]
    for motor, position in zip(motors, figures["rotors"], strict=True):
        joint = description["joints"][motor["jointName"][0]]
        assert joint["origin"][0] == pytest.approx(position, abs=1e-9)
        assert joint["type"] == "continuous"
        link = description["links"][motor["linkName"][0]]
        (mass,), _, inertia = link["inertial"]
        assert mass == figures["rotor_mass"]
        # A bar as long as the radius and 15 mm wide whose mass counts ten times, as its joint turns
        # ten times slower.
        izz = 10 * mass * (figures.get("radius", 0.1) ** 2 + 0.015**2) / 12
        assert inertia["izz"][0] == pytest.approx(izz, rel=1e-6)


@pytest.mark.parametrize("vehicle", VEHICLES)
def test_hover_speed_carries_the_whole_weight(vehicle: str) -> None:
    description = parsed(vehicle)
    masses = [link["inertial"] for link in description["links"].values() if link["inertial"]]
    total_kg = sum(inertial[0][0] for inertial in masses)
    motors = motor_plugins(description)
    force_constant = motors[0]["motorConstant"][0]
    hover = math.sqrt(total_kg * 9.81 / (len(motors) * force_constant))
    assert hover == pytest.approx(FIGURES[vehicle]["hover_speed"], abs=0.5)


@pytest.mark.parametrize("vehicle", VEHICLES)
def test_namespace_prefixes_every_link_joint_and_plugin(vehicle: str) -> None:
    description = parsed(vehicle)
    assert all(name.startswith("v/") for name in description["links"])
    assert all(name.startswith("v/") for name in description["joints"])
    assert all(p["robotNamespace"] == ("v",) for p in description["plugins"].values())


@pytest.mark.parametrize("vehicle", VEHICLES)
def test_links_form_one_tree(vehicle: str) -> None:
    description = parsed(vehicle)
    children = [joint["child"]["link"][0] for joint in description["joints"].values()]
    assert len(children) == len(set(children))
    assert set(description["links"]) - set(children) == {"v/base_link"}


def test_arguments_switch_equipment() -> None:
    without = parsed("firefly", enable_ground_truth="false")
    assert "v/imugt_link" not in without["links"]
    full = parsed(
        "firefly", enable_logging="true", log_file="run7", enable_mavlink_interface="true"
    )
    assert "v/imugt_link" in full["links"]
    assert full["plugins"]["rosbag"]["bagFileName"] == ("run7",)
    assert full["plugins"]["mavlink_interface"]["rotorCount"] == (6.0,)


@pytest.mark.parametrize("vehicle", VEHICLES)
def test_named_files_need_no_argument(vehicle: str) -> None:
    named = model(expand(f"{vehicle}_generic_odometry_sensor.gazebo"))
    assert f"{vehicle}/odometry_sensor1_link" in named["links"]
    base = model(expand(f"{vehicle}_base.xacro"))
    assert f"{vehicle}/odometry_sensor1_link" not in base["links"]
    assert f"{vehicle}/imu_link" in base["links"]


def test_wind_gust_starts_at_forty_seconds() -> None:
    wind = model(expand("mav_with_wind_gust.gazebo", mav_name="iris"))["plugins"]["wind_plugin"]
    assert wind["windGustStart"] == (40.0,)
    assert wind["windGustDuration"] == (2.0,)
    assert wind["windGustForceMean"] == (5.0,)
    assert wind["linkName"] == ("iris/base_link",)


def test_every_sensor_macro_expands(tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("xacro") / "all.xacro"
    path.write_text("""<robot name="all" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find rotors_description)/urdf/firefly_base.xacro"/>
  <xacro:default_gps namespace="firefly" parent_link="firefly/base_link"/>
  <xacro:default_magnetometer namespace="firefly" parent_link="firefly/base_link"/>
  <xacro:default_pressure_sensor namespace="firefly" parent_link="firefly/base_link"/>
  <xacro:vi_sensor_macro namespace="firefly/vi" parent_link="firefly/base_link"
    enable_cameras="true" enable_depth="true" enable_ground_truth="true">
    <origin xyz="0.1 0 -0.03" rpy="0 0.1 0"/>
  </xacro:vi_sensor_macro>
  <xacro:vi_sensor_camera_macro namespace="firefly" parent_link="firefly/base_link"
    camera_suffix="nadir" frame_rate="20.0">
    <origin xyz="0 0 -0.05" rpy="0 1.57 0"/>
  </xacro:vi_sensor_camera_macro>
</robot>
""")
    root = ET.fromstring(expand(str(path)))
    sensors = {str(s.get("name")): s for s in root.iter("sensor")}
    assert set(sensors) == {
        "firefly_gps",
        "firefly/vi_stereo_camera",
        "firefly/vi_camera_depth",
        "firefly_camera_nadir",
    }
    assert len(sensors["firefly/vi_stereo_camera"].findall("camera")) == 2
    stddev = sensors["firefly_gps"].find("gps/position_sensing/vertical/noise/stddev")
    assert stddev is not None
    assert stddev.text == "6.0"
    files = {p.get("filename") for p in root.iter("plugin")}
    assert "librotors_gazebo_magnetometer_plugin.so" in files
    assert "librotors_gazebo_pressure_plugin.so" in files
    assert "libgazebo_ros_openni_kinect.so" in files


def test_every_file_is_expanded_by_a_test() -> None:
    included_only = {
        "camera_snippets.xacro",
        "component_snippets.xacro",
        "default_arguments.xacro",
        "multirotor_base.xacro",
    }
    vehicles = {f"{v}{end}" for v in VEHICLES for end in (".xacro", "_base.xacro")}
    vehicles |= {f"{v}_generic_odometry_sensor.gazebo" for v in VEHICLES}
    tested = {MODEL, "mav_with_wind_gust.gazebo"} | vehicles | included_only
    assert {path.name for path in (PACKAGE / "urdf").iterdir()} == tested
