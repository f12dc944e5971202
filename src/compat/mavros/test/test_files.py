# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Files of parameters and missions."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mavros.files import (
    FormatError,
    Item,
    ParameterFormat,
    format_mission,
    format_parameters,
    parse_mission,
    parse_parameters,
)

NAMES = st.text(alphabet="ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", min_size=1, max_size=16)
NUMBERS = st.integers(-(2**31), 2**31 - 1) | st.floats(-1e6, 1e6)


@pytest.mark.parametrize("layout", list(ParameterFormat))
@given(values=st.dictionaries(NAMES, NUMBERS, max_size=5))
def test_parameters_come_back(layout: ParameterFormat, values: dict[str, int | float]) -> None:
    lines = format_parameters(values, layout).splitlines()
    assert parse_parameters("x", lines, layout) == values


def test_a_line_that_is_no_parameter_is_named() -> None:
    lines = ["# comment", "RTL_ALT 15", "RTL_ALT high"]
    with pytest.raises(FormatError, match=r"x\.txt, line 3: 'RTL_ALT high', legal: a name and"):
        parse_parameters("x.txt", lines, ParameterFormat.MAVPROXY)


def test_a_mission_comes_back() -> None:
    item = Item(True, 3, 16, (1.0, 0.0, 0.5, -1.0), 47.397742, 8.545594, 12.5, True)
    items = [item, Item(False, 2, 20, (0.0, 0.0, 0.0, 0.0), 0.0, 0.0, 0.0, False)]
    assert parse_mission("x", format_mission(items).splitlines()) == items


def test_a_mission_of_another_format_is_refused() -> None:
    with pytest.raises(FormatError, match=r"line 1: 'plan', legal: 'QGC WPL 110'"):
        parse_mission("x", ["plan"])
    with pytest.raises(FormatError, match=r"line 2: '0 1 3', legal: 12 numbers"):
        parse_mission("x", ["QGC WPL 110", "0 1 3"])
