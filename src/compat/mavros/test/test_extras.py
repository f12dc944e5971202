# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Plugins of mavros_extras and the like: topics become messages, and messages topics."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterator
from typing import Any

import pytest
import rospy
from geometry_msgs.msg import Point32, Polygon, PolygonStamped, PoseStamped, Transform, Twist
from mavros_msgs.msg import (
    GPSINPUT,
    RTCM,
    CompanionProcessStatus,
    ESCInfo,
    LogEntry,
    OnboardComputerStatus,
    OpticalFlowRad,
    Trajectory,
)
from mavros_msgs.srv import CommandInt, LogRequestList
from nav_msgs.msg import Path
from peer import Peer, ask_by, connected_peer
from sensor_msgs.msg import LaserScan, Range, TimeReference
from std_srvs.srv import Trigger
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint
from trident.testing import Ros, eventually, package, recorder

NORTH = math.sqrt(0.5)  # z and w of a quaternion that turns the nose from east to north


@pytest.fixture(scope="module")
def peer(session_ros: Ros) -> Iterator[Peer]:
    """A vehicle that beats, and a node with all plugins that is connected to it."""
    with connected_peer(session_ros, {}) as one:
        yield one


def point(x: float, time_s: float) -> MultiDOFJointTrajectoryPoint:
    """To the east, with the nose to the north."""
    transform = Transform()
    transform.translation.x, transform.translation.z = x, 2.0
    transform.rotation.z = transform.rotation.w = NORTH
    velocity = Twist()
    velocity.linear.x = 0.5
    return MultiDOFJointTrajectoryPoint(
        transforms=[transform],
        velocities=[velocity],
        time_from_start=rospy.Duration.from_sec(time_s),
    )


def test_a_trajectory_is_followed_point_by_point(peer: Peer) -> None:
    trajectory = MultiDOFJointTrajectory(points=[point(1.0, 0.0), point(2.0, 0.3)])
    kind = "SET_POSITION_TARGET_LOCAL_NED"
    with recorder("/uav1/mavros/setpoint_trajectory/desired", Path) as paths:
        first = ask_by(peer, "setpoint_trajectory/local", trajectory, kind)
        assert (first.x, first.y, first.z) == (0.0, 1.0, -2.0)
        assert (first.vx, first.vy) == (0.0, 0.5)
        assert first.yaw == pytest.approx(0.0, abs=1e-6)
        assert first.type_mask == 0b000111000000
        assert [pose.pose.position.x for pose in paths.received()[0].poses] == [1.0, 2.0]
        assert paths.messages[0].header.frame_id == "uav1/map"

    def newest() -> Any:
        return [message for message in peer.heard if message.get_type() == kind][-1]

    eventually(lambda: newest().y == 2.0, "the second point")
    reset = rospy.ServiceProxy("/uav1/mavros/setpoint_trajectory/reset", Trigger)
    assert reset().success
    assert not reset().success


def test_a_planned_path_goes_to_the_vehicle_and_what_it_plans_comes(peer: Peer) -> None:
    path = Path(poses=[PoseStamped(), PoseStamped()])
    path.poses[1].pose.position.x = 3.0
    for pose in path.poses:
        pose.pose.orientation.w = 1.0
    came = ask_by(peer, "trajectory/path", path, "TRAJECTORY_REPRESENTATION_WAYPOINTS")
    assert came.valid_points == 2
    assert (came.pos_x[1], came.pos_y[1]) == (0.0, 3.0)
    assert came.pos_yaw[1] == pytest.approx(math.pi / 2)
    assert math.isnan(came.vel_x[1])
    assert math.isnan(came.pos_x[2])
    with recorder("/uav1/mavros/trajectory/desired", Trajectory) as plans:
        peer.send.send(came)
        plan = plans.received()[0]
    assert plan.point_2.position.x == 3.0
    assert list(plan.point_valid) == [1, 1, 0, 0, 0]
    again = ask_by(peer, "trajectory/generated", plan, "TRAJECTORY_REPRESENTATION_WAYPOINTS")
    assert (again.valid_points, again.pos_y[1]) == (2, 3.0)


