# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes of behavior trees by name: one line each. Their fields are the keys in a tree's file."""

from __future__ import annotations

from trident_fleet.core.missions.nodes.base import Node
from trident_fleet.core.missions.nodes.care import (
    AloneTooLong,
    BatteryLow,
    ChangeBattery,
    GoHome,
    TakenOver,
)
from trident_fleet.core.missions.nodes.people import Confirm, Serve, ServeUnasked
from trident_fleet.core.missions.nodes.searching import SearchByGain, SearchPiece, VisitCover

NODES: dict[str, type[Node]] = {
    "taken_over": TakenOver,
    "battery_low": BatteryLow,
    "change_battery": ChangeBattery,
    "alone_too_long": AloneTooLong,
    "go_home": GoHome,
    "serve": Serve,
    "serve_unasked": ServeUnasked,
    "confirm": Confirm,
    "search_piece": SearchPiece,
    "visit_cover": VisitCover,
    "search_by_gain": SearchByGain,
}
