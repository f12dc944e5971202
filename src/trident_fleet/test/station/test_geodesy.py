# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from trident_fleet.core.errors import FormationError
from trident_fleet.core.station.geodesy import Datum


def test_a_minute_of_latitude_is_a_nautical_mile_to_the_north() -> None:
    datum = Datum(45.0, 7.0)
    east, north, up = datum.position(45.0 + 1.0 / 60.0, 7.0, 0.0)
    assert east == pytest.approx(0.0, abs=1e-6)
    assert north == pytest.approx(1852.25, abs=0.5)  # WGS 84 at 45 degrees: 1852.24 m
    assert up == pytest.approx(-(north**2) / (2.0 * 6.37e6), abs=0.01)


def test_a_place_east_of_a_northern_origin_is_east() -> None:
    place = Datum(63.4389, 10.399).position(63.4389, 10.3991, 5.0)
    np.testing.assert_allclose(place, [4.9911, 0.0, 5.0], atol=1e-4)


def test_east_and_height_at_the_equator() -> None:
    datum = Datum(0.0, 179.999, 10.0)
    east, north, up = datum.position(0.0, -179.999, 25.0)
    assert east == pytest.approx(np.radians(0.002) * 6378162.0, rel=1e-6)
    assert north == pytest.approx(0.0, abs=1e-6)
    assert up == pytest.approx(15.0, abs=0.01)


def test_the_datum_itself_is_the_origin() -> None:
    np.testing.assert_allclose(Datum(63.4389, 10.399).position(63.4389, 10.399, 0.0), np.zeros(3))


def test_what_is_no_place_is_refused() -> None:
    with pytest.raises(FormationError, match="datum longitude: 200 deg, legal: -180 to 180 deg"):
        Datum(0.0, 200.0).validate()
