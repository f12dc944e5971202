# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The shell scripts, with stand-ins for the programs that they start."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parent.parent / "scripts"


def run(script: str, *arguments: str, path: Path, **env: str) -> subprocess.CompletedProcess[str]:
    """Runs a script with only ``path`` and the system's basic tools to be found."""
    environment = {"PATH": f"{path}:/usr/bin:/bin", "HOME": os.environ.get("HOME", "/tmp"), **env}
    return subprocess.run(
        [str(SCRIPTS / script), *arguments],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=20.0,
        stdin=subprocess.DEVNULL,
    )


def stand_in(folder: Path, name: str, body: str) -> None:
    """Puts a program ``name`` into ``folder``."""
    program = folder / name
    program.write_text(f"#!/bin/sh\n{body}\n")
    program.chmod(0o755)


def test_viewer_without_a_display_says_how_to_look_and_succeeds(tmp_path: Path) -> None:
    result = run("gzclient", "--verbose", "__name:=gazebo_gui", path=tmp_path)
    assert result.returncode == 0
    assert "no display" in result.stdout
    assert "./trident view --screenshot" in result.stdout


def test_viewer_with_a_display_is_rviz_with_our_configuration(tmp_path: Path) -> None:
    (tmp_path / "config" / "rviz").mkdir(parents=True)
    config = tmp_path / "config" / "rviz" / "a.rviz"
    config.touch()
    stand_in(tmp_path, "rospack", f"echo {tmp_path}")
    stand_in(tmp_path, "rviz", 'echo "rviz $*"')
    result = run("gzclient", "--verbose", "__name:=gazebo_gui", path=tmp_path, DISPLAY=":7")
    assert result.stdout == f"rviz -d {config} __name:=gazebo_gui\n"


def test_viewer_without_a_configuration_is_plain_rviz(tmp_path: Path) -> None:
    stand_in(tmp_path, "rospack", f"echo {tmp_path}")
    stand_in(tmp_path, "rviz", 'echo "rviz $*"')
    assert run("gzclient", path=tmp_path, DISPLAY=":7").stdout == "rviz \n"


@pytest.mark.parametrize("code", [0, 3])
def test_gazebo_runs_simulator_and_viewer_and_ends_as_the_simulator_does(
    tmp_path: Path, code: int
) -> None:
    stand_in(tmp_path, "rosrun", f'echo "rosrun $*"; exit {code}')
    result = run("gazebo", "-u", "a.world", path=tmp_path)
    assert result.returncode == code
    assert "rosrun gazebo_ros gzserver -u a.world" in result.stdout


@pytest.mark.parametrize(("script", "tool"), [("debug", "gdb"), ("perf", "perf")])
def test_tools_start_the_simulator_with_its_arguments(
    tmp_path: Path, script: str, tool: str
) -> None:
    stand_in(tmp_path, "gzserver", 'echo "gzserver $*"')
    stand_in(tmp_path, "catkin_find", f"echo {tmp_path}/gzserver")
    stand_in(tmp_path, tool, f'echo "{tool} $*"')
    env = {"PERF_OUTPUT": str(tmp_path / "out.perf")}
    result = run(script, "-u", "a.world", path=tmp_path, **env)
    assert result.returncode == 0, result.stderr
    (line,) = [line for line in result.stdout.splitlines() if line.startswith(f"{tool} ")][-1:]
    assert line.endswith(f"{tmp_path}/gzserver -u a.world")
