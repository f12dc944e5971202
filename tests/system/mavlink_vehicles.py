# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Iris, rover and boat of mavlink_fleet.launch on ports that nobody has."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from trident_base.ports import free_port

KINDS = {"uav1": "quadrotor", "ugv1": "rover", "usv1": "boat"}
PORTS = ("offboard", "offboard_remote", "gcs", "tcp", "px4_simulator", "ardupilot_json")


@dataclass
class Fleet:
    """A file of vehicles.

    Attributes:
        path: of it.
        router: TCP port that carries all of them.
        vehicles: its entries by name.
    """

    path: Path
    router: int
    vehicles: dict[str, dict[str, Any]]

    def port(self, vehicle: str, part: str) -> int:
        """One of PORTS of a vehicle."""
        return int(self.vehicles[vehicle][f"{part}_port"])


def write_fleet(folder: Path, **autopilots: str) -> Fleet:
    """The file, with "px4" or "ardupilot" for each vehicle; who is not named is ArduPilot's."""
    vehicles = {
        name: {"vehicle": name, "kind": kind, "autopilot": autopilots.get(name, "ardupilot")}
        | {f"{part}_port": free_port() for part in PORTS}
        for name, kind in KINDS.items()
    }
    router = free_port()
    content = {
        "vehicles": list(vehicles.values()),
        "gcs_remote_port": free_port(),
        "router_port": router,
    }
    path = folder / "vehicles.yaml"
    path.write_text(yaml.safe_dump(content), encoding="utf-8")
    return Fleet(path, router, vehicles)
