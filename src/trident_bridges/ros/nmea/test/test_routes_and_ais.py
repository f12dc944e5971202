# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Autopilot sentences, routes and AIS through nmea_node."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
import rospy
from boat import LATITUDE_DEG, LONGITUDE_DEG, Boat, Client, sailing, start_server, with_checksum
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from std_msgs.msg import Float64
from trident.testing import Ros, eventually, recorder

from trident_msgs.msg import AisTarget


def test_a_heading_to_steer_and_a_route_reach_the_vehicles_controller(
    ros: Ros, boat: Boat, client: Callable[[int], Client]
) -> None:
    port = start_server(ros, "nmea", autopilot={"steers": True})
    one = client(port)
    with (
        recorder("/command/heading", Float64) as headings,
        recorder("/command/path", Path) as paths,
    ):
        one.send(with_checksum("$GPAPB,A,A,0.01,R,N,V,V,11.0,T,A,11.0,T,30.0,T"))
        assert headings.received()[0].data == pytest.approx(math.radians(60.0))
        eventually(boat.is_heard, "the node's subscriptions")

        def has_come() -> bool:
            one.send(with_checksum("$GPWPL,6326.33400,N,01023.94000,E,A"))
            one.send(with_checksum("$GPWPL,6326.43400,N,01023.94000,E,B"))
            one.send(with_checksum("$GPRTE,1,1,c,R,A,B"))
            # Sent again once the boat's place is known.
            one.send(with_checksum("$GPWPL,6326.43401,N,01023.94000,E,B"))
            return bool(paths.messages)

        eventually(sailing(boat, has_come), "a path")
        first, second = (pose.pose.position for pose in paths.messages[-1].poses)
        assert math.hypot(first.x, first.y) < 0.05
        assert second.x == pytest.approx(0.0, abs=0.05)
        assert second.y == pytest.approx(0.1 / 60.0 * 111_470.0, rel=2e-3)


def test_without_leave_nothing_is_steered(ros: Ros, client: Callable[[int], Client]) -> None:
    port = start_server(ros, "nmea")
    one = client(port)
    with recorder("/nmea/cross_track_error", Float64) as errors:
        one.send(with_checksum("$GPAPB,A,A,0.01,R,N,V,V,11.0,T,A,11.0,T,30.0,T"))
        assert errors.received()[0].data == pytest.approx(-18.52)
    topics = [name for name, _ in rospy.get_published_topics()]
    assert "/command/heading" not in topics


def test_a_vehicles_path_is_sent_as_a_route(
    ros: Ros, boat: Boat, client: Callable[[int], Client]
) -> None:
    port = start_server(
        ros,
        "nmea",
        rates={"APB": 5.0, "RMB": 5.0, "WPL": 1.0, "RTE": 1.0},
        origin={"given": True, "latitude": LATITUDE_DEG, "longitude": LONGITUDE_DEG},
    )
    one = client(port)
    publisher = rospy.Publisher("command/path", Path, queue_size=1, latch=True)
    path = Path()
    for x, y in ((0.0, 100.0), (100.0, 100.0)):
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y = x, y
        path.poses.append(pose)
    publisher.publish(path)
    eventually(boat.is_heard, "the node's subscriptions")
    done = sailing(boat, lambda: bool(one.lines("RMB") and one.lines("RTE") and one.lines("WPL")))
    eventually(done, "a route")
    publisher.unregister()
    assert one.lines("RTE")[-1].startswith("$GPRTE,1,1,c,ROUTE,WP001,WP002*")
    apb = one.lines("APB")[-1].split(",")
    assert float(apb[8]) == pytest.approx(0.0)
    assert float(apb[13]) == pytest.approx(0.0)


def test_bearings_are_those_of_a_frame_that_is_turned(
    ros: Ros, boat: Boat, client: Callable[[int], Client]
) -> None:
    origin = {"given": True, "latitude": LATITUDE_DEG, "longitude": LONGITUDE_DEG}
    rates = {"RMB": 5.0, "HDT": 5.0}
    port = start_server(ros, "nmea", rates=rates, origin={**origin, "heading": math.pi / 2})
    one = client(port)
    publisher = rospy.Publisher("command/path", Path, queue_size=1, latch=True)
    pose = PoseStamped()
    pose.pose.position.x = 1000.0  # to the north, as the boat's x
    publisher.publish(Path(poses=[pose]))
    eventually(sailing(boat, lambda: bool(one.lines("RMB") and one.lines("HDT"))), "a bearing")
    publisher.unregister()
    heading = float(one.lines("HDT")[-1].split(",")[1])
    bearing = float(one.lines("RMB")[-1].split(",")[11])
    assert math.remainder(heading, 360.0) == pytest.approx(0.0, abs=0.1)
    assert math.remainder(bearing, 360.0) == pytest.approx(0.0, abs=1.0)


def test_vessels_hear_each_other_by_ais(ros: Ros, client: Callable[[int], Client]) -> None:
    ports = [
        start_server(
            ros, name, ais={"mmsi": mmsi, "name": name, "position_period": 1.0}, output=name
        )
        for name, mmsi in (("otter", 257000001), ("wamv", 257000002))
    ]
    one, other = (client(port) for port in ports)
    boat = Boat()
    eventually(boat.is_heard, "the nodes' subscriptions")
    with recorder("/wamv/ais", AisTarget) as targets:

        def named_positions() -> list[AisTarget]:
            # A fix that comes before any odometry is sent without a speed.
            return [
                t
                for t in targets.messages
                if t.name and t.message_type == 1 and math.isfinite(t.speed)
            ]

        def has_come() -> bool:
            return bool(named_positions() and other.lines("VDM") and one.lines("VDO"))

        eventually(sailing(boat, has_come), "a named position of the other vessel")
    boat.close()
    target = named_positions()[-1]
    assert (target.mmsi, target.name) == (257000001, "OTTER")
    assert target.latitude == pytest.approx(LATITUDE_DEG, abs=1e-5)
    assert target.speed == pytest.approx(2.0, abs=0.06)
    assert target.course == pytest.approx(math.pi / 2, abs=0.01)
    assert all(line.startswith("!AIVDM,") for line in other.lines("VDM"))
