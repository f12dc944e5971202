# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs node_poll_loop_check next to a master and a node that answers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from trident.testing import PYTHON, RosProcesses, program

PARTNER = Path(__file__).with_name("partner_node.py")


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[RosProcesses]:
    processes = RosProcesses(tmp_path)
    yield processes
    processes.close()


def test_next_to_another_process(ros: RosProcesses) -> None:
    ros.set_param("/use_sim_time", value=True)
    partner = ros.start_node("/partner", [PYTHON, str(PARTNER)])
    code, output = ros.run([program("trident_bridges", "node_poll_loop_check")])
    assert code == 0, output
    assert "PASSED  ] 10 tests" in output
    assert partner.poll() is None
