# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Several vehicles in one process: each has its names, its frames and its link."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import rospy
from geometry_msgs.msg import PoseStamped
from mavros_msgs.srv import StreamRate
from peer import Peer, wait_for_connection
from trident.testing import Ros, program, recorder
from trident_base.ports import free_port

NAMES = ("uav1", "usv1")
WORDS = ["__name:=mavros", "__ns:=/fleet"]


@pytest.fixture
def peers(ros: Ros) -> Iterator[dict[str, Peer]]:
    """A vehicle for each name, all connected to one node."""
    ros.set_param("/fleet/mavros", {"vehicles": list(NAMES), "conn": {"timesync_rate": 0.0}})
    peers = {}
    for name in NAMES:
        own, far = free_port(), free_port()
        ros.set_param(f"/fleet/{name}/mavros/fcu_url", f"udp://:{own}@127.0.0.1:{far}")
        peers[name] = Peer(far, own)
    node = ros.launch([program("mavros", "mavros_node"), *WORDS])
    for name in NAMES:
        wait_for_connection(f"/fleet/{name}/mavros", node)
    yield peers
    for peer in peers.values():
        peer.close()


def test_each_vehicle_has_its_topics_services_and_frames(peers: dict[str, Peer]) -> None:
    uav, usv = (peers[name] for name in NAMES)
    target = PoseStamped()
    target.pose.position.x, target.pose.orientation.w = 3.0, 1.0
    topic = "/fleet/uav1/mavros/setpoint_position/local"
    publisher = rospy.Publisher(topic, PoseStamped, queue_size=10)
    kind = "SET_POSITION_TARGET_LOCAL_NED"
    assert uav.asked(lambda: publisher.publish(target), kind).y == 3.0
    publisher.unregister()

    stream = "/fleet/usv1/mavros/set_stream_rate"
    rospy.wait_for_service(stream, 30.0)
    call = rospy.ServiceProxy(stream, StreamRate)
    usv.asked(lambda: call(stream_id=0, message_rate=7, on_off=True), "REQUEST_DATA_STREAM")
    assert not any(message.get_type() == kind for message in usv.heard)
    assert not any(message.get_type() == "REQUEST_DATA_STREAM" for message in uav.heard)

    with (
        recorder("/fleet/uav1/mavros/local_position/pose", PoseStamped) as of_uav,
        recorder("/fleet/usv1/mavros/local_position/pose", PoseStamped) as of_usv,
    ):
        usv.send.local_position_ned_send(1, 4.0, 5.0, -6.0, 0.0, 0.0, 0.0)
        pose = of_usv.received()[0]
        uav.send.local_position_ned_send(1, 7.0, 8.0, -9.0, 0.0, 0.0, 0.0)
        assert of_uav.received()[0].header.frame_id == "fleet/uav1/map"
        assert len(of_usv.messages) == 1
    assert pose.header.frame_id == "fleet/usv1/map"
    assert (pose.pose.position.x, pose.pose.position.y, pose.pose.position.z) == (5.0, 4.0, 6.0)


def test_two_vehicles_at_one_port_are_one_error_with_both_names(ros: Ros) -> None:
    ros.set_param("/fleet/mavros", {"vehicles": list(NAMES), "fcu_url": "udp://:14540@"})
    process = ros.launch([program("mavros", "mavros_node"), *WORDS])
    assert process.wait() == 1
    expected = "vehicles /fleet/uav1/mavros and /fleet/usv1/mavros have one endpoint"
    assert f"{expected}: 'UDP port 14540'" in process.log
