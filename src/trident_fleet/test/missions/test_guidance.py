# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Guidance of vehicles that have mass: limits are kept, and everything that is to be passed is."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from massive import Wheels
from trident_fleet.core.missions.guidance import (
    AirLimits,
    AirReference,
    GroundLimits,
    Unstick,
    allowed_speed,
    point_ahead,
    wheels_velocity,
)
from trident_fleet.core.missions.guided import GuidedVehicle, Motion, Reach
from trident_fleet.core.missions.room import Room
from trident_fleet.core.missions.routes import Routes, shortened
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.search.area import Lattice, SearchArea

LIMITS = AirLimits()
REACH = Reach(corner_m=2.0, end_m=1.0, stop_m=0.0)
PLACES = st.lists(st.tuples(st.floats(-80.0, 80.0), st.floats(-80.0, 80.0)), min_size=1, max_size=4)


def at(x: float, y: float, speed_m_s: float = 0.0, height_m: float = 0.0) -> Motion:
    return Motion((x, y), height_m, 0.0, speed_m_s)


def test_corners_are_left_behind_when_they_are_passed_near_or_abreast() -> None:
    vehicle = GuidedVehicle((0.0, 0.0), REACH)
    vehicle.follow([(10.0, 0.0), (10.0, 10.0), (0.0, 10.0)])
    vehicle.measured(at(7.0, 0.0))
    assert next(iter(vehicle.path_left)) == (10.0, 0.0)
    vehicle.measured(at(8.5, 0.0))
    assert vehicle.line == [(10.0, 0.0), (10.0, 10.0), (0.0, 10.0)], "1.5 m are near"
    vehicle.measured(at(15.0, 10.5))
    assert list(vehicle.path_left) == [(0.0, 10.0)], "abreast of it, 5 m aside"
    vehicle.measured(at(1.5, 10.0))
    assert vehicle.path_left, "the end is not only passed"
    vehicle.measured(at(0.5, 10.0))
    assert not vehicle.path_left
    assert vehicle.line == [(0.0, 10.0)], "it keeps to where the path ended"
    assert vehicle.path_m == pytest.approx(7.0 + 1.5 + math.hypot(6.5, 10.5) + 13.51 + 1.0, abs=0.1)


def test_a_halt_keeps_to_the_end_of_the_path_if_that_is_near() -> None:
    vehicle = GuidedVehicle((0.0, 0.0), REACH)
    vehicle.follow([(50.0, 0.0)])
    vehicle.measured(at(48.5, 0.0))
    vehicle.halt()
    assert vehicle.keeps == (50.0, 0.0)
    vehicle.follow([(90.0, 0.0)])
    vehicle.measured(at(60.0, 0.0))
    vehicle.halt()
    assert vehicle.keeps == (60.0, 0.0)
    version = vehicle.version
    vehicle.halt()
    assert vehicle.version == version


def test_a_multirotor_looks_only_from_where_it_sees() -> None:
    vehicle = GuidedVehicle((0.0, 0.0), REACH, looks_from_m=20.0)
    assert not vehicle.looks
    vehicle.measured(at(0.0, 0.0, height_m=21.0))
    assert vehicle.looks


def test_the_point_ahead_turns_around_corners_and_stops_at_the_end() -> None:
    line = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]
    assert point_ahead(line, (4.0, 1.0), 3.0) == pytest.approx((7.0, 0.0))
    assert point_ahead(line, (9.0, -1.0), 3.0) == pytest.approx((10.0, 2.0))
    assert point_ahead(line, (9.0, -1.0), 30.0) == (10.0, 10.0)
    assert point_ahead([(3.0, 3.0)], (0.0, 0.0), 1.0) == (3.0, 3.0)


