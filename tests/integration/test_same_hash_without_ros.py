# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A formation under ROS (server, spawners, controllers, formation nodes) and in one process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

from trident_base.ports import free_port

REPO = Path(__file__).resolve().parents[2]
LAUNCH = REPO / "launch" / "multi_uav_simulation.launch"
EXAMPLE = REPO / "src" / "trident_sim_py" / "examples" / "formation_without_ros.py"
LIMIT_S = 300.0
STOP_S = 60.0
RECORD_S = 0.05


def launch(folder: Path, *args: str) -> dict[str, Any]:
    """Flies under ROS, as fast as possible and to the end; returns run.json."""
    port = free_port()
    env = os.environ | {
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(folder / "ros_home"),
        "ROS_LOG_DIR": str(folder / "log"),
        "TRIDENT_OUT": str(folder),
        "TRIDENT_REAL_TIME_FACTOR": "0",
        "TRIDENT_HEADLESS": "1",
        "TRIDENT_END": "1",
    }
    command = ["roslaunch", "--disable-title", "-p", str(port), str(LAUNCH), *args]
    with (folder / "roslaunch.log").open("w") as log:
        process = subprocess.Popen(
            command, env=env, stdout=log, stderr=subprocess.STDOUT, start_new_session=True
        )
        try:
            process.wait(LIMIT_S)
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                process.wait(STOP_S)
    facts: dict[str, Any] = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    log_text = (folder / "roslaunch.log").read_text(encoding="utf-8", errors="replace")
    assert facts.get("end_reason") == "finished", log_text[-6000:]
    return facts


def fly_without_ros(*args: str) -> tuple[int, dict[str, Any], str]:
    """Runs the example; returns its exit code, its result and its errors."""
    result = subprocess.run(
        [sys.executable, str(EXAMPLE), *args], capture_output=True, text=True, check=False
    )
    return result.returncode, json.loads(result.stdout or "{}"), result.stderr


@pytest.mark.parametrize(
    ("uavs", "seed"), [(6, 0), (2, 7)], ids=["the launch file's defaults", "two, another seed"]
)
def test_same_states_and_hash_with_and_without_ros(tmp_path: Path, uavs: int, seed: int) -> None:
    facts = launch(tmp_path, f"uavs:={uavs}", f"seed:={seed}")
    arguments = ["--uavs", str(uavs), "--seed", str(seed), "--compare", str(tmp_path)]
    code, result, errors = fly_without_ros(*arguments)
    assert errors == ""
    assert code == 0
    assert result["state_hash"] == facts["state_hash"]
    assert result["sim_s"] == pytest.approx(facts["sim_s"])
    assert result["states_compared"] == uavs * round(facts["sim_s"] / RECORD_S)


def test_a_difference_is_found(tmp_path: Path) -> None:
    """The comparison above could fail: one digit of one state, or of the hash, is enough."""
    code, result, _ = fly_without_ros("--uavs", "1")
    assert code == 0
    states = "t,name,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n0.05,UAV1,0,0,0,0,0,0,1,0,0,0,0,0,0\n"
    (tmp_path / "states.csv").write_text(states, encoding="utf-8")
    (tmp_path / "run.json").write_text(json.dumps(result), encoding="utf-8")
    code, compared, errors = fly_without_ros("--uavs", "1", "--compare", str(tmp_path))
    assert (code, compared["equal"], compared["state_hash"]) == (1, False, result["state_hash"])
    assert "first difference: UAV1 at 0.05 s: here (" in errors


def test_a_run_that_has_not_ended_cannot_be_compared(tmp_path: Path) -> None:
    (tmp_path / "run.json").write_text("{}", encoding="utf-8")
    code, result, errors = fly_without_ros("--uavs", "1", "--compare", str(tmp_path))
    assert (code, result) == (1, {})
    assert "no state_hash, the run has not ended" in errors