def test_a_scan_becomes_distances_clockwise_from_ahead(peer: Peer) -> None:
    scan = LaserScan(angle_min=-math.pi / 2, angle_max=math.pi / 2, range_min=0.1, range_max=10.0)
    scan.angle_increment = math.pi / 180
    scan.ranges = [5.0] * 181
    scan.ranges[0] = 1.0  # to the right
    scan.ranges[180] = math.inf
    came = ask_by(peer, "obstacle/send", scan, "OBSTACLE_DISTANCE")
    assert came.increment_f == pytest.approx(-3.0, abs=1e-4)
    assert came.angle_offset == pytest.approx(89.0, abs=1e-4)
    assert (came.distances[0], came.distances[1], came.distances[60]) == (100, 500, 1001)
    assert came.distances[61] == 65535
    assert (came.min_distance, came.max_distance) == (10, 1000)


def test_companions_speak_as_components_of_their_own(peer: Peer) -> None:
    status = CompanionProcessStatus(state=4, component=196)
    topic = "/uav1/mavros/companion_process/status"
    publisher = rospy.Publisher(topic, CompanionProcessStatus, queue_size=10)
    beat = peer.asked(
        lambda: publisher.publish(status), "HEARTBEAT", lambda m: m.get_srcComponent() == 196
    )
    assert beat.system_status == 4
    publisher.unregister()
    computer = OnboardComputerStatus(component=191, uptime=5, ram_total=7, temperature_board=-3)
    came = ask_by(peer, "onboard_computer/status", computer, "ONBOARD_COMPUTER_STATUS")
    assert came.get_srcComponent() == 191
    assert (came.uptime, came.ram_total, came.temperature_board) == (5, 7, -3)


def test_receivers_and_corrections_go_to_the_vehicle(peer: Peer) -> None:
    fix = GPSINPUT(fix_type=3, lat=634389000, lon=103990000, alt=12.5, satellites_visible=9)
    came = ask_by(peer, "gps_input/gps_input", fix, "GPS_INPUT")
    assert (came.lat, came.lon, came.alt) == (634389000, 103990000, 12.5)
    since = len(peer.heard)
    data = bytes(i % 251 for i in range(400))
    ask_by(peer, "gps_rtk/send_rtcm", RTCM(data=data), "GPS_RTCM_DATA")

    def parts() -> list[Any]:
        return [m for m in peer.heard[since:] if m.get_type() == "GPS_RTCM_DATA"]

    eventually(lambda: len(parts()) >= 3, "the fragments")
    first = parts()[:3]
    assert [part.flags & 0b111 for part in first] == [0b001, 0b011, 0b101]
    assert b"".join(bytes(part.data[: part.len]) for part in first) == data


def test_an_area_is_two_corners(peer: Peer) -> None:
    corners = [Point32(1.0, 2.0, 3.0), Point32(-1.0, -2.0, 0.0)]
    area = PolygonStamped(polygon=Polygon(points=corners))
    came = ask_by(peer, "safety_area/set", area, "SAFETY_SET_ALLOWED_AREA")
    assert (came.p1x, came.p1y, came.p1z) == (2.0, 1.0, -3.0)
    assert (came.p2x, came.p2y, came.p2z) == (-2.0, -1.0, 0.0)


