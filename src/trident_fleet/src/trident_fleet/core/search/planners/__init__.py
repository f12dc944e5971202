# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Coverage planners by name: one file each, one line here."""

from __future__ import annotations

from trident_fleet.core.search.area import SearchError
from trident_fleet.core.search.planners.base import CoveragePlanner
from trident_fleet.core.search.planners.boustrophedon import Boustrophedon
from trident_fleet.core.search.planners.probabilistic import Probabilistic
from trident_fleet.core.search.planners.spiral import Spiral
from trident_fleet.core.search.planners.tree import Tree

DEFAULT = "boustrophedon"

_ALL: tuple[CoveragePlanner, ...] = (
    Boustrophedon(),
    Spiral(),
    Tree(),
    Probabilistic(),
)
PLANNERS: dict[str, CoveragePlanner] = {planner.name: planner for planner in _ALL}


def planner_named(name: str) -> CoveragePlanner:
    """The planner of this name.

    Raises:
        SearchError: the name is unknown.
    """
    if name not in PLANNERS:
        raise SearchError(f"coverage planner is {name!r}, legal: {', '.join(PLANNERS)}")
    return PLANNERS[name]
