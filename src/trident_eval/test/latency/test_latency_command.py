# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident latency` and latency_test.py next to a master."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from trident.testing import PYTHON, RosProcesses, program
from trident_eval.core.bridges.latency_plots import draw_latencies
from trident_eval.latency.latency_test import float32_step_ns

FEW = ["--count", "100", "--rate", "1000"]


@pytest.fixture(scope="module")
def ros(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RosProcesses]:
    processes = RosProcesses(tmp_path_factory.mktemp("ros"))
    yield processes
    processes.close()


def latency(ros: RosProcesses, *words: str) -> tuple[int, str]:
    return ros.run([PYTHON, "-m", "trident_eval.latency", *words])


def wait_for_topic(ros: RosProcesses, topic: str) -> None:
    """Until it is published; the test's own limit ends it otherwise."""
    while ros.run(["rostopic", "type", topic])[0] != 0:
        pass


def test_a_topic_that_nobody_publishes_is_measured_with_own_messages(
    ros: RosProcesses, tmp_path: Path
) -> None:
    picture = tmp_path / "latency.png"
    code, output = latency(ros, "/nobody", *FEW, "--out", str(picture))
    assert code == 0, output
    assert "/nobody, published here: 100 messages, 0 lost; [ms] min " in output
    assert "a bare topic, bytes at 1000 Hz: 100 messages, 0 lost" in output
    assert picture.stat().st_size > 10_000


def test_an_echo_is_measured_by_the_same_message(ros: RosProcesses) -> None:
    relay = [program("trident_bridges", "latency_probe"), "relay", "--message", "odometry"]
    process = ros.start([*relay, "--in", "/there", "--out", "/back"])
    code, output = latency(ros, "/there", "--against", "/back", *FEW, "--message", "odometry")
    process.terminate()
    assert code == 0, output
    assert "/there to /back: 100 messages, 0 lost" in output


def test_a_topic_without_stamps_is_refused_and_names_the_other_method(ros: RosProcesses) -> None:
    node = ros.start(["rostopic", "pub", "-r", "10", "/plain", "std_msgs/Float32", "1.0"])
    wait_for_topic(ros, "/plain")
    code, refusal = latency(ros, "/plain", *FEW)
    node.terminate()
    assert code == 2
    assert "std_msgs/Float32 has no header" in refusal
    assert "--against" in refusal


def test_simulated_stamps_are_said_to_be_so(ros: RosProcesses) -> None:
    message, time = "{header: {stamp: {secs: 5}}}", "{clock: {secs: 6}}"
    clock = ros.start(["rostopic", "pub", "-r", "50", "/clock", "rosgraph_msgs/Clock", time])
    node = ros.start(
        ["rostopic", "pub", "-r", "50", "/stamped", "trident_msgs/WindReading", message]
    )
    wait_for_topic(ros, "/clock")
    wait_for_topic(ros, "/stamped")
    ros.set_param("/use_sim_time", value=True)
    try:
        code, output = latency(ros, "/stamped", "--count", "20")
    finally:
        ros.set_param("/use_sim_time", value=False)
        node.terminate()
        clock.terminate()
    assert code == 0, output
    assert "the stamps are simulated times" in output
    assert "/stamped, from its stamps: 20 messages, 0 lost; [ms] min 1000.000" in output


def test_a_missing_folder_is_refused(ros: RosProcesses) -> None:
    code, output = latency(ros, "/x", "--out", "/no/such/folder.png")
    assert code == 2
    assert "its folder does not exist" in output


def test_the_tutorials_node_prints_latencies_and_says_what_a_float32_cannot(
    ros: RosProcesses,
) -> None:
    assert float32_step_ns(1_700_000_000_000_000_000) == 2**37
    code, output = ros.run(
        ["timeout", "-s", "INT", "8", "rosrun", "trident_eval", "latency_test.py"]
    )
    assert code in (0, 124, 130), output
    assert "a Float32 holds 24 bits" in output
    values = [
        float(text) for text in re.findall(r"^Latency: (\d+\.\d\d) ms$", output, re.MULTILINE)
    ]
    assert values


def test_a_histogram_of_equal_latencies_is_drawn(tmp_path: Path) -> None:
    draw_latencies({"zero": np.zeros(5), "some": np.array([0.1, 2.0])}, "t", tmp_path / "h.png")
    assert (tmp_path / "h.png").stat().st_size > 5_000