def test_speed_is_what_braking_allows() -> None:
    corners = [(100.0, 0.0), (100.0, 50.0)]
    assert allowed_speed((0.0, 0.0), corners, 8.0, 2.0, 5.0) == 8.0
    at_corner = allowed_speed((95.0, 0.0), corners, 8.0, 2.0, 5.0)
    assert at_corner == pytest.approx(math.sqrt(2.0 * 5.0)), "an arc of 5 m, by 2 m/s^2"
    near_end = allowed_speed((100.0, 49.0), corners[1:], 8.0, 2.0, 5.0)
    assert near_end == pytest.approx(math.sqrt(2.0 * 2.0 * 1.0))


@settings(max_examples=8, deadline=None)
@given(PLACES)
def test_a_reference_in_the_air_keeps_its_limits_and_arrives(path: list[Place]) -> None:
    vehicle = GuidedVehicle((0.0, 0.0), Reach(7.0, 3.0, 0.0))
    reference = AirReference(np.array([0.0, 0.0, 1.5]), LIMITS)
    vehicle.follow(path)
    before = np.array([0.0, 0.0, 1.5])
    for _ in range(2400):
        if not vehicle.path_left:
            break
        position, velocity, acceleration = reference.advance(vehicle.line, 25.0, False, 5)
        assert np.linalg.norm(acceleration, axis=1).max() <= LIMITS.acceleration_m_s2 + 1e-9
        assert np.hypot(velocity[:, 0], velocity[:, 1]).max() <= LIMITS.speed_m_s + 0.7
        steps = np.diff(np.vstack([before, position]), axis=0)
        assert np.linalg.norm(steps, axis=1).max() <= 0.2, "no jumps"
        before = position[-1]
        x, y, z = position[-1]
        vehicle.measured(Motion((x, y), z, 0.0, float(np.hypot(*velocity[-1, :2]))))
    assert not vehicle.path_left, "within four minutes"
    for _ in range(120):
        reference.advance(vehicle.line, 25.0, False, 5)
    assert math.dist(tuple(reference.position[:2]), path[-1]) < 0.2
    assert float(np.linalg.norm(reference.velocity)) < 0.2


def test_it_climbs_before_it_leaves_and_lands_where_its_path_ends() -> None:
    reference = AirReference(np.array([0.0, 0.0, 1.5]), LIMITS)
    for _ in range(10):
        reference.advance([(0.0, 0.0), (50.0, 0.0)], 25.0, False, 5)
    assert reference.position[0] == 0.0
    assert reference.position[2] > 1.5
    for _ in range(300):
        reference.advance([(0.0, 0.0)], 25.0, True, 5)
    assert reference.position == pytest.approx([0.0, 0.0, 1.5], abs=0.05)


def driven(path: list[Place], yaw_rad: float, limits: GroundLimits) -> tuple[GuidedVehicle, float]:
    """A robot on wheels after its path, and how far it was from its lines at most [m]."""
    vehicle = GuidedVehicle((0.0, 0.0), Reach(0.8, 1.0, 1.6))
    vehicle.measured(Motion((0.0, 0.0), 0.0, yaw_rad, 0.0))
    vehicle.follow(path)
    wheels, far = Wheels(), 0.0
    for _ in range(1200):
        wanted = wheels_velocity(vehicle.motion, vehicle.line, limits)
        assert 0.0 <= wanted[0] <= limits.speed_m_s
        assert abs(wanted[1]) <= limits.turn_rad_s
        vehicle.measured(wheels.driven(vehicle.motion, wanted))
        there = vehicle.place
        legs = itertools.pairwise([(0.0, 0.0), *path])
        far = max(far, min(_off(there, begin, end) for begin, end in legs))
    return vehicle, far


def _off(place: Place, begin: Place, end: Place) -> float:
    along = np.subtract(end, begin)
    share = float(np.dot(np.subtract(place, begin), along) / max(float(np.dot(along, along)), 1e-9))
    nearest = np.add(begin, min(max(share, 0.0), 1.0) * along)
    return math.dist(place, (float(nearest[0]), float(nearest[1])))


