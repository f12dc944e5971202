# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Processes that are kept on one core get their cores back, however their keeper ends."""

from __future__ import annotations

import os
import signal
import socket
import struct
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from trident.testing import eventually, program

pytestmark = pytest.mark.skipif(
    len(os.sched_getaffinity(0)) < 2, reason="there is one core to be kept on"
)
ALL = os.sched_getaffinity(0)
_SET_BYTES = 128  # of cpu_set_t
_NAME = "core_watcher"


@contextmanager
def _running(*command: str, **options: object) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, **options
    ) as process:  # type: ignore[call-overload]
        try:
            yield process
        finally:
            process.kill()


@pytest.fixture
def kept() -> Iterator[int]:
    """A process that does nothing."""
    with _running("cat") as process:
        yield process.pid


@pytest.fixture
def holder(kept: int) -> Iterator[subprocess.Popen[str]]:
    """Keeps the other on one core."""
    with _running(program("trident_ros", "holding_cores_check"), str(kept)) as process:
        assert process.stdout is not None
        core = int(process.stdout.readline())
        assert os.sched_getaffinity(kept) == {core}
        yield process


def _watcher_of(process: int) -> int:
    children = Path(f"/proc/{process}/task/{process}/children").read_text().split()
    names = {int(child): Path(f"/proc/{child}/comm").read_text().strip() for child in children}
    (watcher,) = [child for child, name in names.items() if name == _NAME]
    return watcher


def _is_running(process: int) -> bool:
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"  # of an orphan that nobody waits for


def test_after_sigkill_of_its_keeper_a_process_gets_its_cores_back(
    holder: subprocess.Popen[str], kept: int
) -> None:
    watcher = _watcher_of(holder.pid)
    holder.kill()
    eventually(lambda: os.sched_getaffinity(kept) == ALL, "the process gets its cores back")
    eventually(lambda: not _is_running(watcher), "the watcher ends by itself")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_what_ends_the_keeper_does_not_end_the_watcher_before_its_work_is_done(
    holder: subprocess.Popen[str], kept: int, number: signal.Signals
) -> None:
    watcher = _watcher_of(holder.pid)
    os.kill(watcher, number)
    assert os.getsid(watcher) == watcher  # nor is it reached by signals to a group
    holder.kill()
    eventually(lambda: os.sched_getaffinity(kept) == ALL, "the process gets its cores back")


def test_a_keeper_that_ends_in_order_leaves_neither_a_kept_process_nor_a_watcher(
    holder: subprocess.Popen[str], kept: int
) -> None:
    watcher = _watcher_of(holder.pid)
    assert holder.stdin is not None
    holder.stdin.close()
    assert holder.wait() == 0
    assert os.sched_getaffinity(kept) == ALL
    assert not _is_running(watcher)


def _files_of(process: int) -> dict[int, str]:
    """The open files by descriptor; one that is closed meanwhile is left out."""
    files = {}
    for link in Path(f"/proc/{process}/fd").iterdir():
        with suppress(FileNotFoundError):
            files[int(link.name)] = str(link.readlink()).partition(":")[0]
    return files


def test_the_watcher_holds_no_file_of_its_keeper(holder: subprocess.Popen[str]) -> None:
    watcher = _watcher_of(holder.pid)
    # At its start the dynamic linker opens and closes libraries; a file of the keeper would stay.
    own = {0: "socket", 1: "/dev/null", 2: "/dev/null"}
    eventually(lambda: _files_of(watcher) == own, "its three files alone")


def test_a_keeper_that_keeps_nothing_starts_no_watcher() -> None:
    with _running(program("trident_ros", "holding_cores_check"), "0") as process:
        assert process.stdout is not None
        assert process.stdout.readline().strip() == "-1"
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
        assert children.read_text() == ""


@pytest.mark.parametrize(("later_ticks", "is_restored"), [(0, True), (1, False)])
def test_another_process_that_has_the_number_now_is_left_alone(
    kept: int, later_ticks: int, is_restored: bool
) -> None:
    core = min(ALL)
    os.sched_setaffinity(kept, {core})
    start = int(Path(f"/proc/{kept}/stat").read_text().rpartition(")")[2].split()[19])
    cores = sum(1 << number for number in ALL).to_bytes(_SET_BYTES, "little")
    here, there = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with here, there, subprocess.Popen([program("trident_ros", _NAME)], stdin=there) as watcher:
        there.close()
        here.send(struct.pack(f"=iiQ{_SET_BYTES}s", kept, core, start + later_ticks, cores))
        here.close()
        assert watcher.wait() == 0
    assert os.sched_getaffinity(kept) == (ALL if is_restored else {core})
