# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
import struct

import numpy as np
import pytest
from trident_fleet.core.config import GateConfig, PlanConfig
from trident_fleet.core.encoding import encode_message, encode_points
from trident_fleet.core.errors import FormationError
from trident_fleet.core.feeders import GateFeed, GateFeeder, TimeFeeder, end_of_plan_ns
from trident_fleet.core.gate import FormationGate
from trident_fleet.core.plan import FormationPlan, plan_formation
from trident_fleet.core.quintic import Motion
from trident_fleet.core.schedule import FeedConfig, PlannedFeed

PERIOD_NS = 100_000_000
START_NS = 300_000_000


@pytest.fixture(scope="module")
def plan() -> FormationPlan:
    spawn = np.array([[0.0, 1.0, 0.1], [0.0, -1.0, 0.1]])
    rows = spawn + np.array([[[0.0, 0, 1]], [[0.5, 0, 1]], [[1.0, 0, 1]]])
    return plan_formation(rows, spawn, PlanConfig(yaw_rad=0.5))


@pytest.fixture(scope="module")
def feed(plan: FormationPlan) -> PlannedFeed:
    return PlannedFeed(plan, [0, 1], START_NS, FeedConfig())


def stamp_of(message: bytes) -> int:
    seconds, nanoseconds = struct.unpack_from("<II", message, 4)
    return int(seconds) * 1_000_000_000 + int(nanoseconds)


def test_bytes_are_those_of_the_ros_message() -> None:
    messages = pytest.importorskip("trajectory_msgs.msg")
    rng = np.random.default_rng(7)
    motion = Motion(*(rng.normal(size=(10, 3, 3)) for _ in range(3)))
    offsets = np.arange(10, dtype=np.int64) * 150_000_000
    raw = encode_message(12_345_678_901, encode_points(motion, 1, 0.6, offsets))
    message = messages.MultiDOFJointTrajectory()
    message.deserialize(raw)
    again = io.BytesIO()
    message.serialize(again)
    assert again.getvalue() == raw
    assert (message.header.stamp.secs, message.header.stamp.nsecs) == (12, 345_678_901)
    assert message.header.frame_id == "world"
    assert list(message.joint_names) == ["base_link"]
    point = message.points[7]
    translation = point.transforms[0].translation
    np.testing.assert_array_equal(
        [translation.x, translation.y, translation.z], motion.position[7, 1]
    )
    rotation = point.transforms[0].rotation
    assert (rotation.z, rotation.w) == pytest.approx((np.sin(0.3), np.cos(0.3)), rel=1e-15)
    np.testing.assert_array_equal(point.velocities[0].linear.y, motion.velocity[7, 1, 1])
    np.testing.assert_array_equal(point.accelerations[0].linear.z, motion.acceleration[7, 1, 2])
    assert point.time_from_start.to_nsec() == 1_050_000_000


def test_messages_follow_each_other_without_gap(plan: FormationPlan, feed: PlannedFeed) -> None:
    messages = pytest.importorskip("trajectory_msgs.msg")
    for index in (0, 7, 40):
        stamp = START_NS + index * PERIOD_NS
        for vehicle, raw in enumerate(feed.messages(index)):
            message = messages.MultiDOFJointTrajectory()
            message.deserialize(raw)
            assert message.header.stamp.to_nsec() == feed.stamp_ns(index) == stamp
            times = [point.time_from_start.to_nsec() for point in message.points]
            assert times == list(range(0, PERIOD_NS, 10_000_000))
            wanted = plan.sample((index * PERIOD_NS + np.array(times)) / 1e9).position[:, vehicle]
            got = [point.transforms[0].translation for point in message.points]
            np.testing.assert_array_equal([[p.x, p.y, p.z] for p in got], wanted)


def test_after_the_end_the_last_hover_continues(plan: FormationPlan, feed: PlannedFeed) -> None:
    far = int(plan.duration * 10) + 500
    first, second = (feed.messages(index)[0] for index in (far, far + 1))
    assert stamp_of(second) - stamp_of(first) == PERIOD_NS
    assert first[12:] == second[12:]
    # Header 21 bytes, joint names 17, number of points 4, number of transforms 4.
    assert np.frombuffer(first, "<f8", 3, 46).tolist() == plan.rows[-1, 0].tolist()


