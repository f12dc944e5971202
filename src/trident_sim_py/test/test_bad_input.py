# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Each mistake gives one error that names what is wrong and what is legal."""

from __future__ import annotations

import builtins
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import BALL, WORLD, Fly

import trident_sim

NAN = float("nan")


def test_error_is_a_value_error() -> None:
    assert issubclass(trident_sim.Error, ValueError)
    assert trident_sim.Error.__module__ == "trident_sim"


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: trident_sim.World("nowhere.world"), r"world file 'nowhere.world' not found"),
        (lambda: trident_sim.World("<sdf version='1.6'>\n<world>\n</sdf>"), r"world:\d+: not well"),
        (lambda: trident_sim.World(WORLD, timing="fast"), r"timing is 'fast', legal: rotors, dir"),
        (lambda: trident_sim.World(WORLD, seed=-1), r"seed is -1, legal: 0 to 2\^64 - 1"),
        (lambda: trident_sim.World(WORLD.replace("0.01", "-1")), r"<max_step_size> is -1"),
        (lambda: trident_sim.World(WORLD, plugins=["/nowhere.so"]), r"/nowhere.so"),
        (lambda: trident_sim.find_resource("model://nothing"), r"'model://nothing' not found; se"),
    ],
)
def test_worlds(make: Callable[[], object], text: str) -> None:
    with pytest.raises(trident_sim.Error, match=text):
        make()


def test_syntax_error_in_a_world_file_names_file_and_line(tmp_path: Path) -> None:
    file = tmp_path / "broken.world"
    file.write_text(WORLD.replace("</physics>", ""), encoding="utf-8")
    with pytest.raises(trident_sim.Error, match=rf"{file}:\d+: not well-formed XML"):
        trident_sim.World(file)


