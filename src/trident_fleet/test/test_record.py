# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest
from trident_fleet.core.config import GateConfig, PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.gate import FormationGate
from trident_fleet.core.plan import plan_formation
from trident_fleet.core.quintic import QuinticPath
from trident_fleet.core.record import (
    Origin,
    gate_record,
    plan_record,
    refusal_record,
    write_record,
)

SPAWN = np.array([[0.0, 1.0, 0.1], [0.0, -1.0, 0.1]])
ROWS = SPAWN + np.array([[[0.0, 0, 1]], [[0.5, 0, 1]], [[1.0, 0, 1]]])


@pytest.fixture
def origin(tmp_path: Path) -> Origin:
    file = tmp_path / "f.txt"
    file.write_text("1 2 3 4\n")
    return Origin(FormationSource(str(file), scale=(1, 2, 0.5)), ["UAV1", "UAV2"], 500_000_000)


def test_the_command_can_be_computed_again_to_the_bit(origin: Origin, tmp_path: Path) -> None:
    plan = plan_formation(ROWS, SPAWN, PlanConfig())
    path = write_record(tmp_path / "new" / "run", plan_record(plan, 1, origin))
    assert path.name == "formation_UAV2.json"
    record = json.loads(path.read_text())
    knots = record["knots"]
    again = QuinticPath(
        np.array(knots["time_s"]),
        *(np.array(knots[name])[:, None] for name in ("position", "velocity", "acceleration")),
    )
    time = np.linspace(0.0, plan.duration, 101)
    np.testing.assert_array_equal(again.derivative(time, 0)[:, 0], plan.sample(time).position[:, 1])
    assert record["start_time_s"] == 0.5
    assert record["rows"] == ROWS[:, 1].tolist()
    assert record["source"]["scale"] == [1, 2, 0.5]
    assert record["source"]["sha256"] == hashlib.sha256(b"1 2 3 4\n").hexdigest()
    assert [path.name for path in (tmp_path / "new" / "run").iterdir()] == ["formation_UAV2.json"]


def test_a_gate_records_when_each_row_was_commanded_and_reached(origin: Origin) -> None:
    gate = FormationGate(ROWS, SPAWN, origin.vehicles, PlanConfig(), GateConfig())
    gate.command_ns, gate.arrival_ns = [1_000_000_000, 3_000_000_000], [2_900_000_000]
    record = gate_record(gate, ROWS[:, 0].tolist(), 0, origin)
    assert record["command_time_s"] == [1.0, 3.0]
    assert record["arrival_time_s"] == [2.9]
    assert record["mode"] == "gate"
    assert not record["finished"]
    json.dumps(record, allow_nan=False)


def test_a_refusal_says_why(tmp_path: Path) -> None:
    origin = Origin(FormationSource("/nowhere"), ["UAV1"])
    record = refusal_record(FormationError("too bad"), 0, origin)
    assert record["error"] == "too bad"
    assert record["source"]["sha256"] is None
    json.dumps(record, allow_nan=False)


def test_a_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(FormationError, match=r"out_dir: .*file/run: .*legal: a writable folder"):
        write_record(tmp_path / "file" / "run", {"vehicle": "UAV1"})
