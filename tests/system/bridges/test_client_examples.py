# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Examples of PX4 and MAVSDK, unchanged, fly a simulated iris that speaks as PX4 does.

They are no part of this repository: CLIENT_EXAMPLES names a folder, and what is found there is run,
however deep it lies. docs/howto/mavlink.md says how.
"""

from __future__ import annotations

import math
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from nav_msgs.msg import Odometry
from trident.testing import Launch, Recorder, eventually, recorder
from trident.testing.clients import clients_python
from trident.testing.mavlink_vehicles import entry, write_vehicles

PORT = 14540  # where the examples listen
URL = f"udpin://127.0.0.1:{PORT}"
#: On the earth and in the world the iris stands where PX4's simulated one does.
LAUNCH = """<launch>
  <include file="$(find trident_bringup)/launch/cross_domain.launch">
    <arg name="world" value="basic"/>
    <arg name="ugvs" value="0"/>
    <arg name="usvs" value="0"/>
    <arg name="pilot" value="mavlink"/>
    <arg name="batteries" value="true"/>
    <arg name="uav_x" value="0"/>
    <arg name="uav_y" value="0"/>
    <arg name="uav_z" value="0.1"/>
    <arg name="uav_lidar" value="false"/>
    <arg name="uav_camera" value="false"/>
    <arg name="uav_gnss" value="false"/>
    <arg name="real_time_factor" value="{factor}"/>
  </include>
  <include file="$(find trident_bringup)/launch/links/mavlink.launch">
    <arg name="vehicles" value="{vehicles}"/>
    <arg name="latitude" value="47.397742"/>
    <arg name="longitude" value="8.545594"/>
    <arg name="altitude" value="488"/>
  </include>
  <include if="{mavros}" file="$(find mavros)/launch/px4.launch">
    <arg name="fcu_url" value="udp://:{port}@localhost:{far}"/>
  </include>
