# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Followers and their leader in a simulated world in this process, without ROS."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from trident_fleet.core.config import PlanConfig
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.follow.follow_config import FollowConfig
from trident_fleet.core.follow.followers import Followers, Phase
from trident_fleet.core.follow.leader import LeaderState, LeaderTrack, Measurement, yaw_of
from trident_fleet.core.plan import FormationPlan, plan_formation
from trident_fleet.core.quintic import Array, Motion
from trident_fleet.core.separation import min_separation

trident_sim = pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

REPO = Path(__file__).resolve().parents[2]
PERIOD_NS = 100_000_000
TIMES_S = np.arange(10) * 0.01
LEADER, FOLLOWERS = "UAV1", ["UAV2", "UAV3", "UAV4"]
PLACES = np.array([[2.0, 0.0, 0.1], [0.0, 1.6, 0.1], [0.0, -1.6, 0.1], [0.0, 3.2, 0.1]])
WEDGE = np.array([[-1.3, 1.3, 0.0], [-1.3, -1.3, 0.0], [-2.6, 2.6, 0.0]])


@dataclass
class Flight:
    """What was measured at the end of each period since all have joined.

    Attributes:
        position: p_world of the leader and its followers [m], shape (M, 4, 3).
        ideal: where the followers belonged at the same instants [m], shape (M, 3, 3).
        state_hash: of the world at the end.
    """

    position: Array
    ideal: Array
    state_hash: str


def measure(world: trident_sim.World) -> Measurement:
    model = world.model(LEADER)
    x, y, z, w = model.orientation
    velocity, turn = np.array(model.linear_velocity), np.array(model.angular_velocity)
    # Stamps count from the first set-point, a period after the beginning.
    stamp_ns = world.time_ns - PERIOD_NS
    position = np.array(model.position)
    return Measurement(stamp_ns, position, yaw_of((x, y, z, w)), velocity, float(turn[2]))


def write(world: trident_sim.World, name: str, motion: Motion, index: int, stamp_ns: int) -> None:
    sample = trident_sim.TrajectorySample(
        np.ascontiguousarray(motion.position[:, index]),
        TIMES_S,
        np.ascontiguousarray(motion.velocity[:, index]),
        np.ascontiguousarray(motion.acceleration[:, index]),
        stamp=stamp_ns / 1e9,
    )
    world.ports[f"{name}/command/trajectory"].write(sample)


def build() -> tuple[trident_sim.World, FormationPlan]:
    """The vehicles of launch/leader_follower.launch, and what the leader flies."""
    world = trident_sim.World("package://rotors_gazebo/worlds/basic.world")
    for name, place in zip([LEADER, *FOLLOWERS], PLACES.tolist(), strict=True):
        world.spawn(name, urdf=trident_sim.multirotor(name, "firefly"), pose=tuple(place))
    file = REPO / "config" / "formations" / "leader_path.txt"
    rows = read_formation(FormationSource(str(file), vehicles_in_file=1))
    return world, plan_formation(rows, PLACES[:1], PlanConfig())


def fly() -> Flight:
    world, plan = build()
    followers = Followers(PLACES[1:], FollowConfig(WEDGE, frame="world", end_when_still_s=5.0))
    track = LeaderTrack()
    position, ideal = [], []
    leader: LeaderState | None = None
    period = 0
    while followers.phase is not Phase.DONE and period < 700:
        window_ns = period * PERIOD_NS
        slots = followers.step(leader, window_ns - PERIOD_NS, window_ns)
        stamp_ns = PERIOD_NS + window_ns
        write(world, LEADER, plan.sample(window_ns / 1e9 + TIMES_S), 0, stamp_ns)
        for index, name in enumerate(FOLLOWERS):
            write(world, name, slots.motion, index, stamp_ns)
        world.step_until(stamp_ns / 1e9)
        now = measure(world)
        track.add(now.stamp_ns, lambda now=now: now)
        # The leader's state at the begin of this period commands the next one.
        leader = track.at(window_ns)
        if followers.joined_s is not None and leader is not None:
            position.append([world.model(name).position for name in (LEADER, *FOLLOWERS)])
            ideal.append(followers.ideal(leader).position[0])
        period += 1
    assert followers.phase is Phase.DONE, followers.problem
    return Flight(np.array(position), np.array(ideal), world.state_hash())


@pytest.fixture(scope="module")
def flown() -> Flight:
    return fly()


def test_followers_hold_their_places_around_a_moving_leader(flown: Flight) -> None:
    assert len(flown.position) > 250, "they join in time to follow along most of the path"
    distance = np.linalg.norm(np.diff(flown.position[:, 0], axis=0), axis=1).sum()
    assert distance > 15.0, "the leader moves meanwhile"
    error = np.linalg.norm(flown.position[:, 1:] - flown.ideal, axis=-1)
    # They hover 4 cm too high, as every vehicle under this controller does.
    assert np.sqrt((error**2).mean()) < 0.08
    assert error.max() < 0.2
    assert min_separation(flown.position) > min_separation(WEDGE[None]) - 0.2


def test_the_same_flight_ends_in_the_same_state(flown: Flight) -> None:
    assert fly().state_hash == flown.state_hash
