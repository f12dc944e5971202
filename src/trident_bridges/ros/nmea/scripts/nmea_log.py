#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Writes what an NMEA 0183 server sends to a file of the run, for its verdict.

Parameters: ~host, ~port; ~out_dir, without which nothing is written; ~vehicle, the name of the
model; ~antenna, its place in the model's frame [m]; ~origin, latitude and longitude [deg] and
height above the ellipsoid [m] of the world's origin; ~unpause, whether a paused world runs once it
is connected. Writes <vehicle>.nmea, as it came, and
<vehicle>.nmea.json.
"""

from __future__ import annotations

import json
import socket
import sys
from pathlib import Path
from typing import Any

import rospy
from std_srvs.srv import Empty

_RETRY_S = 0.2  # wall time
_BLOCK = 1 << 16


def connect(host: str, port: int) -> socket.socket | None:
    """A connection, as soon as the server is there; None when ROS is shut down before."""
    while not rospy.is_shutdown():
        try:
            connection = socket.create_connection((host, port), timeout=_RETRY_S)
        except OSError:
            rospy.rostime.wallsleep(_RETRY_S)
            continue
        return connection
    return None


def copy(connection: socket.socket, path: Path) -> None:
    """Appends what comes until the server or ROS ends."""
    with connection, path.open("ab", buffering=0) as log:
        while not rospy.is_shutdown():
            try:
                block = connection.recv(_BLOCK)
            except TimeoutError:
                continue
            except OSError:  # reset: the server has died
                return
            if not block:
                return
            log.write(block)


def unpause() -> None:
    """Lets the world run, as soon as it is there."""
    name = "/gazebo/unpause_physics"
    rospy.wait_for_service(name)
    rospy.ServiceProxy(name, Empty)()


def main() -> int:
    """Runs the node until the server ends; an exit code."""
    rospy.init_node("nmea_log")
    folder = str(rospy.get_param("~out_dir", ""))
    vehicle = str(rospy.get_param("~vehicle"))
    about: dict[str, Any] = {
        "vehicle": vehicle,
        "antenna": rospy.get_param("~antenna", [0.0, 0.0, 0.0]),
        "origin": rospy.get_param("~origin"),
        "utc_start": rospy.get_param("/gazebo/utc_start", "2026-01-01T00:00:00Z"),
    }
    connection = connect(str(rospy.get_param("~host", "127.0.0.1")), int(rospy.get_param("~port")))
    if connection is None:
        return 0
    try:
        if rospy.get_param("~unpause", False):
            unpause()
    except (rospy.ROSException, rospy.ServiceException) as error:
        rospy.logfatal("%s", error)
        return 1
    path = Path(folder) / f"{vehicle}.nmea" if folder else Path("/dev/null")
    if folder:
        path.with_suffix(".nmea.json").write_text(json.dumps(about), encoding="utf-8")
    copy(connection, path)
    rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(main())
