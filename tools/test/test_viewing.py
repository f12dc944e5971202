# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import subprocess
from pathlib import Path

import pytest
from trident_tool.view import screenshot
from trident_tool.view.screenshot import Size, resized
from trident_tool.view.viewing import (
    ViewOptions,
    pick_config,
    source_command,
    view,
    view_environment,
)
from trident_tool.workspace import Runner, TridentError, Workspace


def test_nothing_stands_for_the_run_in_progress(clone: Workspace) -> None:
    assert source_command(clone, [], {}) is None


def test_a_bag_is_played_and_a_world_simulated(clone: Workspace, tmp_path: Path) -> None:
    bag, world = tmp_path / "run.bag", tmp_path / "a.world"
    bag.touch()
    world.touch()
    assert source_command(clone, [str(bag)], {}) == [
        *("rosbag", "play", "--clock", "--quiet"),
        str(bag),
    ]
    command = source_command(clone, [str(world)], {})
    assert command is not None
    assert command[:3] == ["roslaunch", "gazebo_ros", "empty_world.launch"]
    assert command[-1] == f"world_name:={world.resolve()}"


def test_a_launch_file_is_launched_with_its_arguments(clone: Workspace) -> None:
    file = clone.launch / "fly.launch"
    file.write_text('<launch><arg name="uavs" default="1"/></launch>', encoding="utf-8")
    command = source_command(clone, ["fly.launch", "uavs:=3"], {})
    assert command == ["roslaunch", "--disable-title", str(file), "uavs:=3"]
    with pytest.raises(TridentError, match="no argument 'uav'"):
        source_command(clone, ["fly.launch", "uav:=3"], {})


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["gone.bag"], "gone.bag does not exist"),
        (["a.txt"], r"a\.txt: view shows a \.bag, a \.world, an \.sdf or a \.launch file"),
        (["gone.launch"], r"no launch file 'gone\.launch'"),
        (["a.bag", "b.bag"], "one thing at a time, found also b.bag"),
    ],
)
def test_what_cannot_be_shown_is_refused(clone: Workspace, words: list[str], message: str) -> None:
    with pytest.raises(TridentError, match=message):
        source_command(clone, words, {})


