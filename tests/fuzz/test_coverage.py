# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Every program that is a node is treated by some test of this folder."""

from __future__ import annotations

import importlib
import re
import subprocess
from functools import cache
from pathlib import Path

import pytest
from hostile import started
from trident.testing import Ros, eventually, program
from trident.testing.fuzz import Target

HERE = Path(__file__).parent
_INSTALL = re.compile(
    r'file\(INSTALL DESTINATION "\$\{CMAKE_INSTALL_PREFIX\}/lib/([^/"]+)"'
    r" TYPE (?:EXECUTABLE|PROGRAM)(?: OPTIONAL)? FILES([^)]*)\)"
)
_LINKED = re.compile(r"^build devel/lib/([^/ ]+)/([^/ :|]+)[^:]*: CXX_EXECUTABLE_LINKER", re.M)
#: What development builds, and no user starts: unit tests, benchmarks and parts of tests.
_OF_DEVELOPMENT = re.compile(r"/\w+(_test|_benchmark|_check|_round_trip)$")

#: Nodes that hear nothing and serve nothing, which a test below asks them.
DEAF = {"trident_nav/platform_frames.py": "publishes parameters once, on /tf_static"}
#: Nodes that hear a device or a socket alone: tests of their packages feed them hostile bytes.
OF_DEVICES = {
    "nmea_navsat_driver/nmea_serial_driver": "a serial line",
    "nmea_navsat_driver/nmea_socket_driver": "datagrams",
    "nmea_navsat_driver/nmea_topic_serial_reader": "a serial line",
    "trident_bridges/nmea_log.py": "a server, whose bytes it writes as they are",
}
#: Programs that are no nodes although they may use a node's libraries.
NO_NODES = {
    "gazebo_ros/debug": "a shell script that starts gzserver in a debugger",
    "gazebo_ros/gazebo": "a shell script that starts gzserver",
    "gazebo_ros/gzclient": "a shell script without a node",
    **{
        f"mavros/{name}": "asks what mavros_node serves once, and ends"
        for name in ("checkid", "mavcmd", "mavparam", "mavsafety", "mavsys", "mavwp")
    },
    "gazebo_ros/perf": "a shell script that starts gzserver in a profiler",
    "trident_benchmarks/nav_drive_pains": "reads scenes from a file; never calls ros::init",
    "trident_benchmarks/nav_people": "reads crossings from a file; never calls ros::init",
    "trident_benchmarks/nav_trial": "reads a task from a file; never calls ros::init",
    "trident_benchmarks/trajectory_trial": "plans teams of its own; never calls ros::init",
    "trident_eval/fleet_markers.py": "becomes trident_viewer's",
    "trident_eval/hold_at.py": "becomes trident_viewer's",
    "trident_eval/mavlink_demo.py": "speaks MAVLink to a port; never knows a master",
    "trident_eval/observer.py": "becomes trident_viewer's",
    "trident_eval/overview.py": "becomes trident_viewer's",
    "trident_eval/slam_tour.py": "becomes trident_benchmarks'",
    "trident_bridges/modbus_tool": "reads map files, or a device; never calls ros::init",
    "trident_bridges/sitl_program.py": "becomes the program of an autopilot",
    "trident_bridges/latency_probe": "measures a topic for ./trident latency, and ends",
    "trident_eval/latency_test.py": "measures its own topic, and ends with Ctrl-C",
    "trident_slam/slam_offline_bag": "reads a file; never calls ros::init",
    "trident_testing/fuzz_node": "is the fuzzer",
}


@cache
def build_folder() -> Path:
    """Of the workspace that is sourced."""
    return Path(program("trident_testing", "fuzz_node")).parents[3]


def programs() -> set[str]:
    """Package/program of all that the packages install for rosrun, or link for it."""
    found = set()
    for file in build_folder().rglob("cmake_install.cmake"):
        for package, files in _INSTALL.findall(file.read_text(encoding="utf-8")):
            found |= {f"{package}/{Path(name).name}" for name in re.findall(r'"([^"]+)"', files)}
    ninja = (build_folder() / "build.ninja").read_text(encoding="utf-8")
    found |= {f"{package}/{name}" for package, name in _LINKED.findall(ninja)}
    return {name for name in found if not _OF_DEVELOPMENT.search(name)}


def knows_ros(name: str) -> bool:
    """Whether a program is a script, or is linked with roscpp."""
    try:
        path = Path(program(*name.split("/")))
    except AssertionError:
        return True  # a script that the devel space does without
    if not path.read_bytes().startswith(b"\x7fELF"):
        return True
    linked = subprocess.run(["ldd", path], capture_output=True, text=True, check=True).stdout
    return "libroscpp" in linked


def treated() -> set[str]:
    """Package/program of the marks of all tests."""
    found = set()
    for file in HERE.glob("test_*.py"):
        module = importlib.import_module(file.stem)
        for test in vars(module).values():
            marks = getattr(test, "pytestmark", [])
            found |= {name for mark in marks if mark.name == "fuzzes" for name in mark.args}
    return found


def test_every_node_is_treated_by_a_fuzz_test() -> None:
    nodes = {name for name in programs() if knows_ros(name)}
    assert len(nodes) > 30
    missing = nodes - treated() - set(DEAF) - set(NO_NODES) - set(OF_DEVICES)
    assert not missing, f"nodes without a fuzz test: {sorted(missing)}"


def test_what_is_treated_or_excepted_is_there() -> None:
    gone = (treated() | set(DEAF) | set(NO_NODES) | set(OF_DEVICES)) - programs()
    assert not gone, f"no programs of these names: {sorted(gone)}"
    both = treated() & (set(DEAF) | set(NO_NODES) | set(OF_DEVICES))
    assert not both, f"treated, and excepted: {sorted(both)}"


@pytest.mark.parametrize("name", DEAF)
def test_a_deaf_node_hears_and_serves_nothing(ros: Ros, name: str) -> None:
    process = started(ros, "/deaf", [program(*name.split("/")), "__name:=deaf"])
    target = Target("/deaf")
    eventually(lambda: bool(target.publications()), "what it publishes")
    assert not target.subscriptions()
    assert not target.services()
    assert process.running
