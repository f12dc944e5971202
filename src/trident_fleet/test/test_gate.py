# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from trident_fleet.core.config import GateConfig, PlanConfig
from trident_fleet.core.feeders import GateFeed, GateFeeder
from trident_fleet.core.gate import FormationGate, Phase
from trident_fleet.core.quintic import Array
from trident_fleet.core.schedule import FeedConfig

PERIOD_NS = 100_000_000
NAMES = ["UAV1", "UAV2", "UAV3"]
SPAWN = np.array([[0.0, 2.0, 0.1], [0.0, 0.0, 0.1], [0.0, -2.0, 0.1]])
OFFSET = np.array([0.0, 0.0, 0.04])
Follow = Callable[[int, Array, Array], Array]


def rows_ahead(count: int, step_m: float = 0.15) -> Array:
    ahead = np.zeros((count, 3, 3))
    ahead[:, :, 0] = step_m * np.arange(count)[:, None]
    return SPAWN + np.array([0.0, 0.0, 1.0]) + ahead


def new_gate(rows: Array, config: GateConfig | None = None) -> FormationGate:
    return FormationGate(rows, SPAWN, NAMES, PlanConfig(), config or GateConfig())


def fly(gate: FormationGate, follow: Follow, periods: int = 3000) -> int:
    """Fly with a fake clock; `follow(period, position, target)` gives the next position."""
    position, index = SPAWN.copy(), 0
    while gate.phase not in (Phase.DONE, Phase.FAILED) and index < periods:
        now = index * PERIOD_NS
        target = gate.command(np.array([now / 1e9])).position[0]
        position = follow(index, position, target)
        index += 1
        gate.step(index * PERIOD_NS, position, (index + 1) * PERIOD_NS)
    return index


def lag(factor: float) -> Follow:
    return lambda _, position, target: position + factor * (target + OFFSET - position)


def test_all_rows_are_flown_in_order_and_the_offset_is_learned() -> None:
    rows = rows_ahead(20)
    gate = new_gate(rows)
    fly(gate, lag(0.3))
    assert gate.phase is Phase.DONE
    assert gate.failure == ""
    assert gate.row == 19
    assert len(gate.command_ns) == len(gate.arrival_ns) == 20
    np.testing.assert_allclose(gate.steady_offset, np.tile(OFFSET, (3, 1)), atol=2e-3)
    for arrival, command in zip(gate.arrival_ns[:-1], gate.command_ns[1:], strict=True):
        assert command == arrival + PERIOD_NS


def test_an_offset_larger_than_the_gate_does_not_block_it() -> None:
    gate = new_gate(rows_ahead(5), GateConfig(radius_m=0.05))
    high = np.array([0.0, 0.0, 0.13])
    fly(gate, lambda _, position, target: position + 0.3 * (target + high - position))
    assert gate.phase is Phase.DONE


def test_the_formation_waits_for_the_slowest() -> None:
    factors = np.array([0.9, 0.9, 0.1])[:, None]
    gate = new_gate(rows_ahead(6, step_m=0.3))
    # All have to hover before the slow one can hold anybody up.
    fly(gate, lambda _, position, target: position + factors * (target + OFFSET - position))
    assert gate.phase is Phase.DONE
    waits = np.diff(gate.arrival_ns[1:]) / 1e9
    # 0.3 m to 0.1 m at ten per cent per period takes more than ten periods; alone: two.
    assert waits.min() > 1.0


def test_one_vehicle_that_stops_is_named_and_the_others_are_not() -> None:
    def stuck(_: int, position: Array, target: Array) -> Array:
        moved = position + 0.5 * (target + OFFSET - position)
        if gate.row >= 3:
            moved[1] = position[1]
        return moved

    gate = new_gate(rows_ahead(10), GateConfig(timeout_s=3.0))
    fly(gate, stuck)
    assert gate.phase is Phase.FAILED
    assert gate.failure.startswith("row 4 of 10 not reached within 3 s by UAV2 (0.")
    assert "UAV1" not in gate.failure
    assert "UAV3" not in gate.failure


