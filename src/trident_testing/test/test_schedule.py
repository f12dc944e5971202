# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Disturbed schedules: delays that repeat, a campaign that continues, and ten small runs of it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest
from trident.testing.schedule.__main__ import main
from trident.testing.schedule.scenarios import SCENARIOS, SMALL
from trident.testing.schedule.stopping import Stopper, StopPlan
from trident.testing.waiting import LIMIT_S, eventually

INJECTED = Path(__file__).parents[1] / "src/trident/testing/schedule/injected"
_DRAW = "import delayed_rospy as d; x = d.Delays('{}'); print([x.of('here') for _ in range(20000)])"


def delays(seed: int) -> list[float]:
    command = [sys.executable, "-c", _DRAW.format(seed)]
    done = subprocess.run(command, cwd=INJECTED, capture_output=True, text=True, check=True)
    values: list[float] = json.loads(done.stdout)
    return values


def test_delays_are_mostly_none_now_and_then_long_and_a_function_of_the_seed() -> None:
    drawn = delays(7)
    some = [value for value in drawn if value > 0.0]
    assert 0.005 < len(some) / len(drawn) < 0.02
    assert 1e-4 <= min(some) < 1e-3
    assert 0.02 < max(some) <= 0.5
    assert delays(7) == drawn
    assert delays(8) != drawn


def test_what_is_stopped_continues_when_the_block_ends() -> None:
    child = subprocess.Popen(["cat"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    plan = StopPlan(pause_s=0.01, short_s=(30.0, 30.0), long_most=0)
    assert child.stdin is not None
    with Stopper(lambda: [child.pid], 1, plan) as stopper:
        while not stopper.stops:
            pass
    out, _ = child.communicate("on", timeout=30.0)
    assert out == "on"
    assert stopper.stops[0][1] == 30.0


def test_a_campaign_continues_where_it_was_and_judges_all(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "done.jsonl"
    run = {"scenario": "time", "state_hash": "ab", "repeatable": True, "passed": True}
    lines = [json.dumps({**run, "seed": seed}) for seed in (0, 1, 2)]
    out.write_text("\n".join(lines) + '\n{"scenario": "ti', encoding="utf-8")
    assert main(["--runs=2", f"--out={out}", "time"]) == 0, "nothing is left to do"
    assert "time: 3 runs, hashes ab x 3; not good: none" in capsys.readouterr().out
    out.write_text("\n".join([*lines, json.dumps({**run, "seed": 3, "state_hash": "cd"})]) + "\n")
    assert main(["--runs=3", f"--out={out}", "time"]) == 1, "another hash"
    assert main(["--runs=3", f"--out={out}", "tme"]) == 2, "no such scenario"
    assert set(SMALL) <= set(SCENARIOS)


def test_a_campaign_that_is_terminated_leaves_nothing_behind(tmp_path: Path) -> None:
    def started() -> list[str]:
        """Command lines of what the run has started: they name its folder."""
        found = []
        for entry in Path("/proc").glob("[0-9]*/cmdline"):
            with suppress(OSError):
                found.append(entry.read_bytes().decode(errors="replace"))
        return [line for line in found if f"{tmp_path}/trident_schedule" in line]

    command = [sys.executable, "-m", "trident.testing.schedule", "--small", "--runs=1", "time"]
    campaign = subprocess.Popen(
        [*command, f"--out={tmp_path / 'done.jsonl'}"], env={**os.environ, "TMPDIR": str(tmp_path)}
    )
    try:
        eventually(lambda: any("gzserver" in line for line in started()), "a simulator")
    finally:
        campaign.terminate()
        campaign.wait(timeout=LIMIT_S)
    eventually(lambda: not started(), "the end of all that it has started")


def test_ten_disturbed_runs_have_the_hashes_of_the_undisturbed(tmp_path: Path) -> None:
    """Ten seeds over the small scenarios; a minute and a half on a machine at rest."""
    out = tmp_path / "done.jsonl"
    code = main(["--small", "--runs=10", f"--out={out}"])
    done = [json.loads(line) for line in out.read_text(encoding="utf-8").splitlines()]
    assert len(done) == 10 + len(SMALL)
    assert code == 0, [one for one in done if not (one["passed"] and one["repeatable"])] or done
