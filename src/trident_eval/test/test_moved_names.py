# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What was once in this package is found by its old name."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import warnings
from pathlib import Path

import pytest
from trident_eval.moved_names import NEW_NAMES

SCRIPTS = Path(__file__).parents[1] / "scripts"
MOVED = [path for path in sorted(SCRIPTS.glob("*.py")) if "start_moved_node" in path.read_text()]


@pytest.mark.parametrize("old", NEW_NAMES)
def test_a_module_has_moved_to_where_there_is_one(old: str) -> None:
    assert importlib.util.find_spec(NEW_NAMES[old]) is not None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert importlib.util.find_spec(old) is not None


@pytest.mark.parametrize("script", MOVED, ids=lambda path: path.name)
def test_a_node_becomes_that_of_its_new_package(script: Path, tmp_path: Path) -> None:
    (tmp_path / "rosrun").write_text('#!/bin/sh\necho "$@"\n')
    (tmp_path / "rosrun").chmod(0o755)
    env = os.environ | {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
    command = [sys.executable, str(script), "--at", "3", "__name:=it"]
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=True)
    package = done.stdout.partition(" ")[0]
    assert done.stdout == f"{package} {script.name} --at 3 __name:=it\n"
    assert (SCRIPTS.parents[1] / package / "scripts" / script.name).is_file()
    assert f"rosrun {package} {script.name}" in done.stderr
