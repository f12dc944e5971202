# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives a robot along a tour twice: once mapping, once finding itself in the map.

It starts and stops what a user would: the robot, slam.launch, map_saver's service,
localization.launch; it drives itself, in lockstep with the world. Parameters: `~world`, `~robot`,
`~speed` [m/s], `~mode` of slam.launch, `~out_dir`, and those of a tour: `~start` [x, y, yaw],
`~waypoints` [[x, y], ...] [m] in the world, `~lidar_height` [m].
"""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import threading
from pathlib import Path
from typing import Any

import rospy
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from slam_toolbox_msgs.srv import SaveMap
from std_msgs.msg import String
from std_srvs.srv import Empty
from trident_eval.slam.tour import LOCALIZATION, MAPPING, RECORD, TRUTH, write_tum
from trident_nav.core.errors import NavError
from trident_nav.core.waypoints import FollowerConfig, WaypointFollower

from trident_benchmarks.datasets.checked_buffer import CheckedBuffer
from trident_benchmarks.datasets.scan_poses import Poses, ScanPoses
from trident_benchmarks.datasets.tour_drive import SIMULATOR, LockstepDriver, is_sent
from trident_ros import Refusals, init_node, is_offered, pose_problem, stamp_problem

_ROBOT = "ground_robot.launch"
_MAP, _BASE, _ODOM = "map", "base_footprint", "odom"
_PATIENCE_S = 10.0  # of simulated time that scans and transforms may be apart
_STOP_LIMIT_S = 20.0  # wall time
_DRIVE_LIMIT_S = 1800.0  # simulated time
_STAND_S = 2.0  # of simulated time, in which a node that has started hears its first scans
_LATE_S = 0.5  # of simulated time that the world runs ahead of a transform
_READS = ("/scan", "/tf")
_POLL_S = 0.05
# What calls raise when who was called is not there any more.
_FAILURES = (rospy.ROSException, rospy.ServiceException, tf2_ros.TransformException, OSError)


class TourError(RuntimeError):
    """The tour cannot continue; the text says why."""


def scan_stamp_problem(stamp: rospy.Time, now: rospy.Time) -> str:
    """Why nobody will ever know the robot's place at this stamp, or ""."""
    problem = stamp_problem(stamp)
    if problem or abs((stamp - now).to_sec()) <= _PATIENCE_S:
        return problem
    return (
        f"stamp is {stamp.to_sec():.3f} s, legal: within {_PATIENCE_S:g} s of the newest odometry,"
        f" {now.to_sec():.3f} s"
    )


