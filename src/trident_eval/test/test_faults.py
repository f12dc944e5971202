# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Verdicts of runs in which something died."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from runs import Run
from trident_eval.__main__ import main
from trident_eval.core.errors import EvalError
from trident_eval.core.faults import read_faults
from trident_eval.core.tracks import read_states
from trident_eval.recovery import copy_whole_messages, recover_bags

rosbag = pytest.importorskip("rosbag", reason="rosbag is not installed")

# A recorder that is killed: nothing is closed, and what is in its buffers is lost.
RECORDER = """
import os, signal, sys
import rosbag
from genpy import Time
from std_msgs.msg import String

bag = rosbag.Bag(sys.argv[1], "w", chunk_threshold=int(sys.argv[2]))
for number in range(int(sys.argv[3])):
    bag.write("/said", String("x" * 100), Time(10 + number))
bag._file.flush()
os.kill(os.getpid(), signal.SIGKILL)
"""


def killed_recording(path: Path, chunk: int, messages: int) -> bytes:
    """What is in a bag whose recorder was killed after so many messages."""
    command = [sys.executable, "-c", RECORDER, str(path), str(chunk), str(messages)]
    subprocess.run(command, check=False, env=dict(os.environ))
    return path.read_bytes()


def faults(folder: Path, *entries: tuple[str, str, bool]) -> None:
    keys = ("node", "cause", "is_fatal")
    found = [dict(zip(keys, entry, strict=True)) for entry in entries]
    (folder / "faults.json").write_text(json.dumps(found))


def verdict(folder: Path) -> dict[str, object]:
    main(["verdict", str(folder), "--no-pictures"])
    found: dict[str, object] = json.loads((folder / "verdict.json").read_text())
    return found


def test_a_node_that_was_missed_fails_a_flight_that_was_well(planned_run: Run) -> None:
    faults(planned_run.folder, ("/slam", "was killed by SIGKILL", True), ("/b", "died", True))
    found = verdict(planned_run.folder)
    assert found["pass"] is False
    assert found["reasons"] == ["/slam was killed by SIGKILL", "/b died"]


def test_the_first_cause_comes_before_its_consequences(planned_run: Run) -> None:
    planned_run.position[-1, 0, 2] = -0.4
    planned_run.write()
    faults(planned_run.folder, ("/UAV1/pilot", "was killed by SIGSEGV", True))
    reasons = verdict(planned_run.folder)["reasons"]
    assert isinstance(reasons, list)
    assert reasons[0] == "/UAV1/pilot was killed by SIGSEGV"
    assert len(reasons) > 1


def test_a_lost_recording_is_named_and_fails_nothing(
    planned_run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    faults(planned_run.folder, ("/record", "was killed by SIGKILL", False))
    killed_recording(planned_run.folder / "run.bag.active", 400, 20)
    found = verdict(planned_run.folder)
    assert found["pass"] is True
    notes = found["notes"]
    assert isinstance(notes, list)
    assert notes[0] == "/record was killed by SIGKILL"
    assert "run.bag was not closed: its 20 messages up to 29.00 s are kept" in notes[1]
    assert notes[1] in capsys.readouterr().out
    with rosbag.Bag(str(planned_run.folder / "run.bag")) as bag:
        assert bag.get_message_count() == 20


@pytest.mark.parametrize("content", ["{", "[1]", '[{"node": "/a"}]'])
def test_damaged_faults_are_refused(tmp_path: Path, content: str) -> None:
    (tmp_path / "faults.json").write_text(content)
    with pytest.raises(EvalError, match=r"faults\.json: .*legal: a list of node, cause"):
        read_faults(tmp_path)


def test_a_torn_last_line_of_the_states_is_dropped(planned_run: Run) -> None:
    path = planned_run.folder / "states.csv"
    whole = read_states(path)
    text = path.read_text()
    lines = text.splitlines(keepends=True)
    # Where it is torn decides nothing: half a number is a number, too.
    for cut in range(1, len(lines[-1])):
        path.write_text(text[:-cut])
        tracks = read_states(path)
        assert len(tracks.time) == len(whole.time)
        assert tracks.names == whole.names
        is_last_there = bool((tracks.position[-1, -1] == tracks.position[-1, -1]).all())
        assert not is_last_there


@pytest.mark.parametrize("chunk", [400, 800_000])
@pytest.mark.parametrize("cut", [0, 1, 13, 77, 150])
def test_what_is_whole_in_a_bag_is_kept(tmp_path: Path, chunk: int, cut: int) -> None:
    path, source = tmp_path / "run.bag", tmp_path / "run.bag.active"
    data = killed_recording(source, chunk, 50)
    source.write_bytes(data[: len(data) - cut])
    count, end_s = copy_whole_messages(source, path)
    # A message takes 150 bytes.
    assert count >= 48
    assert count == 50 or cut
    with rosbag.Bag(str(path)) as bag:
        stamps = [stamp.to_sec() for _, _, stamp in bag.read_messages()]
    assert stamps == [10.0 + number for number in range(count)]
    assert end_s == stamps[-1]


@pytest.mark.parametrize("content", [b"", b"#ROSBAG V2.0\n", b"no bag at all\n" * 9, bytes(4096)])
def test_a_bag_without_anything_is_named(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "run.bag.active"
    path.write_bytes(content)
    (sentence,) = recover_bags(tmp_path)
    assert str(path) in sentence
    assert path.read_bytes()[: len(content)] == content, "it is left as it was"


def test_a_bag_that_is_there_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "run.bag").write_text("kept")
    (tmp_path / "run.bag.active").write_text("left")
    assert recover_bags(tmp_path)[0].endswith("run.bag is there already")
    assert (tmp_path / "run.bag").read_text() == "kept"
