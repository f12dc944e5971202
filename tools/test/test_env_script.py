# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""env.sh of the devel space: its arguments are those of the command, and of nothing else."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from trident_tool.workspace import Workspace

WORKSPACE = Workspace.of_this_file()
ENV_SH = WORKSPACE.devel / "env.sh"

pytestmark = pytest.mark.skipif(not ENV_SH.is_file(), reason="the workspace is not configured")


def _run(script: Path, *words: str) -> subprocess.CompletedProcess[str]:
    env = {"PATH": "/usr/bin:/bin", "HOME": os.environ.get("HOME", "/")}
    command = [str(script), *words]
    return subprocess.run(command, env=env, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("words", [["--help"], ["--local"], ["--extend", "-h"], ["a b", "*", ""]])
def test_all_arguments_go_to_the_command_as_they_are(words: list[str]) -> None:
    program = "import sys; print(sys.argv[1:])"
    done = _run(ENV_SH, "/usr/bin/python3", "-c", program, *words)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == f"{words}\n"


def test_the_command_runs_in_the_workspace_and_gives_its_exit_code() -> None:
    done = _run(ENV_SH, "sh", "-c", 'echo "$CMAKE_PREFIX_PATH"; exit 7')
    assert done.returncode == 7
    assert done.stdout.strip().split(":")[0] == str(WORKSPACE.devel)


def test_the_installed_script_is_the_same_wherever_it_is(tmp_path: Path) -> None:
    installed = WORKSPACE.build / "catkin_generated" / "installspace" / "env.sh"
    assert installed.read_text() == ENV_SH.read_text()
    assert os.access(installed, os.X_OK)
    shutil.copy(installed, tmp_path)
    (tmp_path / "setup.sh").write_text('export SEEN="$#"\n')
    assert _run(tmp_path / "env.sh", "printenv", "SEEN").stdout == "0\n"


def test_without_a_command_it_says_how_to_call_it() -> None:
    done = _run(ENV_SH)
    assert (done.returncode, done.stderr) == (1, "Usage: env.sh COMMAND [ARGUMENT ...]\n")
