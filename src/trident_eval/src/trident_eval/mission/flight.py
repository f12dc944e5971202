# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A mission from its beginning to its end, with what is drawn of it."""

from __future__ import annotations

import math

from trident_fleet.core.missions.mission import Mission
from trident_fleet.core.missions.record import Record
from trident_fleet.core.missions.setup import Outcome


def fly(mission: Mission, until_s: float = math.inf) -> tuple[Outcome, Record]:
    """Steps a mission until it is over, or a time [s]."""
    record = Record()
    while not mission.is_over() and mission.now_s < until_s:
        mission.step()
        record.note(mission)
    record.end(mission)
    return mission.outcome(), record
