# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Places counted from a start, and the world on the earth."""

from __future__ import annotations

import math

import numpy as np
import pytest
from trident_nav.core.errors import NavError
from trident_nav.core.places import earth_from_world, from_start, quaternion


def test_places_are_ahead_and_left_of_the_start() -> None:
    found = from_start([10.0, 5.0, -math.pi / 2], [[25, 0], [45, 8], [3, 4, 99]])
    np.testing.assert_allclose(found, [[10, -20], [18, -40], [14, 2]], atol=1e-12)


@pytest.mark.parametrize(
    ("start", "places", "what"),
    [
        ([0, 0], [[1, 1]], "start: \\[0, 0\\]; legal: 3 finite numbers"),
        ([0, 0, 0], [], "waypoints: \\[\\]; legal: a list of one or more"),
        ([0, 0, 0], None, "waypoints: None; legal"),
        ([0, 0, 0], [[1, "x"]], "waypoints: \\[1, 'x'\\]; legal: 2 numbers"),
        ([0, 0, 0], [[1, math.nan]], "legal: 2 finite numbers"),
    ],
)
def test_bad_places_are_refused(start: list[float], places: list[list[float]], what: str) -> None:
    with pytest.raises(NavError, match=what):
        from_start(start, places)


def test_the_world_on_the_equator_and_at_the_pole() -> None:
    origin, rotation = earth_from_world(0.0, 0.0, 100.0)
    np.testing.assert_allclose(origin, [6378237.0, 0, 0], atol=1e-6)
    np.testing.assert_allclose(rotation @ [1, 2, 3], [3, 1, 2], atol=1e-12)
    origin, rotation = earth_from_world(90.0, 0.0, 0.0)
    np.testing.assert_allclose(origin, [0, 0, 6356752.314245], atol=1e-6)
    np.testing.assert_allclose(rotation @ [0, 0, 1], [0, 0, 1], atol=1e-12)
    with pytest.raises(NavError, match="latitude: 91 deg, legal: -90 to 90 deg"):
        earth_from_world(91.0, 0.0, 0.0)


def test_a_rotation_and_its_quaternion_turn_alike() -> None:
    random = np.random.default_rng(4)
    for _ in range(50):
        rotation = np.linalg.qr(random.normal(size=(3, 3)))[0]
        rotation *= np.linalg.det(rotation)
        x, y, z, w = quaternion(rotation)
        turned = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        )
        np.testing.assert_allclose(turned, rotation, atol=1e-12)
