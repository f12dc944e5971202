# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds have the physics that the controllers are tuned for; parameter files are complete."""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest
import yaml
from launch_files import PACKAGE

ROOT = PACKAGE.parents[2]
RESOURCE = PACKAGE / "resource"
WORLDS = PACKAGE / "worlds"
DATA = Path(os.environ.get("TRIDENT_DATA", ROOT.parent / "shared" / "data"))
GOLDEN = DATA.parent / "golden" / "params"
ALL_WORLDS = [*sorted(WORLDS.glob("*.world")), *sorted((ROOT / "worlds").glob("*.world"))]
VEHICLES = {"firefly": 6, "hummingbird": 4, "iris": 4}
#: Those that have no gains for attitudes.
LEE_ONLY = {"ardrone": 4, "pelican": 4, "tutorial_iris": 4}

needs_golden = pytest.mark.skipif(
    not GOLDEN.is_dir(), reason=f"reference data is absent: {GOLDEN} (set TRIDENT_DATA)"
)


def world_of(path: Path) -> ET.Element:
    world = ET.parse(path).getroot().find("world")
    assert world is not None
    return world


def number(element: ET.Element, path: str) -> float:
    return float(element.findtext(path, "nan"))


def tree(element: ET.Element) -> Any:
    """Tag, attributes and children or text of an element, with numbers as numbers."""
    words = (element.text or "").split() if len(element) == 0 else []
    return (
        element.tag,
        tuple(sorted(element.attrib.items())),
        tuple(float(w) if w.lstrip("-").replace(".", "", 1).isdigit() else w for w in words),
        tuple(tree(child) for child in element),
    )


def numbers(text: str | None) -> list[float]:
    return [float(word) for word in (text or "").split()]


@needs_golden
def test_basic_world_equals_the_reference() -> None:
    reference = world_of(GOLDEN / "basic.world")
    assert sorted(map(tree, world_of(WORLDS / "basic.world"))) == sorted(map(tree, reference))


@pytest.mark.parametrize("name", ["basic", "cloister", "waypoint"])
def test_flying_worlds_take_hundred_steps_of_ten_milliseconds(name: str) -> None:
    physics = world_of(WORLDS / f"{name}.world").find("physics")
    assert physics is not None
    assert number(physics, "max_step_size") == 0.01
    assert number(physics, "real_time_update_rate") == 100
    assert number(physics, "ode/solver/iters") == 1000
    assert number(physics, "ode/solver/sor") == 1.3
    assert number(physics, "ode/constraints/erp") == 0.2
    assert numbers(physics.findtext("gravity")) == [0, 0, -9.8]


@pytest.mark.parametrize("path", ALL_WORLDS, ids=lambda p: f"{p.parent.parent.name}-{p.stem}")
def test_every_world_runs_in_real_time_and_finds_its_models(path: Path) -> None:
    world = world_of(path)
    physics = world.find("physics")
    assert physics is not None
    rate = number(physics, "max_step_size") * number(physics, "real_time_update_rate")
    assert rate == pytest.approx(1.0)
    for include in world.findall("include"):
        name = include.findtext("uri", "").removeprefix("model://")
        folder = ROOT / "worlds" / "models" / name
        config = ET.parse(folder / "model.config").getroot()
        assert config.findtext("name") == name
        model = ET.parse(folder / config.findtext("sdf", "")).getroot()
        assert [child.get("name") for child in model] == [name]


def test_ground_has_the_friction_of_the_reference_flights() -> None:
    model = ET.parse(ROOT / "worlds" / "models" / "ground_plane" / "model.sdf").getroot()
    (collision,) = model.iter("collision")
    assert collision.find("geometry/plane") is not None
    assert number(collision, "surface/friction/ode/mu") == 100
    assert number(collision, "surface/friction/ode/mu2") == 50


