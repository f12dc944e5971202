# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The client of the planner of trajectories asks for the right thing and aligns what comes."""

from __future__ import annotations

import pytest
import rospy
from geometry_msgs.msg import PoseStamped
from trident_fleet.nodes.trajectories import TrajectoryError, optimize

from trident_msgs.msg import TimedPath
from trident_msgs.srv import OptimizeTrajectoriesRequest, OptimizeTrajectoriesResponse


def _poses(*times: float) -> list[PoseStamped]:
    out = []
    for time in times:
        pose = PoseStamped()
        pose.header.stamp = rospy.Time.from_sec(time)
        pose.header.frame_id = "earth"
        pose.pose.position.x = time
        out.append(pose)
    return out


def _straight(request: OptimizeTrajectoriesRequest) -> OptimizeTrajectoriesResponse:
    answer = OptimizeTrajectoriesResponse(success=True)
    for path in request.initial:
        answer.result.append(TimedPath(header=path.header, times=path.times, poses=path.poses))
    return answer


def test_three_trajectories_have_the_same_stamps_and_the_longest_duration() -> None:
    uav, ugv, usv = optimize(
        _poses(1.0, 5.0), _poses(1.0, 9.0), _poses(2.0, 3.0, 4.0), 2.0, 0.5, _straight
    )
    stamps = [[pose.header.stamp.to_nsec() for pose in path] for path in (uav, ugv, usv)]
    assert stamps[0] == stamps[1] == stamps[2] == [2_000_000_000, 10_000_000_000]
    assert usv[-1].pose.position.x == 4.0
    assert uav[0].header.frame_id == "earth"


def test_limits_go_to_each_platform_under_its_kind() -> None:
    asked = []

    def note(request: OptimizeTrajectoriesRequest) -> OptimizeTrajectoriesResponse:
        asked.append(request)
        return _straight(request)

    optimize(_poses(0.0, 1.0), _poses(0.0, 1.0), _poses(0.0, 1.0), 2.5, 0.7, note)
    assert [path.kind for path in asked[0].initial] == ["uav", "ugv", "usv"]
    assert {limits.max_velocity for limits in asked[0].limits} == {2.5}
    assert {limits.collision_radius for limits in asked[0].limits} == {0.7}


@pytest.mark.parametrize(
    ("ugv", "text"),
    [
        (_poses(1.0), "ugv: 1 poses; legal are 2 or more"),
        (_poses(1.0, 1.0), "ugv: time of pose 1 is 1; legal is > 1"),
    ],
)
def test_stamps_that_do_not_grow_are_refused(ugv: list[PoseStamped], text: str) -> None:
    with pytest.raises(TrajectoryError, match=text):
        optimize(_poses(0.0, 1.0), ugv, _poses(0.0, 1.0), 2.0, 0.5, _straight)


def test_a_team_without_a_solution_is_an_error_that_says_why() -> None:
    def refuse(_: OptimizeTrajectoriesRequest) -> OptimizeTrajectoriesResponse:
        return OptimizeTrajectoriesResponse(success=False, message="'uav' at 2 s: max_velocity")

    with pytest.raises(TrajectoryError, match="'uav' at 2 s: max_velocity"):
        optimize(_poses(0.0, 1.0), _poses(0.0, 1.0), _poses(0.0, 1.0), 2.0, 0.5, refuse)
