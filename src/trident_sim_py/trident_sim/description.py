# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions: where they are, xacro, and a controller to go with them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from xml.sax.saxutils import escape

from trident_sim import _core
from trident_sim._core import Error

FilePath = str | os.PathLike[str]
_MULTIROTOR = "package://rotors_description/urdf/mav_generic_odometry_sensor.gazebo"
_LEE_PLUGIN = "libtrident_lee_position_controller.so"


def find_resource(uri: FilePath, folders: Sequence[FilePath] = ()) -> str:
    """Path of the existing file or folder that a URI or a path means.

    Args:
        uri: `package://`, `model://`, `file://`, an absolute path, or one that is relative to a
            search folder or to the working directory.
        folders: searched before GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH and ROS_PACKAGE_PATH.

    Raises:
        Error: it was not found; the text lists the folders.
    """
    return _core.find_resource(os.fspath(uri), [os.fspath(folder) for folder in folders])


def expand_xacro(path: FilePath, **args: object) -> str:
    """Expand a xacro file.

    `$(find package)` needs the Python package roslaunch, but no master.

    Args:
        path: path or URI of the file.
        args: its arguments; True and False become `true` and `false`, as in launch files.

    Returns:
        Text of the URDF.

    Raises:
        Error: the file is not there or cannot be expanded, or xacro is not installed.
    """
    file = find_resource(path)
    try:
        import xacro
    except ImportError as error:
        raise Error(f"{file}: xacro is not installed for this Python: pip install xacro") from error
    mappings = {
        name: str(value).lower() if isinstance(value, bool) else str(value)
        for name, value in args.items()
    }
    try:
        document = xacro.process_file(file, mappings=mappings)
    except Exception as error:  # xacro raises whatever evaluating an expression does
        raise Error(f"{file}: {str(error) or repr(error)}") from error
    return str(document.toprettyxml(indent="  "))


def lee_parameter_files(vehicle: str = "firefly") -> list[str]:
    """Parameter files of the Lee controller for a vehicle of RotorS.

    Args:
        vehicle: e.g. `firefly`.

    Returns:
        Paths of gains and vehicle parameters, those that its launch files load.

    Raises:
        Error: none were found.
    """
    folder = "package://rotors_gazebo/resource"
    return [
        find_resource(f"{folder}/lee_controller_{vehicle}.yaml"),
        find_resource(f"{folder}/{vehicle}.yaml"),
    ]


def with_lee_controller(
    description: str,
    namespace: str,
    parameter_files: Sequence[FilePath],
    *,
    odometry: str = "odometry_sensor1/odometry",
    trajectory: str = "command/trajectory",
    command: str = "command/motor_speed",
) -> str:
    """Add the Lee position controller to a multirotor, inside the simulator.

    It computes what `rotors_control/lee_position_controller_node` computes, at the same states and
    with the same delays. Set-points go to the input `<namespace>/<trajectory>`, as
    `TrajectorySample`.

    Args:
        description: text of a URDF or SDF.
        namespace: prefix of the ports.
        parameter_files: YAML files of gains and vehicle, see `lee_parameter_files`.
        odometry: output that it reads.
        trajectory: input that it takes set-points from.
        command: input that it writes rotor speeds to.

    Returns:
        The description with the controller.

    Raises:
        Error: not a URDF or SDF of one model, or a file that is not there.
    """
    files = []
    for path in parameter_files:
        files.append(str(Path(find_resource(path)).resolve()))
        if len(files[-1].split()) != 1:
            raise Error(f"parameter file '{files[-1]}': legal: a path without spaces")
    elements = {
        "robotNamespace": namespace.strip("/"),
        "odometryTopic": odometry,
        "trajectoryTopic": trajectory,
        "commandTopic": command,
        "parameterFiles": " ".join(files),
    }
    body = "".join(f"<{name}>{escape(text)}</{name}>" for name, text in elements.items())
    plugin = f'<plugin name="lee_position_controller" filename="{_LEE_PLUGIN}">{body}</plugin>'
    for end, addition in (("</robot>", f"<gazebo>{plugin}</gazebo>"), ("</model>", plugin)):
        head, found, tail = description.rpartition(end)
        if found:
            return head + addition + found + tail
    raise Error("with_lee_controller: description has neither </robot> nor </model>")


def multirotor(namespace: str, vehicle: str = "firefly", *, controlled: bool = True) -> str:
    """Describe a multirotor of RotorS with motors, IMU, odometry and ground truth.

    It is the one that `spawn_mav.launch` spawns. With a controller it takes set-points on
    `<namespace>/command/trajectory` (position [m] and yaw [rad] in the world frame), without one
    rotor speeds [rad/s] on `<namespace>/command/motor_speed`.

    Args:
        namespace: prefix of its ports.
        vehicle: `firefly`, `hummingbird`, `iris`, `pelican`, `ardrone` or `tutorial_iris`.
        controlled: whether the Lee position controller flies it.

    Returns:
        Text of the URDF.

    Raises:
        Error: there is no such vehicle, or xacro is not installed.
    """
    urdf = expand_xacro(
        _MULTIROTOR,
        mav_name=vehicle,
        namespace=namespace,
        enable_ground_truth=True,
        enable_logging=False,
        log_file=vehicle,
        wait_to_record_bag=False,
        enable_mavlink_interface=False,
    )
    if not controlled:
        return urdf
    return with_lee_controller(urdf, namespace, lee_parameter_files(vehicle))
