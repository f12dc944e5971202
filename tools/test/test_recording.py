# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Films and rerun in place of rviz."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from trident_tool.processes import foreground
from trident_tool.view.recording import Recording
from trident_tool.view.screenshot import Size
from trident_tool.view.viewing import ViewOptions, view, viewer_command
from trident_tool.workspace import Runner, TridentError, Workspace


def test_a_film_is_made_by_the_observer(clone: Workspace) -> None:
    recording = Recording(film=Path("a.mp4"), follow="robot", seconds=5.0)
    options = ViewOptions(("a.launch",), size=Size(640, 400), recording=recording)
    command = viewer_command(clone, options, {"DISPLAY": ":0"})
    words = "--seconds 5 --out a.mp4 --wait 60 --size 640x400 --follow robot"
    assert command == ["rosrun", "trident_viewer", "observer.py", *words.split()]


def test_rerun_is_opened_where_there_is_a_display(clone: Workspace) -> None:
    options = ViewOptions(recording=Recording(rerun=True, out=Path("a.rrd")))
    command = viewer_command(clone, options, {})
    assert command[0] == str(clone.venv_python)
    assert command[1:] == ["-m", "trident_viewer.to_rerun", "--out", "a.rrd"]
    assert viewer_command(clone, options, {"DISPLAY": ":0"}) == [*command, "--viewer"]


@pytest.mark.parametrize(
    ("recording", "what"),
    [
        (Recording(film=Path("a.mp4"), rerun=True), "--film and --rerun: one at a time"),
        (Recording(follow="robot"), "--follow goes with --film only"),
        (Recording(out=Path("a.rrd")), "--out goes with --rerun only"),
        (Recording(seconds=1.0), "--seconds goes with --film or --rerun only"),
        (Recording(rerun=True, seconds=float("nan")), "--seconds nan, legal: more than 0"),
        (Recording(film=Path("a.gif")), "--film a.gif: suffix '.gif', legal: .mp4"),
        (Recording(rerun=True, out=Path("a.bag")), "--out a.bag: suffix '.bag', legal: .rrd"),
        (Recording(film=Path("none/a.mp4")), "--film none/a.mp4: its folder does not exist"),
        (Recording(rerun=True), "no DISPLAY for the rerun viewer: record with --out FILE.rrd"),
    ],
)
def test_what_does_not_go_together_is_refused(recording: Recording, what: str) -> None:
    with pytest.raises(TridentError, match=what):
        recording.validate(has_display=False)


def test_a_world_that_is_held_cannot_be_filmed(clone: Workspace) -> None:
    options = ViewOptions(("a.launch",), at_s=3.0, recording=Recording(film=Path("a.mp4")))
    with pytest.raises(TridentError, match="--at and --screenshot go with rviz only"):
        view(clone, Runner(dry_run=True), options)


def _python(code: str) -> list[str]:
    return [sys.executable, "-c", code]


def test_a_process_in_the_foreground_gives_its_exit_code() -> None:
    assert foreground(_python("raise SystemExit(3)"), {}, None) == 3


def test_it_ends_when_what_it_lives_on_has_failed() -> None:
    waiting = """
import signal
try:
    signal.pause()
except KeyboardInterrupt:
    print("finished", flush=True)
"""
    with subprocess.Popen(_python("raise SystemExit(7)")) as source:
        source.wait()
        assert foreground(_python(waiting), {}, source) == 7
