# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A launch file under a master of the test's own."""

from __future__ import annotations

import re
import signal
import subprocess
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from types import TracebackType

from std_msgs.msg import Bool

from trident.testing.master import Ros
from trident.testing.simulation import Simulation
from trident.testing.topics import recorder
from trident.testing.waiting import LIMIT_S, eventually

_NODE_LIMIT_S = 60  # on a loaded machine roslaunch's 15 s are over before a node has ended
_PATIENT = f"--sigint-timeout={_NODE_LIMIT_S}"
_STOP_LIMIT_S = _NODE_LIMIT_S + 25.0  # roslaunch waits 2 s more after SIGTERM
_LAST_S = 5.0  # what nodes have started themselves may need a moment longer than they
_DIED = re.compile(r"\[([^\[\]\s]+)-\d+\] process has died \[pid -?\d+, exit code (-?\d+)")
_ESCALATED = re.compile(r"\[([^\[\]\s]+)-\d+\] escalating to SIGTERM")


class Launch(Simulation):
    """A running roslaunch, and the simulator in it.

    Attributes:
        log_folder: logs of the nodes.
        shutdown_s: wall time from the interrupt to the end of roslaunch [s]; 0 before.
    """

    def __init__(
        self,
        ros: Ros,
        *words: str | Path,
        real_time_factor: float | None = 0.0,
        env: dict[str, str] | None = None,
        **args: object,
    ) -> None:
        """Start it.

        Args:
            ros: the master it is under.
            words: the launch file, or a package and the name of a file in it.
            real_time_factor: 0: as fast as possible; None: as without a test, in real time. A
                launch file with such an argument of its own, given in `args`, decides itself.
            env: additions to the environment.
            args: of the launch file; True and False become true and false.
        """
        number = len(list(ros.folder.glob("launch-*")))
        folder = ros.folder / f"launch-{number}"
        self.log_folder = folder / "log"
        out_dir = folder / "out"
        out_dir.mkdir(parents=True)
        given = [f"{name}:={_text(value)}" for name, value in args.items()]
        variables = {"ROS_LOG_DIR": str(self.log_folder), "TRIDENT_OUT": str(out_dir)}
        if real_time_factor is not None:
            variables["TRIDENT_REAL_TIME_FACTOR"] = f"{real_time_factor:g}"
        command = ["roslaunch", "--disable-title", _PATIENT, *words, *given]
        process = ros.launch(command, "roslaunch", **variables, **(env or {}))
        super().__init__(ros, process, out_dir)
        self.shutdown_s = 0.0

    def __enter__(self) -> Launch:
        """The launch itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """End it; reports what was not clean about its end unless something else is wrong."""
        unclean = self.end()
        assert kind is not None or not unclean, "\n".join([*unclean, self.log[-3000:]])

    def spawned(self, *models: str, limit_s: float = LIMIT_S) -> Launch:
        """Return when the simulator answers and these models are in the world."""
        self.serves(limit_s)

        def all_there() -> bool:
            assert self.process.running, self.log
            return set(models) <= set(self.models())

        eventually(all_there, f"models {', '.join(models)}", limit_s)
        return self

    def ready(self, limit_s: float = LIMIT_S) -> Launch:
        """Return when everything is there that /gazebo/wait_for and wait_for_sources declare.

        From then on a paused world can be stepped in lockstep.
        """
        self.serves(limit_s)

        def is_ready() -> bool:
            assert self.process.running, self.log
            return bool(heard.messages and heard.messages[-1].data)

        with recorder("/gazebo/ready", Bool) as heard:
            eventually(is_ready, "the parts that the launch file declares", limit_s)
        return self

    def end(self, limit_s: float = _STOP_LIMIT_S) -> list[str]:
        """Ctrl-C; nothing is left when it returns.

        Args:
            limit_s: wall time for it [s]; what is left then is killed.

        Returns:
            What was not clean about it, in words: nodes that have died, ignored the signal or
            were left behind. Nothing if it had been ended before.
        """
        was_running = self.process.running
        if was_running:
            begin = time.monotonic()
            self.process.send(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                self.process.popen.wait(limit_s)
            self.shutdown_s = time.monotonic() - begin
        unclean = [f"{name} has died (exit code {code})" for name, code in self.died()]
        unclean += [f"{name} ignored the interrupt" for name in _ESCALATED.findall(self.log)]
        if self.process.running:
            unclean.append(f"roslaunch still ran {limit_s:g} s after the interrupt")
        elif was_running and (left := self._left_behind()):
            unclean.append(f"{left} processes were left behind")
        self.process.stop(signal.SIGKILL)
        return unclean

    def _left_behind(self) -> int:
        """How many processes do not follow roslaunch into its end."""
        with suppress(AssertionError):
            eventually(lambda: not self.process.family(), "the end of all nodes", _LAST_S)
        return len(self.process.family())

    def died(self) -> list[tuple[str, int]]:
        """Name and exit code of each node that has died with another code than 0."""
        found = [(name, int(code)) for name, code in _DIED.findall(self.log)]
        return [(name, code) for name, code in found if code != 0]

    def logs(self) -> Iterator[tuple[str, str]]:
        """Name and text of the log of roslaunch and of every node."""
        yield "roslaunch", self.log
        for file in sorted(self.log_folder.rglob("*.log")):
            if file.is_file():
                yield file.name, file.read_text(encoding="utf-8", errors="replace")


def _text(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
