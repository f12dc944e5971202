# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What one vehicle was commanded, as a JSON file from which the command can be computed again."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from trident_base.flight_record import FOLLOW, FORMAT, GATE, TIME, Knots, record_path

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.gate import FormationGate, Phase
from trident_fleet.core.plan import FormationPlan
from trident_fleet.core.quintic import QuinticPath


@dataclass(frozen=True)
class Origin:
    """Where a flight comes from, the same for all vehicles of it."""

    source: FormationSource
    vehicles: list[str]
    start_ns: int = 0
    settings: dict[str, Any] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """Fields of the record that are common to all vehicles."""
        path = Path(self.source.file).expanduser()
        digest = hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else None
        return {
            "format": FORMAT,
            "vehicles": self.vehicles,
            "start_time_s": self.start_ns / 1e9,
            "source": asdict(self.source) | {"sha256": digest},
            "settings": self.settings,
        }


def plan_record(plan: FormationPlan, vehicle: int, origin: Origin) -> dict[str, Any]:
    """Record of a vehicle whose motion is planned in time."""
    return origin.to_json() | {
        "vehicle": origin.vehicles[vehicle],
        "mode": TIME,
        "end_time_s": origin.start_ns / 1e9 + plan.duration,
        "first_row_s": plan.first_row_s,
        "rows": plan.rows[:, vehicle].tolist(),
        "row_time_s": plan.row_time.tolist(),
        "knots": _knots(plan.path, vehicle),
    }


def gate_record(
    gate: FormationGate, rows: list[list[float]], vehicle: int, origin: Origin
) -> dict[str, Any]:
    """Record of a vehicle that flies row by row, as far as it has come."""
    return origin.to_json() | {
        "vehicle": origin.vehicles[vehicle],
        "mode": GATE,
        "first_row_s": gate.take_off.duration,
        "rows": rows,
        "knots": _knots(gate.take_off, vehicle),
        "command_time_s": [stamp / 1e9 for stamp in gate.command_ns],
        "arrival_time_s": [stamp / 1e9 for stamp in gate.arrival_ns],
        "steady_offset_m": gate.steady_offset[vehicle].tolist(),
        "finished": gate.phase is Phase.DONE,
        "error": gate.failure,
    }


def refusal_record(error: FormationError, vehicle: int, origin: Origin) -> dict[str, Any]:
    """Record of a vehicle that did not fly at all, and why."""
    return origin.to_json() | {"vehicle": origin.vehicles[vehicle], "error": str(error)}


def write_record(folder: Path, record: dict[str, Any]) -> Path:
    """Write a record; a reader sees the old file or the new one, never half of it.

    Raises:
        FormationError: the folder cannot be written.
    """
    # A leader has a record of its own flight, too.
    prefix = f"{FOLLOW}_" if record.get("mode") == FOLLOW else ""
    return write_object(record_path(folder, prefix + record["vehicle"]), record)


def write_object(path: Path, record: Mapping[str, Any]) -> Path:
    """Write an object as a file of its own. As `write_record`."""
    folder = path.parent
    try:
        folder.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(f".{os.getpid()}.tmp")
        partial.write_text(json.dumps(record) + "\n", encoding="utf-8")
        partial.replace(path)
    except OSError as error:
        reason = error.strerror or str(error)
        raise FormationError(f"out_dir: {folder}: {reason}; legal: a writable folder") from error
    return path


def _knots(path: QuinticPath, vehicle: int) -> Knots:
    return {
        "time_s": path.time.tolist(),
        "position": path.position[:, vehicle].tolist(),
        "velocity": path.velocity[:, vehicle].tolist(),
        "acceleration": path.acceleration[:, vehicle].tolist(),
    }
