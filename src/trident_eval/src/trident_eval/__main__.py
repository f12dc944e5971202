# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line: judge a run, or draw a run or a bag."""

from __future__ import annotations

import argparse
import json
import platform
import sys
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.bag import read_bag
from trident_eval.core.animation import animate
from trident_eval.core.errors import EvalError
from trident_eval.core.exit_codes import exit_code_of
from trident_eval.core.faults import add_faults, read_faults
from trident_eval.core.flight_records import Command, read_command
from trident_eval.core.log_warnings import log_warnings
from trident_eval.core.page import Report, page
from trident_eval.core.plots import draw_all
from trident_eval.core.provenance import Provenance, read_object, read_provenance
from trident_eval.core.report import table
from trident_eval.core.scene import Scene, formation_scene
from trident_eval.core.subjects import (
    add_subjects,
    draw_subjects,
    has_subject_with_vehicles,
    judge_subject,
)
from trident_eval.core.tracks import NoStatesError, read_states
from trident_eval.core.vehicles import flights
from trident_eval.core.verdict import Verdict, judge, take_over
from trident_eval.options import add_report
from trident_eval.recovery import recover_bags
from trident_eval.slam import evaluation, tour

PASSED, FAILED, UNUSABLE = 0, 1, 2
ANIMATION = "animation.gif"


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
    recover = commands.add_parser("recover", help="index the bags that a run has left open")
    recover.add_argument("folder", type=Path, metavar="DIR", help="folder of a run that has ended")
    recover.set_defaults(run=_recover)
    report = commands.add_parser("report", help="draw a run or a rosbag")
    add_report(report)
    report.set_defaults(run=_report)
    return parser


def _verdict(options: argparse.Namespace) -> int:
    folder: Path = options.folder
    if not folder.is_dir():
        raise EvalError(f"{folder}: no such folder; legal: the folder of a run")
    notes = recover_bags(folder)
    if record := tour.read_record(folder):
        return _tour_verdict(folder, record, notes, draw=not options.no_pictures)
    scene, verdict = None, None
    try:
        scene, verdict = _judge_folder(folder)
    except EvalError as error:
        verdict = _without_results(folder, error)
    add_subjects(verdict, folder)
    add_faults(verdict, read_faults(folder), notes)
    numbers = verdict.to_json()
    text = json.dumps(numbers, indent=2, allow_nan=False)
    (folder / "verdict.json").write_text(text + "\n", encoding="utf-8")
    print(table(numbers), flush=True)  # pictures take longer than the verdict
    if not options.no_pictures:
        _try_to_report(scene, numbers, folder)
    return PASSED if verdict.passed else FAILED


def _without_results(folder: Path, error: EvalError) -> Verdict:
    """A failed run, unless a world ran in which no vehicle was to be."""
    run = read_object(folder / "run.json")
    was_commanded = read_command(folder) is not None or has_subject_with_vehicles(folder)
    is_world_alone = isinstance(error, NoStatesError) and run.get("steps", 0) and not was_commanded
    verdict = Verdict({"vehicles": []}, [] if is_world_alone else [str(error)])
    take_over(run, verdict)
    return verdict


def _try_to_report(scene: Scene | None, numbers: dict[str, Any], folder: Path) -> None:
    """The report of a run; what hinders it says nothing about the run."""
    try:
        write_report(scene, numbers, folder, folder)
    except EvalError as error:
        print(f"trident_eval: no report: {error}", file=sys.stderr)


def _recover(options: argparse.Namespace) -> int:
    for sentence in recover_bags(options.folder):
        print(sentence)
    return PASSED


def _tour_verdict(folder: Path, record: dict[str, Any], notes: list[str], draw: bool) -> int:
    found, verdict = tour.judge_tour(folder, record)
    add_subjects(verdict, folder)
    add_faults(verdict, read_faults(folder), notes)
    numbers = verdict.to_json()
    text = json.dumps(numbers, indent=2, allow_nan=False)
    (folder / "verdict.json").write_text(text + "\n", encoding="utf-8")
    print(evaluation.table(found.summary()))
    print(table(numbers), flush=True)
    evaluation.write(found, folder, folder.resolve().name, draw)
    return PASSED if verdict.passed else FAILED