ZERO_INERTIA = """<robot name="r"><link name="body"><inertial><mass value="1"/>
  <inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""


@pytest.mark.parametrize(
    ("kwargs", "text"),
    [
        ({}, r"0 of urdf, sdf, file given, legal: one"),
        ({"sdf": BALL, "urdf": BALL}, r"2 of urdf, sdf, file given"),
        ({"sdf": "<sdf"}, r"not well-formed XML"),
        ({"sdf": "<html/>"}, r"root element is <html>"),
        ({"urdf": ZERO_INERTIA}, r"body"),
        ({"sdf": BALL, "pose": (0, 0)}, r"pose has shape \(2,\), legal: \(3,\)"),
        ({"sdf": BALL, "pose": (0, 0, NAN)}, r"pose\[2\] is nan, legal: finite"),
        ({"sdf": BALL, "pose": "here"}, r"pose is 'here', legal: numbers"),
        ({"sdf": BALL, "pose": (0, 0, 0, 0, 0, 0, 2)}, r"quaternion of norm 2.*legal: 1"),
        ({"file": "/nowhere/robot.urdf"}, r"'/nowhere/robot.urdf' not found"),
    ],
)
def test_spawn(world: trident_sim.World, kwargs: dict[str, Any], text: str) -> None:
    with pytest.raises(trident_sim.Error, match=text):
        world.spawn("thing", **kwargs)
    assert len(world.models) == 0
    world.spawn("thing", sdf=BALL)


def test_file_that_is_not_text(world: trident_sim.World, tmp_path: Path) -> None:
    file = tmp_path / "binary.sdf"
    file.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(trident_sim.Error, match=str(file)):
        world.spawn(file=file)


def test_names(world: trident_sim.World) -> None:
    ball = world.spawn(sdf=BALL)
    with pytest.raises(trident_sim.Error, match="'ball' already exists"):
        world.spawn(sdf=BALL)
    with pytest.raises(trident_sim.Error, match="model 'bull' is not in the world; there are: ba"):
        world.model("bull")
    with pytest.raises(trident_sim.Error, match="model 'bull' is not in the world"):
        world.remove("bull")
    with pytest.raises(KeyError, match="there are: ball"):
        _ = world.models["bull"]
    with pytest.raises(KeyError, match="port 'odometry' is not in the world"):
        _ = world.ports["odometry"]
    with pytest.raises(trident_sim.Error, match="has no link 'arm'; there are: body"):
        ball.link("arm")
    with pytest.raises(trident_sim.Error, match="has no joint 'arm'; there are: none"):
        ball.joint("arm")


def test_states(world: trident_sim.World) -> None:
    ball = world.spawn(sdf=BALL)
    with pytest.raises(trident_sim.Error, match=r"pose of model 'ball'\[0\] is inf"):
        ball.set_pose((float("inf"), 0, 0))
    with pytest.raises(trident_sim.Error, match=r"linear has shape \(2,\), legal: \(3,\)"):
        ball.set_velocity((1.0, 2.0))
    with pytest.raises(trident_sim.Error, match=r"force\[1\] is nan"):
        ball.link("body").apply_wrench((0.0, NAN, 0.0))
    with pytest.raises(trident_sim.Error, match="step: n is -1, legal: 0 or more"):
        world.step(-1)
    np.testing.assert_array_equal(ball.position, [0, 0, 0])


@pytest.mark.parametrize(
    ("speeds", "text"),
    [
        ([1.0, 2.0, NAN, 1.0, 1.0, 1.0], r"angular_velocities\[2\] is nan, legal: finite"),
        ([float("inf")] * 6, r"angular_velocities\[0\] is inf"),
        ([[1.0] * 6], r"angular_velocities has shape \(1, 6\), legal: 1 dimension"),
        ([], r"angular_velocities has 0 values, legal: 1 to 32"),
        ([1.0] * 33, r"angular_velocities has 33 values, legal: 1 to 32"),
        (["fast"], r"angular_velocities is \['fast'\], legal: numbers"),
    ],
)
def test_motor_commands(make_flight: Fly, speeds: Any, text: str) -> None:
    world = make_flight(controlled=False)
    with pytest.raises(trident_sim.Error, match=text):
        world.ports["UAV1/command/motor_speed"].write(speeds)
    world.step(3)
    assert world.model("UAV1").joint("UAV1/rotor_0_joint").velocity == 0.0


ONE, TWO = [[0.0, 0.0, 1.0]], [[0.0, 0.0, 1.0]] * 2


@pytest.mark.parametrize(
    ("args", "kwargs", "text"),
    [
        ([[0.0, 0.0, 1.0]], {}, r"positions has shape \(3,\), legal: 2 dimension"),
        ([[[0.0, 1.0]]], {}, r"positions has shape \(1, 2\), legal: \(n, 3\)"),
        ([np.zeros((0, 3))], {}, r"positions has no points, legal: 1 or more"),
        ([[[0.0, NAN, 1.0]]], {}, r"positions\[1\] is nan, legal: finite"),
        ([TWO], {}, r"times is missing, legal: one for each of the 2 positions"),
        ([TWO], {"times": [0.0]}, r"times has 1 rows, legal: 2 as in positions"),
        (
            [TWO],
            {"times": [1.0, 0.5]},
            r"times\[1\] is 0.5.* s, legal: 1.* s, the one before it",
        ),
        ([TWO], {"times": [-1.0, 0.5]}, r"times\[0\] is -1.* s, legal: 0.* s to"),
        ([ONE], {"velocities": [[1.0]]}, r"velocities has shape \(1, 1\), legal: \(n, 3\)"),
        ([ONE], {"velocities": TWO}, r"velocities has 2 rows, legal: 1 as in positions"),
        ([ONE], {"yaw": NAN}, r"yaw\[0\] is nan, legal: finite"),
        ([ONE], {"stamp": -1.0}, r"stamp is -1.* s, legal: 0 to"),
    ],
)
def test_trajectories(args: list[Any], kwargs: dict[str, Any], text: str) -> None:
    with pytest.raises(trident_sim.Error, match=text):
        trident_sim.TrajectorySample(*args, **kwargs)


def test_a_value_of_another_class_is_refused(make_flight: Fly) -> None:
    port = make_flight().ports["UAV1/command/trajectory"]
    with pytest.raises(trident_sim.Error, match=r"positions is <trident_sim.ActuatorCommand"):
        port.write(trident_sim.ActuatorCommand([1.0]))


def test_xacro(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(trident_sim.Error, match=r"'/nowhere\.xacro' not found"):
        trident_sim.expand_xacro("/nowhere.xacro")
    file = tmp_path / "robot.xacro"
    head = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    file.write_text(head + '<link name="${nothing}"/></robot>', encoding="utf-8")
    with pytest.raises(trident_sim.Error, match=f"{file}: .*nothing"):
        trident_sim.expand_xacro(file)
    file.write_text(head, encoding="utf-8")
    with pytest.raises(trident_sim.Error, match=f"{file}: no element found"):
        trident_sim.expand_xacro(file)

    def without_xacro(name: str, *args: Any, **kwargs: Any) -> Any:
        if name == "xacro":
            raise ImportError(name)
        return real_import(name, *args, **kwargs)

    real_import = builtins.__import__
    monkeypatch.setattr(builtins, "__import__", without_xacro)
    with pytest.raises(trident_sim.Error, match="xacro is not installed"):
        trident_sim.expand_xacro(file)


def test_controller(tmp_path: Path) -> None:
    with pytest.raises(trident_sim.Error, match="neither </robot> nor </model>"):
        trident_sim.with_lee_controller("<html/>", "UAV1", [])
    with pytest.raises(trident_sim.Error, match=r"gains\.yaml' not found"):
        trident_sim.with_lee_controller(BALL, "UAV1", [tmp_path / "gains.yaml"])
    spaced = tmp_path / "two words.yaml"
    spaced.write_text("{}", encoding="utf-8")
    with pytest.raises(trident_sim.Error, match="legal: a path without spaces"):
        trident_sim.with_lee_controller(BALL, "UAV1", [spaced])


def test_unknown_key_of_the_controller_names_file_and_line(
    world: trident_sim.World, firefly_urdf: str, tmp_path: Path
) -> None:
    gains = tmp_path / "gains.yaml"
    gains.write_text("mass: 1.5\nmas: 1.5\n", encoding="utf-8")
    with pytest.raises(trident_sim.Error, match=rf"{gains}:2: .*'mas'"):
        world.spawn("UAV1", urdf=trident_sim.with_lee_controller(firefly_urdf, "UAV1", [gains]))
    assert len(world.models) == 0
    assert len(world.ports) == 0
