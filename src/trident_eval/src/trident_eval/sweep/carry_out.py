# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""One run, in the process that was made for it."""

from __future__ import annotations

import contextlib
import ctypes
import importlib
import os
import resource
import signal
import socket
import sys
import time
import traceback
from collections.abc import Callable, Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from trident_eval.core.errors import EvalError
from trident_eval.core.sweep.jobs import Job
from trident_eval.core.sweep.rows import DONE, FAILED, RunRow, checked_metrics, write_row
from trident_eval.sweep.launches import LAUNCH, run_launch

OUTPUT = "output.txt"
CANNOT_WRITE = 74  # exit code of a run whose row cannot be written (EX_IOERR)
_PR_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None, use_errno=True)

Function = Callable[[Mapping[str, Any], int, Path], Mapping[str, float]]


def run_folder(folder: Path, key: str) -> Path:
    """Where a run may write."""
    return folder / "runs" / key[:16]


def load_function(subject: str) -> Function:
    """The function of a job's subject.

    Raises:
        EvalError: there is no such module or function.
    """
    if subject.startswith(LAUNCH):
        return run_launch(subject.removeprefix(LAUNCH).split())
    module_name, _, name = subject.partition(":")
    try:
        module = importlib.import_module(module_name)
    except Exception as error:
        raise EvalError(f"{subject}: {type(error).__name__}: {error}; legal: a module") from error
    function = getattr(module, name, None)
    if not callable(function):
        raise EvalError(f"{subject}: {module.__file__} has no function {name}")
    found: Function = function
    return found


def carry_out(job: Job, folder: Path, gate: socket.socket) -> None:
    """Carries a job out, writes its row, and ends this process.

    Args:
        job: the run.
        folder: of the sweep.
        gate: a byte comes when the run may begin; shut down when it is over.
    """
    _ends_with_parent()
    here = run_folder(folder, job.key)
    try:
        here.mkdir(parents=True, exist_ok=True)
        _redirect_output(here / OUTPUT)
        if not gate.recv(1):
            os._exit(0)  # nobody wants it any more
        _limit_memory(job.memory_mb)
        row = _row_of(job, here)
        with contextlib.suppress(OSError):
            gate.shutdown(socket.SHUT_RDWR)  # a child of the run may have it, too
        sys.stdout.flush()
        sys.stderr.flush()
        _remove_if_empty(here)
        write_row(folder, row)
    except OSError as error:
        os.write(2, f"{error}\n".encode())
        os._exit(CANNOT_WRITE)
    os._exit(0)


def failed_row(job: Job, reason: str, started: str, elapsed_s: float) -> RunRow:
    """The row of a run that has ended without one."""
    return RunRow(
        job.key, job.point, job.seed, job.parameters, FAILED, reason, {}, started, elapsed_s, 0.0,
        0.0, worker_name(),
    )  # fmt: skip


def worker_name() -> str:
    """Host and process."""
    return f"{socket.gethostname()}:{os.getpid()}"


def now_text() -> str:
    """The wall-clock time."""
    return datetime.now().astimezone().isoformat(timespec="milliseconds")


def _row_of(job: Job, here: Path) -> RunRow:
    started, begin = now_text(), time.monotonic()
    metrics: Mapping[str, float] = {}
    status, reason = DONE, ""
    try:
        result = load_function(job.subject)(dict(job.parameters), job.seed, here)
        metrics = checked_metrics(result, job.metrics)
    except EvalError as error:
        status, reason = FAILED, str(error)
    except MemoryError:
        status, reason = FAILED, f"MemoryError; limit: {job.memory_mb:g} MB"
    except SystemExit as error:
        status, reason = FAILED, f"it has called exit({error.code!r})"
    except Exception as error:
        traceback.print_exc()
        status, reason = FAILED, _first_line(error)
    own, children = (
        resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    cpu_s = own.ru_utime + own.ru_stime + children.ru_utime + children.ru_stime
    memory_mb = max(own.ru_maxrss, children.ru_maxrss) / 1024
    elapsed_s = round(time.monotonic() - begin, 6)
    return RunRow(
        job.key, job.point, job.seed, job.parameters, status, reason, metrics, started, elapsed_s,
        round(cpu_s, 6), round(memory_mb, 1), worker_name(),
    )  # fmt: skip


def _first_line(error: Exception) -> str:
    place = traceback.extract_tb(error.__traceback__)[-1]
    lines = str(error).splitlines() or [""]
    return f"{type(error).__name__}: {lines[0][:200]} ({Path(place.filename).name}:{place.lineno})"


def _ends_with_parent() -> None:
    os.setpgid(0, 0)
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _redirect_output(path: Path) -> None:
    nothing = os.open(os.devnull, os.O_RDONLY)
    output = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
    os.dup2(nothing, 0)
    os.dup2(output, 1)
    os.dup2(output, 2)


def _limit_memory(memory_mb: float) -> None:
    """Of what the process writes to (RLIMIT_DATA): libraries that are mapped do not count."""
    if memory_mb > 0:
        size = int(memory_mb * 1024 * 1024)
        resource.setrlimit(resource.RLIMIT_DATA, (size, size))


def _remove_if_empty(here: Path) -> None:
    output = here / OUTPUT
    if output.stat().st_size == 0:
        output.unlink()
    if not any(here.iterdir()):
        here.rmdir()
