# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

import pytest

pytest.importorskip("rospy")

from gazebo_msgs.msg import ModelStates
from geometry_msgs.msg import Point, Pose, Quaternion
from trident_viewer.link_markers import (
    LinkMarkers,
    links_problem,
    places_problem,
    snr_color,
)
from visualization_msgs.msg import Marker

from trident_msgs.msg import LinkStatus, LinkStatusArray


def states(**places: tuple[float, float, float]) -> Any:
    turn = Quaternion(w=1.0)
    return ModelStates(list(places), [Pose(Point(*at), turn) for at in places.values()], [])


def status(*links: tuple[str, str, float, bool]) -> Any:
    return LinkStatusArray(
        links=[LinkStatus(source=a, destination=b, snr_db=snr, up=up) for a, b, snr, up in links]
    )


def test_a_line_per_pair_has_the_color_of_its_worse_direction() -> None:
    links = LinkMarkers()
    links.add_links(status(("a", "b", 25.0, True), ("b", "a", 4.0, True), ("a", "c", -9.0, False)))
    assert links.markers() is None, "nobody has said where they are"
    links.add_places(states(a=(0.0, 0.0, 1.0), b=(10.0, 0.0, 3.0), c=(0.0, 5.0, 1.0)))
    found = links.markers().markers
    assert links.markers() is None, "nothing new"
    assert found[0].action == Marker.DELETEALL
    assert [(marker.ns, marker.type) for marker in found[1:]] == [
        ("a - b", Marker.LINE_STRIP),
        ("a - b", Marker.TEXT_VIEW_FACING),
        ("a - c", Marker.LINE_STRIP),
    ]
    line, label, down = found[1:]
    assert line.header.frame_id == "world"
    assert [(p.x, p.y, p.z) for p in line.points] == [(0.0, 0.0, 1.0), (10.0, 0.0, 3.0)]
    assert line.color == snr_color(4.0)
    assert label.text == "4 dB"
    assert label.pose.position.x == pytest.approx(5.0)
    assert label.pose.position.z > 2.0
    assert down.scale.x < line.scale.x


def test_colors_go_from_red_to_green() -> None:
    bad, middling, good = snr_color(-math.inf), snr_color(15.0), snr_color(50.0)
    assert bad.r > 0.5 > bad.g
    assert good.g > 0.5 > good.r
    assert middling.r > 0.5 < middling.g


def test_a_radio_without_a_model_of_its_name_is_named() -> None:
    links = LinkMarkers()
    links.add_links(status(("a", "ghost", 25.0, True)))
    assert links.unplaced() == []
    links.add_places(states(a=(0.0, 0.0, 1.0)))
    assert links.unplaced() == ["ghost"]
    assert len(links.markers().markers) == 1


def test_hostile_messages_are_refused() -> None:
    assert links_problem(status(("a", "b", math.nan, True))) == "snr_db of a to b is nan"
    assert links_problem(status(("a", "b", -math.inf, False))) == ""
    assert "equally many" in places_problem(ModelStates(["a"], [], []))
    assert "a: " in places_problem(states(a=(math.nan, 0.0, 0.0)))
