# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs raw_service_check next to a master and a node that serves."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from trident.testing import PYTHON, RosProcesses, eventually, program

SERVING = Path(__file__).with_name("serving_node.py")


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[RosProcesses]:
    processes = RosProcesses(tmp_path)
    yield processes
    processes.close()


def test_against_another_process(ros: RosProcesses) -> None:
    ros.start_node("/serving", [PYTHON, str(SERVING)])
    eventually(lambda: ros.master.lookupService("/test", "/die")[0] == 1, "the last service")
    code, output = ros.run([program("trident_ros", "raw_service_check")])
    assert code == 0, output
    assert "PASSED  ] 7 tests" in output
