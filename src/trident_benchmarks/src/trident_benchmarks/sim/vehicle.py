# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The vehicle that is measured: RotorS' firefly with its odometry sensor, and its controller."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder, program

#: Stands for the namespace in an expanded description: expanding takes a third of a second, and
#: only the namespace differs between vehicles.
MARKER = "TRIDENT_BENCH_NS"
MAV = "firefly"
HOVER_HEIGHT_M = 1.0
SPAWN_HEIGHT_M = 0.1
_PER_ROW = 10
_SPACING_M = 2.0


def vehicle_name(index: int) -> str:
    """Name and namespace of vehicle ``index``, counted from 0."""
    return f"UAV{index + 1}"


def place(index: int) -> tuple[float, float]:
    """Where vehicle ``index`` stands and hovers: x and y in the world [m]."""
    return _SPACING_M * (index % _PER_ROW), _SPACING_M * (index // _PER_ROW)


def expand_description(namespace: str) -> str:
    """URDF of the vehicle, as rotors_gazebo's multi_spawn_mav.launch makes it.

    Raises:
        EvalError: xacro fails.
    """
    model = package_folder("rotors_description") / "urdf/mav_generic_odometry_sensor.gazebo"
    command = [
        str(package_folder("xacro") / "xacro"),
        str(model),
        f"mav_name:={MAV}",
        f"namespace:={namespace}",
        "enable_ground_truth:=true",
        "enable_logging:=false",
        f"log_file:={MAV}",
        "wait_to_record_bag:=false",
        "enable_mavlink_interface:=false",
    ]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise EvalError(f"{model}: xacro fails: {result.stderr.strip()}")
    return result.stdout


def describe(template: str, index: int) -> str:
    """URDF of vehicle ``index`` from the one expanded for :data:`MARKER`."""
    return template.replace(MARKER, vehicle_name(index))


@dataclass(frozen=True)
class Setup:
    """What all vehicles of a measurement share.

    Attributes:
        template: URDF with :data:`MARKER` for the namespace.
        world: SDF world, RotorS' settings: steps of 10 ms.
        parameter_files: the controller's YAML files.
        controller: its executable.
    """

    template: str
    world: Path
    parameter_files: tuple[Path, Path]
    controller: str

    def controller_params(self) -> dict[str, Any]:
        """Both files as one dictionary, as rosparam loads them one after the other."""
        params: dict[str, Any] = {}
        for path in self.parameter_files:
            params |= yaml.safe_load(path.read_text(encoding="utf-8"))
        return params


def prepare(controller: Path | None) -> Setup:
    """Finds and expands what is measured.

    Args:
        controller: a lee_position_controller_node to use in place of the workspace's.

    Raises:
        EvalError: a package, program or file is missing.
    """
    if controller is not None and not controller.is_file():
        raise EvalError(f"--controller {controller}: no such file; legal: an executable")
    gazebo = package_folder("rotors_gazebo")
    resource = gazebo / "resource"
    return Setup(
        template=expand_description(MARKER),
        world=gazebo / "worlds/basic.world",
        parameter_files=(resource / f"lee_controller_{MAV}.yaml", resource / f"{MAV}.yaml"),
        controller=str(controller.resolve())
        if controller
        else program("rotors_control", "lee_position_controller_node"),
    )
