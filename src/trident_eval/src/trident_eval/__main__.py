# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line: judge a run, or draw a run or a bag."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from trident_eval.bag import read_bag
from trident_eval.core.command import Command, read_command
from trident_eval.core.errors import EvalError
from trident_eval.core.plots import draw_all
from trident_eval.core.report import page, table
from trident_eval.core.scene import Scene, formation_scene
from trident_eval.core.tracks import read_states
from trident_eval.core.verdict import Verdict, judge

PASSED, FAILED, UNUSABLE = 0, 1, 2


def main(arguments: list[str] | None = None) -> int:
    """Run a subcommand.

    Returns:
        0: passed or drawn; 1: the verdict fails; 2: nothing that can be drawn.
    """
    options = _parser().parse_args(arguments)
    try:
        return int(options.run(options))
    except EvalError as error:
        print(f"trident_eval: {error}", file=sys.stderr)
        return UNUSABLE


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="trident_eval", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    verdict = commands.add_parser("verdict", help="judge a run and draw it")
    verdict.add_argument("folder", type=Path, metavar="DIR", help="folder of the run")
    verdict.add_argument("--no-pictures", action="store_true", help="only verdict.json")
    verdict.set_defaults(run=_verdict)
    report = commands.add_parser("report", help="draw a run or a rosbag")
    report.add_argument("source", type=Path, metavar="RUN_OR_BAG", help="folder of a run, or a bag")
    report.add_argument("--out", type=Path, metavar="DIR", help="folder of the pictures")
    report.set_defaults(run=_report)
    return parser


def _verdict(options: argparse.Namespace) -> int:
    folder: Path = options.folder
    if not folder.is_dir():
        raise EvalError(f"{folder}: no such folder; legal: the folder of a run")
    scene, verdict = None, None
    try:
        scene, verdict = _judge_folder(folder)
    except EvalError as error:
        # A run without usable results is a failed run.
        verdict = Verdict({"vehicles": []}, [str(error)])
    numbers = verdict.to_json()
    text = json.dumps(numbers, indent=2, allow_nan=False)
    (folder / "verdict.json").write_text(text + "\n", encoding="utf-8")
    if scene and not options.no_pictures:
        _draw(scene, numbers, folder)
    print(table(numbers))
    return PASSED if verdict.passed else FAILED


def _report(options: argparse.Namespace) -> int:
    source: Path = options.source
    if source.is_dir():
        scene, verdict = _judge_folder(source)
        numbers: dict[str, Any] | None = verdict.to_json()
        folder = options.out or source
    else:
        scene, numbers = read_bag(source), None
        folder = options.out or source.with_name(source.stem + "_report")
    folder.mkdir(parents=True, exist_ok=True)
    for picture in _draw(scene, numbers, folder):
        print(picture)
    return PASSED


def _judge_folder(folder: Path) -> tuple[Scene, Verdict]:
    tracks = read_states(folder / "states.csv")
    command = read_command(folder)
    verdict = judge(tracks, command, _run_summary(folder / "run.json"))
    title = folder.resolve().name
    if isinstance(command, Command):
        return formation_scene(title, tracks, command), verdict
    return Scene(title, tracks), verdict


def _run_summary(path: Path) -> dict[str, Any]:
    if not path.exists():
        return {}
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise EvalError(f"{path}: {error}; legal: what the simulator writes at its end") from error
    if not isinstance(summary, dict):
        raise EvalError(f"{path}: not an object; legal: what the simulator writes at its end")
    return summary


def _draw(scene: Scene, numbers: dict[str, Any] | None, folder: Path) -> list[Path]:
    pictures = draw_all(scene, folder)
    report = folder / "report.html"
    report.write_text(page(scene.title, numbers, pictures), encoding="utf-8")
    return [*pictures, report]


if __name__ == "__main__":
    sys.exit(main())
