# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the parts of latency_probe (trident_bridges) against the master of the environment."""

from __future__ import annotations

import subprocess
from pathlib import Path

from trident_eval.core.bridges.latency import LatencyRecord, make_record, read_record
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

WARM_UP = 50  # messages that do not count
_STOP_LIMIT_S = 10.0


def _probe(part: str, record: Path, **options: object) -> list[str]:
    words = [program("trident_bridges", "latency_probe"), part, "--record", str(record)]
    for name, value in options.items():
        words += [f"--{name}", str(value)]
    return words


def _finish(process: subprocess.Popen[str], what: str) -> None:
    """Waits for a part.

    Raises:
        EvalError: it has failed.
    """
    output, _ = process.communicate()
    if process.returncode != 0:
        reason = output.strip().splitlines()[-1:] or ["no reason given"]
        raise EvalError(f"{what}: {reason[0].removeprefix('latency_probe: ')}")


def _start(words: list[str]) -> subprocess.Popen[str]:
    return subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    )


def _end(process: subprocess.Popen[str]) -> None:
    if process.poll() is not None:
        return
    process.terminate()
    try:
        process.wait(_STOP_LIMIT_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def send_and_receive(
    folder: Path, topic: str, echo: str, message: str, *, rate: float, count: int, size: int
) -> LatencyRecord:
    """Publishes numbered messages on one topic and receives them on another, by two processes.

    Args:
        folder: for the record.
        topic: where they are published.
        echo: where they come back; the same for a bare topic.
        message: a carrier of latency_probe: bytes, float32, float64, odometry, nav_sat_fix.
        rate: [Hz].
        count: messages that count.
        size: of the message bytes.

    Raises:
        EvalError: nothing comes back within 30 s, or a process fails.
    """
    record = folder / "record"
    make_record(record, count + WARM_UP + 1)
    sink = _start(_probe("sink", record, message=message, topic=echo))
    options = {"message": message, "rate": rate, "count": count + WARM_UP, "size": size}
    source = _start(_probe("source", record, topic=topic, **options))
    try:
        _finish(source, topic)
        _finish(sink, echo)
    finally:
        _end(source)
        _end(sink)
    return read_record(record, first=WARM_UP + 1)


def listen(folder: Path, topic: str, *, count: int, limit_s: float) -> LatencyRecord:
    """Compares the stamps of a topic with the time at which its messages arrive.

    Both are times of ros::Time: simulated where /use_sim_time is set.

    Args:
        folder: for the record.
        topic: of messages that begin with a header.
        count: messages.
        limit_s: wall time after which fewer are enough.

    Raises:
        EvalError: nothing comes.
    """
    record = folder / "record"
    make_record(record, count)
    listener = _start(_probe("listener", record, topic=topic, limit_s=limit_s))
    try:
        _finish(listener, topic)
    finally:
        _end(listener)
    return read_record(record, first=0)
