# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes of mavros under hostile messages; what they send to the vehicle comes back to them."""

from __future__ import annotations

import struct

import pytest
import rospy
from geometry_msgs.msg import PoseStamped
from hostile import Asked, answers_on, started, withstands
from mavros_msgs.msg import Mavlink
from pymavlink.dialects.v20 import common
from trident.testing import Ros, program
from trident_base.ports import free_port

#: Services whose answer is the vehicle's, for which they would wait for seconds each.
ASK_THE_VEHICLE = (
    *(f"/mavros/{group}/*" for group in ("cmd", "mission", "geofence", "rallypoint", "param")),
    *(f"/mavros/{group}/*" for group in ("ftp", "log_transfer", "home_position")),
    *(f"/mavros/{name}" for name in ("set_*", "vehicle_info_get")),
)


def echo_url() -> str:
    """A socket that sends to itself."""
    port = free_port()
    return f"udp://127.0.0.1:{port}@127.0.0.1:{port}"


def heartbeat() -> Mavlink:
    """Of a quadrotor, as a packet in a message."""
    link = common.MAVLink(None, srcSystem=1, srcComponent=1)
    packet = common.MAVLink_heartbeat_message(2, 12, 81, 0, 3, 3)
    frame = packet.pack(link)
    size = frame[1]
    payload = frame[10 : 10 + size]
    words = struct.unpack("<2Q", payload.ljust(16, b"\0"))
    return Mavlink(
        header=rospy.Header(stamp=rospy.Time.now()),
        framing_status=Mavlink.FRAMING_OK,
        magic=Mavlink.MAVLINK_V20,
        len=size,
        sysid=1,
        compid=1,
        checksum=struct.unpack_from("<H", frame, 10 + size)[0],
        payload64=list(words),
    )


def place() -> PoseStamped:
    message = PoseStamped()
    message.header.stamp = rospy.Time.now()
    message.pose.position.z, message.pose.orientation.w = 2.0, 1.0
    return message


@pytest.mark.fuzzes("mavros/mavros_node")
def test_mavros_node(ros: Ros) -> None:
    ros.set_param("/mavros", {"fcu_url": echo_url(), "gcs_url": ""})
    command = [program("mavros", "mavros_node"), "__name:=mavros"]
    process = started(ros, "/mavros", command)
    target = Asked("/mavros/setpoint_position/local", place, "/mavlink/from", Mavlink)
    examples = {target.topic: place()}
    withstands(process, "/mavros", target.is_answered, examples, target.send, ASK_THE_VEHICLE)
    target.close()


@pytest.mark.fuzzes("mavros/gcs_bridge")
def test_gcs_bridge(ros: Ros) -> None:
    ros.set_param("/bridge", {"gcs_url": echo_url()})
    process = started(ros, "/bridge", [program("mavros", "gcs_bridge"), "__name:=bridge"])
    answers_on(process, "/bridge", Asked("/mavlink/from", heartbeat, "/mavlink/to", Mavlink))
