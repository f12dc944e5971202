# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("trident.testing", reason="the workspace is not built or sourced")
pytest.importorskip("rospy", reason="ROS is not installed")

import rospy
from gazebo_msgs.srv import (
    GetLinkProperties,
    GetLinkPropertiesResponse,
    GetLinkState,
    GetLinkStateResponse,
    GetModelProperties,
    GetModelPropertiesResponse,
    GetModelState,
    GetModelStateResponse,
    GetWorldProperties,
    GetWorldPropertiesResponse,
)
from trident.testing import Ros
from trident.testing.pytest_plugin import ros, session_ros
from trident_eval.viewing.census import models_in_the_world

__all__ = ["ros", "session_ros"]

ROBOTS = [f"UAV{number}" for number in range(20)]
ANSWERS = {
    "get_world_properties": (
        GetWorldProperties,
        GetWorldPropertiesResponse(model_names=["ground_plane", *ROBOTS], success=True),
    ),
    "get_model_properties": (
        GetModelProperties,
        GetModelPropertiesResponse(body_names=["base"], joint_names=["rotor"], success=True),
    ),
    "get_model_state": (GetModelState, GetModelStateResponse(success=True)),
    "get_link_properties": (GetLinkProperties, GetLinkPropertiesResponse(success=True)),
    "get_link_state": (GetLinkState, GetLinkStateResponse(success=True)),
}


class CountingService(rospy.Service):  # type: ignore[misc]
    """Notes connections and calls."""

    def __init__(self, name: str, kind: Any, answer: Any) -> None:
        self.connections = self.calls = 0
        self._answer = answer
        super().__init__(f"/gazebo/{name}", kind, self._reply)

    def handle(self, transport: Any, header: Any) -> None:
        self.connections += 1
        super().handle(transport, header)

    def _reply(self, _request: Any) -> Any:
        self.calls += 1
        return self._answer


@pytest.fixture
def simulator(ros: Ros) -> Iterator[dict[str, CountingService]]:
    services = {name: CountingService(name, *answer) for name, answer in ANSWERS.items()}
    yield services
    for service in services.values():
        service.shutdown()


def test_a_census_makes_one_connection_to_each_service(
    simulator: dict[str, CountingService],
) -> None:
    assert [model.name for model in models_in_the_world()] == ROBOTS
    assert simulator.pop("get_world_properties").calls == 1
    assert {service.calls for service in simulator.values()} == {len(ROBOTS)}
    assert {service.connections for service in simulator.values()} == {1}
