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
_BUILT_STAMP = ".trident-built"
# A translation unit that includes Eigen, PCL or roscpp needs about this much memory.
_BYTES_PER_JOB = 1.5e9

# What an earlier sourced workspace would leak into this one.
_LEAKING = ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH", "LD_LIBRARY_PATH")


def _shared_compiler_cache(workspace: Workspace) -> dict[str, str]:
    """What lets ccache serve one clone with what it compiled for another."""
    return {"CCACHE_BASEDIR": str(workspace.root), "CCACHE_NOHASHDIR": "1"}


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
    """package.xml of every package in the workspace, sorted; CATKIN_IGNORE is respected."""
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

    ninja re-runs cmake when a CMakeLists.txt or package.xml changes, but misses a new package.
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
    """Whether build/ was made at another place (moved or copied), which cmake refuses."""
    cache = workspace.build / "CMakeCache.txt"
    if not cache.is_file():
        return False
    home = f"CMAKE_HOME_DIRECTORY:INTERNAL={workspace.root}\n"
    return home not in cache.read_text(encoding="utf-8", errors="replace")


def configure(workspace: Workspace, runner: Runner) -> None:
    """Runs cmake if the workspace is not configured, has moved, or has other packages."""
    key = configure_key(workspace)
    if _configured_elsewhere(workspace):
        say("build/ was made at another place, building from scratch")
        if not runner.dry_run:
            shutil.rmtree(workspace.build)
            hide_from_crawlers(workspace.build)
    if _is_configured(workspace, key):
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
    (workspace.build / _STAMP).write_text(key, encoding="utf-8")


def _is_configured(workspace: Workspace, key: str) -> bool:
    """Whether build/ was configured with just this ``configure_key``."""
    stamp = workspace.build / _STAMP
    is_complete = (workspace.build / "build.ninja").is_file() and stamp.is_file()
    return is_complete and stamp.read_text(encoding="utf-8") == key


def errors_of_cmake(output: str) -> str:
    """The part of cmake's output from its first error on, or the last lines where it names none."""
    start = output.find("CMake Error")
    return output[start:] if start >= 0 else "\n".join(output.splitlines()[-20:]) + "\n"


def source_key(workspace: Workspace, targets: Sequence[str]) -> str:
    """Digest of what a build of ``targets`` depends on: names, sizes and times of the files.

    ninja alone cannot detect that there is nothing to do, because genmsg's checks always run.
    Debian's package state stands for the libraries and headers outside the clone.
    """
    digest = hashlib.sha256("\0".join([configure_key(workspace), *targets]).encode())
    outside = Path("/var/lib/dpkg/status")
    for path in (workspace.root / "CMakeLists.txt", outside, *_sources(workspace.root)):
        with contextlib.suppress(FileNotFoundError):  # an editor's file that has just gone
            state = path.lstat()
            digest.update(f"{path}\0{state.st_size}\0{state.st_mtime_ns}\0".encode())
    return digest.hexdigest()


def _sources(root: Path) -> Iterator[Path]:
    """Every file that a build may read, in a fixed order."""
    for top in ("cmake", "src", "tests"):
        for folder, subfolders, files in os.walk(root / top):
            subfolders[:] = sorted(name for name in subfolders if name != "__pycache__")
            yield from (Path(folder, name) for name in sorted(files))


def _is_built(workspace: Workspace, key: str) -> bool:
    stamp = workspace.build / _BUILT_STAMP
    return (
        (workspace.devel / "setup.sh").is_file()
        and stamp.is_file()
        and key in stamp.read_text(encoding="utf-8").splitlines()
    )


def _remember_built(workspace: Workspace, key: str) -> None:
    """Adds ``key`` to the last few: building one target does not undo another."""
    stamp = workspace.build / _BUILT_STAMP
    known = stamp.read_text(encoding="utf-8").splitlines() if stamp.is_file() else []
    stamp.write_text("\n".join([*known[-7:], key]) + "\n", encoding="utf-8")


def is_built(workspace: Workspace, targets: Sequence[str] = ()) -> bool:
    """Whether nothing has changed since ``targets`` (default: all) were built."""
    return _is_built(workspace, source_key(workspace, targets))


def make_configured(workspace: Workspace, runner: Runner) -> None:
    """Configures the workspace if needed, and builds nothing."""
    if not os.access(workspace.build, os.W_OK):
        raise TridentError(f"{workspace.build} is not writable: was it built by another user?")
    with _exclusive(workspace):
        configure(workspace, runner)


def build(
    workspace: Workspace, runner: Runner, targets: Sequence[str] = (), jobs: int | None = None
) -> bool:
    """Configures if needed and builds ``targets`` (default: everything but the tests).

    Returns:
        Whether there was anything to do.

    Raises:
        TridentError: cmake or the compiler failed; their own output says why.
    """
    key = source_key(workspace, targets)
    if _is_built(workspace, key):
        return False
    command = ["ninja", "-C", str(workspace.build), f"-j{jobs or default_jobs()}", *targets]
    if runner.dry_run:
        configure(workspace, runner)
        runner.run(command)
        return True
    if not os.access(workspace.build, os.W_OK):
        raise TridentError(f"{workspace.build} is not writable: was it built by another user?")
    with _exclusive(workspace):
        configure(workspace, runner)
        # stdout belongs to the command that is run after the build.
        env = clean_environment() | _shared_compiler_cache(workspace)
        runner.check(command, what="building", env=env, stdout=sys.stderr)
        _remember_built(workspace, key)
    return True
