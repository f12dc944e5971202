# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a team's node flies: read from its parameters and the files that they name."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from trident_base.params import Getter, Params

from trident_fleet.core.missions.kinds import MissionConfig, read_mission
from trident_fleet.core.missions.scene import Scene, read_scene
from trident_fleet.core.missions.setup import Setup, death_of
from trident_fleet.core.missions.tree_file import TreePlan, read_tree
from trident_fleet.core.search.area import SearchError

_LONGEST_S = 36000.0


@dataclass(frozen=True)
class TeamSettings:
    """Everything that the node of a team needs to know.

    Attributes:
        scene_file: record of the coast.
        scene: the same, read.
        config: numbers of the mission.
        tree: of each robot.
        setup: team, method, links, seed and faults.
        whole: whether the mission has all the time that its file gives it.
    """

    scene_file: Path
    scene: Scene
    config: MissionConfig
    tree: TreePlan
    setup: Setup
    whole: bool


def read_team(get: Getter) -> TeamSettings:
    """Settings from parameters.

    Args:
        get: value of a parameter, or None where it is not set.

    Raises:
        FormationError: names parameter, or file and line, with value and what is legal.
    """
    params = Params(get, SearchError)
    files = _files(params)
    config = read_mission(files["numbers"])
    until_s = params.number("duration", 0.0)
    if not 0.0 <= until_s <= _LONGEST_S:
        raise SearchError(
            f"duration: {until_s:g}; legal: 0 to {_LONGEST_S:g} s, 0: as the file has"
        )
    whole = until_s == 0.0 or until_s >= config.rules.until_s
    if until_s > 0.0:
        config = replace(config, rules=replace(config.rules, until_s=until_s))
    kill = params.text("kill", "").replace(",", " ")
    setup = Setup(
        mode=params.text("mode", Setup.mode),
        method=params.text("method", Setup.method),
        links=params.text("links", Setup.links),
        seed=params.integer("seed", Setup.seed),
        deaths=tuple(death_of("kill", text) for text in kill.split()),
    )
    scene, tree = read_scene(files["scene"]), read_tree(files["tree"])
    return TeamSettings(files["scene"], scene, config, tree, setup, whole)


def _files(params: Params) -> dict[str, Path]:
    names = {name: params.text(name, "") for name in ("scene", "numbers", "tree")}
    for name, file in names.items():
        if not file:
            raise SearchError(f"{name}: ''; legal: path of a file")
    return {name: Path(file) for name, file in names.items()}