class Tour:
    """The node."""

    def __init__(self) -> None:
        """Read the parameters and listen."""
        self._out = Path(str(rospy.get_param("~out_dir", "")) or "slam_room").resolve()
        self._out.mkdir(parents=True, exist_ok=True)
        self._start = [float(value) for value in rospy.get_param("~start")]
        self._children: list[subprocess.Popen[bytes]] = []
        self._needed: dict[str, subprocess.Popen[bytes]] = {}  # launch files that must not end
        self._lock = threading.Lock()
        self._estimate: ScanPoses | None = None
        self._truth = Poses()
        self._now = rospy.Time()  # of the newest truth
        self._refusals = Refusals()
        self._has_map = False
        self._buffer = CheckedBuffer(rospy.Duration.from_sec(2 * _PATIENCE_S))
        self._listener = tf2_ros.TransformListener(self._buffer)
        rospy.Subscriber("ground_truth/odom", Odometry, self._on_truth)
        rospy.Subscriber("scan", LaserScan, self._on_scan)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._on_diagnostics)
        self._driver = LockstepDriver(self._check_alive, self._keeps_up)

    def run(self) -> list[str]:
        """Both rounds; returns what went wrong."""
        errors: list[str] = []
        try:
            self._spawn()
            self._map()
            self._localize()
        except TourError as error:
            rospy.logerr("slam_tour: %s", error)
            errors.append(str(error))
        except _FAILURES as error:
            # What was asked is not there any more, and who has ended is the reason for it.
            text = self._ended() or f"{type(error).__name__}: {error}"
            rospy.logerr("slam_tour: %s", text)
            errors.append(text)
        finally:
            for child in reversed(self._children):
                stop(child)
        self._write(errors)
        return errors

    def _spawn(self) -> None:
        x, y, yaw = self._start
        robot = rospy.get_param("~robot", "my_nav_robot")
        self._roslaunch(_ROBOT, robot=robot, x=x, y=y, yaw=yaw)
        self._driver.stand(_STAND_S)

    def _map(self) -> None:
        mapper = self._roslaunch("slam.launch", mode=rospy.get_param("~mode", "sync"))
        service = "/slam_toolbox/save_map"
        self._driver.wait(lambda: is_offered(service), f"slam.launch to offer {service}")
        self._begin_with("/slam_toolbox")
        self._drive(MAPPING)
        rospy.ServiceProxy(service, SaveMap)(String(str(self._out / "map")))
        pose = self._buffer.lookup_transform(_MAP, _BASE, rospy.Time()).transform
        q = pose.rotation
        self._place = (pose.translation.x, pose.translation.y, 2.0 * math.atan2(q.z, q.w))
        self._needed.clear()
        stop(mapper)

    def _localize(self) -> None:
        # What the mapper said is not to be believed any more.
        self._buffer.clear()
        x, y, yaw = self._place
        initial = {"initial_pose_x": x, "initial_pose_y": y, "initial_pose_a": yaw}
        self._roslaunch("localization.launch", map_file=self._out / "map.yaml", **initial)
        self._driver.wait(lambda: self._has_map, "amcl to have its map")
        self._begin_with("/amcl")
        self._drive(LOCALIZATION)
        # The end of the run is where the world stands now.
        rospy.ServiceProxy("/gazebo/pause_physics", Empty)()

    def _begin_with(self, node: str) -> None:
        """Have a node that has started hear the same scans in each run, and find its place."""
        self._driver.wait(lambda: is_sent(SIMULATOR, _READS, node), f"{node} to listen")
        # Its first transforms are needed, too: without them the first scans have no pose.
        me = rospy.get_name()
        self._driver.wait(lambda: is_sent(node, ("/tf",), me), f"the transforms of {node}")
        self._driver.stand(_STAND_S)
        self._driver.wait(self._knows_place, f"{_MAP} -> {_ODOM} of {node}")

    def _check_alive(self) -> None:
        if rospy.is_shutdown():
            raise TourError("interrupted")
        if (ended := self._ended()) is not None:
            raise TourError(ended)

    def _knows_place(self) -> bool:
        return bool(self._buffer.can_transform(_MAP, _ODOM, rospy.Time()))

    def _drive(self, part: str) -> None:
        """One round; the estimates at its scans are written when it is over."""
        estimate = ScanPoses(self._place_at)
        with self._lock:
            self._estimate = estimate
        places = rospy.get_param("~waypoints")
        speed = float(rospy.get_param("~speed", 0.5))
        try:
            # It steers by the truth, so that the tour is the same whatever odometry says.
            follower = WaypointFollower(places, FollowerConfig(speed=speed))
        except NavError as error:
            raise TourError(f"{part}: {error}") from error
        if not self._driver.drive(follower, _DRIVE_LIMIT_S):
            raise TourError(f"{part}: the tour did not come to its end")
        self._driver.wait(self._has_all_transforms, "the last transforms")
        with self._lock:
            self._estimate = None
        if not len(estimate.poses):
            raise TourError(f"{part}: {_MAP} -> {_BASE} was never known")
        write_tum(self._out / f"{part}.tum", estimate.poses.trajectory())
        rospy.loginfo("slam_tour: %s: %d scans", part, len(estimate.poses))

    def _on_truth(self, message: Odometry) -> None:
        pose = message.pose.pose
        if pose_problem(pose) or stamp_problem(message.header.stamp):
            return  # the driver hears it, too, and reports it
        self._now = message.header.stamp
        self._truth.add(message.header.stamp, pose.position, pose.orientation)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            if status.name.endswith("amcl: Standard deviation"):
                self._has_map = status.message != "no map yet"

    def _on_scan(self, message: LaserScan) -> None:
        problem = scan_stamp_problem(message.header.stamp, self._now)
        if problem:
            self._refusals.note("scan refused", f"scan refused: {problem}")
            return
        with self._lock:
            if self._estimate is not None:
                self._estimate.add(message.header.stamp)

    def _keeps_up(self) -> bool:
        """Whether the poses at all scans but the newest are known."""
        with self._lock:
            return self._estimate is None or self._estimate.lag_s() <= _LATE_S

    def _has_all_transforms(self) -> bool:
        with self._lock:
            return self._estimate is None or self._estimate.is_complete()

    def _place_at(self, stamp: rospy.Time) -> Any:
        """The transform map -> base at a stamp, or None."""
        try:
            return self._buffer.lookup_transform(_MAP, _BASE, stamp).transform
        except tf2_ros.TransformException:
            return None

    def _write(self, errors: list[str]) -> None:
        record = {
            "world": rospy.get_param("~world"),
            "robot": rospy.get_param("~robot", "my_nav_robot"),
            "start": self._start,
            "lidar_height": float(rospy.get_param("~lidar_height")),
            "errors": errors,
        }
        if len(self._truth):
            write_tum(self._out / f"{TRUTH}.tum", self._truth.trajectory())
        path = self._out / RECORD
        path.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")
        rospy.loginfo("slam_tour: %s", self._out)

    def _roslaunch(self, file: str, **arguments: object) -> subprocess.Popen[bytes]:
        words = [f"{name}:={value}" for name, value in arguments.items()]
        child = self._child(["roslaunch", "--disable-title", "trident_bringup", file, *words])
        if file != _ROBOT:
            self._needed[file] = child
        return child

    def _ended(self) -> str | None:
        """Which of the launch files has ended that must not, in words, or None."""
        gone = [file for file, child in self._needed.items() if child.poll() is not None]
        return f"{gone[0]} has ended: its nodes have died" if gone else None

    def _child(self, command: list[str]) -> subprocess.Popen[bytes]:
        child = subprocess.Popen(command, start_new_session=True)
        self._children.append(child)
        return child


def stop(child: subprocess.Popen[bytes]) -> None:
    """End a child as Ctrl-C does, and by force if that takes too long."""
    if child.poll() is not None:
        return
    os.killpg(child.pid, signal.SIGINT)
    try:
        child.wait(_STOP_LIMIT_S)
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()


def main() -> int:
    """Run the tour.

    Returns:
        Exit code: 1 if it could not be driven to its end.
    """
    init_node("slam_tour")
    return 1 if Tour().run() else 0
