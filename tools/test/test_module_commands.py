# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Commands that pass their words on to a module of a package."""

import pytest
from trident_tool import cli, modules
from trident_tool.workspace import Workspace


@pytest.fixture(autouse=True)
def _nothing_is_built(clone: Workspace, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "provision", lambda *_args: None)
    monkeypatch.setattr(modules, "build", lambda *_args: None)
    monkeypatch.setattr(Workspace, "of_this_file", staticmethod(lambda: clone))


@pytest.mark.parametrize(
    ("words", "module"),
    [
        ("formation tour.yaml", "trident_fleet.cli.make_formation tour.yaml"),
        (
            "formation line rotate:-90 circle --uavs 12 --spacing 2 --out a.txt --out b.mat",
            "trident_fleet.cli.make_formation line rotate:-90 circle "
            "--uavs 12 --spacing 2.0 --out a.txt --out b.mat",
        ),
        (
            "formation grid translate:-1,0,0.5 --min-separation 1.2",
            "trident_fleet.cli.make_formation grid translate:-1,0,0.5 --min-separation 1.2",
        ),
        ("formation-launch --uavs 40", "trident_fleet.cli.make_launch --uavs 40"),
        (
            "formation-launch --formation p.mat --vehicles-in-file 8 --uavs 7 --out f.launch",
            "trident_fleet.cli.make_launch "
            "--uavs 7 --formation p.mat --vehicles-in-file 8 --out f.launch",
        ),
        ("worldmap forest --above-ground", "trident_sim.worldmap forest --above-ground"),
        ("worldgen forest --seed 2", "trident_worldgen forest --seed 2"),
        ("worldmap room", "trident_sim.worldmap room"),
        (
            "worldmap a.world --height 0.2 --height 1 --start=-2,0 --out m.pgm --resolution 0.1",
            "trident_sim.worldmap a.world "
            "--out m.pgm --resolution 0.1 --height 0.2 --height 1.0 --start=-2,0",
        ),
        ("worldgen office --seed 4 --out w", "trident_worldgen office --seed 4 --out w"),
        ("worldgen hall --length 12.5", "trident_worldgen hall --length 12.5"),
        (
            "plan m.yaml -1,2,0 3,-4,1.5 --planner navfn/NavfnROS --out p.png",
            "trident_nav.plan m.yaml -1,2,0 3,-4,1.5 --planner navfn/NavfnROS --out p.png",
        ),
        ("lattice --model omni --out a.json", "trident_nav.lattice --model omni --out a.json"),
    ],
)
def test_what_is_given_is_passed_on(
    words: str, module: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main([*words.split(), "--dry-run"]) == 0
    assert capsys.readouterr().out == f"would run: /usr/bin/python3 -m {module}\n"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("formation", "formation: the following arguments are required"),
        ("formation-launch", "formation-launch: the following arguments are required: --uavs"),
        ("formation-launch --uavs many", "argument --uavs: invalid int value: 'many'"),
        ("formation line --row 3", "formation: unknown option '--row'"),
        ("worldmap", "worldmap: the following arguments are required: WORLD"),
        ("worldmap room --height low", "argument --height: invalid float value: 'low'"),
        ("worldmap room --hight 1", "worldmap: unknown option '--hight'"),
        ("worldgen castle", "argument kind: invalid choice: 'castle'"),
    ],
)
def test_a_wrong_command_line_is_one_line(
    words: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        cli.main(words.split())
    assert caught.value.code == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
