# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Generator
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
