# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import pytest
from trident_tool import cli, modules
from trident_tool.workspace import Workspace


@pytest.fixture(autouse=True)
def _nothing_is_built(clone: Workspace, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "provision", lambda *_args: None)
    monkeypatch.setattr(modules, "build", lambda *_args: None)
    monkeypatch.setattr(Workspace, "of_this_file", staticmethod(lambda: clone))


@pytest.mark.parametrize(
    ("words", "passed_on"),
    [
        ("worldmap forest --above-ground", "worldmap forest --above-ground"),
        ("worldgen forest --seed 2", "worldgen forest --seed 2"),
        ("worldmap room", "worldmap room"),
        (
            "worldmap a.world --height 0.2 --height 1 --start=-2,0 --out m.pgm --resolution 0.1",
            "worldmap a.world --out m.pgm --resolution 0.1 --height 0.2 --height 1.0 --start=-2,0",
        ),
        ("worldgen office --seed 4 --out w", "worldgen office --seed 4 --out w"),
        ("worldgen hall --length 12.5", "worldgen hall --length 12.5"),
    ],
)
def test_what_is_given_is_passed_on(
    words: str, passed_on: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main([*words.split(), "--dry-run"]) == 0
    expected = f"would run: /usr/bin/python3 -m trident_sim.{passed_on}\n"
    assert capsys.readouterr().out == expected


@pytest.mark.parametrize(
    ("words", "message"),
    [
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
