# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import re
from pathlib import Path

import pytest
from trident_tool import cli, modules
from trident_tool.cli import COMMANDS, make_parser, parse_command_line
from trident_tool.workspace import Runner, TridentError, Workspace


def _exit_code(argv: list[str]) -> int | str | None:
    with pytest.raises(SystemExit) as caught:
        parse_command_line(argv)
    return caught.value.code


@pytest.mark.parametrize("argv", [[], ["help"], ["-h"], ["run", "-h"]])
def test_help_is_a_success(argv: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert _exit_code(argv) == 0
    assert "trident" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("argv", "message"),
    [
        (["buidl"], "trident: there is no command 'buidl'; did you mean 'build'?"),
        (["zzz"], "trident: there is no command 'zzz'; there are setup, build,"),
        (["run"], "the following arguments are required"),
        (["run", "--fast", "a.launch"], "run: unknown option '--fast'"),
        (["bench", "ships"], "invalid choice: 'ships'"),
        (["bench"], "the following arguments are required: BENCHMARK"),
        (["bench", "sim", "--fast"], "bench: unknown option '--fast'"),
        (["bench", "sim", "--runs", "0"], "argument --runs: 0 is not legal; legal: >= 1"),
        (["modbus"], "the following arguments are required: COMMAND"),
        (["modbus", "see"], "invalid choice: 'see'"),
        (["build", "-j", "many"], "invalid int value: 'many'"),
    ],
)
def test_a_wrong_command_line_is_one_line_and_exit_code_2(
    argv: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _exit_code(argv) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "options"),
    [
        ("bench sim", "--quick --out --profile --markdown --runs --mode --controller --world"),
        ("bench sensors", "--quick --out --runs --mode"),
        ("bench amcl", "--quick --out"),
        ("bench vessels", "--quick --out --only"),
        ("bench slam", "--quick --runs --method --config --data --live --robustness --world"),
        ("bench posegraph", "--runs --quick --out --gtsam-python"),
        ("modbus watch", "--map --unit --seconds --once --allow-remote"),
        ("report", "--out --animate"),
        ("slam", "--method --config --out --relations --truth --no-pictures"),
        ("evaluate", "--relations --truth --align --map --true-map --out --no-pictures"),
        ("posegraph", "--robust --init --strategy --solver --iterations --tolerance --strict"),
        ("sweep", "--engine --workers --out --only --plan --serve"),
    ],
)
def test_a_command_of_a_module_documents_all_its_options(
    words: str, options: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _exit_code([*words.split(), "-h"]) == 0
    shown = capsys.readouterr().out
    assert f"usage: trident {words} " in shown
    missing = [option for option in options.split() if f"\n  {option}" not in shown]
    assert not missing


def test_bench_lists_what_can_be_measured(capsys: pytest.CaptureFixture[str]) -> None:
    assert _exit_code(["bench", "-h"]) == 0
    shown = capsys.readouterr().out
    for name in ("sim", "sensors", "slam", "amcl", "posegraph", "vessels"):
        assert re.search(rf"\n    {name}\s", shown)


def test_every_command_has_help_and_every_parser_is_a_command() -> None:
    help_text = make_parser().format_help()
    # The text of a long name begins on the next line.
    assert all(re.search(rf"\n    {name}\s", help_text) for name in COMMANDS)


@pytest.mark.parametrize("argv", [["--dry-run", "build"], ["build", "--dry-run"]])
def test_dry_run_may_stand_before_or_after_the_command(argv: list[str]) -> None:
    assert parse_command_line(argv).dry_run


def test_a_word_inside_a_shell_command_is_not_an_option() -> None:
    options = parse_command_line(["shell", "-c", "ls --dry-run"])
    assert options.command == "ls --dry-run"
    assert not options.dry_run


def test_unknown_options_of_test_go_to_ctest() -> None:
    options = parse_command_line(["test", "-k", "fleet", "--repeat", "until-fail:3"])
    assert (options.pattern, options.rest) == ("fleet", ["--repeat", "until-fail:3"])


@pytest.mark.parametrize(("words", "sanitizer"), [([], "address"), (["thread"], "thread")])
def test_sanitizers_are_a_build_of_their_own(
    words: list[str],
    sanitizer: str,
    monkeypatch: pytest.MonkeyPatch,
    clone: Workspace,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(Workspace, "of_this_file", staticmethod(lambda: clone))
    monkeypatch.setattr(cli, "provision", lambda *_args: None)
    assert cli.main(["test", "--dry-run", "--sanitize", *words]) == 0
    output = capsys.readouterr().out
    assert f"-DTRIDENT_SANITIZE={sanitizer}" in output
    assert "core_tests" in output


class _Steps:
    """Records which steps a subcommand takes, in place of the real ones."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, clone: Workspace) -> None:
        self.names: list[str] = []
        for owner, name in ((cli, "provision"), (cli, "build"), (modules, "build")):
            monkeypatch.setattr(owner, name, lambda *_args, name=name: self.names.append(name))
        monkeypatch.setattr(Workspace, "of_this_file", staticmethod(lambda: clone))


@pytest.mark.parametrize(
    ("argv", "printed"),
    [
        (
            ["bench", "sim", "--quick", "--out", "rows.json", "--dry-run"],
            "would run: /usr/bin/python3 -m trident_benchmarks sim --quick --out rows.json\n",
        ),
        (
            ["bench", "--dry-run", "slam", "--world", "office"],
            "would run: /usr/bin/python3 -m trident_benchmarks slam --world office\n",
        ),
        (
            ["slam", "drive.log", "--lifelong", "--dry-run"],
            "would run: /usr/bin/python3 -m trident_eval.slam slam drive.log --lifelong\n",
        ),
        (
            ["bench", "vessels", "--out", "docs/images/vessels", "--dry-run"],
            "would run: /usr/bin/python3 -m trident_benchmarks vessels --out docs/images/vessels\n",
        ),
        (
            ["bench", "posegraph", "--quick", "a.g2o", "--dry-run"],
            "would run: /usr/bin/python3 -m trident_benchmarks posegraph --quick a.g2o\n",
        ),
        (
            ["posegraph", "a.g2o", "--robust", "gnc", "--dry-run"],
            "would run: /usr/bin/python3 -m trident_eval.pose_graph a.g2o --robust gnc\n",
        ),
        (
            ["report", "out/latest", "--dry-run"],
            "would run: /usr/bin/python3 -m trident_eval report out/latest\n",
        ),
        (["shell", "-c", "rosnode list", "--dry-run"], "would run: bash -c 'rosnode list'\n"),
    ],
)
def test_dry_run_prints_the_command_after_setup_and_build(
    argv: list[str],
    printed: str,
    clone: Workspace,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    steps = _Steps(monkeypatch, clone)
    assert cli.main(argv) == 0
    assert steps.names == ["provision", "build"]
    assert capsys.readouterr().out == printed


def test_an_error_is_one_line_and_exit_code_1(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    _Steps(monkeypatch, clone)
    assert cli.main(["report", str(clone.root / "gone.bag")]) == 1
    error = capsys.readouterr().err
    assert error.startswith("trident: ")
    assert "gone.bag does not exist" in error
    assert error.count("\n") == 1


def test_a_failing_command_is_named(tmp_path: Path) -> None:
    with pytest.raises(TridentError, match=r"copying failed \(exit code 3\): sh -c 'exit 3'"):
        Runner().check(["sh", "-c", "exit 3"], what="copying", cwd=tmp_path)
