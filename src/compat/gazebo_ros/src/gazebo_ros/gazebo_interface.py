# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Clients of the simulator's model services, under the names that Gazebo's ROS package uses.

Each call waits for its service, in wall-clock time, then for the answer. Call ``rospy.init_node``
first.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import rospy
from gazebo_msgs.srv import SetModelConfiguration, SpawnModel
from geometry_msgs.msg import Pose


def _call(service: str, service_type: Any, *arguments: Any) -> bool:
    """Calls ``service``; prints what went wrong, or the server's message, and returns success."""
    rospy.wait_for_service(service)
    try:
        response = rospy.ServiceProxy(service, service_type)(*arguments)
    except rospy.ServiceException as error:
        print(f"Service call to {service} failed: {error}", file=sys.stderr)
        return False
    if response.status_message:
        rospy.loginfo("%s: %s", service, response.status_message)
    return bool(response.success)


def spawn_sdf_model_client(
    model_name: str,
    model_xml: str,
    robot_namespace: str,
    initial_pose: Pose,
    reference_frame: str,
    gazebo_namespace: str,
) -> bool:
    """Spawns a model from SDF text.

    Args:
        model_name: name in the world; must be free.
        model_xml: the SDF text.
        robot_namespace: ROS namespace of the model's plugins.
        initial_pose: pose of the model in ``reference_frame`` [m, unit quaternion].
        reference_frame: a model or ``model::link``; empty or ``world`` for the world.
        gazebo_namespace: namespace of the simulator's services, usually ``/gazebo``.

    Returns:
        Whether the model is in the world.
    """
    return _call(
        f"{gazebo_namespace}/spawn_sdf_model",
        SpawnModel,
        model_name,
        model_xml,
        robot_namespace,
        initial_pose,
        reference_frame,
    )


def spawn_urdf_model_client(
    model_name: str,
    model_xml: str,
    robot_namespace: str,
    initial_pose: Pose,
    reference_frame: str,
    gazebo_namespace: str,
) -> bool:
    """Spawns a model from URDF text; arguments as in :func:`spawn_sdf_model_client`."""
    return _call(
        f"{gazebo_namespace}/spawn_urdf_model",
        SpawnModel,
        model_name,
        model_xml,
        robot_namespace,
        initial_pose,
        reference_frame,
    )


def set_model_configuration_client(
    model_name: str,
    model_param_name: str,
    joint_names: Sequence[str],
    joint_positions: Sequence[float],
    gazebo_namespace: str,
) -> bool:
    """Puts joints of a model at positions.

    Args:
        model_name: name in the world.
        model_param_name: parameter that holds the URDF; may be empty.
        joint_names: joints to move.
        joint_positions: where to, in the same order [rad or m].
        gazebo_namespace: namespace of the simulator's services, usually ``/gazebo``.

    Returns:
        Whether every joint was set.
    """
    return _call(
        f"{gazebo_namespace}/set_model_configuration",
        SetModelConfiguration,
        model_name,
        model_param_name,
        list(joint_names),
        list(joint_positions),
    )
