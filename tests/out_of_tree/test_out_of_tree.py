# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A package outside adds a sensor with its own message, a SLAM method and a scan matcher."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest
from trident.testing.master import RosProcesses
from trident.testing.waiting import eventually

REPO = Path(__file__).resolve().parents[2]
PACKAGE = Path(__file__).with_name("package")
TOPLEVEL = Path("/usr/share/catkin/cmake/toplevel.cmake")
#: At rest 2 m from the source: 400 / 2^2 counts per second.
WORLD = """<sdf version='1.6'><world name='survey'><gravity>0 0 0</gravity>
<model name='buoy'><pose>2 0 0 0 0 0</pose><link name='hull'><inertial><mass>2</mass><inertia>
<ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link><plugin name='counter'
filename='libradiation_counter.so'><linkName>hull</linkName><rateAt1m>400</rateAt1m></plugin></model>
</world></sdf>"""


@dataclass(frozen=True)
class Workspace:
    """The package's own workspace, on top of one space of this one."""

    root: Path
    setup: Path

    def sourced(self, command: str) -> list[str]:
        """A shell's command with the environment of both."""
        return ["/bin/sh", "-c", f". {shlex.quote(str(self.setup))} && exec {command}"]


def run(command: list[str], env: dict[str, str] | None = None) -> str:
    result = subprocess.run(command, capture_output=True, text=True, check=False, env=env)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def bare_environment() -> dict[str, str]:
    """Without any workspace."""
    kept = ("HOME", "PATH", "LANG", "CCACHE_DIR", "CCACHE_BASEDIR")
    env = {name: value for name, value in os.environ.items() if name in kept}
    parts = env["PATH"].split(":")
    env["PATH"] = ":".join(part for part in parts if not part.startswith(str(REPO)))
    return env


def space_of(name: str) -> Path:
    """The folder of the devel or the install space, the latter brought up to date."""
    build = REPO / "build"
    if name == "devel":
        return build / "devel"
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    prefix = re.search(r"^CMAKE_INSTALL_PREFIX:PATH=(.*)$", cache, re.MULTILINE)
    assert prefix, f"{build} has no install prefix"
    if Path(prefix[1]) != build / "install":
        pytest.skip(f"the install space is {prefix[1]}, outside of the build folder")
    run(["cmake", "--install", str(build)])
    return build / "install"


@pytest.fixture(scope="module", params=["devel", "install"])
def workspace(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Workspace:
    root = tmp_path_factory.mktemp(request.param)
    package = root / "src" / "radiation_survey"
    for path in PACKAGE.rglob("*"):
        if path.is_file():
            copy = package / path.relative_to(PACKAGE).with_name(path.name.removesuffix(".in"))
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, copy)
    (root / "src" / "CMakeLists.txt").symlink_to(TOPLEVEL)
    setup = space_of(request.param) / "setup.sh"
    below = Workspace(root, setup)
    configure = f"cmake -S {root / 'src'} -B {root / 'build'} -GNinja"
    configure += " -DPYTHON_EXECUTABLE=/usr/bin/python3"
    run(below.sourced(configure), bare_environment())
    run(below.sourced(f"ninja -C {root / 'build'} -j2"), bare_environment())
    return Workspace(root, root / "build" / "devel" / "setup.sh")


def test_method_and_matcher_stand_with_those_of_the_package(workspace: Workspace) -> None:
    output = run(workspace.sourced("rosrun radiation_survey centroid_slam"), bare_environment())
    names, centroid, odometry = output.splitlines()
    assert {"centroid", "graph_slam_2d", "odometry"} <= set(names.split())
    assert float(odometry.split()[1]) == pytest.approx(0.5)
    # The mean of points at equal angles is not the room's center: it sees half of the distance.
    assert 0.2 < float(centroid.split()[1]) < 0.6


def test_the_sensor_sends_its_own_message(workspace: Workspace, tmp_path: Path) -> None:
    world = tmp_path / "survey.world"
    world.write_text(WORLD, encoding="utf-8")
    ros = RosProcesses(tmp_path)
    ros.env = {**bare_environment(), **{k: v for k, v in ros.env.items() if k.startswith("ROS_")}}
    try:
        library = workspace.root / "build" / "devel" / "lib"
        server = f"env GAZEBO_PLUGIN_PATH={library} rosrun gazebo_ros gzserver {world}"
        ros.start(workspace.sourced(server))
        listing = workspace.sourced("rostopic type /radiation")
        eventually(lambda: ros.run(listing)[1].strip() == "radiation_survey/Radiation", "the topic")
        code, text = ros.run(workspace.sourced("rostopic echo -n1 -p /radiation/counts_per_second"))
        assert code == 0, text
        assert float(text.split(",")[-1]) == pytest.approx(100.0)
    finally:
        ros.close()
