# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sends a robot to random goals with the action of move_base and judges it by the truth.

It cuts the true map of the world, spawns the robot, and starts navigation.launch as a user would.
Parameters: `~world`, `~robot`, `~goals`, `~seed`, `~robot_config` (YAML with the footprint and the
limits), `~map_file` (empty: the true map), `~scan_topic` (empty: the robot's own), `~start`
[x, y, yaw], `~lidar_height` [m], `~out_dir`, `~lockstep` (the world is paused, and waits for
move_base after that).
"""

from __future__ import annotations

import json
import math
import subprocess
import threading
import time
import warnings
import xmlrpc.client
from pathlib import Path
from typing import Any

import actionlib
import numpy as np
import rosgraph
import rospy
from actionlib_msgs.msg import GoalStatus
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal, RecoveryStatus
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder

from trident_benchmarks.datasets.tour_node import stop
from trident_benchmarks.nav.goals import Places, Pose, Tried, Verdict, lower_bound_s
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.pictures.drives import draw_drive
from trident_benchmarks.nav.trials import scan_topic_of
from trident_benchmarks.procfs import process_cpu_s
from trident_ros import init_node

RECORD = "navigation.json"
PICTURE = "drive.png"
_TRACK_STEP_M = 0.05  # between points of the track that is drawn
_MIN_DISTANCE_M = 1.0  # straight to a goal
_SPARE_M = 0.1  # beyond the circumscribed circle that a goal has
_SLOWEST = 10.0  # times the lower bound
_LEAST_LIMIT_S = 60.0  # simulated time for a goal
_START_LIMIT_S = 120.0  # simulated time until move_base is there
_COMMAND_TIMEOUT_S = 0.3  # of robots whose description has such an argument
_POLL_S = 0.02  # wall time
_READERS = {(topic, node) for topic in ("/scan", "/tf") for node in ("/amcl", "/move_base")}
_NODE = "/move_base"
_FARTHEST_M = 1e8  # of a legal position
_LENGTH_TOLERANCE = 0.01  # of a quaternion's length


def plane_pose(message: Odometry) -> Pose | None:
    """Where a robot is on the ground; None: the message has no such pose."""
    place, q = message.pose.pose.position, message.pose.pose.orientation
    length = math.hypot(q.x, q.y, q.z, q.w)
    if not (math.hypot(place.x, place.y) < _FARTHEST_M and abs(length - 1.0) < _LENGTH_TOLERANCE):
        return None
    yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y**2 + q.z**2))
    return place.x, place.y, yaw


class Truth:
    """Where the robot is, and how near to obstacles it came since the last goal."""

    def __init__(self, places: Places) -> None:
        """Listen to the ground truth."""
        self._places = places
        self._lock = threading.Lock()
        self._pose: Pose | None = None
        self._nearest_m = math.inf
        self._track: list[Pose] = []
        rospy.Subscriber("ground_truth/odom", Odometry, self._receive)

    def _receive(self, message: Odometry) -> None:
        pose = plane_pose(message)
        if pose is None:
            rospy.logwarn_throttle(5.0, "navigate: the ground truth has a pose that is not finite")
            return
        with self._lock:
            self._pose = pose
            self._nearest_m = min(self._nearest_m, self._places.clearance(*pose[:2]))
            if not self._track or math.dist(pose[:2], self._track[-1][:2]) >= _TRACK_STEP_M:
                self._track.append(pose)

    def pose(self) -> Pose | None:
        """The newest one."""
        with self._lock:
            return self._pose

    def track(self) -> list[Pose]:
        """Where it has been, every few centimeters."""
        with self._lock:
            return list(self._track)

    def take_nearest(self) -> float:
        """The least distance to an obstacle since the last call [m]."""
        with self._lock:
            nearest, self._nearest_m = self._nearest_m, math.inf
            return nearest


class Drive:
    """The node."""

    def __init__(self) -> None:
        """Read the parameters, cut the map, and listen."""
        self._out = Path(str(rospy.get_param("~out_dir", "")) or "navigation").resolve()
        self._out.mkdir(parents=True, exist_ok=True)
        self._robot = RobotLimits(Path(str(rospy.get_param("~robot_config"))))
        self._random = np.random.default_rng((int(rospy.get_param("~seed", 0)), 7))
        self._children: list[subprocess.Popen[bytes]] = []
        self._verdict = Verdict()
        self._is_lockstep = bool(rospy.get_param("~lockstep", False))
        self._last_goal: Pose | None = None
        places = self._cut_map(str(rospy.get_param("~world")))
        self._places = places
        self._truth = Truth(places)
        rospy.Subscriber("move_base/recovery_status", RecoveryStatus, self._on_recovery)

    def run(self) -> bool:
        """Drive to all goals.

        Returns:
            Whether all were reached without contact.
        """
        try:
            client = self._start()
            begin_s, begin_cpu_s = rospy.get_time(), self._cpu_s()
            for _ in range(int(rospy.get_param("~goals", 20))):
                self._drive_to_one(client)
            elapsed_s = rospy.get_time() - begin_s
            self._verdict.cpu_s_per_s = (self._cpu_s() - begin_cpu_s) / elapsed_s
        finally:
            for child in reversed(self._children):
                stop(child)
        return self._judge()

    def _cut_map(self, world: str) -> Places:
        from trident_sim.occupancy import MapConfig, occupancy_map

        from trident_sim import SimulationWarning, World

        file = package_folder("trident_bringup") / "worlds" / f"{world}.world"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SimulationWarning)
            height = float(rospy.get_param("~lidar_height", 0.15))
            grid = occupancy_map(World(file), MapConfig(heights=(height,)))
        grid.save(self._out / "true_map.pgm")
        self._grid = grid
        return Places(grid, self._robot.inscribed_m, self._robot.circumscribed_m + _SPARE_M)

    def _start(self) -> actionlib.SimpleActionClient:
        x, y, yaw = (float(value) for value in rospy.get_param("~start", [0.0, 0.0, 0.0]))
        robot = rospy.get_param("~robot", "my_nav_robot")
        # Should move_base end, the robot does not drive on.
        self._roslaunch(
            "ground_robot.launch",
            robot=robot,
            x=x,
            y=y,
            yaw=yaw,
            command_timeout=_COMMAND_TIMEOUT_S,
        )
        self._roslaunch(
            "navigation.launch",
            map_file=str(rospy.get_param("~map_file", "")) or self._out / "true_map.yaml",
            robot_config=rospy.get_param("~robot_config"),
            scan_topic=str(rospy.get_param("~scan_topic", "")) or scan_topic_of(str(robot)),
            initial_pose_x=x,
            initial_pose_y=y,
            initial_pose_a=yaw,
            lockstep=self._is_lockstep,
        )
        if self._is_lockstep:
            self._begin_time()
            self._last_goal = (x, y, yaw)
        return self._client()

    def _client(self) -> actionlib.SimpleActionClient:
        """That of move_base, once that is there and the robot's true pose is known."""
        client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        if not client.wait_for_server(rospy.Duration.from_sec(_START_LIMIT_S)):
            raise EvalError("move_base has not come")
        while self._truth.pose() is None and not rospy.is_shutdown():
            time.sleep(_POLL_S)  # of wall time: the world may stand
        return client

    def _begin_time(self) -> None:
        """Lets the world run once all scans reach amcl and move_base, and amcl has its map."""
        has_map = rospy.ServiceProxy("request_nomotion_update", Empty)
        while not rospy.is_shutdown():
            try:
                has_map()
                if readers_of_simulator() >= _READERS:
                    break
            except (rospy.ServiceException, OSError, rosgraph.MasterException):
                pass
            time.sleep(_POLL_S)
        rospy.ServiceProxy("/gazebo/unpause_physics", Empty)()

    def _drive_to_one(self, client: actionlib.SimpleActionClient) -> None:
        start = self._truth.pose()
        assert start is not None
        # What the truth is when a goal has ended depends on which message comes first.
        goal, route = self._places.goal(self._random, self._last_goal or start, _MIN_DISTANCE_M)
        self._last_goal = goal if self._is_lockstep else None
        bound_s = lower_bound_s(route, start, goal, self._robot)
        self._truth.take_nearest()
        begin_s = rospy.get_time()
        client.send_goal(_message(goal))
        limit_s = max(_SLOWEST * bound_s, _LEAST_LIMIT_S)
        if not client.wait_for_result(rospy.Duration.from_sec(limit_s)):
            client.cancel_goal()
        time_s = rospy.get_time() - begin_s
        end = self._truth.pose() or start
        position_error_m = math.dist(end[:2], goal[:2])
        heading_error_rad = abs(math.remainder(end[2] - goal[2], 2.0 * math.pi))
        tried = Tried(
            goal=goal,
            is_reached=client.get_state() == GoalStatus.SUCCEEDED,
            text=client.get_goal_status_text(),
            time_s=time_s,
            bound_s=bound_s,
            position_error_m=position_error_m,
            heading_error_rad=heading_error_rad,
            nearest_m=self._truth.take_nearest(),
        )
        self._verdict.tried.append(tried)
        rospy.loginfo(
            "goal (%.2f, %.2f, %.2f): %s %.1f s (bound %.1f s), off by %.3f m and %.3f rad",
            *goal,
            tried.text or "no result",
            time_s,
            bound_s,
            position_error_m,
            heading_error_rad,
        )

    def _judge(self) -> bool:
        path = self._out / RECORD
        path.write_text(json.dumps(self._verdict.record(), indent=2) + "\n", encoding="utf-8")
        draw_drive(self._out / PICTURE, self._grid, self._truth.track(), self._verdict.tried)
        for line in self._verdict.lines(self._robot.inscribed_m):
            rospy.loginfo("verdict: %s", line)
        return all(
            one.is_reached and one.nearest_m >= self._robot.inscribed_m
            for one in self._verdict.tried
        )

    def _cpu_s(self) -> float:
        """Of the program move_base; NaN while it does not answer."""
        try:
            api = rosgraph.Master(rospy.get_name()).lookupNode(_NODE)
            node: Any = xmlrpc.client.ServerProxy(api)
            return process_cpu_s(int(node.getPid(rospy.get_name())[2]))
        except (OSError, EvalError, rosgraph.MasterException):
            return math.nan

    def _on_recovery(self, _message: RecoveryStatus) -> None:
        self._verdict.recoveries += 1

    def _roslaunch(self, file: str, **arguments: object) -> None:
        words = [f"{name}:={value}" for name, value in arguments.items()]
        command = ["roslaunch", "--disable-title", "trident_bringup", file, *words]
        self._children.append(subprocess.Popen(command, start_new_session=True))


def readers_of_simulator() -> set[tuple[str, str]]:
    """Topic and node of the connections that the simulator has to those who listen to it."""
    api = rosgraph.Master(rospy.get_name()).lookupNode("/gazebo")
    node: Any = xmlrpc.client.ServerProxy(api)
    return {(row[4], row[1]) for row in node.getBusInfo(rospy.get_name())[2] if row[2] == "o"}


def _message(goal: Pose) -> MoveBaseGoal:
    message = MoveBaseGoal()
    message.target_pose.header.frame_id = "map"
    message.target_pose.pose.position.x = goal[0]
    message.target_pose.pose.position.y = goal[1]
    message.target_pose.pose.orientation.z = math.sin(goal[2] / 2.0)
    message.target_pose.pose.orientation.w = math.cos(goal[2] / 2.0)
    return message


def main() -> int:
    """Run the drive.

    Returns:
        Exit code: 1 unless all goals were reached without contact.
    """
    init_node("navigate")
    try:
        return 0 if Drive().run() else 1
    except EvalError as error:
        rospy.logerr("navigate: %s", error)
        return 1
