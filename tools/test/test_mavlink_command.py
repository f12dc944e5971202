# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The command about MAVLink: addresses, logs played again, what is shown."""

from __future__ import annotations

import math
import socket
from contextlib import closing
from pathlib import Path

import pytest
from trident_tool import cli
from trident_tool.mavlink.address import Address
from trident_tool.mavlink.replay import Record, read_log, records, replay
from trident_tool.mavlink.watch import Board
from trident_tool.workspace import TridentError


def _heartbeat_1() -> bytes:
    return bytes([0xFE, 9, 0, 1, 1, 0]) + bytes(9 + 2)


def _signed_2() -> bytes:
    return bytes([0xFD, 3, 1, 0, 0, 1, 1, 0, 0, 0]) + bytes(3 + 2 + 13)


def _log(*packets: bytes, step_us: int = 1000) -> bytes:
    return b"".join(
        (10**15 + i * step_us).to_bytes(8, "big") + packet for i, packet in enumerate(packets)
    )


def test_a_log_is_cut_into_its_packets() -> None:
    packets = (_heartbeat_1(), _signed_2(), _heartbeat_1())
    found = list(records(_log(*packets), "x.tlog"))
    assert [record.packet for record in found] == list(packets)
    assert [record.time_us - 10**15 for record in found] == [0, 1000, 2000]


@pytest.mark.parametrize(
    ("log", "text"),
    [
        (b"no log at all", "x.tlog: byte 0: no record"),
        (_log(_heartbeat_1(), _heartbeat_1())[:-1], "x.tlog: byte 25: the last record is cut"),
        (_log(_heartbeat_1()) + bytes(4), "x.tlog: byte 25: no record"),
    ],
)
def test_what_is_no_log_is_an_error_with_its_byte(log: bytes, text: str) -> None:
    with pytest.raises(TridentError, match=text):
        list(records(log, "x.tlog"))


def test_an_empty_or_missing_log_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(TridentError, match="No such file"):
        read_log(tmp_path / "missing.tlog")
    (tmp_path / "empty.tlog").touch()
    with pytest.raises(TridentError, match="the log is empty"):
        read_log(tmp_path / "empty.tlog")


@pytest.mark.parametrize(
    ("speed", "waits"), [(1.0, [0.5, 1.5]), (2.0, [0.25, 0.75]), (math.inf, [])]
)
def test_packets_are_sent_at_their_pace(speed: float, waits: list[float]) -> None:
    log = [Record(time_us, b"p") for time_us in (10, 500_010, 2_000_010)]
    clock, waited, sent = [0.0], [], []

    def sleep(seconds: float) -> None:
        waited.append(seconds)
        clock[0] += seconds

    assert replay(log, sent.append, speed, now=lambda: clock[0], sleep=sleep) == 3
    assert waited == pytest.approx(waits)
    assert len(sent) == 3


def test_addresses_are_loopback_unless_allowed() -> None:
    assert Address.parse("tcp:localhost:14445", allow_remote=False).port == 14445
    assert str(Address.parse("udp:127.0.0.2:9", allow_remote=False)) == "udp:127.0.0.2:9"
    with pytest.raises(TridentError, match="is another computer"):
        Address.parse("udp:192.0.2.7:14550", allow_remote=False)
    assert Address.parse("udp:192.0.2.7:14550", allow_remote=True).host == "192.0.2.7"
    for odd in ("14550", "udp:127.0.0.1", "serial:a:1", "udp:127.0.0.1:0", "udp:127.0.0.1:65536"):
        with pytest.raises(TridentError, match="legal"):
            Address.parse(odd, allow_remote=True)


def test_replay_sends_a_log_to_a_port(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cli, "provision", lambda *_args: None)
    path = tmp_path / "flight.tlog"
    path.write_bytes(_log(_heartbeat_1(), _signed_2()))
    with closing(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) as ground:
        ground.bind(("127.0.0.1", 0))
        ground.settimeout(30.0)
        at = f"udp:127.0.0.1:{ground.getsockname()[1]}"
        assert cli.main(["mavlink", "replay", str(path), "--at", at, "--speed", "0"]) == 0
        assert ground.recv(300) == _heartbeat_1()
        assert ground.recv(300) == _signed_2()
    assert f"sent 2 packets to {at}" in capsys.readouterr().err


def test_a_log_is_named_with_replay_alone(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cli, "provision", lambda *_args: None)
    for words in (["replay"], ["list", "x.tlog"]):
        assert cli.main(["mavlink", *words]) == 1
        assert "FILE.tlog is named with replay" in capsys.readouterr().err


def test_parameters_are_printed_by_the_action_and_by_the_option(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cli, "provision", lambda *_args: None)
    for subject, end in (([], "mavlink_parameters"), (["px4/uav"], "mavlink_parameters px4 uav")):
        for first in ("parameters", "--parameters"):
            assert cli.main(["--dry-run", "mavlink", first, *subject]) == 0
            assert capsys.readouterr().out.rstrip().endswith(end)
    assert cli.main(["mavlink", "list", "--parameters"]) == 1
    assert "legal: one of list, watch, replay FILE.tlog, parameters" in capsys.readouterr().err


def test_the_board_shows_rates_and_last_values() -> None:
    board = Board()
    for roll in (0.5, 0.25):
        board.add({"name": "ATTITUDE", "system": 1, "component": 1, "fields": {"roll": roll}})
    board.add({"packets": 2})
    lines = board.table(1.0).splitlines()
    assert lines[1].split() == ["1", "1", "ATTITUDE", "2.0", "roll", "0.25"]
    assert board.table(1.0).splitlines()[1].split()[3] == "0.0"
