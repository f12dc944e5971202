# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A node ends well wherever its main thread is when the signal comes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from trident.testing import PYTHON, RosProcesses, eventually

PUBLISHER = Path(__file__).with_name("interrupted_publisher.py")


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[RosProcesses]:
    processes = RosProcesses(tmp_path)
    yield processes
    processes.close()


def test_a_signal_amid_a_publication_ends_the_node(ros: RosProcesses) -> None:
    ros.start(["/usr/bin/rostopic", "echo", "/count"])
    process = ros.start_node("/interrupted_publisher", [PYTHON, str(PUBLISHER)])
    eventually(lambda: process.poll() is not None, "the end of the node")
    assert process.stdout is not None
    output = process.stdout.read()
    assert process.returncode == 0, output
    assert "Traceback" not in output
    assert ros.master.lookupNode("/test", "/interrupted_publisher")[0] != 1
