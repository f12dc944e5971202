# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A node that is killed loses no more scans than those of the autosave's interval."""

from __future__ import annotations

import json
import math
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from scan_bag import BEAMS, MOUNT_M, START_S, SWEEP_S, path, scan, transform
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from trident.testing import Recorder, Ros, eventually, program, recorder

INTERVAL_S = 0.8
PERIOD_S = 0.1
#: Nodes that run one after the other, each killed after so many poses at least: soon, and later.
LIVES = ((3, "sync"), (15, "sync"), (16, "lifelong"), (25, "lifelong"))
_AHEAD = 20  # scans that are sent before their poses are heard


class Drive:
    """Scans of a drive through the room, sent as fast as a node takes them."""

    def __init__(self) -> None:
        self.truth = path(PERIOD_S * np.arange(sum(count + _AHEAD for count, _ in LIVES)))
        self.next = 0
        self._rng = np.random.default_rng(3)
        self._scans = rospy.Publisher("/scan", LaserScan, queue_size=100)
        self._transforms = rospy.Publisher("/tf", TFMessage, queue_size=100)

    def send(self, count: int, poses: Recorder) -> None:
        """Send scans to a new node until so many of their poses are heard."""
        begun = self.next
        for publisher in (self._scans, self._transforms):
            eventually(lambda p=publisher: p.get_num_connections() > 0, "the node's subscriber")

        def are_heard() -> bool:
            self._send(begun, poses)
            return len(poses.messages) >= count

        eventually(are_heard, f"{count} poses")

    def _send(self, begun: int, poses: Recorder) -> None:
        heard = number(poses.messages[-1]) if poses.messages else begun - 1
        while self.next < min(heard + _AHEAD, len(self.truth)):
            pose = self.truth[self.next]
            stamp = rospy.Time(START_S, round(self.next * PERIOD_S * 1e9))
            message = transform("odom", "base_footprint", stamp, pose)
            mount = np.array([MOUNT_M, 0.0, 0.0])
            message.transforms += transform("base_footprint", "laser", stamp, mount).transforms
            self._transforms.publish(message)
            beams = path(PERIOD_S * self.next + np.linspace(0.0, SWEEP_S, BEAMS))
            self._scans.publish(scan(stamp, beams, self._rng))
            self.next += 1


def number(message: Any) -> int:
    """Which scan a pose belongs to."""
    return round((message.header.stamp.to_sec() - START_S) / PERIOD_S)


def contents(session: Path) -> dict[str, Any]:
    """What a session file holds; it must be whole."""
    words = [program("trident_slam", "slam_session"), str(session)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return dict(json.loads(done.stdout))


def test_a_killed_node_loses_at_most_the_interval(ros: Ros, tmp_path: Path) -> None:
    session = tmp_path / "map.posegraph"
    words = [
        "__name:=slam_toolbox",
        f"_autosave_file:={session}",
        f"_autosave_interval:={INTERVAL_S}",
    ]
    drive = Drive()
    begun = rospy.Time(START_S)  # of this life; what the last one lost is lost
    for count, kind in LIVES:
        if session.exists():
            ros.set_param("/slam_toolbox/map_file_name", str(session.with_suffix("")))
        node = ros.launch([program("slam_toolbox", f"{kind}_slam_toolbox_node"), *words])
        with recorder("/slam_toolbox/pose", PoseWithCovarianceStamped) as poses:
            drive.send(count, poses)
            ros.kill(node)
            heard = poses.messages[-1]
        drive.next = number(heard) + 1
        if not session.exists():
            assert number(heard) < round(INTERVAL_S / PERIOD_S)
            drive.next = 0  # nothing is lost yet: the next node begins again
            continue
        kept_until = contents(session)["last_stamp_ns"]
        lost_ns = heard.header.stamp.to_nsec() - max(kept_until, begun.to_nsec())
        assert lost_ns <= round(INTERVAL_S * 1e9)
        begun = heard.header.stamp
        place = heard.pose.pose
        yaw = 2.0 * math.atan2(place.orientation.z, place.orientation.w)
        start = [place.position.x, place.position.y, yaw]
        ros.set_param("/slam_toolbox/map_start_pose", start)
    found = contents(session)
    # The rest is there, from all lives of the node, and the poses are those of one map.
    lost = number(heard) + 1 - found["scans"]
    assert lost <= len(LIVES) * INTERVAL_S / PERIOD_S
    error = np.array(start[:2]) - (drive.truth[number(heard)][:2] - drive.truth[0][:2])
    assert np.linalg.norm(error) < 0.1
