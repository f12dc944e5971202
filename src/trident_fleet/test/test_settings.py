# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest
from trident_fleet.core.errors import FormationError
from trident_fleet.core.settings import (
    Vehicle,
    fleet_around,
    fleet_of_names,
    read_settings,
    vehicle_of_line,
)


def test_nothing_given_gives_the_defaults() -> None:
    settings = read_settings(lambda name: None, "own.txt")
    assert settings.source.file == "own.txt"
    assert settings.source.scale == (1.0, 1.0, 1.0)
    assert settings.mode == "time"
    assert settings.feed.period_ns == 100_000_000


def test_parameters_arrive_where_they_belong() -> None:
    given = {
        "formation_file": "f.mat",
        "vehicles_in_file": 8,
        "uavs": 4,
        "scale_x": 1,
        "scale_y": 2.0,
        "scale_z": 0.5,
        "offset": -1.0,
        "offset_z": 3,
        "layout": "3xNxT",
        "mode": "gate",
        "v_max": 2,
        "a_max": 1.5,
        "j_max": 4.0,
        "yaw_deg": 90.0,
        "gate_radius": 0.2,
        "gate_timeout": 7.0,
        "hold_last": 1.0,
        "period": 0.05,
        "lookahead": 3,
        "guard": True,
    }
    settings = read_settings(given.get, "own.txt")
    assert settings.source.file == "f.mat"
    assert (settings.source.vehicles_in_file, settings.source.uavs) == (8, 4)
    assert settings.source.scale == (1.0, 2.0, 0.5)
    assert settings.source.offset == (-1.0, -1.0, 3.0)
    assert (settings.source.layout, settings.mode) == ("3xNxT", "gate")
    assert (settings.plan.limits.v_max, settings.plan.limits.j_max) == (2.0, 4.0)
    assert settings.plan.yaw_rad == pytest.approx(math.pi / 2)
    assert (settings.gate.radius_m, settings.gate.timeout_s) == (0.2, 7.0)
    assert settings.plan.hold_last_s == settings.gate.hold_last_s == 1.0
    assert (settings.feed.period_ns, settings.lookahead) == (50_000_000, 3)
    assert settings.guard


@pytest.mark.parametrize(
    ("name", "value", "what"),
    [
        ("mode", "fast", "mode: 'fast'; legal: time, gate"),
        ("uavs", 2.5, "uavs: 2.5; legal: a whole number"),
        ("uavs", True, "uavs: True; legal: a whole number"),
        ("v_max", "quick", "v_max: 'quick'; legal: a number"),
        ("a_max", True, "a_max: True; legal: a number"),
        ("v_max", -1, "v_max: -1.0; legal: finite, greater than 0"),
        ("scale_y", 0, "scale_y: 0.0; legal: finite, not 0"),
        ("offset", float("inf"), "offset: inf; legal: a finite number"),
        ("formation_file", 7, "formation_file: 7; legal: a text"),
        ("guard", 1, "guard: 1; legal: true or false"),
        ("period", 0.02, "period: 0.02 s; legal: 0.05 to 1 s"),
        ("lookahead", -1, "lookahead: -1; legal: 0 to 100 periods"),
        ("gate_radius", 0, "radius_m: 0.0"),
    ],
)
def test_a_bad_parameter_gives_its_name_value_and_what_is_legal(
    name: str, value: object, what: str
) -> None:
    with pytest.raises(FormationError) as caught:
        read_settings({name: value}.get, "own.txt")
    assert what in str(caught.value)


def test_an_empty_file_name_means_the_default() -> None:
    assert read_settings({"formation_file": ""}.get, "own.txt").source.file == "own.txt"


@pytest.mark.parametrize("prefix", ["/UAV3/", "UAV3", "/UAV3", "UAV3/"])
def test_one_vehicle_knows_the_others(prefix: str) -> None:
    vehicles = fleet_around(prefix, index=2, count=4)
    assert [vehicle.name for vehicle in vehicles] == ["UAV1", "UAV2", "UAV3", "UAV4"]
    assert [vehicle.prefix for vehicle in vehicles] == [f"/UAV{i}/" for i in range(1, 5)]
    assert [vehicle.index for vehicle in vehicles] == [0, 1, 2, 3]


def test_numbers_may_start_anywhere_and_namespaces_may_be_deep() -> None:
    assert fleet_around("/lab/drone0/", 0, 2) == [
        Vehicle("drone0", "/lab/drone0/", 0),
        Vehicle("drone1", "/lab/drone1/", 1),
    ]


def test_a_single_vehicle_may_be_called_anything() -> None:
    assert fleet_around("/firefly/", 0, 1) == [Vehicle("firefly", "/firefly/", 0)]


@pytest.mark.parametrize("prefix", ["", "/", "/firefly/", "/UAV1/"])
def test_a_name_that_says_nothing_about_the_others_is_refused(prefix: str) -> None:
    with pytest.raises(FormationError, match=r"UAV: .*vehicle 3 of 6; legal: .* e.g. /UAV3/"):
        fleet_around(prefix, 2, 6)


def test_named_vehicles_keep_their_order() -> None:
    assert [v.prefix for v in fleet_of_names(["b", "/a/"])] == ["/b/", "/a/"]
    for bad in ([], ["a", "a"], ["a", ""]):
        with pytest.raises(FormationError, match="vehicles: "):
            fleet_of_names(bad)


def test_the_first_line_says_which_vehicle_and_row() -> None:
    assert vehicle_of_line(4, 6, 6) == (4, 0)
    assert vehicle_of_line(13, 6, 4) == (1, 2)
    with pytest.raises(FormationError, match="seq: 5 is vehicle 6 of 6, but uavs is 4"):
        vehicle_of_line(5, 6, 4)
    with pytest.raises(FormationError, match="seq: -1; legal: 0 or more"):
        vehicle_of_line(-1, 6, 6)
