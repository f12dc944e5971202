# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest
import trident.testing
from trident.testing import Process, eventually, logged_problems, package, program


def start(script: str, folder: Path) -> Process:
    return Process(["sh", "-c", script], os.environ, folder / "log")


def test_a_condition_that_never_holds_is_named() -> None:
    with pytest.raises(AssertionError, match=r"the moon did not happen within 0\.05 s"):
        eventually(lambda: False, "the moon", 0.05)


def test_what_a_condition_raises_ends_the_wait() -> None:
    def broken() -> bool:
        raise RuntimeError("gone")

    with pytest.raises(RuntimeError, match="gone"):
        eventually(broken, "anything")


def test_output_and_exit_code_of_a_process(tmp_path: Path) -> None:
    process = start("echo out; echo err >&2; exit 3", tmp_path)
    assert process.wait() == 3
    assert process.log == "out\nerr\n"
    process.eventually_logs("err")


def test_children_that_ignore_everything_end_with_their_process(tmp_path: Path) -> None:
    process = start("trap '' INT TERM; (setsid sleep 600) & echo up; sleep 600", tmp_path)
    process.eventually_logs("up")
    eventually(lambda: len(process.family()) >= 3, "the children")
    assert process.stop(signal.SIGINT, limit_s=0.2) == -signal.SIGKILL
    eventually(lambda: not process.family(), "the end of all of them", 5.0)


def test_packages_and_programs_that_are_not_there_are_named() -> None:
    assert (package("trident_testing") / "package.xml").is_file()
    assert Path(program("gazebo_ros", "gzserver")).is_file()
    with pytest.raises(AssertionError, match="no package no_such_package"):
        package("no_such_package")
    with pytest.raises(AssertionError, match="gazebo_ros/no_such is not built"):
        program("gazebo_ros", "no_such")


def test_logged_problems_are_warnings_errors_and_tracebacks() -> None:
    log = (
        "[ INFO] fine\n[ WARN] [1.0]: low\n[ERROR] [2.0]: bad\nTraceback (most recent call last)\n"
    )
    assert len(logged_problems(log)) == 3


def test_an_old_name_still_works_and_names_the_new_one() -> None:
    name = "complaints"
    with pytest.warns(FutureWarning, match=r"trident\.testing\.logged_problems now"):
        old = getattr(trident.testing, name)
    assert old is logged_problems