def test_in_lockstep_every_message_is_sent_once_and_ahead(feed: PlannedFeed) -> None:
    feeder = TimeFeeder(feed, lookahead=5, is_lockstep=True)
    assert [stamp_of(batch[0]) for batch in feeder.due(0)] == [
        START_NS + index * PERIOD_NS for index in range(6)
    ]
    assert feeder.due(START_NS) == []
    assert feeder.due(START_NS + PERIOD_NS - 1) == []
    assert [stamp_of(b[1]) for b in feeder.due(START_NS + PERIOD_NS)] == [START_NS + 6 * PERIOD_NS]
    late = feeder.due(START_NS + 9 * PERIOD_NS)
    assert [stamp_of(b[0]) for b in late] == [START_NS + i * PERIOD_NS for i in range(7, 15)]


def test_a_clock_of_another_century_draws_no_message_of_the_time_between(feed: PlannedFeed) -> None:
    """It would take all memory: three weeks are 2e7 messages, fifty years 2e10."""
    feeder = TimeFeeder(feed, lookahead=5, is_lockstep=True)
    ahead = 20_000
    stamps = [stamp_of(first) for first, _ in feeder.due(START_NS + ahead * PERIOD_NS)]
    assert stamps == [START_NS + (ahead + number) * PERIOD_NS for number in range(6)]
    assert len(feeder.due(START_NS + (ahead + 1) * PERIOD_NS)) == 1, "it continues from there"


def test_without_lockstep_nothing_is_early_and_nothing_is_stale(feed: PlannedFeed) -> None:
    feeder = TimeFeeder(feed, lookahead=5, is_lockstep=False)
    assert feeder.due(START_NS - 1) == []
    assert [stamp_of(b[0]) for b in feeder.due(START_NS + 10)] == [START_NS]
    assert feeder.due(START_NS + 20) == []
    overtaken = feeder.due(START_NS + 8 * PERIOD_NS + 5)
    assert [stamp_of(b[0]) for b in overtaken] == [START_NS + 8 * PERIOD_NS]


def test_a_gate_answers_each_period_once() -> None:
    spawn = np.array([[0.0, 0.0, 0.1]])
    gate = FormationGate(spawn[None] + 1.0, spawn, ["UAV1"], PlanConfig(), GateConfig())
    feeder = GateFeeder(gate, GateFeed([0], START_NS, 0.0, FeedConfig()))
    assert [stamp_of(b[0]) for b in feeder.begin()] == [START_NS, START_NS + PERIOD_NS]
    assert feeder.on_state(0, spawn) == []
    assert feeder.on_state(START_NS, spawn) == []
    assert feeder.on_state(START_NS + PERIOD_NS + 10_000_000, spawn) == []
    answer = feeder.on_state(START_NS + PERIOD_NS, spawn)
    assert [stamp_of(b[0]) for b in answer] == [START_NS + 2 * PERIOD_NS]
    assert feeder.on_state(START_NS + PERIOD_NS, spawn) == []
    answer = feeder.on_state(START_NS + 4 * PERIOD_NS, spawn)
    assert [stamp_of(b[0]) for b in answer] == [START_NS + 5 * PERIOD_NS]


def test_the_end_of_a_plan_is_a_whole_period() -> None:
    config = FeedConfig()
    assert end_of_plan_ns(START_NS, 2.0, config) == START_NS + 2_000_000_000
    assert end_of_plan_ns(START_NS, 2.01, config) == START_NS + 2_100_000_000


@pytest.mark.parametrize(
    ("config", "what"),
    [
        (FeedConfig(period_ns=10_000_000), "period: 0.01 s; legal: 0.05 to 1 s"),
        (FeedConfig(point_ns=0), "point_spacing: 0 s"),
        (FeedConfig(point_ns=30_000_000), "point_spacing: 0.03 s; legal: a whole part of"),
    ],
)
def test_bad_periods_are_refused(config: FeedConfig, what: str) -> None:
    with pytest.raises(FormationError, match=what):
        config.validate()
