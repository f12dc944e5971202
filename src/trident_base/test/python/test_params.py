# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import pytest
from trident_base.params import ParamError, Params, named, nearest, read, require, unknown


@dataclass(frozen=True)
class _Limits:
    v_max: float = 1.5
    count: int = 2


@dataclass(frozen=True)
class _Config:
    limits: _Limits = field(default_factory=_Limits)
    yaw_rad: float = named(0.0, "yaw_deg", math.radians)
    climb_m: float = named(0.5, "climb")
    name: str = "a"
    on: bool = False
    scale: tuple[float, float, float] = (1.0, 2.0, 3.0)


def test_nothing_given_gives_the_defaults_of_the_dataclass() -> None:
    assert read(_Config(), Params({}.get)) == _Config()


def test_every_field_is_a_parameter_in_its_own_unit_also_those_of_groups() -> None:
    given = {"v_max": 2, "count": 3, "yaw_deg": 180, "climb": 1, "name": "b", "on": True}
    config = read(_Config(), Params((given | {"scale": 5, "scale_y": 7.0}).get))
    assert config == _Config(_Limits(2.0, 3), math.pi, 1.0, "b", True, (5.0, 7.0, 5.0))


def test_a_group_may_have_a_prefix_and_a_field_may_be_left() -> None:
    params = Params({"way_v_max": 4.0, "v_max": 9.0, "name": "b"}.get)
    config = read(_Config(), params, {"limits": "way_"}, leave=["name", "limits.count"])
    assert config == _Config(_Limits(4.0, 2))
    assert {"way_v_max", "yaw_deg", "scale", "scale_x"} <= params.asked
    assert not {"name", "way_count", "v_max"} & params.asked


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"v_max": "fast"}, "v_max: 'fast'; legal: a number"),
        ({"v_max": True}, "v_max: True; legal: a number"),
        ({"v_max": math.nan}, "v_max: nan; legal: a finite number"),
        ({"count": 1.5}, "count: 1.5; legal: a whole number"),
        ({"name": 3}, "name: 3; legal: a text"),
        ({"on": 1}, "on: 1; legal: true or false"),
        ({"scale_z": "x"}, "scale_z: 'x'; legal: a number"),
    ],
)
def test_a_value_of_another_type_is_named_with_what_is_legal(
    given: dict[str, Any], text: str
) -> None:
    with pytest.raises(ParamError) as caught:
        read(_Config(), Params(given.get))
    assert str(caught.value) == text


def test_an_unknown_name_comes_with_the_nearest_known_one() -> None:
    assert unknown(["look_ahead", "v_max", "zzz"], ["lookahead", "v_max"]) == [
        "look_ahead: unknown; did you mean 'lookahead'?",
        "zzz: unknown",
    ]
    assert nearest("v_mx", ["v_max", "a_max"]) == "; did you mean 'v_max'?"


@pytest.mark.parametrize("value", [-0.1, 2.1, math.inf, math.nan])
def test_a_value_out_of_its_range_is_refused_in_its_unit(value: float) -> None:
    with pytest.raises(ParamError, match=r"speed: .* m/s, legal: 0 to 2 m/s"):
        require("speed", value, 0.0, 2.0, "m/s")
    require("speed", 2.0, 0.0, 2.0, "m/s")
