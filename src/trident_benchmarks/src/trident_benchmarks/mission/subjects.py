# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""One mission of the sweep: the seed makes the coast, the team and the day are parameters."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from statistics import median
from typing import Any

from trident_eval.ros_paths import package_folder
from trident_fleet.core.missions.kinds import read_mission
from trident_fleet.core.missions.mission import Mission, Outcome, Setup, names_of
from trident_fleet.core.missions.scene import read_scene
from trident_fleet.core.missions.tree_file import read_tree
from trident_worldgen.coast import CoastConfig, coast
from trident_worldgen.sdf import write_files

_DEATH_SHARE, _SILENCE_S = 0.3, (200.0, 320.0)


def fly(parameters: Mapping[str, Any], seed: int, folder: Path) -> dict[str, float]:
    """Make the coast of a seed, and search it.

    Args:
        parameters: `mode`, `method`, `links`, and `day`: fair, `kill NAME`, or `silent NAME`.
        seed: of the coast and of all that is random.
        folder: of the run.

    Returns:
        The metrics of `metrics_of`.
    """
    config = CoastConfig(seed=seed, length=400.0, covers=14, casualties=12)
    write_files(coast(config), folder)
    setup = Setup(
        str(parameters["mode"]),
        str(parameters["method"]),
        str(parameters["links"]),
        seed,
        **_faults(str(parameters["day"]), str(parameters["mode"])),
    )
    missions = package_folder("trident_bringup") / "config" / "missions"
    mission = Mission(
        read_scene(folder / "coast.scene.yaml"),
        read_mission(missions / "search_and_rescue.yaml"),
        read_tree(missions / "search_and_rescue_tree.yaml"),
        setup,
    )
    outcome = mission.run()
    (folder / "curve.json").write_text(json.dumps(outcome.curve), encoding="utf-8")
    return metrics_of(outcome)


def _faults(day: str, mode: str) -> dict[str, Any]:
    """What befalls the team, as fields of a `Setup`."""
    what, _, name = day.partition(" ")
    if what == "kill":
        return {"deaths": ((name, 900.0 * _DEATH_SHARE),)}
    if what == "silent":
        return {"silences": ((name, *_SILENCE_S),)}
    if what == "dark":
        return {"silences": tuple((one, 0.0, 1e9) for one in names_of(mode))}
    return {}


def metrics_of(outcome: Outcome) -> dict[str, float]:
    """What a mission is judged by, as numbers."""
    people = max(outcome.people, 1)
    curve = list(outcome.curve)
    at_60_s = {
        f"curve_{60 * step}": curve[6 * step - 1] for step in range(1, 16) if len(curve) >= 6 * step
    }
    last = {f"curve_{60 * step}": outcome.coverage for step in range(1, 16)}
    return {
        "coverage": outcome.coverage,
        "found": outcome.found / people,
        "confirmed": outcome.confirmed / people,
        "served": outcome.served / people,
        "sectors": float(outcome.sectors),
        "value": outcome.value,
        "end_s": outcome.end_s,
        "efficiency": outcome.efficiency,
        "complete": float(outcome.complete),
        "contacts": float(outcome.contacts),
        "find_s": median(outcome.find_s) if outcome.find_s else outcome.end_s,
        "path_m": sum(outcome.path_m.values()),
        "messages": float(outcome.messages),
        **(last | at_60_s),
    }
