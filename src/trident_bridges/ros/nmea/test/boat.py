# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Instruments of a boat, the node that sends what they say, and a client of it."""

from __future__ import annotations

import math
import socket
from collections.abc import Callable

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import NavSatFix, Range
from std_msgs.msg import Float64
from trident.testing import Ros, eventually, program
from trident_base.ports import free_port

from trident_msgs.msg import GnssStatus, WindReading

LATITUDE_DEG = 63.4389
LONGITUDE_DEG = 10.399


def with_checksum(text: str) -> str:
    """The sentence as it is sent."""
    checksum = 0
    for character in text[1:]:
        checksum ^= ord(character)
    return f"{text}*{checksum:02X}\r\n"


class Boat:
    """Publishes what a boat's instruments measure; RTK fixed, 2 m/s to the east."""

    def __init__(self) -> None:
        self.fix = rospy.Publisher("fix", NavSatFix, queue_size=10)
        self.status = rospy.Publisher("gnss_status", GnssStatus, queue_size=10)
        self.odometry = rospy.Publisher("odometry", Odometry, queue_size=10)
        self.wind = rospy.Publisher("wind_reading", WindReading, queue_size=10)
        self.depth = rospy.Publisher("depth", Range, queue_size=10)
        self.speed = rospy.Publisher("speed_through_water", Float64, queue_size=10)
        self._all = (self.fix, self.status, self.odometry, self.wind, self.depth, self.speed)

    def is_heard(self) -> bool:
        """Whether somebody listens to all of it."""
        return all(publisher.get_num_connections() > 0 for publisher in self._all)

    def publish(self, at_s: float, latitude_deg: float = LATITUDE_DEG) -> None:
        """All of it once, stamped `at_s`."""
        stamp = rospy.Time.from_sec(at_s)
        odometry = Odometry()
        odometry.header.stamp = stamp
        odometry.pose.pose.orientation.w = 1.0
        odometry.twist.twist.linear.x = 2.0
        self.odometry.publish(odometry)
        fix = NavSatFix(latitude=latitude_deg, longitude=LONGITUDE_DEG, altitude=41.0)
        fix.header.stamp = stamp
        self.fix.publish(fix)
        status = GnssStatus(
            fix_type=GnssStatus.FIXED,
            horizontal_stddev=0.01,
            vertical_stddev=0.02,
            satellites=9,
            geoid_separation=39.5,
        )
        status.header.stamp = stamp
        self.status.publish(status)
        wind = WindReading(speed=5.0, angle=math.pi / 2)
        wind.header.stamp = stamp
        self.wind.publish(wind)
        depth = Range(range=4.5, max_range=100.0)
        depth.header.stamp = stamp
        self.depth.publish(depth)
        self.speed.publish(Float64(1.9))

    def close(self) -> None:
        for publisher in self._all:
            publisher.unregister()


class Client:
    """A TCP client that keeps what it reads."""

    def __init__(self, port: int) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=10.0)
        self._socket.setblocking(False)
        self.text = ""

    def read(self) -> str:
        """All that has come since the beginning."""
        try:
            while block := self._socket.recv(65536):
                self.text += block.decode("ascii")
        except BlockingIOError:
            pass
        return self.text

    def lines(self, kind: str) -> list[str]:
        """The whole sentences of a type."""
        whole = self.read().rpartition("\r\n")[0]
        return [line for line in whole.split("\r\n") if line[3:6] == kind]

    def send(self, text: str) -> None:
        self._socket.sendall(text.encode("latin1"))

    def close(self) -> None:
        self._socket.close()


def start_node(ros: Ros, url: str, name: str = "nmea", **params: object) -> None:
    """The node nmea_node with one link, whose topics of what it hears are below its name."""
    ros.set_param(f"/{name}/links", [{"url": url}])
    for key, value in params.items():
        ros.set_param(f"/{name}/{key}", value)
    process = ros.launch(
        [program("trident_bridges", "nmea_node"), f"__name:={name}", f"nmea:={name}"], name=name
    )
    eventually(lambda: "sends and listens" in process.log, "the node is up")


def start_server(ros: Ros, name: str = "nmea", **params: object) -> int:
    """The same with a TCP server, whose port this is."""
    port = free_port()
    start_node(ros, f"tcp-l://:{port}", name, **params)
    return port


def sailing(boat: Boat, condition: Callable[[], bool], begin_s: float = 10.0) -> Callable[[], bool]:
    """The condition, before which the instruments have measured again, 0.2 s later."""
    at_s = [begin_s]
    eventually(boat.is_heard, "the node's subscriptions")

    def sail() -> bool:
        at_s[0] += 0.2
        boat.publish(at_s[0])
        return condition()

    return sail
