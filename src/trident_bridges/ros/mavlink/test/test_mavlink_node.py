# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The node mavlink_vehicle_node as a process, with pymavlink at its ports."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import rospy
from fleet import standing_still, start_fleet
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink
from trident.testing import Process, Ros, eventually, recorder
from trident.testing.mavlink_vehicles import entry
from trident_base.ports import free_port

KEY = bytes(range(32))


def await_node(process: Process) -> None:
    eventually(lambda: "speak MAVLink" in process.log, "the node is up")


@contextmanager
def client(port: int) -> Iterator[Any]:
    link = mavutil.mavlink_connection(f"tcp:127.0.0.1:{port}", source_system=255)
    try:
        yield link
    finally:
        link.close()


@contextmanager
def advertised(topic: str) -> Iterator[rospy.Publisher]:
    """Odometry that the node listens to."""
    publisher = rospy.Publisher(topic, Odometry, queue_size=10)
    try:
        eventually(lambda: publisher.get_num_connections() > 0, "the node listens")
        yield publisher
    finally:
        publisher.unregister()


def ack_of(link: Any, system: int, wait_s: float = 10.0) -> Any:
    """The vehicle's answer to the question which protocol it speaks; None: it has none."""
    number = mavlink.MAV_CMD_REQUEST_PROTOCOL_VERSION
    link.mav.command_long_send(system, 1, number, 0, 1, 0, 0, 0, 0, 0, 0)
    return link.recv_match(type="COMMAND_ACK", blocking=True, timeout=wait_s)


def test_the_router_carries_all_and_each_has_a_port_of_its_own(ros: Ros, tmp_path: Path) -> None:
    boat = entry("usv1", "boat")
    process, fleet = start_fleet(ros, tmp_path, entry("uav1", "quadrotor"), boat)
    await_node(process)
    with client(fleet.router) as link:
        for odometry in ("/uav1/odometry_sensor1/odometry", "/usv1/odometry"):
            send_until_heard(odometry, link)
        for system in (1, 2):
            ack = ack_of(link, system)
            assert ack is not None
            assert ack.get_srcSystem() == system
    with client(boat["tcp_port"]) as link:
        assert ack_of(link, 2).result == mavlink.MAV_RESULT_ACCEPTED
        assert ack_of(link, 1, 0.3) is None


def send_until_heard(topic: str, link: Any) -> None:
    """Odometry until a heartbeat comes, by which the router learns where the vehicle is."""
    message = Odometry()
    message.header.frame_id = "world"
    message.pose.pose.orientation.w = 1.0
    with advertised(topic) as publisher:
        for second in range(1, 4):
            message.header.stamp.secs = 2 * second
            publisher.publish(message)
            assert link.recv_match(type="HEARTBEAT", blocking=True, timeout=10.0) is not None


def test_packets_that_leave_together_are_one_datagram(ros: Ros, tmp_path: Path) -> None:
    process, fleet = start_fleet(ros, tmp_path, entry("uav1", "quadrotor"))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
        station.bind(("127.0.0.1", fleet.ground_station))
        station.settimeout(20.0)
        await_node(process)
        with standing_still("/uav1/odometry_sensor1/odometry"):
            datagrams = [station.recv(65536) for _ in range(20)]
    reader = mavlink.MAVLink(None)
    counts = [len(reader.parse_buffer(datagram) or []) for datagram in datagrams]
    assert min(counts) >= 1  # each is whole
    assert max(counts) > 3
    assert max(map(len, datagrams)) <= 1400
    assert reader.total_receive_errors == 0


def test_a_rover_answers_each_odometry_once(ros: Ros, tmp_path: Path) -> None:
    process, _ = start_fleet(ros, tmp_path, entry("ugv1", "rover"))
    await_node(process)
    message = Odometry()
    message.header.frame_id = "world"
    message.pose.pose.orientation.w = 1.0
    with (
        advertised("/ugv1/odom") as publisher,
        recorder("/ugv1/cmd_vel", Twist) as twists,
    ):
        for index in range(1, 101):
            message.header.stamp.nsecs = index * 1_000_000
            publisher.publish(message)
            eventually(lambda count=index: len(twists.messages) >= count, "an answer")
        assert len(twists.messages) == 100


def test_a_vehicle_with_a_key_hears_its_own_alone(ros: Ros, tmp_path: Path) -> None:
    key = tmp_path / "fleet.key"
    key.touch(mode=0o600)
    key.write_text(KEY.hex())
    drone = entry("uav1", "quadrotor", signing_key_file=str(key))
    process, _ = start_fleet(ros, tmp_path, drone)
    await_node(process)
    with client(drone["tcp_port"]) as stranger:
        assert ack_of(stranger, 1, 0.3) is None
        eventually(lambda: "packet refused" in process.log, "it is named")
    with client(drone["tcp_port"]) as friend:
        friend.setup_signing(KEY, sign_outgoing=True)
        ack = ack_of(friend, 1)
        assert ack.result == mavlink.MAV_RESULT_ACCEPTED
        assert ack.get_signed()


def test_what_two_vehicles_claim_is_one_error(ros: Ros, tmp_path: Path) -> None:
    port = free_port()
    vehicles = [entry(name, "boat", tcp_port=port) for name in ("a", "b")]
    process, _ = start_fleet(ros, tmp_path, *vehicles)
    assert process.wait() == 1
    assert f"'a' and 'b' both have TCP port {port}" in process.log


def test_a_port_that_somebody_has_is_named_with_its_vehicle(ros: Ros, tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        process, _ = start_fleet(ros, tmp_path, entry("usv1", "boat", tcp_port=port))
        assert process.wait() == 1
    assert "vehicle 'usv1'" in process.log
    assert str(port) in process.log