</launch>
"""
#: Examples for what no vehicle here has, or that need more than a vehicle, by words of names.
NOT_OURS = (
    "calibration", "camera", "do_orbit", "failure", "follow_me", "ftp", "gimbal", "gripper",
    "logfile", "px4_ev", "rtk", "shell", "show_debug", "transponder", "upload_params", "winch",
)  # fmt: skip
#: Of mavsdk.System: they run until somebody ends them.
ENDLESS = ("goto", "highres_imu", "manual_control", "mavlink_direct_receive", "telemetry",
           "telemetry_flight_mode", "telemetry_is_armed_is_in_air",
           "telemetry_status_text")  # fmt: skip
#: Words after the address, for those that take an address.
WORDS = {"params": ["get_all"]}
#: Where an example must have been: x, y, z [m].
PLACES = {
    "offb_node": [(0.0, 0.0, 2.0)],
    "offboard_position_ned": [(0.0, 0.0, 5.0), (0.0, 5.0, 5.0), (10.0, 5.0, 5.0)],
    "goto": [(-190.9, -15.1, 20.0)],
}
NEAR_M = 0.5
ENOUGH_LINES = 3
SILENT = "telemetry_status_text"  # a vehicle that stands says nothing
LIMIT_S = 300.0
FLIES = re.compile(r"\.takeoff\(\)|\.start_mission\(\)|offboard\.start\(\)")
ENDS = re.compile(r"\.land\(\)|return_to_launch(?:\(\)|_after_mission\(True\))|offboard\.stop\(\)")
USES_MAVSDK = re.compile(r"^(from|import) mavsdk\b", re.MULTILINE)
USES_SYSTEM = re.compile(r"^from mavsdk import .*\bSystem\b", re.MULTILINE)  # of MAVSDK 3
USES_ASYNC_MAVSDK = re.compile(r"^(from|import) aiomavsdk\b", re.MULTILINE)  # not on PyPI


def found() -> Iterator[Path]:
    """Examples in the folder."""
    folder = os.environ.get("CLIENT_EXAMPLES")
    for path in sorted(Path(folder).rglob("*")) if folder else ():
        if path.suffix not in (".py", ".cpp") or ".venv" in path.parts:
            continue
        text = path.read_text(encoding="utf-8")
        is_known = path.stem == "offb_node" or (
            USES_MAVSDK.search(text) and not USES_ASYNC_MAVSDK.search(text)
        )
        if is_known and not any(word in path.stem for word in NOT_OURS):
            yield path


def compiled(source: Path, folder: Path) -> Path:
    """A node, built with the messages of this workspace."""
    result = folder / source.stem
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    include = [f"-I{prefix}/include" for prefix in prefixes]
    libraries = subprocess.check_output(["pkg-config", "--libs", "roscpp"], text=True).split()
    command = ["c++", "-std=c++17", "-o", str(result), *include, str(source), *libraries]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return result


def command_of(example: Path, folder: Path) -> list[str]:
    """How it is run: those of MAVSDK by a .venv next to them or above, or by .venv-clients."""
    if example.suffix == ".cpp":
        return [str(compiled(example, folder))]
    if example.stem == "offb_node":
        return [sys.executable, str(example)]
    own = (parent / ".venv" / "bin" / "python" for parent in example.parents)
    python = next((one for one in own if one.is_file()), None)
    if python is None and USES_SYSTEM.search(example.read_text(encoding="utf-8")):
        pytest.skip(f"SKIPPED: {example} wants MAVSDK 3 in a .venv next to it")
    python = python or clients_python("mavsdk")
    takes_address = "sys.argv" in example.read_text(encoding="utf-8")
    return [str(python), str(example), *([URL, *WORDS.get(example.stem, [])] * takes_address)]


class Example:
    """One that runs, and the track of the iris [m].

    Attributes:
        process: the example.
    """

    def __init__(self, path: Path, command: list[str], track: Recorder, log: Path) -> None:
        text = path.read_text(encoding="utf-8")
        self.stem, self._track, self._log = path.stem, track, log
        self.flies = path.stem in PLACES or FLIES.search(text) is not None
        ends = ENDS.findall(text)
        self.lands = bool(ends) and "stop" not in ends[-1]  # which holds
        is_old = USES_SYSTEM.search(text) is not None
        self.is_endless = path.stem == "offb_node" or (is_old and path.stem in ENDLESS)
        with log.open("w", encoding="utf-8") as output:
            self.process = subprocess.Popen(
                command,
                cwd=path.parent,
                env={**os.environ, "PYTHONUNBUFFERED": "1"},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    @property
    def log(self) -> str:
        """What it has said."""
        return self._log.read_text(encoding="utf-8")

    def places(self) -> Iterator[tuple[float, float, float]]:
        """Where the iris was."""
        for message in list(self._track.messages):
            place = message.pose.pose.position
            yield place.x, place.y, place.z

    def height(self) -> float:
        """Where the iris is."""
        return float(self._track.messages[-1].pose.pose.position.z)

    def has_flown(self) -> bool:
        """Whether it was where it must have been, if it must."""
        if not self.flies:
            return True
        wanted = PLACES.get(self.stem, [])
        been = list(self.places())
        return any(place[2] > 1.5 for place in been) and all(
            any(math.dist(place, one) < NEAR_M for place in been) for one in wanted
        )

    def is_done(self) -> bool:
        """Whether it has ended, or an endless one has done what it does."""
        if self.process.poll() is not None:
            return True
        said = [line for line in self.log.splitlines() if not line.startswith("INFO")]
        enough = ENOUGH_LINES - (self.stem == SILENT)
        has_said = self.stem in PLACES or len(said) >= enough
        return self.is_endless and has_said and self.has_flown()

    def judge(self) -> None:
        """Until it is done; fails where it did not do what it is for."""
        eventually(self.is_done, f"the end of {self.stem}", LIMIT_S)
        if self.is_endless:
            assert self.process.poll() is None, self.log
        else:
            assert self.process.returncode == 0, self.log
        assert "Traceback" not in self.log, self.log
        assert "failed" not in self.log, self.log
        assert self.has_flown(), self.log
        if self.lands:
            eventually(lambda: self.height() < NEAR_M, "the ground", LIMIT_S)


@contextmanager
def run_example(path: Path, command: list[str], folder: Path) -> Iterator[Example]:
    """Started, and ended with the test."""
    with recorder("/uav1/odometry_sensor1/odometry", Odometry) as track:
        track.connected()
        example = Example(path, command, track, folder / "example.log")
        try:
            yield example
        finally:
            # With its server, which outlives an interrupt.
            with suppress(ProcessLookupError):
                os.killpg(example.process.pid, signal.SIGKILL)
            example.process.wait()
            print(example.log)


def test_there_are_examples() -> None:
    if not os.environ.get("CLIENT_EXAMPLES"):
        pytest.skip("SKIPPED: CLIENT_EXAMPLES is not set: docs/howto/mavlink.md")
    assert list(found()), f"none below {os.environ['CLIENT_EXAMPLES']}"


@pytest.mark.parametrize(
    "path", [pytest.param(one, id="/".join(one.parts[-3:])) for one in found()]
)
def test_an_example_does_what_it_is_for(
    path: Path, launch: Callable[..., Launch], tmp_path: Path
) -> None:
    command = command_of(path, tmp_path)
    vehicle = entry("uav1", "quadrotor", autopilot="px4", offboard_remote_port=PORT)
    fleet = write_vehicles(tmp_path, vehicle)
    uses_mavros = path.stem == "offb_node"
    # Those that sleep between set-points other than places expect what a vehicle does in that time.
    is_timed = path.stem.startswith("offboard") and path.stem not in PLACES
    factor = 1 if is_timed else 5
    file = tmp_path / "examples.launch"
    far = fleet.port("uav1", "offboard")
    values = {"vehicles": fleet.path, "factor": factor, "mavros": str(uses_mavros).lower()}
    file.write_text(LAUNCH.format(**values, port=PORT, far=far))
    launch(str(file)).ready()
    with run_example(path, command, tmp_path) as example:
        example.judge()
