# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The shell scripts, with stand-ins for the programs that they start."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from trident.testing.waiting import eventually

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


@pytest.fixture
def viewer(tmp_path: Path) -> Path:
    """Stand-ins of rviz, which ends at once, and of the node next to it, which does not."""
    stand_in(tmp_path, "rospack", f"echo {tmp_path}")
    until_node = f"while [ ! -e {tmp_path}/node ]; do sleep 0.01; done"
    stand_in(tmp_path, "rviz", f'echo "rviz $*"; {until_node}; exit ${{RVIZ_CODE:-0}}')
    trap = 'trap "echo ended >>$0.log; exit" TERM'
    wait = "while :; do sleep 0.01; done"
    stand_in(tmp_path, "rosrun", f'echo "$*" >$0.log; {trap}; touch {tmp_path}/node; {wait}')
    return tmp_path


def test_viewer_with_a_display_is_rviz_with_our_configuration(viewer: Path) -> None:
    (viewer / "config" / "rviz").mkdir(parents=True)
    for name in ("a.rviz", "b.rviz"):
        (viewer / "config" / "rviz" / name).touch()
    result = run("gzclient", "--verbose", "__name:=gazebo_gui", path=viewer, DISPLAY=":7")
    config = viewer / "config" / "rviz" / "a.rviz"
    assert result.stdout == f"rviz -d {config} __name:=gazebo_gui\n"


def test_viewer_without_a_configuration_is_plain_rviz(viewer: Path) -> None:
    assert run("gzclient", path=viewer, DISPLAY=":7").stdout == "rviz \n"


@pytest.mark.parametrize("code", [0, 3])
def test_the_markers_of_the_fleet_end_with_the_viewer(viewer: Path, code: int) -> None:
    result = run("gzclient", path=viewer, DISPLAY=":7", RVIZ_CODE=str(code))
    assert result.returncode == code
    log = viewer / "rosrun.log"
    eventually(lambda: "ended" in log.read_text(), "the end of the markers")
    assert log.read_text() == "trident_viewer fleet_markers.py\nended\n"


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
