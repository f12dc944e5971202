# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from trident_eval.core.errors import EvalError
from trident_eval.core.sweep.jobs import Job
from trident_eval.core.sweep.rows import DONE, FAILED, RunRow, read_row
from trident_eval.sweep.carry_out import OUTPUT, run_folder
from trident_eval.sweep.local_engine import LocalEngine

HERE = Path(__file__).parent
Engine = Callable[..., LocalEngine]


@pytest.fixture(autouse=True)
def subjects_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """By this process and by those that it starts."""
    path = os.pathsep.join([str(HERE), *filter(None, sys.path)])
    monkeypatch.setenv("PYTHONPATH", path)


@pytest.fixture
def engine(tmp_path: Path) -> Iterator[Engine]:
    """Starts engines, and ends them."""
    started = []

    def start(subject: str = "subjects:odd", workers: int = 2) -> LocalEngine:
        started.append(LocalEngine(tmp_path, subject, workers))
        return started[-1]

    yield start
    for one in started:
        one.close()


def job(how: str, time_s: float = 60.0, memory_mb: float = 0.0) -> Job:
    return Job(
        how.ljust(64, "0"), 0, "subjects:odd", {"how": how}, 1, time_s, memory_mb, ("score",)
    )


def outcome(engine: LocalEngine, folder: Path, one: Job) -> RunRow:
    """Carries one job out."""
    engine.submit(one)
    while one.key not in engine.as_completed(60.0):
        pass
    row = read_row(folder, one.key)
    assert row is not None
    return row


def test_what_a_run_prints_and_writes_is_kept_in_its_folder(engine: Engine, tmp_path: Path) -> None:
    one = job("write")
    row = outcome(engine(), tmp_path, one)
    assert (row.status, row.metrics) == (DONE, {"score": 1.0})
    folder = run_folder(tmp_path, one.key)
    assert (folder / OUTPUT).read_text() == "a word\n"
    assert (folder / "note.txt").read_text() == "kept"


@pytest.mark.parametrize(
    ("how", "reason"),
    [
        ("crash", "ended by SIGSEGV"),
        ("raise", "RuntimeError: no luck (subjects.py:"),
        ("exit", "ended with exit code 3 and no result"),
        ("sys_exit", "it has called exit(5)"),
        ("nothing", "the result is a NoneType; legal: {metric: number}"),
        ("missing", "score: not in the result, which has other"),
        ("nan", "score: nan; legal: a finite number"),
        ("text", "score: 'high'; legal: a finite number"),
        ("die", "killed by SIGKILL, 4 times"),
    ],
)
def test_a_run_that_goes_wrong_is_a_row_with_a_reason(
    engine: Engine, tmp_path: Path, how: str, reason: str
) -> None:
    row = outcome(engine(), tmp_path, job(how))
    assert row.status == FAILED
    assert row.reason.startswith(reason)
    assert row.metrics == {}


def test_a_run_that_hangs_is_ended_with_all_that_it_has_started(
    engine: Engine, tmp_path: Path
) -> None:
    one = job("hang", time_s=2.0)
    row = outcome(engine(), tmp_path, one)
    assert row.reason == "it took longer than 2 s"
    child = int((run_folder(tmp_path, one.key) / "child").read_text())
    status = Path(f"/proc/{child}/status")
    assert not status.exists() or "zombie" in status.read_text()


def test_memory_is_limited(engine: Engine, tmp_path: Path) -> None:
    row = outcome(engine(), tmp_path, job("fill", memory_mb=1000))
    assert row.reason == "MemoryError; limit: 1000 MB"


def test_a_run_that_somebody_kills_is_made_again(engine: Engine, tmp_path: Path) -> None:
    assert outcome(engine(), tmp_path, job("die_once")).metrics == {"score": 3.0}


def test_runs_continue_after_the_fork_server_was_killed(engine: Engine, tmp_path: Path) -> None:
    one = engine()
    slow = [job(f"hang{i}", time_s=1.0) for i in range(2)]
    jobs = [Job(s.key, 0, s.subject, {"how": "hang"}, 1, 1.0, 0.0, s.metrics) for s in slow]
    for each in jobs:
        one.submit(each)
    os.kill(one._process.pid, signal.SIGKILL)
    ended: Counter[str] = Counter()
    while sum(ended.values()) < len(jobs):
        ended.update(one.as_completed(60.0))
    assert set(ended.values()) == {1}


def test_cancelled_runs_leave_no_row(engine: Engine, tmp_path: Path) -> None:
    one = engine()
    one.submit(job("hang"))
    one.cancel()
    assert read_row(tmp_path, job("hang").key) is None
    assert outcome(one, tmp_path, job("write")).status == DONE


@pytest.mark.parametrize(
    ("subject", "message"),
    [
        ("nowhere_to_be_found:run", "ModuleNotFoundError"),
        ("subjects:missing_function", "has no function missing_function"),
    ],
)
def test_a_subject_that_is_not_there_is_refused_at_once(
    engine: Engine, subject: str, message: str
) -> None:
    with pytest.raises(EvalError, match=message):
        engine(subject)


def test_a_fork_server_ends_with_the_one_that_has_started_it(tmp_path: Path) -> None:
    script = (
        "import sys, os, pathlib\n"
        "from trident_eval.sweep.local_engine import LocalEngine\n"
        f"engine = LocalEngine(pathlib.Path({str(tmp_path)!r}), 'subjects:odd', 1)\n"
        "print(engine._process.pid, flush=True)\n"
        "os.kill(os.getpid(), 9)\n"
    )
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, check=False)
    pidfd = None
    try:
        pidfd = os.pidfd_open(int(run.stdout))
    except ProcessLookupError:
        return
    import select

    assert select.select([pidfd], [], [], 60.0)[0], "it is still there"
    os.close(pidfd)
