# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A node with the simulator's model services that keeps what it is asked for.

Usage: fake_simulator.py LOG [MODEL ...]. Writes one JSON object per call to LOG. A model named
``bad`` is refused; MODELs exist from the start.
"""

import json
import sys
from typing import Any

import rospy
from gazebo_msgs.srv import (
    DeleteModel,
    DeleteModelResponse,
    GetWorldProperties,
    GetWorldPropertiesResponse,
    SetModelConfiguration,
    SetModelConfigurationResponse,
    SpawnModel,
    SpawnModelResponse,
)
from std_srvs.srv import Empty, EmptyResponse


class FakeSimulator:
    """Answers and records calls."""

    def __init__(self, log: str, models: list[str]) -> None:
        self._log = log
        self._models = models
        rospy.Service("/gazebo/spawn_urdf_model", SpawnModel, lambda r: self._spawn("urdf", r))
        rospy.Service("/gazebo/spawn_sdf_model", SpawnModel, lambda r: self._spawn("sdf", r))
        rospy.Service("/gazebo/delete_model", DeleteModel, self._delete)
        rospy.Service("/gazebo/unpause_physics", Empty, self._unpause)
        rospy.Service("/gazebo/get_world_properties", GetWorldProperties, self._world)
        rospy.Service("/gazebo/set_model_configuration", SetModelConfiguration, self._configure)

    def _note(self, call: str, **content: Any) -> None:
        with open(self._log, "a", encoding="utf-8") as log:
            log.write(json.dumps({"call": call, **content}) + "\n")

    def _spawn(self, form: str, request: Any) -> SpawnModelResponse:
        position, orientation = request.initial_pose.position, request.initial_pose.orientation
        self._note(
            f"spawn_{form}",
            model=request.model_name,
            xml=request.model_xml,
            namespace=request.robot_namespace,
            frame=request.reference_frame,
            position=[position.x, position.y, position.z],
            orientation=[orientation.x, orientation.y, orientation.z, orientation.w],
        )
        if request.model_name == "bad":
            return SpawnModelResponse(False, "SpawnModel: Failure - entity already exists.")
        self._models.append(request.model_name)
        return SpawnModelResponse(True, "SpawnModel: Successfully spawned entity")

    def _delete(self, request: Any) -> DeleteModelResponse:
        self._note("delete", model=request.model_name)
        return DeleteModelResponse(True, "")

    def _unpause(self, _request: Any) -> EmptyResponse:
        self._note("unpause")
        return EmptyResponse()

    def _world(self, _request: Any) -> GetWorldPropertiesResponse:
        return GetWorldPropertiesResponse(model_names=self._models, success=True)

    def _configure(self, request: Any) -> SetModelConfigurationResponse:
        self._note(
            "configure",
            model=request.model_name,
            names=list(request.joint_names),
            positions=list(request.joint_positions),
        )
        return SetModelConfigurationResponse(True, "")


if __name__ == "__main__":
    rospy.init_node("fake_simulator")
    simulator = FakeSimulator(sys.argv[1], sys.argv[2:])
    rospy.spin()
