# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from trident_nav.core.errors import NavError
from trident_nav.core.velocity import STOP, Velocity
from trident_nav.core.waypoints import FollowerConfig, WaypointFollower

CONFIG = FollowerConfig(speed=0.4, turn_rate=1.0, lookahead=0.4, tolerance=0.05, acceleration=0.5)
DT_S = 0.02
Pose = tuple[float, float, float]


def moved(pose: Pose, velocity: Velocity) -> Pose:
    """A unicycle after DT_S, along the exact arc."""
    x, y, yaw = pose
    turn = velocity.angular * DT_S
    middle = yaw + turn / 2
    distance = velocity.linear * DT_S * float(np.sinc(turn / (2 * math.pi)))
    return x + distance * math.cos(middle), y + distance * math.sin(middle), yaw + turn


def drive(
    follower: WaypointFollower, pose: Pose, limit_s: float = 200.0
) -> tuple[list[Pose], list[Velocity]]:
    poses, commands = [pose], []
    for step in range(round(limit_s / DT_S)):
        command = follower.command(step * DT_S, poses[-1])
        if follower.is_done:
            return poses, commands
        commands.append(command)
        poses.append(moved(poses[-1], command))
    return poses, commands


def off_the_lines(poses: list[Pose], corners: list[tuple[float, float]]) -> float:
    """Largest distance of the poses from the lines between corners [m]."""
    points = np.array(poses)[:, :2]
    best = np.full(len(points), np.inf)
    for a, b in zip(np.array(corners[:-1]), np.array(corners[1:]), strict=True):
        t = ((points - a) @ (b - a) / ((b - a) @ (b - a))).clip(0.0, 1.0)
        best = np.minimum(best, np.linalg.norm(points - a - t[:, None] * (b - a), axis=1))
    return float(best.max())


def test_a_square_is_driven_close_to_its_sides_and_to_its_end() -> None:
    corners = [(3.0, 0.0), (3.0, 3.0), (0.0, 3.0), (0.0, 0.0)]
    poses, _ = drive(WaypointFollower(corners, CONFIG), (0.0, 0.0, 0.0))
    assert math.dist(poses[-1][:2], (0.0, 0.0)) <= CONFIG.tolerance
    assert off_the_lines(poses, [(0.0, 0.0), *corners]) < 0.2


def test_it_does_not_exceed_what_it_is_allowed() -> None:
    _, commands = drive(WaypointFollower([(2.0, 1.0), (-1.0, 2.0)], CONFIG), (0.0, 0.0, 0.0))
    speeds = np.array([command.linear for command in commands])
    assert speeds.min() >= 0.0
    assert speeds.max() <= CONFIG.speed
    assert np.diff(speeds).max() <= CONFIG.acceleration * DT_S * (1 + 1e-9)
    assert max(abs(command.angular) for command in commands) <= CONFIG.turn_rate
    assert speeds[-1] < 0.3, "it brakes before it is there"


def test_a_waypoint_behind_is_turned_to_on_the_spot() -> None:
    follower = WaypointFollower([(-2.0, 0.1)], CONFIG)
    first = follower.command(0.0, (0.0, 0.0, 0.0))
    assert first.linear == 0.0
    assert first.angular > 0.0
    poses, _ = drive(WaypointFollower([(-2.0, 0.1)], CONFIG), (0.0, 0.0, 0.0))
    assert math.dist(poses[-1][:2], (-2.0, 0.1)) <= CONFIG.tolerance


def test_pure_pursuit_curvature_is_coulters() -> None:
    follower = WaypointFollower([(10.0, 0.0)], CONFIG)
    follower.command(0.0, (0.0, 0.0, 0.0))
    follower.command(10.0, (2.0, -0.1, 0.0))
    command = follower.command(10.02, (2.0, -0.1, 0.0))
    target = np.array([CONFIG.lookahead, 0.1])
    assert command.angular / command.linear == pytest.approx(2 * 0.1 / (target @ target))


def test_a_loop_never_ends() -> None:
    corners = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)]
    follower = WaypointFollower(corners, replace(CONFIG, loop=True))
    poses, commands = drive(follower, (0.0, 0.0, 0.0), limit_s=120.0)
    assert not follower.is_done
    distance = sum(command.linear for command in commands) * DT_S
    assert distance > 3 * 4.0
    assert off_the_lines(poses, [(0.0, 0.0), *corners]) < 0.25


def test_it_starts_over_when_time_goes_back() -> None:
    follower = WaypointFollower([(1.0, 0.0)], CONFIG)
    follower.command(5.0, (0.99, 0.0, 0.0))
    assert follower.is_done
    assert follower.command(5.1, (0.99, 0.0, 0.0)) == STOP
    follower.command(0.0, (0.0, 0.0, 0.0))
    assert not follower.is_done


@given(
    st.lists(
        st.tuples(st.floats(-4, 4), st.floats(-4, 4)).map(
            lambda p: (round(p[0], 1), round(p[1], 1))
        ),
        min_size=1,
        max_size=5,
    ),
    st.floats(-4, 4),
)
def test_the_last_waypoint_is_reached_from_anywhere(
    corners: list[tuple[float, float]], yaw: float
) -> None:
    follower = WaypointFollower(corners, CONFIG)
    poses, _ = drive(follower, (0.0, 0.0, yaw), limit_s=400.0)
    assert follower.is_done
    assert math.dist(poses[-1][:2], corners[-1]) <= CONFIG.tolerance


@pytest.mark.parametrize(
    ("waypoints", "change", "what"),
    [
        ([], {}, r"waypoints: shape \(0,\)"),
        ([(1.0, 2.0, 3.0)], {}, r"waypoints: shape \(1, 3\); legal: \(n, 2\)"),
        ([(0.0, 0.0), (1.0, math.inf)], {}, r"waypoints\[1\]: \[1.0, inf\]; legal: finite"),
        ([("a", "b")], {}, "waypoints: .* legal: a list of"),
        ([(1.0, 0.0)], {"loop": True}, "waypoints: 1 of them; legal: 2 or more"),
        ([(1.0, 0.0)], {"lookahead": 0.0}, "lookahead: 0 m, legal: 0.05 to 20 m"),
        ([(1.0, 0.0)], {"speed": -1.0}, "speed: -1 m/s"),
    ],
)
def test_bad_input_is_refused(
    waypoints: list[tuple[float, float]], change: dict[str, float], what: str
) -> None:
    with pytest.raises(NavError, match=what):
        WaypointFollower(waypoints, replace(CONFIG, **change))  # type: ignore[arg-type]
