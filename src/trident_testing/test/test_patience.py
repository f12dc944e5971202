# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from trident import patience
from trident.patience import Patience, Usage, family, rate_of_time, usage_of
from trident.testing.waiting import eventually, output_of


@pytest.mark.parametrize(
    ("ran_s", "waited_s", "rate"),
    [
        (1.0, 0.0, 1.0),  # a quiet machine
        (0.1, 0.9, 0.1),
        (0.2, 3.8, 0.05),  # four threads that compete
        (0.0, 5.0, 0.02),  # starved; every wait ends
        (0.0, 0.0, 1.0),  # it hangs and wants nothing
        (0.001, 0.04, 1.0),
    ],
)
def test_time_counts_as_far_as_the_machine_gives_it(
    ran_s: float, waited_s: float, rate: float
) -> None:
    assert rate_of_time(ran_s, waited_s, 1.0) == pytest.approx(rate)


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    now = [100.0]
    monkeypatch.setattr(patience.time, "monotonic", lambda: now[0])
    return now


def test_a_process_with_a_tenth_of_a_processor_has_ten_times_the_limit(clock: list[float]) -> None:
    usage: Usage = {7: (0, 0)}
    patience = Patience(lambda: dict(usage))
    for second in range(1, 602):
        clock[0] += 1.0
        usage[7] = (second * 100_000_000, second * 900_000_000)
        spent_s = patience.spent_s()
    assert spent_s == pytest.approx(1.0 + 60.0)


def test_what_wants_nothing_reaches_its_limit_as_on_a_quiet_machine(clock: list[float]) -> None:
    patience = Patience(lambda: {7: (5, 5)})
    for _ in range(60):
        clock[0] += 1.0
        spent_s = patience.spent_s()
    assert spent_s == pytest.approx(60.0)


def test_threads_that_come_and_go_take_nothing_away(clock: list[float]) -> None:
    seen: Iterator[Usage] = iter([{1: (10**9, 0)}, {2: (0, 10**9)}, {}, {3: (10**9, 10**9)}])
    patience = Patience(lambda: next(seen))
    spent = []
    for _ in range(4):
        clock[0] += 1.0
        spent.append(patience.spent_s())
    assert spent == pytest.approx([1.0, 1.02, 2.02, 2.52])


def test_the_family_of_a_process_is_found_with_what_it_got() -> None:
    child = subprocess.Popen(
        ["sh", "-c", "sleep 1000 & echo $!; wait"], stdout=subprocess.PIPE, text=True
    )
    assert child.stdout is not None
    grandchild = int(child.stdout.readline())
    try:
        members = family(os.getpid())
        assert {os.getpid(), child.pid, grandchild} <= set(members)
        ran_ns, _ = usage_of([os.getpid()])[os.getpid()]
        assert ran_ns > 0
        assert grandchild in usage_of([grandchild])
    finally:
        os.kill(grandchild, 9)
        child.communicate()


def test_a_wait_without_end_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(AssertionError, match=r"the sky to fall did not happen within 0.3 s"):
        eventually(lambda: False, "the sky to fall", 0.3)
    sleeper = subprocess.Popen(
        [sys.executable, "-c", "print('here', flush=True); import time; time.sleep(1000)"],
        stdout=subprocess.PIPE,
        text=True,
    )
    with pytest.raises(AssertionError, match=r"did not end within 0.1 s:\n(here)?"):
        output_of(sleeper, 0.1)
    assert sleeper.returncode == -9


def test_a_run_of_tests_that_hangs_says_where_and_ends_its_fixtures(tmp_path: Path) -> None:
    (tmp_path / "test_hangs.py").write_text(
        "import pytest, threading\n"
        "@pytest.fixture\n"
        "def open_file():\n    yield\n    print('closed')\n"
        "def test_hangs(open_file):\n    [threading.Event().wait(0.1) for _ in range(100000)]\n"
    )
    command = [sys.executable, "-m", "pytest", "-q", "-s", "-p", "trident.pytest_limit"]
    done = subprocess.run(
        [*command, "-p", "no:cacheprovider", str(tmp_path)],
        env=os.environ | {"TRIDENT_TEST_LIMIT_S": "0.5"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2, done.stdout
    assert "not done after 0.5 s that the machine gave it" in done.stderr
    assert "test_hangs.py" in done.stderr, "where it was"
    assert "closed" in done.stdout


def test_a_process_that_ends_while_it_is_looked_at_has_got_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    own, scandir = f"/proc/{os.getpid()}/task", os.scandir

    def gone(path: str) -> Iterator[os.DirEntry[str]]:
        if str(path) == own:
            raise FileNotFoundError(2, "No such file or directory", own)
        return scandir(path)

    assert usage_of([os.getpid()])
    monkeypatch.setattr(os, "scandir", gone)
    assert usage_of([os.getpid()]) == {}
