# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A vehicle that speaks MAVLink over UDP, and mavros_node in front of it."""

from __future__ import annotations

from typing import Any

import rospy
from mavros_msgs.msg import State
from trident.testing import Recorder, Ros, eventually, program
from trident_base.ports import free_port


class Vehicle:
    """A vehicle and its mavros_node, below /mavros."""

    def __init__(
        self, ros: Ros, kind: str = "px4", battery: float = 0.9, launch_file: str = ""
    ) -> None:
        """Start both.

        Args:
            ros: the master.
            kind: px4 or ardupilot.
            battery: filling, 0 to 1.
            launch_file: of mavros that starts the node; empty: without one.
        """
        own, far = free_port(), free_port()
        self.fcu_url = f"udp://:{own}@127.0.0.1:{far}"
        vehicle = ros.launch(
            [program("mavros", "mavros_udp_vehicle"), kind, f"udp://:{far}@:{own}", str(battery)]
        )
        eventually(lambda: "the vehicle is up" in vehicle.log, "the vehicle")
        if launch_file:
            url = f"fcu_url:={self.fcu_url}"
            self.node = ros.launch(["roslaunch", "--disable-title", "mavros", launch_file, url])
        else:
            ros.set_param("/mavros/fcu_url", self.fcu_url)
            self.node = ros.launch([program("mavros", "mavros_node"), "__name:=mavros"])
        eventually(lambda: "mavros: " in self.node.log, "the node")
        self.states = Recorder("/mavros/state", State).connected()

    @property
    def state(self) -> State:
        """The newest one."""
        return self.states.received()[-1]

    def connected(self) -> Vehicle:
        """Return when HEARTBEATs come."""
        eventually(lambda: bool(self.state.connected), "the connection")
        return self

    def call(self, name: str, service: Any, **request: Any) -> Any:
        """The answer of a service below /mavros."""
        rospy.wait_for_service(f"/mavros/{name}", 30.0)
        return rospy.ServiceProxy(f"/mavros/{name}", service)(**request)

    def close(self) -> None:
        """Unsubscribe."""
        self.states.close()
