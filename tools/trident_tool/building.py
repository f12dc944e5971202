# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Configures and builds the catkin workspace. Nothing is done twice."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from trident_tool.workspace import (
    Runner,
    TridentError,
    Workspace,
    base_environment,
    hide_from_crawlers,
    say,
)

_STAMP = ".trident-configured"
# A translation unit that includes Eigen, PCL or roscpp needs about this much memory.
_BYTES_PER_JOB = 1.5e9

# What an earlier sourced workspace would leak into this one.
_LEAKING = ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH", "LD_LIBRARY_PATH")


def build_jobs(cpus: int, memory_bytes: float) -> int:
    """Parallel compilers for a machine with ``cpus`` cores and ``memory_bytes`` of memory."""
    return max(1, min(cpus, int(memory_bytes / _BYTES_PER_JOB)))


def default_jobs() -> int:
    """Parallel compilers on this machine."""
    memory = float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    return build_jobs(len(os.sched_getaffinity(0)), memory)


def configure_command(workspace: Workspace) -> list[str]:
    """The cmake call that configures the workspace."""
    return [
        "cmake",
        "-S",
        str(workspace.root),
        "-B",
        str(workspace.build),
        "-G",
        "Ninja",
        "-DPYTHON_EXECUTABLE=/usr/bin/python3",
        "-DPython3_EXECUTABLE=/usr/bin/python3",
    ]


def package_manifests(workspace: Workspace) -> list[Path]:
    """package.xml of every package in the workspace, sorted; folders with CATKIN_IGNORE are skipped."""
    found: list[Path] = []
    for folder, subfolders, files in os.walk(workspace.root / "src"):
        if "CATKIN_IGNORE" in files:
            subfolders.clear()
        elif "package.xml" in files:
            found.append(Path(folder) / "package.xml")
            subfolders.clear()
    return sorted(found)


def configure_key(workspace: Workspace) -> str:
    """What the configuration depends on beyond the files that ninja itself watches.

    ninja re-runs cmake when a CMakeLists.txt or package.xml changes, but does not see a new package.
    """
    names = [str(path.relative_to(workspace.root)) for path in package_manifests(workspace)]
    return hashlib.sha256("\0".join([*configure_command(workspace), *names]).encode()).hexdigest()


def clean_environment() -> dict[str, str]:
    """The caller's environment without what an earlier sourced workspace put there."""
    env = base_environment()
    for name in _LEAKING:
        env.pop(name, None)
    return env


@contextlib.contextmanager
def _exclusive(workspace: Workspace) -> Iterator[None]:
    """Holds the build folder: two builds at once would overwrite each other's files."""
    with (workspace.build / ".trident-lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say("waiting for another build in this clone")
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _configured_elsewhere(workspace: Workspace) -> bool:
    """Whether build/ was made by a clone at another place (moved or copied): cmake refuses such a folder."""
    cache = workspace.build / "CMakeCache.txt"
    if not cache.is_file():
        return False
    home = f"CMAKE_HOME_DIRECTORY:INTERNAL={workspace.root}\n"
    return home not in cache.read_text(encoding="utf-8", errors="replace")


def configure(workspace: Workspace, runner: Runner) -> None:
    """Runs cmake if the workspace is not configured, has moved, or has other packages than before."""
    stamp = workspace.build / _STAMP
    key = configure_key(workspace)
    if _configured_elsewhere(workspace):
        say("build/ was made at another place, starting afresh")
        if not runner.dry_run:
            shutil.rmtree(workspace.build)
            hide_from_crawlers(workspace.build)
    if (
        (workspace.build / "build.ninja").is_file()
        and stamp.is_file()
        and stamp.read_text(encoding="utf-8") == key
    ):
        return
    command = configure_command(workspace)
    if runner.dry_run:
        runner.run(command)
        return
    say("configuring the workspace")
    log = workspace.build / "configure.log"
    with log.open("wb") as file:
        code = subprocess.run(
            command, env=clean_environment(), stdout=file, stderr=subprocess.STDOUT, check=False
        ).returncode
    if code != 0:
        sys.stderr.write(errors_of_cmake(log.read_text(encoding="utf-8", errors="replace")))
        raise TridentError(f"configuring failed (exit code {code}); all of it is in {log}")
    stamp.write_text(key, encoding="utf-8")


def errors_of_cmake(output: str) -> str:
    """The part of cmake's output from its first error on, or the last lines where it names none."""
    start = output.find("CMake Error")
    return output[start:] if start >= 0 else "\n".join(output.splitlines()[-20:]) + "\n"


def build(
    workspace: Workspace, runner: Runner, targets: Sequence[str] = (), jobs: int | None = None
) -> None:
    """Configures if needed and builds ``targets`` (default: everything but the tests).

    Raises:
        TridentError: cmake or the compiler failed; their own output says why.
    """
    command = ["ninja", "-C", str(workspace.build), f"-j{jobs or default_jobs()}", *targets]
    if runner.dry_run:
        configure(workspace, runner)
        runner.run(command)
        return
    if not os.access(workspace.build, os.W_OK):
        raise TridentError(f"{workspace.build} is not writable: was it built by another user?")
    with _exclusive(workspace):
        configure(workspace, runner)
        runner.check(command, what="building", env=clean_environment())
