# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""When a launch counts as up."""

from __future__ import annotations

import pytest

pytest.importorskip("rospy", reason="ROS is not installed")

from trident_viewer.launch_nodes import missing_nodes, node_of

ROSCORE = ["master", "rosout-1"]


def test_a_process_is_named_for_its_node() -> None:
    assert node_of("UAV1/controller-3") == "/UAV1/controller"
    assert node_of("lidar-2-7") == "/lidar-2"


def test_all_is_up_when_every_process_has_registered_or_ended() -> None:
    active, dead = [*ROSCORE, "gazebo-1", "UAV1/controller-3"], ["UAV1/spawn-2"]
    registered = ["/gazebo", "/UAV1/controller", "/hold_at_7"]
    assert not missing_nodes(3, active, dead, registered)


@pytest.mark.parametrize(
    ("active", "dead", "registered", "what"),
    [
        (["gazebo-1"], [], ["/gazebo"], "2 of 3 nodes are not started"),
        (["gazebo-1", "a-2", "b/c-3"], [], ["/gazebo"], "not registered: /a, /b/c"),
        (ROSCORE, [], ["/rosout"], "3 of 3 nodes are not started"),
        (["gazebo-1", "a-2"], ["b-3"], ["/a"], "not registered: /gazebo"),
    ],
)
def test_what_is_missing_is_named(
    active: list[str], dead: list[str], registered: list[str], what: str
) -> None:
    assert missing_nodes(3, active, dead, registered) == what
