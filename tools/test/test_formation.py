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
        ("formation tour.yaml", "make_formation tour.yaml"),
        (
            "formation line rotate:-90 circle --uavs 12 --spacing 2 --out a.txt --out b.mat",
            "make_formation line rotate:-90 circle --uavs 12 --spacing 2.0 --out a.txt --out b.mat",
        ),
        (
            "formation grid translate:-1,0,0.5 --min-separation 1.2",
            "make_formation grid translate:-1,0,0.5 --min-separation 1.2",
        ),
        ("formation-launch --uavs 40", "make_launch --uavs 40"),
        (
            "formation-launch --formation p.mat --vehicles-in-file 8 --uavs 7 --out f.launch",
            "make_launch --uavs 7 --formation p.mat --vehicles-in-file 8 --out f.launch",
        ),
    ],
)
def test_what_is_given_is_passed_on(
    words: str, passed_on: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main([*words.split(), "--dry-run"]) == 0
    expected = f"would run: /usr/bin/python3 -m trident_fleet.cli.{passed_on}\n"
    assert capsys.readouterr().out == expected


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("formation", "formation: the following arguments are required"),
        ("formation-launch", "formation-launch: the following arguments are required: --uavs"),
        ("formation-launch --uavs many", "argument --uavs: invalid int value: 'many'"),
        ("formation line --row 3", "formation: unknown option '--row'"),
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