def test_without_a_display_only_a_picture_can_be_made(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    with pytest.raises(TridentError, match="there is no DISPLAY"):
        view(clone, Runner(), ViewOptions())


def test_a_picture_without_a_request_is_taken_in_the_world(
    clone: Workspace, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (clone.root / "config" / "rviz" / "fleet.rviz").touch()
    (clone.launch / "fly.launch").write_text("<launch/>", encoding="utf-8")
    picture = tmp_path / "a.png"
    options = ViewOptions(("fly.launch",), screenshot=picture, at_s=3.0, size=Size(800, 500))
    view(clone, Runner(dry_run=True), options)
    took = f"overview.py --out {picture} --size 800x500 --hold --at 3"
    assert took in capsys.readouterr().out
    view(clone, Runner(dry_run=True), ViewOptions(screenshot=picture))
    output = capsys.readouterr().out
    assert f"overview.py --out {picture} --size 1600x1000" in output
    assert "--hold" not in output, "a run in progress continues"
    view(clone, Runner(dry_run=True), ViewOptions(("fly.launch",), "fleet", screenshot=picture))
    assert "rviz" in capsys.readouterr().out
    bag = tmp_path / "a.bag"
    bag.touch()
    view(clone, Runner(dry_run=True), ViewOptions((str(bag),), screenshot=picture))
    assert "rviz" in capsys.readouterr().out, "a bag holds no world"


def test_only_a_launch_can_be_held(clone: Workspace, tmp_path: Path) -> None:
    bag = tmp_path / "run.bag"
    bag.touch()
    for words in ((), (str(bag),)):
        with pytest.raises(TridentError, match="--at goes with a launch file only"):
            view(clone, Runner(dry_run=True), ViewOptions(words, at_s=3.0))


def test_what_is_looked_at_runs_in_real_time_and_does_not_end() -> None:
    env = view_environment({"HOME": "/h", "DISPLAY": ":1", "TRIDENT_END": "1"})
    assert env == {"HOME": "/h", "TRIDENT_REAL_TIME_FACTOR": "1", "TRIDENT_HEADLESS": "1"}
    assert view_environment({"TRIDENT_REAL_TIME_FACTOR": "5"})["TRIDENT_REAL_TIME_FACTOR"] == "5"


@pytest.mark.parametrize("text", ["", "1200", "1200x", "99x700", "700x99999", "-1x2", "1.5x200"])
def test_a_size_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="legal: WIDTHxHEIGHT"):
        Size.parse(text)


def test_the_window_is_as_large_as_the_picture() -> None:
    assert Size.parse("1200x700") == Size(1200, 700)
    text = (
        "Views: ~\nWindow Geometry:\n  Displays:\n    collapsed: true\n  Height: 9\n  Width: 14\n"
    )
    sized = "Views: ~\nWindow Geometry:\n  Height: 700\n  Width: 1200\n"
    assert resized(text, Size(1200, 700)) == sized
    assert resized("Views: ~\n", Size(1200, 700)) == sized


def test_rviz_configuration_by_name(clone: Workspace) -> None:
    assert pick_config(clone, None) is None
    wanted = clone.root / "config" / "rviz" / "fleet.rviz"
    wanted.touch()
    assert pick_config(clone, None) == wanted
    default = clone.root / "config" / "rviz" / "default.rviz"
    (clone.root / "config" / "rviz" / "cross.rviz").touch()
    default.touch()
    assert pick_config(clone, None) == default
    default.unlink()
    (clone.root / "config" / "rviz" / "cross.rviz").unlink()
    assert pick_config(clone, "fleet") == wanted
    with pytest.raises(TridentError, match=r"'slam'.*\(it has: fleet\)"):
        pick_config(clone, "slam")


@pytest.mark.parametrize(("code", "starts"), [(-6, 3), (1, 1)])
def test_only_a_viewer_that_crashes_is_started_again(
    code: int, starts: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    calls = []

    def ended(*_args: object) -> None:
        calls.append(1)
        raise screenshot.ViewerEndedError(code)

    monkeypatch.setattr(screenshot, "_picture", ended)
    with pytest.raises(TridentError, match=f"rviz ended with exit code {code}"):
        screenshot.screenshot(["rviz"], {}, tmp_path / "a.png", Size(), tries=3)
    assert len(calls) == starts


def test_a_configuration_that_is_no_text_is_refused(clone: Workspace, tmp_path: Path) -> None:
    binary = tmp_path / "binary.rviz"
    binary.write_bytes(bytes(range(256)))
    with pytest.raises(TridentError, match=r"binary\.rviz: .*legal: an rviz configuration"):
        pick_config(clone, str(binary))


def test_a_clock_of_progress_stands_while_the_program_waits_for_a_core(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    wall_s = iter([10.0, 12.0, 15.0, 16.0])
    waited = iter([{7: 1.0}, {7: 1.5, 8: 0.1}, {7: 1.5, 8: 2.1}, {8: 9.0}])
    monkeypatch.setattr(screenshot, "waited_s", lambda _pid: next(waited))
    clock = screenshot.ProgressClock(7, lambda: next(wall_s))
    assert clock.now_s() == pytest.approx(2.0 - 0.5)
    assert clock.now_s() == pytest.approx(1.5 + 3.0 - 2.0)
    assert clock.now_s() == pytest.approx(2.5)  # never back


def test_the_waiting_of_a_program_is_that_of_all_its_processes() -> None:
    command = ["sh", "-c", "cat; true"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as shell:
        assert shell.stdin is not None
        assert shell.stdout is not None
        shell.stdin.write(b"there\n")
        shell.stdin.flush()
        assert shell.stdout.readline() == b"there\n"  # by cat
        waited = screenshot.waited_s(shell.pid)
        assert len(waited) == 2
        assert shell.pid in waited
        assert min(waited.values()) >= 0.0
        shell.stdin.close()
    assert screenshot.waited_s(shell.pid) == {}