def _report(options: argparse.Namespace) -> int:
    source: Path = options.source
    if source.is_dir():
        scene, verdict = _judge_folder(source)
        add_subjects(verdict, source)
        add_faults(verdict, read_faults(source), [])
        numbers: dict[str, Any] | None = verdict.to_json()
        folder = options.out or source
    else:
        scene, numbers = read_bag(source), None
        folder = options.out or source.with_name(source.stem + "_report")
    folder.mkdir(parents=True, exist_ok=True)
    if options.animate:
        animate(scene, folder / ANIMATION, _show_frames)
    for picture in write_report(scene, numbers, source, folder):
        print(picture)
    return PASSED


def _show_frames(count: int, total: int) -> None:
    if sys.stderr.isatty():
        end = "\n" if count == total else ""
        print(f"\rdrawing {100 * count // total:3d} %", end=end, file=sys.stderr, flush=True)


def _judge_folder(folder: Path) -> tuple[Scene, Verdict]:
    tracks = read_states(folder / "states.csv")
    title = folder.resolve().name
    if judged := judge_subject(tracks, folder):
        names, verdict = judged
        return Scene(title, tracks.select(names)), verdict
    command = read_command(folder)
    verdict = judge(tracks, command, read_object(folder / "run.json"))
    if isinstance(command, Command):
        return formation_scene(title, tracks, command), verdict
    return Scene(title, tracks), verdict


def _draw(scene: Scene | None, source: Path, folder: Path) -> list[Path]:
    """The pictures in the order of the report; an animation is shown, not made."""
    pictures = draw_all(scene, folder) if scene else []
    if source.is_dir():
        pictures = draw_subjects(source, scene, folder, leads=True) + pictures
        pictures += draw_subjects(source, scene, folder, leads=False)
    if scene and (folder / ANIMATION).is_file():
        pictures.insert(0, folder / ANIMATION)
    return pictures


def write_report(
    scene: Scene | None, numbers: dict[str, Any] | None, source: Path, folder: Path
) -> list[Path]:
    """Draw a scene and write report.html, which holds the pictures.

    Args:
        scene: what to show; None: nothing is known of the vehicles.
        numbers: of the verdict, if there is one.
        source: the run's folder, or a bag.
        folder: where the files go; an animation that is there already is shown too.

    Returns:
        The files.

    Raises:
        EvalError: a file of the run is not what it should be.
    """
    pictures = _draw(scene, source, folder)
    provenance = read_provenance(source) if source.is_dir() else Provenance()
    report = Report(
        title=source.resolve().name,
        about=_about(scene, source, provenance),
        verdict=numbers,
        flown=flights(scene) if scene else (),
        pictures=pictures,
        provenance=provenance,
        warnings=log_warnings(source / "roslaunch.log"),
        drawn_with=_drawn_with(),
    )
    path = folder / "report.html"
    path.write_text(page(report), encoding="utf-8")
    return [*pictures, path]


def _about(scene: Scene | None, source: Path, provenance: Provenance) -> str:
    words = [Path(provenance.launch.get("launch_file", source)).name]
    if scene:
        begin, end = scene.tracks.time[0], scene.tracks.time[-1]
        count = len(scene.tracks.names)
        words.append(f"{count} vehicle{'s' * (count != 1)}")
        words.append(f"{begin:.1f} s to {end:.1f} s of simulated time")
    return ", ".join(words)


def _drawn_with() -> dict[str, str]:
    import matplotlib

    return {
        "Python": platform.python_version(),
        "numpy": np.__version__,
        "matplotlib": matplotlib.__version__,
        "written": datetime.now().astimezone().isoformat(timespec="seconds"),
    }


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