def test_a_vehicle_that_never_takes_off_is_named() -> None:
    def grounded(_: int, position: Array, target: Array) -> Array:
        moved = target + OFFSET
        moved[2] = SPAWN[2]
        return moved

    gate = new_gate(rows_ahead(10))
    fly(gate, grounded)
    assert gate.phase is Phase.FAILED
    assert gate.failure == "row 1 of 10 not reached within 14 s by UAV3 (1.00 m away)"


def test_a_vehicle_that_is_gone_is_named() -> None:
    def vanish(index: int, position: Array, target: Array) -> Array:
        moved = target + OFFSET
        if gate.row >= 2:
            moved[0] = np.nan
        return moved

    gate = new_gate(rows_ahead(10))
    fly(gate, vanish)
    assert gate.failure == "row 3 of 10 not reached within 10 s by UAV1 (gone)"


def test_the_last_row_is_held() -> None:
    gate = new_gate(rows_ahead(3), GateConfig(hold_last_s=2.0))
    ended = fly(gate, lag(0.6))
    assert ended * PERIOD_NS - gate.arrival_ns[-1] >= 2_000_000_000
    target = gate.command(np.array([ended / 10.0 + 5.0]))
    np.testing.assert_array_equal(target.position[0], rows_ahead(3)[-1])
    assert not target.velocity.any()


def test_arrival_is_strictly_inside_the_radius() -> None:
    gate = new_gate(rows_ahead(2, step_m=0.25), GateConfig(timeout_s=1.0))
    away = np.array([0.11, 0.0, 0.0])

    def short(_: int, position: Array, target: Array) -> Array:
        return target + OFFSET - (away if gate.row else 0.0)

    fly(gate, short)
    assert gate.failure == (
        "row 2 of 2 not reached within 1 s by UAV1 (0.11 m away), UAV2 (0.11 m away), UAV3 (0.11 m"
        " away)"
    )


def test_two_instances_fed_alike_decide_alike() -> None:
    gates = [new_gate(rows_ahead(15)) for _ in range(2)]
    feeds = [
        GateFeeder(gate, GateFeed([index], 0, 0.0, FeedConfig()))
        for index, gate in enumerate(gates)
    ]
    rng = np.random.default_rng(5)
    position = SPAWN.copy()
    for feed in feeds:
        feed.begin()
    for index in range(1, 400):
        target = gates[0].command(np.array([index / 10.0])).position[0]
        position = position + 0.4 * (target + OFFSET - position) + rng.normal(0, 1e-3, (3, 3))
        for feed in feeds:
            feed.on_state(index * PERIOD_NS, position)
    assert gates[0].phase is gates[1].phase is Phase.DONE
    assert gates[0].command_ns == gates[1].command_ns
    assert gates[0].arrival_ns == gates[1].arrival_ns
    assert feeds[0].end_ns == feeds[1].end_ns
    np.testing.assert_array_equal(gates[0].steady_offset, gates[1].steady_offset)


def test_the_end_is_announced_two_periods_ahead_or_more() -> None:
    gate = new_gate(rows_ahead(2), GateConfig(hold_last_s=0.5))
    start_ns = 700_000_000
    feeder = GateFeeder(gate, GateFeed([0], start_ns, 0.0, FeedConfig()))
    assert len(feeder.begin()) == 2
    index = 0
    while feeder.end_ns is None:
        index += 1
        target = gate.command(np.array([index / 10.0])).position[0]
        feeder.on_state(start_ns + index * PERIOD_NS, target + OFFSET)
    assert feeder.end_ns - (start_ns + index * PERIOD_NS) >= 2 * PERIOD_NS
    assert math.isclose(feeder.end_ns % PERIOD_NS, 0.0)
