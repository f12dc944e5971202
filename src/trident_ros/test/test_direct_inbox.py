# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs direct_inbox_check next to a master and a node that answers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from trident.testing import PYTHON, RosProcesses, program

ECHO = Path(__file__).with_name("echo_node.py")


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[RosProcesses]:
    processes = RosProcesses(tmp_path)
    yield processes
    processes.close()


def test_against_another_process(ros: RosProcesses) -> None:
    echo = ros.start_node("/echo", [PYTHON, str(ECHO)])
    code, output = ros.run([program("trident_ros", "direct_inbox_check")])
    assert code == 0, output
    assert "PASSED  ] 19 tests" in output
    assert echo.poll() is None
