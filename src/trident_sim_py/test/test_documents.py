# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""docs/howto/python.md does what it says: its code runs, and is typed."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from documents import EXAMPLES, REPO, code, run_unsourced

import trident_sim

FOUND = Path(trident_sim.__file__).parent


def test_the_module_is_found_without_a_sourced_shell() -> None:
    result = run_unsourced("-c", "import trident_sim; print(trident_sim.__file__)")
    assert result.returncode == 0, f"run ./trident setup first: {result.stderr}"
    assert Path(result.stdout.strip()).parent == FOUND


def test_the_ten_lines_run_without_a_sourced_shell() -> None:
    example = code()
    assert len([line for line in example.splitlines() if line.strip()]) <= 10
    # rosclean, which roslaunch imports, asks Python 3.11's own distutils for one function.
    warnings = ["-W", "error", "-W", "ignore:The distutils package:DeprecationWarning"]
    result = run_unsourced(*warnings, "-c", example)
    assert result.returncode == 0, result.stderr
    assert re.fullmatch(r"[0-9.]+ s \[.*\] [0-9a-f]{64}\n", result.stdout), result.stdout


def test_they_give_the_same_hash_in_a_sourced_shell() -> None:
    here = subprocess.run(
        [sys.executable, "-c", code()], capture_output=True, text=True, check=True
    )
    assert run_unsourced("-c", code()).stdout == here.stdout


def test_what_the_shell_has_set_stays() -> None:
    command = "import os, trident_sim; print(os.environ['ROS_PACKAGE_PATH'])"
    env = os.environ | {"ROS_PACKAGE_PATH": "/mine"}
    result = subprocess.run(
        [sys.executable, "-c", command], env=env, capture_output=True, text=True, check=True
    )
    assert result.stdout == "/mine\n"


def test_the_tests_of_the_page_pass(tmp_path: Path) -> None:
    (tmp_path / "conftest.py").write_text(code("conftest"), encoding="utf-8")
    (tmp_path / "test_hover.py").write_text(code("test"), encoding="utf-8")
    result = run_unsourced(
        *("-m", "pytest", "-q", "--strict-markers", "-p", "no:cacheprovider", "."), cwd=tmp_path
    )
    assert result.returncode == 0, result.stdout
    assert "2 passed" in result.stdout


@pytest.mark.parametrize("label", ["", "test"])
def test_the_code_of_the_page_is_well_typed(tmp_path: Path, label: str) -> None:
    """By the stubs that a user's mypy finds, not by the sources."""
    file = tmp_path / "program.py"
    file.write_text(code(label), encoding="utf-8")
    result = run_unsourced(
        "-m", "mypy", "--strict", f"--cache-dir={tmp_path}", "program.py", cwd=tmp_path
    )
    assert result.returncode == 0, result.stdout


def test_a_wrong_type_is_found(tmp_path: Path) -> None:
    (tmp_path / "program.py").write_text(
        "import trident_sim\n"
        "world = trident_sim.World('w', seed='one')\n"
        "world.model('UAV1').positon\n"
        "trident_sim.WindSample(velocity=3)\n",
        encoding="utf-8",
    )
    result = run_unsourced(
        "-m", "mypy", "--strict", f"--cache-dir={tmp_path}", "program.py", cwd=tmp_path
    )
    assert "Found 3 errors" in result.stdout, result.stdout


def test_the_examples_are_well_typed(tmp_path: Path) -> None:
    files = sorted(map(str, EXAMPLES.glob("*.py")))
    assert files
    config = f"--config-file={REPO / 'pyproject.toml'}"
    result = run_unsourced("-m", "mypy", config, f"--cache-dir={tmp_path}", *files, cwd=tmp_path)
    assert result.returncode == 0, result.stdout