@pytest.mark.parametrize("yaw_rad", [0.0, 1.5, 3.0, -2.2])
def test_wheels_follow_their_path_whatever_they_head_for_at_first(yaw_rad: float) -> None:
    path = [(20.0, 0.0), (20.0, 10.0), (5.0, 12.0), (5.0, 30.0)]
    vehicle, far = driven(path, yaw_rad, GroundLimits())
    assert math.dist(vehicle.place, path[-1]) < 0.4
    assert vehicle.motion.speed_m_s == 0.0
    assert far < 1.0


def walled() -> SearchArea:
    """Water with a mole that ends in it."""
    lattice = Lattice(40, 40, 2.0, (-40.0, -40.0))
    water = np.ones(lattice.shape, dtype=bool)
    water[20:, 19:21] = False
    return SearchArea(lattice, ~water, ~water, ~water, water, np.zeros(lattice.shape))


def test_paths_keep_away_from_what_stands_there_and_keep_their_ends() -> None:
    room = Room(walled(), "water", 3.5)
    start, goal = (-20.0, 10.0), (20.0, 10.0)
    tight = Routes(walled(), "water").path(start, goal)
    path = [start, *room.widened(start, tight)]
    assert path[-1] == goal
    assert len(path) <= 12
    along = np.array(
        [
            np.add(one, share * np.subtract(other, one))
            for one, other in itertools.pairwise(path)
            for share in np.linspace(0.0, 1.0, 30)
        ]
    )
    assert room.away_m(along).min() >= 3.0
    assert room.away_m(np.array(tight)).min() < 2.0, "what is tight is near"
    assert room.widened(start, [(-30.0, -30.0)]) == [(-30.0, -30.0)]
    assert room.widened(start, []) == []


def test_who_lies_there_is_passed_at_a_distance() -> None:
    room = Room(walled(), "water", 1.0)
    start, person = (-30.0, -20.0), (-28.8, -20.0)
    path = [start, *room.widened(start, [(-10.0, -20.0)], [person])]
    assert path[-1] == (-10.0, -20.0)
    assert min(math.dist(place, person) for place in path[1:]) > 1.3


def test_what_is_stuck_drives_back_and_then_ahead() -> None:
    unstick, ahead, still = Unstick(), (0.5, 0.1), at(0.0, 0.0)
    assert [unstick.velocity(ahead, at(0.0, 0.0, 0.4)) for _ in range(60)] == [ahead] * 60
    said = [unstick.velocity(ahead, still) for _ in range(90)]
    assert said[:20] == [ahead] * 20
    assert said[20:45] == [(-0.5, 0.0)] * 25
    assert said[45:65] == [ahead] * 20
    assert said[65:90] == [(0.5, 0.0)] * 25
    turning = [Motion((0.0, 0.0), 0.0, 0.05 * index, 0.0) for index in range(60)]
    assert [unstick.velocity((0.0, 1.0), motion) for motion in turning] == [(0.0, 1.0)] * 60
    stands = [unstick.velocity((0.0, 0.0), still) for _ in range(60)]
    assert stands == [(0.0, 0.0)] * 60


def test_in_a_gap_the_middle_is_taken() -> None:
    area = walled()
    area.water[:18, 19:21] = False
    room = Room(area, "water", 9.0)
    path = [(-20.0, -3.5), *room.widened((-20.0, -3.5), [(20.0, -3.5)])]
    crossing = min(path, key=lambda place: abs(place[0]))
    assert crossing[1] == pytest.approx(-2.0, abs=0.6)


def test_a_path_is_shortened_from_its_end() -> None:
    path = [(10.0, 0.0), (10.0, 4.0)]
    assert shortened((0.0, 0.0), path, 0.0) == path
    assert shortened((0.0, 0.0), path, 1.0) == [(10.0, 0.0), (10.0, 3.0)]
    assert shortened((0.0, 0.0), path, 6.0) == [(8.0, 0.0)]
    assert shortened((0.0, 0.0), path, 20.0) == []
