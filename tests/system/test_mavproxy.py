# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""MAVProxy, unchanged, flies a simulated vehicle: parameters, modes, a mission, the return."""

from __future__ import annotations

import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from trident.testing import Launch, eventually
from trident.testing.clients import clients_python
from trident.testing.mavlink_vehicles import write_fleet

LIMIT_S = 60.0
AT_ONCE_S = 0.5
#: Ten times real time is what MAVProxy keeps up with.
LAUNCH = """<launch>
  <include file="$(find trident_bringup)/launch/mavlink_fleet.launch">
    <arg name="vehicles" value="{vehicles}"/>
    <arg name="real_time_factor" value="10"/>
  </include>
</launch>
"""
MODULES = "cmdlong,mode,arm,wp,misc,param,rc,battery"
#: A take-off and two places next to where uav1 starts; item 0 is home.
MISSION = """QGC WPL 110
0 1 0 16 0 0 0 0 63.4394 10.3992 0 1
1 0 3 22 0 0 0 0 0 0 8 1
2 0 3 16 0 2 0 0 63.43935 10.39925 10 1
3 0 3 16 0 2 0 0 63.4393 10.39915 10 1
"""


class MavProxy:
    """It, its words and what it says."""

    def __init__(self, python: Path, port: int, folder: Path) -> None:
        script = python.parent / "mavproxy.py"
        master = [f"--master=tcp:127.0.0.1:{port}", f"--state-basedir={folder}", "--aircraft=uav"]
        self.process = subprocess.Popen(
            [str(python), str(script), *master, f"--default-modules={MODULES}"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            bufsize=1,
        )
        self.lines: list[str] = []
        self._heard = threading.Condition()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            with self._heard:
                self.lines.append(line.rstrip())
                self._heard.notify_all()

    def expect(self, text: str, since: int = 0) -> None:
        """Until it says so."""
        with self._heard:
            assert self._heard.wait_for(
                lambda: any(text in line for line in self.lines[since:]), LIMIT_S
            ), f"no '{text}' in\n" + "\n".join(self.lines)

    def say(self, line: str) -> None:
        """Type a line."""
        assert self.process.stdin is not None
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def command(self, line: str, answer: str) -> None:
        """Type a line, and wait for what it must say then."""
        since = len(self.lines)
        self.say(line)
        self.expect(answer, since)

    def answers(self, line: str, answer: str) -> bool:
        """Type a line; whether it says so at once."""
        since = len(self.lines)
        self.say(line)
        with self._heard:
            return self._heard.wait_for(
                lambda: any(answer in one for one in self.lines[since:]), AT_ONCE_S
            )


@contextmanager
def mavproxy(port: int, folder: Path) -> Iterator[MavProxy]:
    """Started, and ended with the test."""
    client = MavProxy(clients_python("MAVProxy"), port, folder)
    try:
        yield client
    finally:
        client.process.kill()
        client.process.wait()


def test_mavproxy_flies_a_mission_and_returns(
    launch: Callable[..., Launch], tmp_path: Path
) -> None:
    clients_python("MAVProxy")
    fleet = write_fleet(tmp_path)
    mission = tmp_path / "mission.txt"
    mission.write_text(MISSION.replace(" ", "\t").replace("QGC\tWPL\t110", "QGC WPL 110"))
    file = tmp_path / "fleet.launch"
    file.write_text(LAUNCH.format(vehicles=fleet.path))
    run = launch(str(file))
    run.ready()
    with mavproxy(fleet.port("uav1", "tcp"), tmp_path) as client:
        client.expect("parameters")
        client.say("param set WPNAV_SPEED 450")
        eventually(lambda: client.answers("param show WPNAV_SPEED", "450.0"), "another speed")
        client.command("mode GUIDED", "DO_SET_MODE: ACCEPTED")
        client.command("arm throttle", "COMPONENT_ARM_DISARM: ACCEPTED")
        client.command("takeoff 6", "NAV_TAKEOFF: ACCEPTED")
        eventually(lambda: run.position("uav1")[2] > 7.0, "a height of 6 m above the start")
        client.command(f"wp load {mission}", "MISSION_ACK: TYPE_MISSION: ACCEPTED")
        client.command("wp list", "63.4393000000")
        client.command("mode AUTO", "Mission is finished.")
        client.command("mode GUIDED", "DO_SET_MODE: ACCEPTED")
        client.command("guided 63.43935 10.39925 12", "DO_REPOSITION: ACCEPTED")
        eventually(lambda: run.position("uav1")[2] > 12.5, "12 m above the start")
        client.command("mode RTL", "Disarmed: landed.")
        assert not any("breach" in line for line in client.lines)
    x, y, _ = run.position("uav1")
    assert abs(x - 10.0) < 1.0
    assert abs(y - 57.0) < 1.0