def test_reports_of_the_vehicle_become_topics(peer: Peer) -> None:
    with recorder("/uav1/mavros/rangefinder/rangefinder", Range) as ranges:
        peer.send.rangefinder_send(2.5, 0.0)
        assert ranges.received()[0].range == 2.5
    with recorder("/uav1/mavros/px4flow/raw/optical_flow_rad", OpticalFlowRad) as flows:
        peer.send.optical_flow_rad_send(1, 0, 100, 0.1, 0.2, 0.3, 0.4, 0.5, 2000, 200, 0, 1.5)
        flow = flows.received()[0]
        assert flow.header.frame_id == "uav1/px4flow"
        assert (flow.integrated_x, flow.integrated_y) == pytest.approx((0.1, -0.2))
        assert flow.integrated_zgyro == pytest.approx(-0.5)
    with recorder("/uav1/mavros/esc_info", ESCInfo) as infos:
        peer.send_esc_info((2000, 2500, 3000, 3500))
        escs = infos.received()[0].esc_info
        assert [one.temperature for one in escs] == [20, 25, 30, 35]
        assert [one.error_count for one in escs] == [5, 6, 7, 8]


def test_logs_are_asked_for_and_listed(peer: Peer) -> None:
    ask = rospy.ServiceProxy("/uav1/mavros/log_transfer/raw/log_request_list", LogRequestList)
    came = peer.asked(lambda: ask(start=0, end=9), "LOG_REQUEST_LIST")
    assert (came.target_system, came.end) == (1, 9)
    with recorder("/uav1/mavros/log_transfer/raw/log_entry", LogEntry) as entries:
        peer.send.log_entry_send(3, 1, 3, 1_700_000_000, 4096)
        entry = entries.received()[0]
    assert (entry.id, entry.size, entry.time_utc.secs) == (3, 4096, 1_700_000_000)


def test_checkid_names_who_speaks(peer: Peer, session_ros: Ros) -> None:
    script = str(package("mavros") / "scripts" / "checkid")
    words = [script, "-n", "/uav1/mavros", "--period", "2", "__ns:=/uav1"]
    log = session_ros.call(*words)
    assert "OK. Messages come from 1:1." in log
    assert "  1:1 " in log
    process = session_ros.launch([script, "-n", "/nobody/mavros", "--period", "0.5"])
    assert process.wait() == 1
    assert "NOTE: /nobody/mavros/target_system_id is not set" in process.log
    assert "ERROR. Messages come from 0 addresses, none from 1:1." in process.log


def test_a_time_that_no_stamp_holds_ends_nothing(peer: Peer) -> None:
    with recorder("/uav1/mavros/time_reference", TimeReference) as times:
        peer.send.system_time_send(2**64 - 1, 0)
        peer.send.system_time_send(1_800_000_000_000_000, 0)
        eventually(lambda: bool(times.messages), "a time")
    assert times.messages[0].time_ref.secs == 1_800_000_000


def test_corrections_of_whole_fragments_have_an_empty_last_one(peer: Peer) -> None:
    publisher = rospy.Publisher("/uav1/mavros/gps_rtk/send_rtcm", RTCM, queue_size=1)
    eventually(lambda: publisher.get_num_connections() > 0, "the node listens")
    message = RTCM(data=bytes(360))
    end = peer.asked(
        lambda: publisher.publish(message), "GPS_RTCM_DATA", lambda one: bool(one.len == 0)
    )
    publisher.unregister()
    assert end.flags & 0b111 == 0b101  # fragmented, the third


def test_x_and_y_of_a_command_without_a_place_stay_as_they_are(peer: Peer) -> None:
    rospy.wait_for_service("/uav1/mavros/cmd/command_int")
    call = rospy.ServiceProxy("/uav1/mavros/cmd/command_int", CommandInt)
    asking = threading.Thread(target=lambda: call(command=31000, frame=6, x=5, y=473977420))
    since = len(peer.heard)
    asking.start()

    def came() -> list[Any]:
        return [one for one in peer.heard[since:] if one.get_type() == "COMMAND_INT"]

    eventually(lambda: bool(came()), "the command")
    assert (came()[0].x, came()[0].y) == (5, 473977420)
    peer.send.command_ack_send(31000, 0)
    asking.join()
