# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import io
import json
import signal
import socket
import struct
import sys
import threading
import zlib
from datetime import datetime
from pathlib import Path
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from trident_tool.progress import (
    ProgressView,
    Tail,
    last_warnings,
    parse_report,
    progress_line,
    required_node_failed,
    strip_ansi,
)
from trident_tool.running import (
    Ending,
    Run,
    free_port,
    launch,
    new_run_folder,
    open_run_folder,
    plan_run,
    run_environment,
    why_failed,
)
from trident_tool.shell import running_master, simulator_master
from trident_tool.view.framebuffer import Image, read_xwd, write_png
from trident_tool.workspace import TridentError, Workspace

DIED = """\
================REQUIRED process [gazebo-2] has died!
process has died [pid 17, exit code {code}, cmd gazebo].
"""


def _launch_file(clone: Workspace, args: str = "") -> None:
    text = f"<launch>{args}</launch>"
    (clone.launch / "fly.launch").write_text(text, encoding="utf-8")


def test_a_run_is_headless_fast_and_under_its_own_master(clone: Workspace) -> None:
    _launch_file(clone)
    run = plan_run(clone, ["fly.launch"], {"HOME": "/h"}, is_built=False)
    assert run.env["TRIDENT_REAL_TIME_FACTOR"] == "0"
    assert run.env["TRIDENT_HEADLESS"] == "1"
    assert run.env["TRIDENT_END"] == "1"
    assert run.env["TRIDENT_OUT"] == str(run.folder)
    assert run.env["ROS_MASTER_URI"] == f"http://localhost:{run.port}"
    assert run.env["HOME"] == "/h"
    assert run.command[-3:] == ["-p", str(run.port), str(clone.launch / "fly.launch")]


def test_strict_reaches_the_simulator_with_and_without_such_an_arg(clone: Workspace) -> None:
    _launch_file(clone, "")
    assert "TRIDENT_STRICT" not in plan_run(clone, ["fly.launch"], {}).env
    run = plan_run(clone, ["fly.launch", "strict:=true"], {})
    assert run.env["TRIDENT_STRICT"] == "1"
    assert run.args == {}
    assert plan_run(clone, ["fly.launch", "strict:=false"], {}).env["TRIDENT_STRICT"] == "0"
    _launch_file(clone, '<arg name="strict" default="false"/>')
    assert plan_run(clone, ["fly.launch", "strict:=true"], {}).args == {"strict": "true"}
    with pytest.raises(TridentError, match="strict is 'perhaps', legal: true or false"):
        plan_run(clone, ["fly.launch", "strict:=perhaps"], {})


def test_real_time_factor_reaches_the_simulator_with_and_without_such_an_arg(
    clone: Workspace,
) -> None:
    _launch_file(clone)
    run = plan_run(clone, ["fly.launch", "real_time_factor:=1"], {}, is_built=False)
    assert run.env["TRIDENT_REAL_TIME_FACTOR"] == "1"
    assert run.args == {}
    _launch_file(clone, '<arg name="real_time_factor" default="1"/>')
    run = plan_run(clone, ["fly.launch", "real_time_factor:=2"], {}, is_built=False)
    assert run.env["TRIDENT_REAL_TIME_FACTOR"] == "2"
    assert run.command[-1] == "real_time_factor:=2"


def test_a_given_host_name_is_kept() -> None:
    assert run_environment({}, Path("/o"), 1, "0")["ROS_HOSTNAME"] == "localhost"
    assert run_environment({"ROS_HOSTNAME": "h"}, Path("/o"), 1, "0")["ROS_HOSTNAME"] == "h"
    assert "ROS_HOSTNAME" not in run_environment({"ROS_IP": "1.2.3.4"}, Path("/o"), 1, "0")


def test_two_runs_in_one_second_have_two_folders(tmp_path: Path) -> None:
    now = datetime(2026, 1, 2, 3, 4, 5)
    first = new_run_folder(tmp_path, "fly", now)
    first.mkdir()
    assert first.name == "20260102-030405-fly"
    assert new_run_folder(tmp_path, "fly", now).name == "20260102-030405-fly-2"


