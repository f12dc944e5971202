# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds that a seed decides: the same seed gives the same files."""

from trident_sim.worldgen.buoys import RegattaConfig, regatta
from trident_sim.worldgen.coast import CoastConfig, coast
from trident_sim.worldgen.forest import ForestConfig, forest
from trident_sim.worldgen.hall import HallConfig, hall
from trident_sim.worldgen.office import OfficeConfig, office
from trident_sim.worldgen.sdf import Files

__all__ = [
    "CoastConfig",
    "Files",
    "ForestConfig",
    "HallConfig",
    "OfficeConfig",
    "RegattaConfig",
    "coast",
    "forest",
    "hall",
    "office",
    "regatta",
]
