# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Feeds scans to a running SLAM node at their rate, and measures when map -> odom reflects them.

Run as a process: ``live_feeder LOG --first N --rate HZ --seconds S --node PID``; prints one line
of JSON.
"""

from __future__ import annotations

import argparse
import json
import math
import threading
import time
from itertools import islice
from pathlib import Path

import numpy as np
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from sensor_msgs.msg import LaserScan
from slam_toolbox_msgs.srv import LoopClosure
from tf2_msgs.msg import TFMessage

from trident_benchmarks.procfs import memory_of
from trident_benchmarks.slam.live_drive import BEAMS, RANGE_MAX, Array
from trident_benchmarks.slam.live_waits import waits

_NODE = "/slam_toolbox"
_FORCE_EVERY_S = 1.0
_END_LIMIT_S = 5.0
_RANGES_AT = 9  # words of a ROBOTLASER1 line before its ranges


class Observer:
    """What the node says, and when it was heard."""

    def __init__(self) -> None:
        self.corrections: list[tuple[float, Array]] = []
        self.poses: dict[int, Array] = {}
        rospy.Subscriber("/tf", TFMessage, self._hear_transforms, tcp_nodelay=True)
        rospy.Subscriber(
            f"{_NODE}/pose", PoseWithCovarianceStamped, self._hear_pose, tcp_nodelay=True
        )
        rospy.Subscriber("/map", rospy.AnyMsg, lambda _: None)

    def _hear_transforms(self, message: TFMessage) -> None:
        heard = time.monotonic()
        for one in message.transforms:
            if one.header.frame_id == "map":
                T = one.transform
                self.corrections.append((heard, _pose(T.translation, T.rotation)))

    def _hear_pose(self, message: PoseWithCovarianceStamped) -> None:
        place = message.pose.pose
        self.poses[message.header.stamp.to_nsec()] = _pose(place.position, place.orientation)


def _pose(p: object, q: object) -> Array:
    return np.array([p.x, p.y, 2.0 * math.atan2(q.z, q.w)])  # type: ignore[attr-defined]


def _scan(ranges: Array, stamp: rospy.Time) -> LaserScan:
    message = LaserScan(angle_min=-math.pi, angle_max=math.pi, range_min=0.05)
    message.angle_increment = 2.0 * math.pi / BEAMS
    message.range_max = RANGE_MAX
    message.header.stamp, message.header.frame_id = stamp, "base_footprint"
    message.ranges = ranges.tolist()
    return message


def _transform(pose: Array, stamp: rospy.Time) -> TFMessage:
    message = TransformStamped()
    message.header.stamp, message.header.frame_id = stamp, "odom"
    message.child_frame_id = "base_footprint"
    message.transform.translation.x, message.transform.translation.y = pose[0], pose[1]
    message.transform.rotation.z = math.sin(0.5 * pose[2])
    message.transform.rotation.w = math.cos(0.5 * pose[2])
    return TFMessage([message])


def _read(log: Path, first: int, count: int) -> list[tuple[Array, Array]]:
    """Ranges and odometry of some scans of a log that live_drive wrote."""
    records = []
    with log.open(encoding="ascii") as file:
        for line in islice(file, first, first + count):
            words = line.split()
            ranges = np.array(words[_RANGES_AT : _RANGES_AT + BEAMS], dtype=float)
            place = _RANGES_AT + BEAMS + 1
            records.append((ranges, np.array(words[place : place + 3], dtype=float)))
    return records


def _force_loops(done: threading.Event) -> None:
    rospy.wait_for_service(f"{_NODE}/manual_loop_closure")
    close = rospy.ServiceProxy(f"{_NODE}/manual_loop_closure", LoopClosure)
    while not done.wait(_FORCE_EVERY_S):
        close()


def feed(log: Path, first: int, rate: float, seconds: float) -> list[float]:
    """Publish scans in real time while the graph is optimised over and over; their waits [s]."""
    records = _read(log, first, round(rate * seconds))
    observer = Observer()
    scans = rospy.Publisher("/scan", LaserScan, queue_size=100, tcp_nodelay=True)
    transforms = rospy.Publisher("/tf", TFMessage, queue_size=100, tcp_nodelay=True)
    while scans.get_num_connections() == 0 or transforms.get_num_connections() < 2:
        time.sleep(0.01)
    done = threading.Event()
    forcing = threading.Thread(target=_force_loops, args=(done,))
    forcing.start()
    sent = []
    begin = time.monotonic()
    for index, (ranges, odometry) in enumerate(records):
        time.sleep(max(0.0, begin + index / rate - time.monotonic()))
        stamp = rospy.Time.now()
        transforms.publish(_transform(odometry, stamp))
        message = _scan(ranges, stamp)
        sent.append((stamp.to_nsec(), time.monotonic(), odometry))
        scans.publish(message)
    end = time.monotonic() + _END_LIMIT_S
    while sent[-1][0] not in observer.poses and time.monotonic() < end:
        time.sleep(0.01)
    time.sleep(0.2)  # the last pose is heard before or after its correction
    done.set()
    forcing.join()
    return waits(sent, observer.poses, observer.corrections)


def main() -> None:
    """Entry point of the process."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("log", type=Path)
    parser.add_argument("--first", type=int, required=True)
    parser.add_argument("--rate", type=float, required=True)
    parser.add_argument("--seconds", type=float, required=True)
    parser.add_argument("--node", type=int, required=True, help="its process id")
    options = parser.parse_args()
    rospy.init_node("live_feeder", disable_signals=True)
    found = np.array(feed(options.log, options.first, options.rate, options.seconds)) * 1e3
    result = {
        "count": len(found),
        "median_ms": float(np.median(found)),
        "p99_ms": float(np.percentile(found, 99)),
        "max_ms": float(found.max()),
        "node_rss_mb": memory_of(options.node).rss_mb,
    }
    print(json.dumps(result))


if __name__ == "__main__":
    main()
