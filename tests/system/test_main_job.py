# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The main job as `./trident run` does it: verdict, equal hashes, recording, and its refusals."""

from __future__ import annotations

import shutil
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import rosbag
import scipy.io
from harness import REPO, Recorder, Ros, eventually
from nav_msgs.msg import Odometry
from trident_runs import Outcome, Trident

FORMATION = REPO / "config" / "formations" / "hexagon_translate_rotate.txt"
LAUNCH = "multi_uav_simulation.launch"


@pytest.fixture(scope="module")
def recorded(trident: Trident) -> Outcome:
    """One whole main job with a bag; the tests below look at it from several sides."""
    return trident("run", LAUNCH, "record:=true")


@pytest.fixture
def short_formation(tmp_path: Path) -> Path:
    """The first 30 rows of each vehicle, comma separated and with CRLF."""
    rows = [
        line.split()
        for line in FORMATION.read_text("utf-8").splitlines()
        if line.strip() and not line.lstrip().startswith("%")
    ]
    path = tmp_path / "short.csv"
    path.write_text("".join(",".join(row) + "\r\n" for row in rows[: 30 * 6]), "utf-8")
    return path


def test_the_main_job_passes_and_a_second_run_has_the_same_hash(
    trident: Trident, recorded: Outcome
) -> None:
    first = recorded.passed
    assert first["formation_rms_m"] < 0.05
    assert first["min_separation_m"] >= first["file_min_separation_m"] - 0.1
    assert first["rows_flown"] == first["rows"] == 200
    assert len(first["vehicles"]) == 6
    second = trident("run", LAUNCH).passed
    assert second["state_hash"] == first["state_hash"], "recorded or not"
    assert second["sim_s"] == first["sim_s"]
    assert second["formation_rms_m"] == first["formation_rms_m"]


def test_four_vehicles_fly_another_file_in_gate_mode(
    trident: Trident, short_formation: Path
) -> None:
    run = trident("run", LAUNCH, "mode:=gate", "uavs:=4", f"formation_file:={short_formation}")
    verdict = run.passed
    assert verdict["mode"] == "gate"
    assert verdict["vehicles"] == ["UAV1", "UAV2", "UAV3", "UAV4"]
    assert verdict["formation_rms_m"] < 0.08
    assert verdict["rows_flown"] == verdict["rows"] == 30
    assert verdict["formation_file"] == str(short_formation)


def test_a_flight_that_misses_its_marks_exits_with_1(
    trident: Trident, short_formation: Path
) -> None:
    run = trident(
        "run",
        LAUNCH,
        f"formation_file:={short_formation}",
        "v_max:=20",
        "a_max:=60",
        "j_max:=1000",
        "scale_x:=3",
        "scale_y:=3",
    )
    assert run.code == 1, run.output
    assert not run.verdict["pass"]
    assert run.verdict["reasons"], "it says why"


def test_the_recording_gives_the_pictures_of_the_run(
    trident: Trident, recorded: Outcome, tmp_path: Path
) -> None:
    assert recorded.folder is not None
    pictures = {file.name for file in recorded.folder.glob("*.png")}
    assert len(pictures) >= 3
    bag = tmp_path / "run.bag"
    shutil.copy(recorded.folder / "run.bag", bag)
    report = trident("report", bag)
    assert report.code == 0, report.output
    drawn = {file.name: file for file in tmp_path.rglob("*.png")}
    assert pictures <= set(drawn), f"{pictures} from the run, {set(drawn)} from the bag"
    for file in drawn.values():
        assert file.read_bytes().startswith(b"\x89PNG")
        assert file.stat().st_size > 5000


def test_the_recording_can_be_played(ros: Ros, recorded: Outcome) -> None:
    assert recorded.folder is not None
    path = recorded.folder / "run.bag"
    topic = "/UAV4/odometry_sensor1/odometry"
    with rosbag.Bag(str(path)) as bag:
        recorded_stamps = [message.header.stamp for _, message, _ in bag.read_messages(topic)]
        topics = set(bag.get_type_and_topic_info().topics)
    assert {f"/UAV{n}/odometry_sensor1/odometry" for n in range(1, 7)} <= topics
    assert recorded_stamps == sorted(set(recorded_stamps))
    gaps = [(b - a).to_sec() for a, b in pairwise(recorded_stamps)]
    assert max(gaps) <= 0.1, "pictures drawn from the recording show the flight"
    assert recorded_stamps[0].to_sec() <= 0.2
    heard = Recorder(topic, Odometry, queue_size=100000)
    # A player that ends drops what is still in its queue: it has to stay, and its queue to be long.
    ros.launch(
        [
            *("rosbag", "play", "--rate=8", "--quiet", "--keep-alive", "--queue=100000"),
            *("--wait-for-subscribers", "--topics", topic, "--bags", path),
        ]
    )
    try:
        eventually(lambda: len(heard.messages) >= len(recorded_stamps), "all messages are played")
    finally:
        heard.close()
    assert [message.header.stamp for message in heard.messages] == recorded_stamps


def bad_formation(case: str, folder: Path) -> tuple[Path, list[str]]:
    """A file with one fault, and what the message must say of it."""
    lines = FORMATION.read_text("utf-8").splitlines()
    data = [n for n, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("%")]
    path = folder / f"{case}.txt"
    words = [path.name]
    if case == "missing column":
        lines[data[7]] = " ".join(lines[data[7]].split()[:3])
        words.append(f":{data[7] + 1}")
    elif case == "non-numeric cell":
        cells = lines[data[20]].split()
        lines[data[20]] = " ".join([cells[0], "3..5", *cells[2:]])
        words += [f":{data[20] + 1}", "3..5"]
    elif case == "rows do not divide":
        lines = lines[: data[-1]]
        words += ["1199", "6"]
    elif case == "empty":
        lines = []
    elif case == "no vehicle_pos":
        path = folder / "wrong.mat"
        scipy.io.savemat(path, {"positions": np.zeros((3, 6, 10))})
        return path, ["wrong.mat", "vehicle_pos", "positions"]
    path.write_text("\n".join(lines) + "\n" * bool(lines), "utf-8")
    return path, words


@pytest.mark.parametrize(
    "case",
    [
        "missing column",
        "non-numeric cell",
        "rows do not divide",
        "empty",
        "no vehicle_pos",
    ],
)
def test_a_bad_formation_file_ends_the_run_with_its_place(
    trident: Trident, tmp_path: Path, case: str
) -> None:
    path, words = bad_formation(case, tmp_path)
    run = trident("run", LAUNCH, "uavs:=1", f"formation_file:={path}")
    assert run.code != 0, run.output
    assert "Traceback" not in run.output
    lines = [line for line in run.output.splitlines() if all(word in line for word in words)]
    assert lines, f"no line with {words} in:\n{run.output}"


def test_unknown_arguments_are_refused_before_anything_starts(trident: Trident) -> None:
    run = trident("run", LAUNCH, "no_such_arg:=3")
    assert run.code != 0
    assert "no_such_arg" in run.output
    assert run.folder is None or not (run.folder / "roslaunch.log").exists()
