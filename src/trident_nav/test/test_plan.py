# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""``./trident plan`` and ``./trident lattice``."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from trident_nav import lattice, plan


@pytest.fixture
def room(tmp_path: Path) -> Path:
    """A map of 6 x 4 m with a wall that leaves 1 m at its upper end; the origin is the middle."""
    pixels = np.full((80, 120), 254, dtype=np.uint8)
    pixels[:2] = pixels[-2:] = pixels[:, :2] = pixels[:, -2:] = 0
    pixels[22:, 58:62] = 0
    Image.fromarray(pixels).save(tmp_path / "room.pgm")
    text = (
        "image: room.pgm\nresolution: 0.05\norigin: [-3.0, -2.0, 0.0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    (tmp_path / "room.yaml").write_text(text, encoding="utf-8")
    return tmp_path / "room.yaml"


@pytest.mark.parametrize(
    "planner",
    [
        "navfn/NavfnROS",
        "nav2_smac_planner::SmacPlannerHybrid",
        "nav2_smac_planner/SmacPlannerLattice",
    ],
)
def test_a_path_is_drawn_and_written(
    room: Path, tmp_path: Path, planner: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out, poses = tmp_path / "p.png", tmp_path / "p.json"
    words = [str(room), "-1.8,-1,1.57", "1.8,-1.0,-1.57", "--planner", planner]
    assert plan.main([*words, "--out", str(out), "--json", str(poses)]) == 0
    assert capsys.readouterr().out.startswith(f"{planner}: ")
    path = np.array(json.loads(poses.read_text(encoding="utf-8")))
    assert path[0, :2].tolist() == [-1.8, -1.0]
    assert path[-1].tolist() == [1.8, -1.0, -1.57]
    assert path[:, 1].max() > 1.0
    with Image.open(out) as image:
        colors = {color for _, color in image.getcolors(1 << 20) or []}
        assert image.size[0] > image.size[1]
    assert {(255, 0, 0), (255, 165, 0), (20, 20, 20)} <= colors


def test_the_paths_of_all_planners_are_drawn_on_one_map(
    room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, layers, poses = (tmp_path / name for name in ("all.png", "layers.png", "all.json"))
    words = [str(room), "-1.8,-1,1.57", "1.8,-1.0,-1.57", "--planner", "all"]
    words += ["--out", str(out), "--layers", str(layers), "--json", str(poses)]
    assert plan.main(words) == 0
    assert len(capsys.readouterr().out.splitlines()) == len(plan.PLANNERS)
    assert set(json.loads(poses.read_text(encoding="utf-8"))) == set(plan.PLANNERS)
    with Image.open(out) as image:
        found = image.convert("RGB").getcolors(1 << 20) or []
        colors = {"#{:02x}{:02x}{:02x}".format(*color) for _, color in found}
        assert set(plan.PLANNERS.values()) <= colors
        single = image.width
    with Image.open(layers) as image:
        assert image.width > 2 * single


@pytest.mark.parametrize(
    "controller", ["nav2_mppi_controller::MPPIController", "dwa_local_planner/DWAPlannerROS"]
)
def test_what_a_controller_weighs_is_drawn(room: Path, tmp_path: Path, controller: str) -> None:
    out = tmp_path / "fan.png"
    words = [str(room), "-1.8,-1,1.57", "1.8,-1.0,-1.57", "--controller", controller]
    assert plan.main([*words, "--out", str(out)]) == 0
    options = plan.make_parser().parse_args([words[0], f" {words[1]}", *words[2:]])
    weighed = plan.find_plan(options).weighed
    assert weighed is not None
    assert len(weighed.trajectories) > 50
    best = weighed.trajectories[weighed.selected]
    assert best[-1, 1] > best[0, 1] + 0.2  # upwards, around the wall
    with Image.open(out) as image:
        assert (0, 0, 255) in {color for _, color in image.getcolors(1 << 20) or []}


def test_obstacles_that_the_map_does_not_have_are_led_around_and_drawn(
    room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    layers, poses = tmp_path / "layers.png", tmp_path / "p.json"
    words = [str(room), "-2.5,-1,0", "-0.5,-1,0", "--planner", "navfn/NavfnROS"]
    words += ["--inflation", "0.2", "--json", str(poses)]
    assert plan.main(words) == 0
    free = np.array(json.loads(poses.read_text(encoding="utf-8")))
    words += ["--obstacle", "-1.5,-1,0.3", "--obstacle", "-1.5,0.5,0.1"]
    assert plan.main([*words, "--layers", str(layers)]) == 0
    path = np.array(json.loads(poses.read_text(encoding="utf-8")))
    assert np.abs(free[:, 1] + 1.0).max() < 0.1
    assert np.hypot(path[:, 0] + 1.5, path[:, 1] + 1.0).min() > 0.4
    with Image.open(layers) as image:
        assert image.width > 3 * 4 * 120  # three panels
    assert plan.main([*words, "--obstacle", "1,2"]) == 2
    assert "obstacle: 1,2, legal: X,Y,RADIUS [m]" in capsys.readouterr().err


def test_no_path_says_why(room: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert plan.main([str(room), "-1.8,-1,0", "0,-1,0"]) == 1
    assert "no path. The footprint is in contact at the goal" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["-1,0,0", "1,0"], "pose: 1,0, legal: X,Y,YAW [m, rad]"),
        (["-1,0,0", "1,0,0", "--planner", "navfn/Navfn"], "navfn/NavfnROS"),
        (["-1,0,0", "1,0,0", "--params", "{tolerance: -1}"], "tolerance"),
    ],
)
def test_wrong_input_is_one_message(
    room: Path, words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert plan.main([str(room), *words]) == 2
    assert message in capsys.readouterr().err


def test_a_made_lattice_is_planned_with(room: Path, tmp_path: Path) -> None:
    out = tmp_path / "set.json"
    assert lattice.main(["--model", "diff", "--radius", "0.4", "--out", str(out)]) == 0
    data = json.loads(out.read_text(encoding="utf-8"))
    assert data["lattice_metadata"]["number_of_trajectories"] == len(data["primitives"])
    words = [str(room), "-1.8,-1,1.57", "1.8,-1.0,-1.57"]
    words += ["--planner", "nav2_smac_planner/SmacPlannerLattice"]
    assert plan.main([*words, "--params", f"{{lattice_filepath: {out}}}"]) == 0


def test_a_lattice_needs_a_known_model(capfd: pytest.CaptureFixture[str]) -> None:
    assert lattice.main(["--model", "legs"]) == 2
    assert "legal: diff, ackermann, omni" in capfd.readouterr().err
