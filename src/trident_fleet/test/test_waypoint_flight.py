# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Places that one vehicle flies through, counted from its start."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from trident_fleet.core.config import FlightLimits, PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.plan import plan_formation
from trident_fleet.nodes.waypoint_flight import along_lines, read_places, rows_from


def test_places_turn_with_the_start() -> None:
    rows = rows_from(np.array([1.0, 2.0, 3.0]), math.pi / 2, np.array([[2.0, 1.0, 4.0]]))
    np.testing.assert_allclose(rows, [[[0.0, 4.0, 7.0]]], atol=1e-12)


def test_a_path_keeps_its_places_and_gets_others_between() -> None:
    places = np.array([[0, 0, 5], [10, 0, 5], [10, 2, 5], [10, 2, 5]], dtype=float)
    path = along_lines(places, 3.0)
    assert len(path) == 1 + 4 + 1 + 1
    for place in places:
        assert (path == place).all(axis=1).any()
    assert np.linalg.norm(np.diff(path, axis=0), axis=1).max() <= 3.0


def test_a_smooth_flight_keeps_to_the_lines() -> None:
    places = np.array([[0, 0, 6], [12, -30, 10], [12, -60, 10]], dtype=float)
    rows = rows_from(np.zeros(3), 0.0, along_lines(places, 3.0))
    plan = plan_formation(rows, np.zeros((1, 3)), PlanConfig(limits=FlightLimits(5.0, 2.5, 5.0)))
    flown = plan.sample(np.linspace(plan.row_time[0], plan.row_time[-1], 400)).position[:, 0]
    legs = list(pairwise(places))
    for point in flown:
        away = []
        for begin, end in legs:
            along = end - begin
            share = np.clip((point - begin) @ along / (along @ along), 0.0, 1.0)
            away.append(np.linalg.norm(point - begin - share * along))
        assert min(away) < 0.3


@pytest.mark.parametrize("bad", [None, [], [[1, 2]], [[1, 2, math.inf]], "path", [[1, 2, "x"]]])
def test_bad_places_are_refused(bad: Any) -> None:
    with pytest.raises(FormationError, match="legal: a list of one or more"):
        read_places(bad)
