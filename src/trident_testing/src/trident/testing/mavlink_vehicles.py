# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Files of mavlink_vehicle_node whose vehicles are on ports that nobody has."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from trident_base.ports import free_port

#: Of mavlink_fleet.launch, with the system ids 1, 2 and 3.
KINDS = {"uav1": "quadrotor", "ugv1": "rover", "usv1": "boat"}
_PORTS = ("offboard", "offboard_remote", "gcs", "tcp", "px4_simulator", "ardupilot_json")
Entry = dict[str, Any]


@dataclass
class VehiclesFile:
    """A file of vehicles.

    Attributes:
        path: of it.
        router: TCP port that carries all of them.
        ground_station: UDP port that all of them send to.
        vehicles: its entries by name.
    """

    path: Path
    router: int
    ground_station: int
    vehicles: dict[str, Entry]

    def port(self, vehicle: str, part: str) -> int:
        """Of a vehicle: offboard, offboard_remote, gcs, tcp, px4_simulator or ardupilot_json."""
        return int(self.vehicles[vehicle][f"{part}_port"])


def entry(name: str, kind: str, **more: object) -> Entry:
    """A vehicle, ArduPilot's unless `more` says otherwise."""
    ports = {f"{part}_port": free_port() for part in _PORTS}
    return {"vehicle": name, "kind": kind, "autopilot": "ardupilot", **ports, **more}


def write_vehicles(folder: Path, *vehicles: Entry) -> VehiclesFile:
    """The file with these vehicles."""
    router, ground_station = free_port(), free_port()
    content = {
        "vehicles": list(vehicles),
        "gcs_remote_port": ground_station,
        "router_port": router,
    }
    path = folder / "vehicles.yaml"
    path.write_text(yaml.safe_dump(content), encoding="utf-8")
    return VehiclesFile(path, router, ground_station, {one["vehicle"]: one for one in vehicles})


def write_fleet(folder: Path, **autopilots: str) -> VehiclesFile:
    """The file of all KINDS, with "px4" or "ardupilot" for each; who is not named is the latter."""
    vehicles = [
        entry(name, kind, autopilot=autopilots.get(name, "ardupilot"))
        for name, kind in KINDS.items()
    ]
    return write_vehicles(folder, *vehicles)
