# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A user's workspace on top of this one builds and runs its own small package."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

OVERLAY = Path(__file__).with_name("overlay")
TOPLEVEL = Path("/usr/share/catkin/cmake/toplevel.cmake")


def run(command: list[str]) -> str:
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("overlay")
    package = root / "src" / "overlay_example"
    package.mkdir(parents=True)
    for path in OVERLAY.iterdir():
        shutil.copy(path, package / path.name.removesuffix(".in"))
    (root / "src" / "CMakeLists.txt").symlink_to(TOPLEVEL)
    run(
        [
            "cmake",
            f"-S{root / 'src'}",
            f"-B{root / 'build'}",
            "-GNinja",
            "-DPYTHON_EXECUTABLE=/usr/bin/python3",
        ]
    )
    run(["ninja", "-j1", "-C", str(root / "build")])
    return root


@pytest.mark.skipif(not TOPLEVEL.is_file(), reason=f"catkin is not in {TOPLEVEL.parent}")
class TestOverlay:
    def test_program_uses_messages_and_conversions(self, workspace: Path) -> None:
        expected = ["command/trajectory", "1", "2", "3", "0.5", "overlay", "4"]
        program = workspace / "build" / "devel" / "lib" / "overlay_example" / "waypoint"
        assert run([str(program)]).split() == expected

    def test_both_workspaces_are_found_from_the_overlay(self, workspace: Path) -> None:
        script = f". {workspace}/build/devel/setup.sh && rospack find overlay_example && "
        script += "rospack find rotors_gazebo && rospack find rotors_description"
        folders = [Path(line) for line in run(["/bin/sh", "-c", script]).splitlines()]
        assert folders[0] == workspace / "src" / "overlay_example"
        assert (folders[1] / "launch" / "spawn_mav.launch").is_file()
        assert (folders[2] / "urdf" / "mav_generic_odometry_sensor.gazebo").is_file()
