# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("rospy", reason="the workspace is not sourced")

import hostile
from trident.testing.pytest_plugin import pytest_runtest_makereport, ros, session_ros

__all__ = ["pytest_runtest_makereport", "ros", "session_ros"]


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "fuzzes(*programs): package/program that the test treats")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None, Any, Any]:
    """A test treats the programs that it says it does, each case of a parametrized one some."""
    hostile.TREATED.clear()
    result = yield
    named = {name for mark in item.iter_markers("fuzzes") for name in mark.args}
    treated = set(hostile.TREATED)
    is_one_of_them = hasattr(item, "callspec") and bool(treated) and treated <= named
    assert treated == named or is_one_of_them, f"treats {sorted(treated)}, says {sorted(named)}"
    return result


@pytest.fixture
def map_file(tmp_path: Path) -> Path:
    """A map of the room that the robot drives in."""
    columns, rows = hostile.MAP_CELLS
    pixels = bytearray([205] * (columns * rows))
    for row in range(10, rows - 10):
        for column in range(10, columns - 10):
            is_wall = row in (10, rows - 11) or column in (10, columns - 11)
            pixels[row * columns + column] = 0 if is_wall else 254
    (tmp_path / "room.pgm").write_bytes(b"P5 %d %d 255\n" % hostile.MAP_CELLS + bytes(pixels))
    file = tmp_path / "room.yaml"
    file.write_text(
        "image: room.pgm\nresolution: 0.05\norigin: [-4.5, -3.5, 0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    return file
