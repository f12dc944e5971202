# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""One run of a scenario under a disturbed schedule, and what came of it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from contextlib import nullcontext
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from trident_base.ports import free_port

from trident.testing.programs import Process, package
from trident.testing.schedule.scenarios import Scenario
from trident.testing.schedule.stopping import Stopper, StopPlan

_INJECTED = Path(__file__).parent / "injected"
_MAX_STANDING_S = 240.0  # wall time without any progress that a run is given up after
_POLL_S = 0.1


@dataclass
class Result:
    """What a run came to.

    Attributes:
        scenario: its name.
        seed: of the disturbances; 0: none.
        state_hash: of its end; "": it left none.
        repeatable: what the run says of itself.
        passed: its verdict.
        sim_s: its length [s].
        wall_s: what it took [s].
        reasons: against it, and what it says is not repeatable.
        stops: what was stopped: name and seconds.
    """

    scenario: str
    seed: int
    state_hash: str = ""
    repeatable: bool = False
    passed: bool = False
    sim_s: float = 0.0
    wall_s: float = 0.0
    reasons: list[str] = field(default_factory=list)
    stops: list[tuple[str, float]] = field(default_factory=list)

    def line(self) -> str:
        """One line of JSON."""
        return json.dumps(asdict(self))


def run(
    name: str, scenario: Scenario, seed: int, folder: Path, plan: StopPlan | None = None
) -> Result:
    """Run it once.

    Args:
        name: of the scenario.
        scenario: what is launched.
        seed: of all disturbances; 0: without any.
        folder: is made for its results and logs.
        plan: of the stops; None: as usual.
    """
    folder.mkdir(parents=True)
    result = Result(name, seed)
    begin = time.monotonic()
    process = Process(
        _command(scenario, folder), _environment(seed, folder), folder / "roslaunch.log"
    )
    stopper = None
    if seed:
        stopper = Stopper(process.family, seed, plan or StopPlan(), lambda: _has_begun(folder))
    try:
        with stopper or nullcontext():
            _wait(process, folder, result)
    finally:
        process.stop(signal.SIGINT, 40.0)
    result.wall_s = round(time.monotonic() - begin, 2)
    result.stops = stopper.stops if stopper else []
    _judge(folder, process.log, scenario.is_judged, result)
    return result


def _command(scenario: Scenario, folder: Path) -> list[str]:
    file = package("trident_bringup") / "launch" / scenario.launch
    words = ["roslaunch", "--disable-title", "-p", str(free_port()), str(file)]
    return [*words, *scenario.arguments(folder)]


def _environment(seed: int, folder: Path) -> dict[str, str]:
    env = dict(os.environ) | {
        "TRIDENT_OUT": str(folder),
        "TRIDENT_REAL_TIME_FACTOR": "0",
        "TRIDENT_LOCKSTEP_POLICY": "wait",
        "TRIDENT_END": "1",
        "TRIDENT_HEADLESS": "1",
        "ROS_LOG_DIR": str(folder / "log"),
        "ROS_HOME": str(folder / "ros_home"),
        "ROS_HOSTNAME": "localhost",
        "PATH": "/usr/bin:" + os.environ.get("PATH", ""),
    }
    for variable in ("DISPLAY", "ROS_MASTER_URI", "ROS_IP", "ROS_NAMESPACE"):
        env.pop(variable, None)
    if seed:
        env["TRIDENT_SCHEDULE_FUZZ"] = str(seed)
        env["PYTHONPATH"] = os.pathsep.join([str(_INJECTED), env.get("PYTHONPATH", "")])
    return env


def _wait(process: Process, folder: Path, result: Result) -> None:
    """Until it has ended, or nothing has changed for too long."""
    last: Any = None
    since = time.monotonic()
    while process.running:
        now = _progress(folder)
        if now != last:
            last, since = now, time.monotonic()
        if time.monotonic() - since > _MAX_STANDING_S:
            result.reasons.append(f"hangs: no progress for {_MAX_STANDING_S:g} s: {last}")
            return
        time.sleep(_POLL_S)


def _progress(folder: Path) -> Any:
    """Simulated time and what is waited for, as the simulator reports them; not how long."""
    try:
        line = (folder / "progress.jsonl").read_text(encoding="utf-8").splitlines()[-1]
        report = json.loads(line)
    except (OSError, ValueError, IndexError):
        return None
    return report.get("sim_s"), str(report.get("state", "")).split(" (")[0]


def _has_begun(folder: Path) -> bool:
    progress = _progress(folder)
    return progress is not None and bool(progress[0])


def _judge(folder: Path, log: str, by_verdict: bool, result: Result) -> None:
    facts = _read(folder / "run.json")
    result.state_hash = str(facts.get("state_hash", ""))
    result.sim_s = float(facts.get("sim_s", 0.0))
    result.repeatable = facts.get("repeatable") is True
    for note in facts.get("not_repeatable", []):
        result.reasons.append(f"not repeatable: {note['who']}, t = {note['t']}: {note['why']}")
    if not facts:
        result.reasons.append("no results: " + log.strip()[-300:])
    if not by_verdict:
        result.passed = facts.get("end_reason") in ("finished", "end_time")
        return
    command = ["/usr/bin/python3", "-m", "trident_eval", "verdict", "--no-pictures", str(folder)]
    subprocess.run(command, capture_output=True, check=False)
    verdict = _read(folder / "verdict.json")
    result.passed = verdict.get("pass") is True
    result.reasons += [str(reason) for reason in verdict.get("reasons", [])]


def _read(path: Path) -> dict[str, Any]:
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found
