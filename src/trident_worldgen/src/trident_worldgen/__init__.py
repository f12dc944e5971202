# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds that a seed decides: the same seed gives the same files."""

from trident_worldgen.buoys import RegattaConfig, regatta
from trident_worldgen.coast import CoastConfig, coast
from trident_worldgen.cylinders import CylindersConfig, cylinders
from trident_worldgen.forest import ForestConfig, forest
from trident_worldgen.hall import HallConfig, hall
from trident_worldgen.office import OfficeConfig, office
from trident_worldgen.sdf import Files

__all__ = [
    "CoastConfig",
    "CylindersConfig",
    "Files",
    "ForestConfig",
    "HallConfig",
    "OfficeConfig",
    "RegattaConfig",
    "coast",
    "cylinders",
    "forest",
    "hall",
    "office",
    "regatta",
]
