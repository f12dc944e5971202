# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line: fly a search and rescue in this process, check or draw the tree of one."""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
import tempfile
from pathlib import Path

from trident_fleet.core.errors import FormationError
from trident_fleet.core.missions.kinds import read_mission
from trident_fleet.core.missions.mission import Mission
from trident_fleet.core.missions.scene import Scene, read_scene
from trident_fleet.core.missions.setup import Outcome, Setup, death_of
from trident_fleet.core.missions.tree_file import TreePlan, read_tree
from trident_worldgen.coast import CoastConfig, coast
from trident_worldgen.sdf import write_files

import trident_sim
from trident_eval.core.errors import EvalError
from trident_eval.mission.flight import fly
from trident_eval.mission.goals import missed_goals
from trident_eval.mission.pictures import draw_map, draw_times, draw_tree
from trident_eval.options import add_mission
from trident_eval.ros_paths import package_folder

PASSED, FAILED, UNUSABLE = 0, 1, 2
_NUMBERS, _TREE = "search_and_rescue.yaml", "search_and_rescue_tree.yaml"


def main(arguments: list[str] | None = None) -> int:
    """Carry out one action.

    Returns:
        0: passed, or no mistake; 1: the verdict fails; 2: bad input.
    """
    parser = argparse.ArgumentParser(prog="./trident mission", description=__doc__)
    add_mission(parser)
    options = parser.parse_args(arguments)
    try:
        return {"fly": _fly, "check": _check, "draw": _draw}[options.action](options)
    except (FormationError, EvalError, trident_sim.Error, OSError) as error:
        print(f"trident_eval: {error}", file=sys.stderr)
        return UNUSABLE


def _shipped(name: str) -> Path:
    return package_folder("trident_bringup") / "config" / "missions" / name


def _check(options: argparse.Namespace) -> int:
    file = options.file or _shipped(_TREE)
    for line in as_text(read_tree(file)):
        print(line)
    return PASSED


def as_text(plan: TreePlan, depth: int = 0) -> list[str]:
    """A tree, a line for each node, with the parameters of leaves."""
    values = dataclasses.asdict(plan.node) if plan.node is not None else {}
    parameters = ", ".join(f"{name} {value:g}" for name, value in values.items())
    line = "  " * depth + plan.kind + (f" ({parameters})" if parameters else "")
    return [line, *(text for child in plan.children for text in as_text(child, depth + 1))]


def _draw(options: argparse.Namespace) -> int:
    file = options.file or _shipped(_TREE)
    target = options.out or Path(f"{file.stem}.png")
    draw_tree(target, read_tree(file))
    print(f"wrote {target}")
    return PASSED


def _fly(options: argparse.Namespace) -> int:
    setup = Setup(
        options.mode,
        options.method,
        options.links,
        options.seed,
        deaths=tuple(death_of("--kill", text) for text in options.kill),
    )
    tree = read_tree(options.file or _shipped(_TREE))
    numbers = read_mission(options.numbers or _shipped(_NUMBERS))
    mission = Mission(_scene(options), numbers, tree, setup)
    outcome, record = fly(mission, options.until)
    folder = options.out or Path("mission")
    folder.mkdir(parents=True, exist_ok=True)
    draw_map(folder / "map.png", record, mission.truth)
    draw_times(folder / "times.png", record)
    missed = missed_goals(outcome)
    verdict = dataclasses.asdict(outcome) | {"passed": not missed, "reasons": missed}
    text = json.dumps(verdict, indent=2, allow_nan=False)
    (folder / "verdict.json").write_text(text + "\n", encoding="utf-8")
    for line in _lines_of(setup, outcome, missed, folder):
        print(line)
    return FAILED if missed else PASSED


def _scene(options: argparse.Namespace) -> Scene:
    """The record that was named, or that of a coast of this seed."""
    if options.scene:
        return read_scene(options.scene)
    with tempfile.TemporaryDirectory() as folder:
        config = CoastConfig(seed=options.seed, length=400.0, covers=14, casualties=12)
        write_files(coast(config), Path(folder))
        return read_scene(Path(folder) / "coast.scene.yaml")


def _lines_of(setup: Setup, outcome: Outcome, missed: list[str], folder: Path) -> list[str]:
    lines = [
        f"  mission             {setup.mode}, {setup.method}, links: {setup.links}",
        f"  ended at            {outcome.end_s:.1f} s",
        f"  coverage            {100 * outcome.coverage:.1f} %",
        f"  found, served       {outcome.found}, {outcome.served} of {outcome.people}",
        f"  value per minute    {outcome.efficiency:.2f}",
        f"  messages            {outcome.messages}",
    ]
    lines += [f"  lost                {name}" for name in outcome.lost]
    lines += [f"  missed              {reason}" for reason in missed]
    lines.append(f"  verdict             {'FAIL' if missed else 'PASS'}")
    return [*lines, f"  pictures            {folder}/map.png, times.png"]


if __name__ == "__main__":
    sys.exit(main())
