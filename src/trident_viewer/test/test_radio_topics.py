# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which topics cross by radio, and which are read past it."""

from __future__ import annotations

from trident_viewer.radio_topics import (
    Graph,
    PastRadio,
    RelayedTopic,
    aligned,
    called_services,
    graph_of,
    radios,
    read_past_radio,
    relayed_topics,
    topics_text,
)

STATUS = "trident_msgs/LinkStatusArray"
ODOMETRY = "nav_msgs/Odometry"


def team() -> Graph:
    """Two robots with radios, one without, and tools outside of all of them."""
    publishers = [
        ("/uav1/link_status", ["/gazebo"]),
        ("/usv1/link_status", ["/gazebo"]),
        ("/uav1/odometry", ["/gazebo"]),
        ("/usv1/from/uav1/odometry", ["/gazebo"]),
        ("/usv1/odometry", ["/gazebo"]),
        ("/ugv1/odometry", ["/gazebo"]),
        ("/radio/links", ["/gazebo"]),
    ]
    readers = [
        ("/uav1/odometry", ["/usv1/spy", "/uav1/controller", "/rviz"]),
        ("/usv1/from/uav1/odometry", ["/usv1/planner", "/recorder"]),
        ("/uav1/from/usv1/plan", ["/uav1/planner"]),
        ("/ugv1/odometry", ["/uav1/planner"]),
        ("/usv1/from/uav1/odometry_of_ugv1", []),
        ("/usv10/odometry", ["/uav1/planner"]),
    ]
    types = [(topic, ODOMETRY) for topic, _ in publishers if topic.endswith("odometry")]
    types += [("/uav1/link_status", STATUS), ("/usv1/link_status", "*")]
    names = ["/usv1/to/uav1/arm", "/uav1/arm", "/usv1/to/ugv1/arm", "/usv1/to/uav1"]
    return graph_of(publishers, readers, types, [(name, ["/gazebo"]) for name in names])


def test_radios_are_the_namespaces_with_a_status() -> None:
    assert radios(team()) == ["uav1", "usv1"]


def test_another_type_of_that_name_or_one_outside_of_a_namespace_is_no_radio() -> None:
    publishers = [("/link_status", ["/a"]), ("/wifi/link_status", ["/b"]), ("/a/b/link_status", [])]
    types = [("/wifi/link_status", "std_msgs/String"), ("/a/b/link_status", STATUS)]
    assert radios(graph_of(publishers, [], types)) == ["a/b"]


def test_relayed_topics_have_types_and_readers() -> None:
    assert relayed_topics(team()) == [
        RelayedTopic("/uav1/from/usv1/plan", "*", ["/uav1/planner"], is_published=False),
        RelayedTopic(
            "/usv1/from/uav1/odometry",
            ODOMETRY,
            ["/recorder", "/usv1/planner"],
            is_published=True,
        ),
        RelayedTopic("/usv1/from/uav1/odometry_of_ugv1", "*", [], is_published=False),
    ]


def test_services_by_radio_are_those_from_one_radio_to_another() -> None:
    assert called_services(team()) == ["/usv1/to/uav1/arm"]


def test_only_nodes_of_a_radio_that_read_another_one_read_past_it() -> None:
    assert read_past_radio(team()) == [PastRadio("/usv1/spy", "/uav1/odometry")]


def test_what_another_robot_has_by_radio_is_not_ones_own() -> None:
    graph = team()
    readers = {"/usv1/from/uav1/odometry": ["/uav1/mirror", "/usv1/planner"]}
    changed = Graph(graph.publishers, readers, graph.types)
    assert read_past_radio(changed) == [PastRadio("/uav1/mirror", "/usv1/from/uav1/odometry")]


def test_a_node_belongs_to_the_innermost_robot() -> None:
    publishers = [("/fleet/link_status", ["/g"]), ("/fleet/uav1/link_status", ["/g"])]
    readers = [("/fleet/uav1/odometry", ["/fleet/uav1/controller", "/fleet/planner"])]
    graph = graph_of(publishers, readers, [])
    assert read_past_radio(graph) == [PastRadio("/fleet/planner", "/fleet/uav1/odometry")]


def test_the_text_names_everything_in_columns() -> None:
    assert topics_text(team()).splitlines() == [
        "radios: uav1, usv1",
        "relayed topics:",
        "  /uav1/from/usv1/plan              *                  read by /uav1/planner; nothing is "
        "published: no rule for it, or no message so far",
        "  /usv1/from/uav1/odometry          nav_msgs/Odometry  read by /recorder, /usv1/planner",
        "  /usv1/from/uav1/odometry_of_ugv1  *                  no readers; nothing is published: "
        "no rule for it, or no message so far",
        "services by radio:",
        "  /usv1/to/uav1/arm",
        "read past the radio:",
        "  /usv1/spy  reads /uav1/odometry",
    ]


def test_the_text_of_a_simulation_without_radios() -> None:
    assert topics_text(graph_of([], [("/a/b", ["/c/d"])], [])).splitlines() == [
        "radios: none",
        "relayed topics: none",
        "services by radio: none",
        "read past the radio: nothing",
    ]


def test_numbers_stand_on_the_right() -> None:
    assert aligned([["source", "MCS"], ["uav1", "10"]], numbers_from=1) == [
        "  source  MCS",
        "  uav1     10",
    ]
    assert aligned([]) == []
