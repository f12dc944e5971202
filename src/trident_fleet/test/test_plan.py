# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from trident_fleet.core.config import FlightLimits, GateConfig, PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.plan import plan_formation
from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import min_separation


@pytest.fixture(scope="module")
def rows(own_formation: Path) -> Array:
    return read_formation(FormationSource(str(own_formation)))


def test_from_the_ground_through_all_rows_to_a_hover(rows: Array, line_spawn: Array) -> None:
    config = PlanConfig()
    plan = plan_formation(rows, line_spawn, config)
    at_ground = plan.sample(np.array([0.0, config.ground_s]))
    np.testing.assert_array_equal(at_ground.position[0], line_spawn)
    np.testing.assert_array_equal(at_ground.position[1], line_spawn)
    at_rows = plan.sample(plan.row_time)
    np.testing.assert_allclose(at_rows.position, rows, atol=1e-12)
    assert plan.row_time[0] - plan.first_row_s == pytest.approx(config.hold_first_s)
    assert plan.duration - plan.row_time[-1] == pytest.approx(config.hold_last_s)
    hover = plan.sample(np.linspace(plan.first_row_s, plan.row_time[0], 9))
    np.testing.assert_allclose(hover.position, np.repeat(rows[:1], 9, axis=0), atol=1e-12)
    np.testing.assert_allclose(hover.velocity, 0.0, atol=1e-12)


def test_the_whole_flight_keeps_limits_and_distance(rows: Array, line_spawn: Array) -> None:
    limits = FlightLimits()
    plan = plan_formation(rows, line_spawn, PlanConfig(limits=limits))
    motion = plan.sample(np.arange(0.0, plan.duration, 0.005))
    assert np.linalg.norm(motion.velocity, axis=-1).max() <= limits.v_max * 1.001
    assert np.linalg.norm(motion.acceleration, axis=-1).max() <= limits.a_max * 1.001
    assert min_separation(motion.position) >= min_separation(rows) - 1e-3
    assert 20.0 < plan.duration < 120.0


def test_the_real_file_from_the_real_grid(formation_data: Path, line_spawn: Array) -> None:
    source = FormationSource(str(formation_data / "pos_data.txt"), scale=(1.0, 2.0, 0.5))
    plan = plan_formation(read_formation(source), line_spawn, PlanConfig())
    motion = plan.sample(np.arange(0.0, plan.duration, 0.01))
    assert min_separation(motion.position) > 1.38
    assert plan.duration < 60.0


def test_one_row_is_a_place_to_hover(line_spawn: Array) -> None:
    goal = line_spawn[None] + np.array([0.0, 0.0, 1.0])
    plan = plan_formation(goal, line_spawn, PlanConfig())
    assert plan.row_time.shape == (1,)
    np.testing.assert_allclose(plan.sample(np.array([plan.duration])).position, goal, atol=1e-12)


def test_the_same_inputs_give_the_same_bits(rows: Array, line_spawn: Array) -> None:
    plans = [plan_formation(rows.copy(), line_spawn.copy(), PlanConfig()) for _ in range(2)]
    time = np.arange(0.0, plans[0].duration, 0.01)
    samples = [plan.sample(time) for plan in plans]
    for name in ("position", "velocity", "acceleration"):
        assert getattr(samples[0], name).tobytes() == getattr(samples[1], name).tobytes()


@pytest.mark.parametrize(
    ("point", "what"),
    [
        ((0.0, 0.0, -0.5), r"row 3, vehicle 2: \(0, 0, -0.5\) m .*; legal: z >= spawn height 0.1"),
        ((2e4, 0.0, 1.0), r"row 3, vehicle 2: .*legal: \|x\|, \|y\|, \|z\| <= 10000 m"),
    ],
)
def test_rows_that_cannot_be_flown_are_named(
    rows: Array, line_spawn: Array, point: tuple[float, float, float], what: str
) -> None:
    bad = rows.copy()
    bad[2, 1] = point
    with pytest.raises(FormationError, match=what):
        plan_formation(bad, line_spawn, PlanConfig())


def test_spawn_positions_have_to_be_finite(rows: Array, line_spawn: Array) -> None:
    line_spawn[0, 0] = np.nan
    with pytest.raises(FormationError, match="spawn positions"):
        plan_formation(rows, line_spawn, PlanConfig())


@pytest.mark.parametrize(
    ("config", "what"),
    [
        (PlanConfig(limits=FlightLimits(v_max=0.0)), "v_max: 0.0; legal: finite, greater than 0"),
        (PlanConfig(limits=FlightLimits(a_max=float("nan"))), "a_max: nan"),
        (PlanConfig(limits=FlightLimits(j_max=-1.0)), "j_max: -1.0"),
        (PlanConfig(ground_s=0.0), "ground_s: 0.0"),
        (PlanConfig(hold_last_s=float("inf")), "hold_last_s: inf"),
        (PlanConfig(min_separation_m=-1.0), "min_separation_m: -1.0; legal: finite, 0 or more"),
        (PlanConfig(yaw_rad=float("nan")), "yaw_rad: nan"),
        (GateConfig(radius_m=0.0), "radius_m: 0.0"),
        (GateConfig(average_s=5.0), "average_s: 5.0; legal: at most settle_s 4.0"),
    ],
)
def test_bad_numbers_are_refused(config: PlanConfig | GateConfig, what: str) -> None:
    with pytest.raises(FormationError, match=what):
        config.validate()


def test_negative_yaw_and_no_wanted_separation_are_fine() -> None:
    dataclasses.replace(PlanConfig(), yaw_rad=-1.0, min_separation_m=0.0).validate()