class TestCloister:
    LOW, HIGH = (-7.0, -10.0), (17.0, 14.0)  # corners of the open court [m]

    @staticmethod
    def boxes() -> dict[str, tuple[list[float], list[float]]]:
        """Axis-aligned bounds of every collision: name -> (low, high) [m]."""
        bounds = {}
        for collision in world_of(WORLDS / "cloister.world").iter("collision"):
            center = numbers(collision.findtext("pose"))[:3]
            size = numbers(collision.findtext("geometry/box/size"))
            if not size:
                radius = number(collision, "geometry/cylinder/radius")
                size = [2 * radius, 2 * radius, number(collision, "geometry/cylinder/length")]
            low = [c - s / 2 for c, s in zip(center, size, strict=True)]
            high = [c + s / 2 for c, s in zip(center, size, strict=True)]
            bounds[str(collision.get("name"))] = (low, high)
        return bounds

    def test_open_court_is_clear(self) -> None:
        for name, (low, high) in self.boxes().items():
            apart = [high[k] <= self.LOW[k] or low[k] >= self.HIGH[k] for k in (0, 1)]
            assert any(apart), f"{name} stands in the court"

    def test_columns_carry_the_roof(self) -> None:
        boxes = self.boxes()
        columns = {name: box for name, box in boxes.items() if name.startswith("column")}
        roofs = {name: box for name, box in boxes.items() if name.startswith("roof")}
        assert len(columns) == 32
        assert len(roofs) == 4
        underside = {round(low[2], 6) for low, _ in roofs.values()}
        assert underside == {3.4}
        assert {round(high[2], 6) for _, high in columns.values()} == underside
        for name, (low, high) in columns.items():
            center = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
            under = [
                all(r_low[k] <= center[k] <= r_high[k] for k in (0, 1))
                for r_low, r_high in roofs.values()
            ]
            assert any(under), f"{name} carries nothing"

    def test_walls_stand_on_the_ground_and_leave_one_gate(self) -> None:
        walls = {name: b for name, b in self.boxes().items() if name.startswith("wall")}
        assert {round(low[2], 6) for low, _ in walls.values()} == {0.0}
        south, north = walls["wall_east_south"], walls["wall_east_north"]
        assert north[0][1] - south[1][1] == pytest.approx(3.0)
        assert all(high[2] - low[2] == pytest.approx(4.0) for low, high in walls.values())

    def test_walk_is_three_meters_wide(self) -> None:
        boxes = self.boxes()
        columns = [box for name, box in boxes.items() if name.startswith("column")]
        walk = min(low[1] for low, _ in columns) - boxes["wall_south"][1][1]
        assert walk == pytest.approx(3.05, abs=0.1)


@pytest.mark.parametrize("path", sorted(RESOURCE.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_parameter_file_is_a_mapping(path: Path) -> None:
    content = yaml.safe_load(path.read_text())
    assert isinstance(content, dict)
    assert content


@pytest.mark.parametrize(("vehicle", "rotors"), (VEHICLES | LEE_ONLY).items())
def test_vehicle_parameters_are_complete(vehicle: str, rotors: int) -> None:
    content = yaml.safe_load((RESOURCE / f"{vehicle}.yaml").read_text())
    assert set(content) == {"mass", "inertia", "rotor_configuration"}
    assert set(content["inertia"]) == {"xx", "xy", "xz", "yy", "yz", "zz"}
    assert list(content["rotor_configuration"]) == [str(i) for i in range(rotors)]
    directions = 0.0
    for rotor in content["rotor_configuration"].values():
        assert set(rotor) == {
            "angle",
            "arm_length",
            "rotor_force_constant",
            "rotor_moment_constant",
            "direction",
        }
        assert abs(rotor["angle"]) <= math.pi + 1e-6
        directions += rotor["direction"]
    assert directions == 0.0


@pytest.mark.parametrize(
    ("controller", "vehicle"),
    [("lee_controller", vehicle) for vehicle in VEHICLES | LEE_ONLY]
    + [("roll_pitch_yawrate_thrust_controller", vehicle) for vehicle in VEHICLES],
)
def test_controller_gains_are_complete_and_positive(controller: str, vehicle: str) -> None:
    content = yaml.safe_load((RESOURCE / f"{controller}_{vehicle}.yaml").read_text())
    expected = {"attitude_gain", "angular_rate_gain"}
    if controller == "lee_controller":
        expected |= {"position_gain", "velocity_gain"}
    assert set(content) == expected
    for gain in content.values():
        assert set(gain) == {"x", "y", "z"}
        assert min(gain.values()) > 0


@needs_golden
@pytest.mark.parametrize("name", ["firefly.yaml", "lee_controller_firefly.yaml"])
def test_firefly_parameters_equal_the_reference(name: str) -> None:
    ours = yaml.safe_load((RESOURCE / name).read_text())
    assert ours == yaml.safe_load((GOLDEN / name).read_text())


def test_example_waypoints_fly_a_square() -> None:
    rows = [numbers(line) for line in (RESOURCE / "example_waypoints.txt").read_text().splitlines()]
    assert [row[1:3] for row in rows] == [[20, 0], [20, 20], [0, 20], [0, 0]]
    assert all(len(row) == 5 and row[0] == 60 and row[3] >= 1 for row in rows)