def _opened_run(clone: Workspace, command: list[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """A run whose folder exists and whose roslaunch is ``command``."""
    _launch_file(clone)
    run = plan_run(clone, ["fly.launch"], {"PATH": "/usr/bin:/bin"}, is_built=False)
    open_run_folder(clone, run)
    monkeypatch.setattr(Run, "command", property(lambda _self: command))
    return run


def test_latest_points_at_the_newest_run(clone: Workspace, monkeypatch: pytest.MonkeyPatch) -> None:
    _opened_run(clone, [], monkeypatch)
    second = _opened_run(clone, [], monkeypatch)
    assert (clone.out / "latest").resolve() == second.folder
    facts = json.loads((clone.out / "latest" / "launch.json").read_text(encoding="utf-8"))
    assert facts["ros_master_uri"] == second.env["ROS_MASTER_URI"]
    assert (clone.out / "rospack_nosubdirs").is_file()


def test_exit_code_and_output_of_the_launch_are_kept(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = _opened_run(clone, ["sh", "-c", "echo said; exit 4"], monkeypatch)
    assert launch(run) == Ending(4, [])
    assert (run.folder / "roslaunch.log").read_text(encoding="utf-8") == "said\n"


def test_ctrl_c_interrupts_the_launch_and_waits_for_its_end(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    script = (
        "import pathlib, signal, sys\n"
        "def stop(*_):\n"
        "    print('cleaned up', flush=True)\n"
        "    sys.exit(0)\n"
        "signal.signal(signal.SIGINT, stop)\n"
        "pathlib.Path('ready').touch()\n"
        "signal.pause()\n"
    )
    run = _opened_run(clone, [sys.executable, "-c", script], monkeypatch)
    monkeypatch.chdir(run.folder)

    def interrupt(_view: ProgressView) -> None:
        if Path("ready").exists():
            raise KeyboardInterrupt

    monkeypatch.setattr(ProgressView, "update", interrupt)
    monkeypatch.setattr(ProgressView, "close", lambda _view: None)
    handler = signal.getsignal(signal.SIGINT)
    assert launch(run) == Ending(130, [])
    assert (run.folder / "roslaunch.log").read_text(encoding="utf-8") == "cleaned up\n"
    assert signal.getsignal(signal.SIGINT) == handler


def test_a_launch_ends_when_a_node_dies_that_it_cannot_do_without(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    line = "[slam-1] process has died [pid 17, exit code -9, cmd x]."
    run = _opened_run(clone, ["sh", "-c", f"echo '{line}'; sleep 1000"], monkeypatch)
    ending = launch(run)
    assert [fault.text for fault in ending.faults] == ["/slam was killed by SIGKILL"]
    assert why_failed(run, ending) == "/slam was killed by SIGKILL"


@pytest.mark.parametrize("factor", ["-1", "fast"])
def test_a_wrong_real_time_factor_starts_nothing(clone: Workspace, factor: str) -> None:
    _launch_file(clone)
    with pytest.raises(TridentError, match=f"real_time_factor is '{factor}'"):
        plan_run(clone, ["fly.launch", f"real_time_factor:={factor}"], {})
    assert not clone.out.exists()


def test_a_free_port_can_be_listened_on() -> None:
    with socket.socket() as server:
        server.bind(("", free_port()))
        server.listen()


def test_a_free_port_is_given_to_nobody_who_asks_for_any() -> None:
    limits = Path("/proc/sys/net/ipv4/ip_local_port_range").read_text(encoding="ascii").split()
    low, high = map(int, limits)
    assert not any(low <= free_port() <= high for _ in range(50))


def test_the_master_of_a_run_is_found_only_while_it_listens(clone: Workspace) -> None:
    folder = clone.out / "latest"
    folder.mkdir(parents=True)
    assert running_master(clone) is None
    with socket.socket() as server:
        server.bind(("localhost", 0))
        server.listen()
        uri = f"http://localhost:{server.getsockname()[1]}"
        (folder / "launch.json").write_text(json.dumps({"ros_master_uri": uri}), encoding="utf-8")
        assert running_master(clone) == uri
    assert running_master(clone) is None


def test_the_master_of_a_simulator_is_that_of_the_environment(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    services = {"/gazebo/get_world_properties": "rosrpc://localhost:1"}

    def lookup(_caller: str, name: str) -> tuple[int, str, str]:
        return (1, "", services[name]) if name in services else (-1, "unknown", "")

    with SimpleXMLRPCServer(("localhost", 0), logRequests=False) as master:
        master.register_function(lookup, "lookupService")
        thread = threading.Thread(target=master.serve_forever)
        thread.start()
        uri = f"http://localhost:{master.server_address[1]}"
        monkeypatch.setenv("ROS_MASTER_URI", uri)
        try:
            assert simulator_master() == uri
            services.clear()
            assert simulator_master() is None
        finally:
            master.shutdown()
            thread.join()
    assert simulator_master() is None


@pytest.mark.parametrize(
    ("report", "line"),
    [
        (
            {"sim_s": 30, "end_s": 120, "rtf": 41.26, "vehicles": 6, "state": "flying"},
            "[#####...............]  25%  30.0/120.0 s simulated  x41.3 real time  "
            "6 vehicles  flying",
        ),
        ({"sim_s": 3.0}, "3.0 s simulated"),
        ({"sim_s": 0, "end_s": None, "state": "waiting"}, "0.0 s simulated  waiting"),
    ],
)
def test_progress_line(report: dict[str, object], line: str) -> None:
    assert progress_line(report) == line


def test_progress_line_fits_the_terminal() -> None:
    assert len(progress_line({"sim_s": 1, "state": "x" * 200}, width=79)) == 79


def test_half_a_report_is_none() -> None:
    assert parse_report('{"sim_s": 1') is None
    assert parse_report("[1]") is None
    assert parse_report('{"sim_s": 1}') == {"sim_s": 1}


def test_tail_gives_whole_lines_once(tmp_path: Path) -> None:
    path = tmp_path / "log"
    tail = Tail(path)
    assert tail.lines() == []
    path.write_bytes(b"one\ntw")
    assert tail.lines() == ["one"]
    with path.open("ab") as file:
        file.write(b"o\n")
    assert tail.lines() == ["two"]
    assert tail.lines() == []


@pytest.mark.parametrize(
    ("log", "name"),
    [(DIED.format(code=1), "gazebo-2"), (DIED.format(code=-11), "gazebo-2"), ("all well", None)],
)
def test_a_failed_required_node_is_found(log: str, name: str | None) -> None:
    assert required_node_failed(log) == name


def test_a_required_node_that_ends_with_0_or_cleanly_did_not_fail() -> None:
    assert required_node_failed(DIED.format(code=0)) is None
    clean = "REQUIRED process [gazebo-2] has died!\nprocess has finished cleanly\n"
    assert required_node_failed(clean) is None


def test_view_shows_warnings_once_and_progress_sparsely(tmp_path: Path) -> None:
    stream = io.StringIO()
    view = ProgressView(tmp_path, stream)
    warning = "\x1b[33m[ WARN] [17.{0}]: no plugin libx.so\x1b[0m\n"
    (tmp_path / "roslaunch.log").write_text(
        "started\n" + warning.format(1) + warning.format(2), encoding="utf-8"
    )
    with (tmp_path / "progress.jsonl").open("w", encoding="utf-8") as file:
        file.write('{"sim_s": 1}\n{"sim_s": 2}\n')
    view.update()
    assert stream.getvalue() == "[ WARN] [17.1]: no plugin libx.so\n2.0 s simulated\n"
    with (tmp_path / "progress.jsonl").open("a", encoding="utf-8") as file:
        file.write('{"sim_s": 3}\n')
    view.update()
    assert "3.0" not in stream.getvalue()


def test_last_warnings_name_the_log(tmp_path: Path) -> None:
    (tmp_path / "UAV1-lee.log").write_text("fine\n[ERROR] [1.0]: no gains\n", encoding="utf-8")
    assert last_warnings(tmp_path) == ["UAV1-lee.log: [ERROR] [1.0]: no gains"]


def test_a_warning_in_several_logs_is_said_once(tmp_path: Path) -> None:
    texts = {
        "roslaunch.log": "\x1b[31m[ERROR] [17.5]: no gains\x1b[0m\n",
        "lee-2.log": "[rosout][ERROR] 2026-11-21 07:28:39,327: no gains\n",
        "rosout.log": "17.5 ERROR /lee [lee.cpp:11(main)] [topics: /rosout] no gains\n",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    (warning,) = last_warnings(tmp_path)
    assert warning.endswith("no gains")


def test_ansi_codes_and_titles_are_removed() -> None:
    assert strip_ansi("\x1b[31mred\x1b[0m \x1b]2;title\x07text") == "red text"


def _xwd(pixels: list[int], width: int, order: int = 0, padding: int = 4) -> bytes:
    """An X window dump; ``order`` 0 is little-endian."""
    height = len(pixels) // width
    fields = [0] * 25
    fields[0], fields[1], fields[4], fields[5] = 104, 7, width, height
    fields[7], fields[11], fields[12], fields[19] = order, 32, 4 * width + padding, 1
    endian = "<" if order == 0 else ">"
    rows = b"".join(
        struct.pack(f"{endian}{width}I", *pixels[row * width : (row + 1) * width]) + bytes(padding)
        for row in range(height)
    )
    return struct.pack(">25I", *fields) + b"name" + bytes(12) + rows


@pytest.mark.parametrize("order", [0, 1])
def test_window_dump_is_read_in_both_byte_orders(order: int) -> None:
    image = read_xwd(_xwd([0x112233, 0x445566, 0x778899, 0xAABBCC], 2, order))
    assert image == Image(2, 2, bytes.fromhex("112233445566778899aabbcc"))
    assert not image.is_blank()


def test_blank_screen_is_known() -> None:
    assert read_xwd(_xwd([5, 5, 5, 5], 2)).is_blank()


@pytest.mark.parametrize("data", [b"", b"x" * 200, _xwd([1, 2], 2)[:-1]])
def test_what_is_no_window_dump_is_refused(data: bytes) -> None:
    with pytest.raises(TridentError, match="X window dump"):
        read_xwd(data)


def test_the_border_around_a_window_is_cut_off() -> None:
    black, red = bytes(3), b"\xff\0\0"
    rows = [[black] * 4, [black, red, red, black], [black, black, red, black], [black] * 4]
    image = Image(4, 4, b"".join(b"".join(row) for row in rows))
    assert image.cropped() == Image(2, 2, red + red + black + red)
    assert Image(2, 1, bytes(6)).cropped() == Image(2, 1, bytes(6))


def test_png_holds_the_pixels(tmp_path: Path) -> None:
    target = tmp_path / "new" / "a.png"
    write_png(Image(2, 1, bytes(range(6))), target)
    data = target.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    start = data.index(b"IDAT") + 4
    length = struct.unpack(">I", data[start - 8 : start - 4])[0]
    assert zlib.decompress(data[start : start + length]) == b"\0" + bytes(range(6))
