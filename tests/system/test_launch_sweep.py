# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""./trident sweep of a launch file: a flight in a folder of its own, a table of verdicts."""

from __future__ import annotations

import csv
import json
from pathlib import Path

from trident_runs import Trident

FLIGHTS = """
launch: multi_uav_simulation.launch
axes:
  v_max: {list: [1.6]}
seeds: 1
limits: {time_s: 600}
metrics:
  pass: {unit: "1", better: higher}
  formation_rms_m: {unit: m, better: lower}
"""


def test_a_flight_is_a_run_and_is_not_flown_again(trident: Trident, tmp_path: Path) -> None:
    scenario = tmp_path / "flights.yaml"
    scenario.write_text(FLIGHTS, encoding="utf-8")
    folder = tmp_path / "flights"
    words = ("sweep", scenario, "--out", folder, "--workers", "1")
    flown = trident(*words)
    assert flown.code == 0, flown.output
    with (folder / "runs.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in rows] == ["done"]
    assert float(rows[0]["metric.pass"]) == 1.0
    assert 0.0 < float(rows[0]["metric.formation_rms_m"]) < 0.1
    verdicts = [*folder.glob("runs/*/2*-multi_uav_simulation/verdict.json")]
    assert len(verdicts) == 1
    assert json.loads(verdicts[0].read_text(encoding="utf-8"))["pass"]
    assert (folder / "report.html").is_file()
    again = trident(*words)
    assert "1 of 1 runs are there already" in again.output
