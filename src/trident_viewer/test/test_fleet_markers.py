# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

rospy = pytest.importorskip("rospy")

from geometry_msgs.msg import Point, Pose, Quaternion  # noqa: E402
from test_visuals import URDF  # noqa: E402
from trident_viewer.fleet_markers import FleetMarkers  # noqa: E402
from visualization_msgs.msg import Marker  # noqa: E402

from trident_msgs.msg import FleetState  # noqa: E402


@pytest.fixture
def parameters(monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    known: dict[str, str] = {}
    monkeypatch.setattr(rospy, "get_param", lambda name, default: known.get(name, default))
    return known


def state(stamp_s: float, **places: tuple[float, float, float]) -> Any:
    """Vehicles that look along y."""
    message = FleetState(name=list(places))
    message.header.stamp = rospy.Time.from_sec(stamp_s)
    message.header.frame_id = "world"
    turn = Quaternion(0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5))
    message.pose = [Pose(Point(*place), turn) for place in places.values()]
    return message


def by_name(markers: Any) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {}
    for marker in markers.markers:
        found.setdefault(marker.ns, []).append(marker)
    return found


def test_shape_name_and_path_of_every_vehicle(parameters: dict[str, str]) -> None:
    parameters["/A/robot_description"] = URDF
    fleet = FleetMarkers()
    assert fleet.markers() is None
    for step in range(11):
        fleet.add(state(0.1 * step, A=(0.1 * step, 0.0, 1.0), B=(0.0, 5.0, 0.0)))
    found = by_name(fleet.markers())
    assert fleet.markers() is None, "nothing new"
    assert found[""][0].action == Marker.DELETEALL
    mesh = found["A/shape"][-1]
    assert mesh.type == Marker.MESH_RESOURCE
    assert mesh.mesh_resource == "package://a/b.dae"
    assert mesh.header.frame_id == "world"
    # 3 m to the left of a vehicle at x = 1 that looks along y.
    at = mesh.pose.position
    assert (at.x, at.y, at.z) == pytest.approx((-2.0, 0.0, 1.0), abs=1e-9)
    turn = mesh.pose.orientation
    assert abs(turn.z) == pytest.approx(1.0)
    assert found["A/name"][0].text == "A"
    path = found["A/path"][0].points
    assert [point.x for point in path] == pytest.approx(np.linspace(0.0, 1.0, 11))
    assert len(found["B/shape"]) == 1, "a disc, without a description"
    assert "B/path" not in found, "it has not moved"


def test_a_reset_begins_new_paths_and_a_vehicle_that_is_gone_is_not_shown(
    parameters: dict[str, str],
) -> None:
    del parameters
    fleet = FleetMarkers()
    for step in range(5):
        fleet.add(state(1.0 + step, A=(step, 0.0, 1.0), B=(step, 1.0, 1.0)))
    fleet.add(state(0.0, A=(0.0, 0.0, 1.0)))
    found = by_name(fleet.markers())
    assert set(found) == {"", "A/shape", "A/name"}


def test_a_description_that_is_none_is_a_disc(
    parameters: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    logged: list[str] = []
    monkeypatch.setattr(rospy, "logwarn", lambda text, *words: logged.append(text % words))
    parameters["/A/robot_description"] = "<robot"
    fleet = FleetMarkers()
    for step in range(2):
        fleet.add(state(step, A=(0.0, 0.0, 1.0)))
        (disc,) = by_name(fleet.markers())["A/shape"]
        assert disc.type == Marker.CYLINDER
    assert len(logged) == 1, "once, not with every picture"
    assert logged[0].startswith("A is shown as a disc: robot_description: ")


def test_a_vehicle_that_goes_while_its_marker_is_made_does_not_end_the_node(
    parameters: dict[str, str],
) -> None:
    """States come in a thread of their own."""
    fleet = FleetMarkers()
    pose = state(0.0, A=(0.0, 0.0, 1.0)).pose[0]

    class Leaving(SimpleNamespace):
        @property
        def orientation(self) -> Any:
            fleet.add(state(1.0, B=(0.0, 0.0, 1.0)))
            return pose.orientation

    leaving = state(0.0, A=(0.0, 0.0, 1.0))
    leaving.pose = [Leaving(position=pose.position)]
    fleet.add(leaving)
    assert set(by_name(fleet.markers())) == {"", "A/shape", "A/name"}
    assert set(by_name(fleet.markers())) == {"", "B/shape", "B/name"}
    parameters["/A/robot_description"] = URDF
    fleet.add(state(2.0, A=(0.0, 0.0, 1.0)))
    shapes = by_name(fleet.markers())["A/shape"]
    assert shapes[-1].type == Marker.MESH_RESOURCE, "what came back is described again"
