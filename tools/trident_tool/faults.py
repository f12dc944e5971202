# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that die during a run: which, by what, and whether the run can do without them."""

from __future__ import annotations

import json
import re
import signal
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path

from trident_tool.launch.launch_plan import LaunchPlan
from trident_tool.progress import Tail, strip_ansi

FAULTS_FILE = "faults.json"
_DIED = re.compile(r"^\s*\[([^\[\]]+-\d+)\] process has died \[pid (-?\d+), exit code (-?\d+)")
_REQUIRED = re.compile(r"REQUIRED process \[([^\]]+)\] has died")
_ITS_DEATH = re.compile(r"^process has died \[pid (-?\d+), exit code (-?\d+)")
# What these do is seen, or heard, but decides nothing.
_ONLOOKERS = frozenset(
    {
        ("rosbag", "record"),
        ("rviz", "rviz"),
        ("gazebo_ros", "gzclient"),
        ("robot_state_publisher", "robot_state_publisher"),
        ("robot_state_publisher", "state_publisher"),
        ("joint_state_publisher", "joint_state_publisher"),
        ("trident_viewer", "fleet_markers.py"),
        ("trident_viewer", "link_markers.py"),
        ("trident_eval", "fleet_markers.py"),  # its old name
        ("rqt_gui", "rqt_gui"),
        ("rqt_graph", "rqt_graph"),
        ("rqt_plot", "rqt_plot"),
    }
)


@dataclass(frozen=True)
class Fault:
    """One node that has died.

    Attributes:
        node: its name.
        cause: what ended it, in words.
        is_fatal: whether the run cannot do without it.
    """

    node: str
    cause: str
    is_fatal: bool

    @property
    def text(self) -> str:
        """A sentence about it."""
        return f"{self.node} {self.cause}"


def describe_exit(code: int, out_of_memory: bool = False) -> str:
    """What an exit code as of subprocess says, in words: "was killed by SIGSEGV".

    Args:
        code: below zero: by that signal; scripts of a shell return 128 more than a signal.
        out_of_memory: whether the kernel has killed something for lack of memory meanwhile.
    """
    number = -code if code < 0 else code - 128 if 128 < code < 160 else 0
    if not number:
        return f"has died with exit code {code}"
    name = _signal_name(number)
    lack = " (the machine was out of memory)" if out_of_memory and name == "SIGKILL" else ""
    return f"was killed by {name}{lack}"


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def oom_kills() -> int:
    """How many processes the kernel has killed for lack of memory since it was started."""
    try:
        for line in Path("/proc/vmstat").read_text("ascii").splitlines():
            if line.startswith("oom_kill "):
                return int(line.split()[1])
    except OSError:
        pass
    return 0


@dataclass
class FaultWatch:
    """Reads roslaunch's own output for nodes that have died."""

    log: Path
    plan: LaunchPlan
    faults: list[Fault] = field(default_factory=list)
    _required: str | None = None  # with its end the launch ends: what dies then follows from it
    _is_over: bool = False

    def __post_init__(self) -> None:
        self._tail = Tail(self.log)
        self._oom_kills = oom_kills()

    @property
    def is_fatal(self) -> bool:
        """Whether something has died that the run cannot do without."""
        return any(fault.is_fatal for fault in self.faults)

    def look(self) -> None:
        """Takes note of what has died since the last look."""
        for line in self._tail.lines():
            self._read(strip_ansi(line).rstrip())

    def _read(self, line: str) -> None:
        if found := _REQUIRED.search(line):
            self._required = self._required or found.group(1)
        elif self._required is None:
            if found := _DIED.match(line):
                self._died(found.group(1), int(found.group(3)))
        elif (found := _ITS_DEATH.match(line)) and not self._is_over:
            self._died(self._required, int(found.group(2)))
            self._is_over = True

    def _died(self, process: str, code: int) -> None:
        if code == 0:
            return
        cause = describe_exit(code, oom_kills() > self._oom_kills)
        node = self.plan.of_process(process)
        if node is None:
            self.faults.append(Fault("/" + process.rpartition("-")[0], cause, True))
            return
        if node.respawn:
            return
        if node.spawns is not None:
            cause += f": model {node.spawns} is not in the world"
        is_onlooker = (node.package, node.type) in _ONLOOKERS
        self.faults.append(Fault(node.name, cause, not is_onlooker))


def save_faults(folder: Path, faults: Sequence[Fault]) -> None:
    """Writes them next to the results of the run, if there are any."""
    if faults:
        text = json.dumps([asdict(fault) for fault in faults], indent=2)
        (folder / FAULTS_FILE).write_text(text + "\n", encoding="utf-8")
