# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Files of missions: trees, numbers and scenes; each error names file, line, key and value."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from small import MISSIONS
from trident_fleet.core.errors import FormationError
from trident_fleet.core.missions.kinds import read_mission
from trident_fleet.core.missions.nodes import NODES
from trident_fleet.core.missions.scene import read_scene
from trident_fleet.core.missions.tree_file import TreePlan, read_tree

SCENE = """seed: 4
size: [8, 6]
cell: 2
cells: cells.png
heights: {file: heights.png, lowest: -2, relief: 4}
environment: package://x/y.yaml
bases: {air: [1, 1], ground: [1, 2], water: [1, -1]}
covers:
  - {x: 3, y: 1, side: 18, kind: roof}
casualties:
  - {name: casualty_0, x: -1, y: -2, where: water}
"""


def kinds_in(plan: TreePlan) -> set[str]:
    return {plan.kind}.union(*(kinds_in(child) for child in plan.children))


def test_the_shipped_tree_has_all_nodes() -> None:
    assert set(NODES) <= kinds_in(read_tree(MISSIONS / "search_and_rescue_tree.yaml"))


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("tree: {fly: {}}", "tree.yaml:1: fly: unknown node; legal: selector, sequence, subtree"),
        ("tree: {selector: []}", "selector: no children"),
        ("tree: {battery_low: {margin: 3}}", "margin: unknown key; legal: detour, reserve"),
        ("tree: {battery_low: {reserve: -3}}", "reserve: -3; legal: 0 or more"),
        ("tree: {battery_low: {reserve: soon}}", "reserve: 'soon'; legal: a number"),
        ("tree: {serve: {}, confirm: {}}", "2 keys; legal: one"),
        ("tree: {subtree: a}", "subtree: 'a'; legal: "),
        (
            "tree: {subtree: a}\nsubtrees:\n  a: {subtree: b}\n  b: {subtree: a}",
            "a: contains itself; legal: a tree without cycles",
        ),
    ],
)
def test_bad_trees_are_refused(text: str, what: str, tmp_path: Path) -> None:
    file = tmp_path / "tree.yaml"
    file.write_text(text)
    with pytest.raises(FormationError, match=what):
        read_tree(file)


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("speed: 8.0", "speed: 0", "speed: 0; legal: above 0"),
        ("domain: air", "domain: space", "'space'; legal: air, ground, water"),
        ("detect: 0.5", "detect: 1.5", "detect is 1.5, legal: 0 to below 1"),
        ("loss: 0.1", "loss: 2", "loss is 2.0, legal: 0"),
        ("leeway: person_sitting", "leeway: log", "leeway is 'log', legal: person"),
        ("serves: true", "serves: 1", "serves: 1; legal: true or false"),
        ("until: 900.0", "until: 900.0\n  rounds: 3", "rounds: unknown key"),
        ("open_land: 5.0", "open_land: -5.0", "open_land is -5.0, legal: from 0"),
    ],
)
def test_bad_numbers_are_refused(old: str, new: str, what: str, tmp_path: Path) -> None:
    text = (MISSIONS / "search_and_rescue.yaml").read_text()
    assert old in text
    file = tmp_path / "mission.yaml"
    file.write_text(text.replace(old, new, 1))
    with pytest.raises(FormationError, match=what):
        read_mission(file)


def written(folder: Path, text: str, rows: int = 3) -> Path:
    """A scene of 3 x 4 cells: water in the south, one covered cell in the north-west."""
    cells = np.full((rows, 4), 8, dtype=np.uint8)
    cells[0] = 5
    cells[0, 0] = 7
    Image.fromarray(cells).save(folder / "cells.png")
    Image.fromarray(np.full((rows, 4), 65535, dtype=np.uint16)).save(folder / "heights.png")
    file = folder / "a.scene.yaml"
    file.write_text(text)
    return file


def test_a_scene_is_read_with_its_south_at_row_0(tmp_path: Path) -> None:
    scene = read_scene(written(tmp_path, SCENE))
    assert scene.area.lattice.shape == (3, 4)
    assert scene.area.land[2].all()
    assert not scene.area.land[:2].any()
    assert list(zip(*np.nonzero(scene.area.covered), strict=True)) == [(2, 0)]
    assert (scene.area.heights == 2.0).all()
    assert scene.people[0].where == "water"
    assert scene.covers == ((3.0, 1.0),)


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("size: [8, 6]", "size: [8, x]", "size: .*legal: .X, Y., finite"),
        ("size: [8, 6]", "size: [12, 6]", r"cells.png: \(3, 4\) pixels; legal: \(3, 6\)"),
        ("cell: 2", "cell: 0", "cell: 0; legal: above 0 m"),
        ("cells.png", "none.png", "none.png: cannot be read"),
        ("where: water", "where: sky", "'sky'; legal: open, cover, water"),
        ("seed: 4", "seed: 4\nseeds: 4", "seeds: unknown key"),
    ],
)
def test_bad_scenes_are_refused(old: str, new: str, what: str, tmp_path: Path) -> None:
    with pytest.raises(FormationError, match=what):
        read_scene(written(tmp_path, SCENE.replace(old, new, 1)))
