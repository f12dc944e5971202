# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Folders as a simulated run leaves them, made of pure functions: no simulator is needed."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from trident_fleet.core.config import GateConfig, PlanConfig
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.gate import FormationGate, Phase
from trident_fleet.core.plan import plan_formation
from trident_fleet.core.quintic import Array
from trident_fleet.core.record import Origin, gate_record, plan_record, write_record

NAMES = ["UAV1", "UAV2", "UAV3"]
SPAWN = np.array([[0.0, 2.0, 0.1], [0.0, 0.0, 0.1], [0.0, -2.0, 0.1]])
OFFSET = np.array([0.0, 0.0, 0.04])
START_S = 0.3
STATE_PERIOD_S = 0.05
SUMMARY = {"rtf": 25.0, "state_hash": "ab" * 32, "sim_s": 30.0, "wall_s": 1.2}


def formation_rows(count: int = 12) -> Array:
    """A triangle that forms, moves ahead and turns."""
    share = np.linspace(0.0, 1.0, count)[:, None]
    rows = np.empty((count, 3, 3))
    angle = 0.8 * share
    along = SPAWN[None, :, 1] * np.ones((count, 1))
    ahead = share * np.array([[0.0, 1.0, 0.0]])
    rows[:, :, 0] = 3.0 * share + ahead * np.cos(angle) - along * np.sin(angle)
    rows[:, :, 1] = ahead * np.sin(angle) + along * np.cos(angle)
    rows[:, :, 2] = 1.2
    return rows


@dataclass
class Run:
    """A run's folder, and what is in it."""

    folder: Path
    rows: Array
    time: Array
    position: Array

    @staticmethod
    def planned(folder: Path) -> Run:
        rows = formation_rows()
        plan = plan_formation(rows, SPAWN, PlanConfig())
        origin = Origin(FormationSource("f.txt"), NAMES, round(START_S * 1e9))
        folder.mkdir()
        for vehicle in range(3):
            write_record(folder, plan_record(plan, vehicle, origin))
        time = np.arange(0.0, START_S + plan.duration, STATE_PERIOD_S)
        run = Run(folder, rows, time, plan.sample(time - START_S).position + OFFSET)
        run.write()
        return run

    @staticmethod
    def gated(folder: Path) -> Run:
        rows = formation_rows()
        gate = FormationGate(rows, SPAWN, NAMES, PlanConfig(), GateConfig())
        position, states, index = SPAWN.copy(), [SPAWN.copy()], 0
        while gate.phase not in (Phase.DONE, Phase.FAILED):
            index += 1
            target = gate.command(np.array([index / 20.0])).position[0]
            position = position + 0.2 * (target + OFFSET - position)
            states.append(position)
            if index % 2 == 0:
                now = index * 50_000_000
                gate.step(now, position, now + 100_000_000)
        folder.mkdir()
        origin = Origin(FormationSource("f.txt"), NAMES, 0)
        for vehicle in range(3):
            record = gate_record(gate, rows[:, vehicle].tolist(), vehicle, origin)
            write_record(folder, record)
        time = STATE_PERIOD_S * np.arange(len(states))
        run = Run(folder, rows, time, np.array(states))
        run.write()
        return run

    def write(self) -> None:
        """Write states.csv (again), and the simulator's summary."""
        lines = ["t,name,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz"]
        for time, points in zip(self.time, self.position, strict=True):
            for name, (x, y, z) in zip(NAMES, points, strict=True):
                lines.append(f"{time:.3f},{name},{x:.6f},{y:.6f},{z:.6f},0,0,0,1,0,0,0,0,0,0")
        (self.folder / "states.csv").write_text("\n".join(lines) + "\n")
        (self.folder / "run.json").write_text(json.dumps(SUMMARY))

    def edit_record(self, vehicle: str, **change: object) -> None:
        """Overwrite fields of a vehicle's record."""
        path = self.folder / f"formation_{vehicle}.json"
        path.write_text(json.dumps(json.loads(path.read_text()) | change))
