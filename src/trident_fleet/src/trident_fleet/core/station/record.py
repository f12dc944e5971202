# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a base station did, as a record of its run."""

from __future__ import annotations

from dataclasses import dataclass, field

from trident_base.station_record import STATION_FORMAT, StationPhase, StationRecord

from trident_fleet.core.base_station import BaseStation, Phase
from trident_fleet.core.station.settings import StationSettings


@dataclass
class StationLog:
    """Phases of a flight.

    Attributes:
        start_s: simulated time of the first set-point [s].
    """

    start_s: float
    _phases: list[StationPhase] = field(default_factory=list)

    def note(self, station: BaseStation, time_s: float) -> bool:
        """Look at a station, `time_s` after the first set-point; whether its phase is a new one."""
        last = self._phases[-1] if self._phases else None
        if last is not None and last["phase"] == station.phase.value:
            is_same = last["reason"] == station.reason or station.phase is Phase.FOLLOW
            if is_same:
                return False
        self._phases.append(
            {
                "time_s": self.start_s + time_s,
                "phase": station.phase.value,
                "reason": station.reason,
                "goal": station.goal.tolist(),
                "found_db": station.found_db,
            }
        )
        return True

    def record(self, settings: StationSettings, error: str = "") -> StationRecord:
        """For the folder of the run."""
        return {
            "format": STATION_FORMAT,
            "vehicle": settings.vehicle.name,
            "links": settings.links,
            "places": {name: place.tolist() for name, place in settings.places.items()},
            "fence": settings.fence.corners.tolist(),
            "lowest_m": settings.fence.lowest_m,
            "highest_m": settings.fence.highest_m,
            "phases": self._phases,
            "error": error,
        }
