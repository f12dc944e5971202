# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Client of the planner of trajectories: three platforms clear of each other in space and time."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence

import rospy
from geometry_msgs.msg import PoseStamped

from trident_msgs.msg import TimedPath, TrajectoryLimits
from trident_msgs.srv import (
    OptimizeTrajectories,
    OptimizeTrajectoriesRequest,
    OptimizeTrajectoriesResponse,
)

SERVICE = "optimize_trajectories"
_KINDS = ("uav", "ugv", "usv")

Trajectory = list[PoseStamped]
Service = Callable[[OptimizeTrajectoriesRequest], OptimizeTrajectoriesResponse]


class TrajectoryError(ValueError):
    """Trajectories that are not legal, or a team that has none."""


def _duration_s(poses: Sequence[PoseStamped]) -> float:
    """From the first pose to the last one [s]."""
    return (poses[-1].header.stamp - poses[0].header.stamp).to_sec() if poses else 0.0


def _request(
    teams: Mapping[str, Sequence[PoseStamped]], max_velocity: float, collision_radius: float
) -> OptimizeTrajectoriesRequest:
    """Of platforms by kind that take as long as the slowest of them."""
    duration = max(_duration_s(poses) for poses in teams.values())
    request = OptimizeTrajectoriesRequest()
    for kind, poses in teams.items():
        request.initial.append(timed_path(kind, poses, duration))
        limits = TrajectoryLimits(robot=kind, max_velocity=max_velocity)
        limits.collision_radius = collision_radius
        request.limits.append(limits)
    return request


def timed_path(kind: str, poses: Sequence[PoseStamped], duration: float) -> TimedPath:
    """A platform's first and last pose, at rest, `duration` [s] apart.

    Raises:
        TrajectoryError: there are fewer than two poses, or their times do not grow.
    """
    times = [pose.header.stamp.to_sec() for pose in poses]
    if len(times) < 2:
        raise TrajectoryError(f"{kind}: {len(times)} poses; legal are 2 or more")
    for i, (before, after) in enumerate(itertools.pairwise(times), 1):
        if after <= before:
            raise TrajectoryError(f"{kind}: time of pose {i} is {after:g}; legal is > {before:g}")
    path = TimedPath(header=poses[0].header, robot=kind, kind=kind)
    path.times = [0.0, duration]
    path.poses = [poses[0].pose, poses[-1].pose]
    return path


def optimize(
    uav: Sequence[PoseStamped],
    ugv: Sequence[PoseStamped],
    usv: Sequence[PoseStamped],
    max_velocity: float,
    collision_radius: float,
    service: Service | None = None,
) -> tuple[Trajectory, Trajectory, Trajectory]:
    """Paths of least jerk from each platform's first pose to its last one.

    Args:
        uav: poses with growing stamps; its first and last one count, and so for the others. The
            longest of the three is how long all of them take.
        ugv: the same of the ground robot.
        usv: the same of the vessel.
        max_velocity: of each [m/s].
        collision_radius: of each; centers keep twice that between them [m].
        service: what plans; default the ROS service optimize_trajectories.

    Returns:
        The trajectories of the three. The stamps of the three are equal, pose by pose.

    Raises:
        TrajectoryError: stamps that do not grow, or a team that has no path; the text says why.
    """
    teams = dict(zip(_KINDS, (uav, ugv, usv), strict=True))
    request = _request(teams, max_velocity, collision_radius)
    answer = (service or rospy.ServiceProxy(SERVICE, OptimizeTrajectories))(request)
    if not answer.success:
        raise TrajectoryError(f"{SERVICE}: {answer.message}")
    begin = max(poses[0].header.stamp for poses in teams.values())
    first, second, third = (_stamped(path, begin) for path in answer.result)
    return first, second, third


def _stamped(path: TimedPath, begin: rospy.Time) -> Trajectory:
    out = []
    for time, pose in zip(path.times, path.poses, strict=True):
        stamped = PoseStamped(pose=pose)
        stamped.header.frame_id = path.header.frame_id
        stamped.header.stamp = begin + rospy.Duration.from_sec(time)
        out.append(stamped)
    return out
