# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink
from trident_benchmarks.__main__ import main
from trident_benchmarks.bridges.all_rows import ROWS
from trident_benchmarks.bridges.limits import at_least, at_most
from trident_benchmarks.bridges.measure import chosen_rows, line, measure_row
from trident_benchmarks.bridges.rows import ECHO, Bench, BridgeRow, MissingDataError, Node
from trident_benchmarks.bridges.rows_fleet import measure_fleet
from trident_benchmarks.bridges.sockets import drops_of
from trident_benchmarks.bridges.telemetry_listener import attitude_time_s, packets_of
from trident_benchmarks.processes import Processes
from trident_benchmarks.results import UNUSABLE
from trident_eval.core.errors import EvalError

_SHARE = 0.005


@pytest.fixture(scope="module")
def bench() -> Iterator[Bench]:
    with Processes() as processes:
        _, master = processes.start_master()
        yield Bench(processes, master)


def measured(name: str, bench: Bench) -> tuple[dict[str, Any], str]:
    """A row in its short form, and its line."""
    row = chosen_rows(name)[-1]
    result = measure_row(row, bench, _SHARE, echo_ms=0.1)
    return result, line(row, result)


@pytest.mark.parametrize("name", ["bytes over UDP", "MAVLink ODOMETRY over UDP"])
def test_messages_cross_two_bridges_and_none_is_lost(name: str, bench: Bench) -> None:
    result, text = measured(name, bench)
    assert result["lost"] == 0
    assert 0.0 < result["median_ms"] <= result["p99_ms"] <= result["max_ms"]
    assert result["over_echo_ms"] == pytest.approx(result["median_ms"] - 0.1)
    wire_bytes = {"udp": 280, "mavlink": 244}[result["protocol"]]
    assert result["mbit_s"] == pytest.approx(8e-6 * wire_bytes * result["messages_s"])
    assert result["kernel_drops"] == 0
    assert all("receive buffer" in buffers for buffers in result["socket_buffers"])
    assert len(result["socket_buffers"]) == 2
    assert text.startswith(f"{name}: median ")
    assert "; 0 lost; " in text


def test_a_log_crosses_two_bridges_packet_by_packet(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each record is a time, and a HEARTBEAT of MAVLink 1."""
    file = tmp_path / "mavlink" / "vtol.tlog"
    file.parent.mkdir()
    sender = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    packets = []
    for number in range(300):
        beat = mavlink.MAVLink_heartbeat_message(2, 12, 0, number, 3, 3)
        packets.append(bytes(beat.pack(sender, force_mavlink1=True)))
        sender.seq = (sender.seq + 1) % 256
    file.write_bytes(b"".join(bytes(8) + packet for packet in packets))
    monkeypatch.setenv("TRIDENT_DATA", str(tmp_path))
    result, _ = measured("MAVLink telemetry over UDP", bench)
    assert result["lost"] == 0
    assert result["messages_s"] > 0.0


def test_a_log_that_is_not_there_is_said(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TRIDENT_DATA", str(tmp_path))
    with pytest.raises(MissingDataError, match=r"vtol\.tlog is not there"):
        measured("MAVLink telemetry over UDP", bench)


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("MAVLink codec", "mbit_s"),
        ("MAVLink codec, signed", "mbit_s"),
        ("NMEA codec", "sentences_s"),
        ("Modbus codec", "pdus_s"),
        ("Modbus registers over TCP", "mbit_s"),
    ],
)
def test_a_codec_has_a_rate_with_its_limit(name: str, key: str, bench: Bench) -> None:
    result, text = measured(name, bench)
    assert result[key] > 0.0
    assert result["cpu_ms_per_1000"] > 0.0
    assert f"(>= {result['limits'][key]['min']:,.15g}" in text


def test_a_fleet_is_measured_by_its_own_clock(bench: Bench) -> None:
    result = measure_fleet(bench, 0.0, (1, 1, 1))
    assert 0.0 < result["cpu_s_per_s"] < 1.0
    assert result["rss_mb"] > 1.0
    assert result["messages_s"] > 3 * 2 * 25  # ATTITUDE alone, to two ports of each


def test_a_bridge_that_passes_nothing_on_is_an_error() -> None:
    def nodes() -> list[Node]:
        return [Node("deaf", ["sleep", "60"])]

    row = BridgeRow("deaf", "udp", "bytes", 8, nodes, words=lambda: ["--limit_s", "1"])
    with Processes() as processes:  # its own: a process that failed fails all that follow
        _, master = processes.start_master()
        with pytest.raises(EvalError, match="source has ended with exit code 1"):
            measure_row(row, Bench(processes, master), share=0.001)


def test_a_figure_that_is_missing_keeps_no_limit() -> None:
    assert at_most("lost", 0).holds({"lost": 0})
    assert not at_most("lost", 0).holds({"lost": 1})
    assert at_least("mbit_s", 60.0).holds({"mbit_s": 60.0})
    assert not at_least("mbit_s", 60.0).holds({"mbit_s": 59.9})
    assert not at_least("mbit_s", 60.0).holds({})


def test_drops_are_those_of_the_port() -> None:
    text = (
        "  sl  local_address rem_address   st ... drops\n"
        "  1: 0100007F:1F90 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 7 2 0 12\n"
        "  2: 0100007F:1F91 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 8 2 0 5\n"
    )
    assert drops_of(text, 0x1F90) == 12
    assert drops_of(text, 0x1F92) == 0


def test_packets_of_a_datagram_and_the_time_of_an_attitude() -> None:
    packet = bytes([0xFD, 2, 0, 0, 9, 1, 1, 30, 0, 0, 0xE8, 0x03, 0, 0])
    signed = bytes([0xFD, 1, 1, 0, 9, 2, 1, 0, 0, 0]) + bytes(1 + 2 + 13)
    assert list(packets_of(signed + packet + b"no packet")) == [signed, packet]
    assert attitude_time_s(packet) == pytest.approx(1.0)
    assert attitude_time_s(packet[:7] + bytes([31]) + packet[8:]) is None


def test_names_of_rows_are_unique_and_an_unknown_one_is_refused() -> None:
    assert len({row.name for row in ROWS}) == len(ROWS)
    with pytest.raises(EvalError, match="did you mean 'roscpp relays'"):
        chosen_rows("roscpp relay")


def test_a_row_comes_behind_the_one_that_it_is_compared_with() -> None:
    assert [row.name for row in chosen_rows("NMEA GGA over TCP")] == [ECHO, "NMEA GGA over TCP"]
    assert [row.name for row in chosen_rows("bytes over UDP")] == ["bytes over UDP"]


def test_a_missing_folder_is_refused_before_anything_is_measured(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bridges", "--out", str(tmp_path / "no" / "rows.json")]) == UNUSABLE
    assert "its folder does not exist" in capsys.readouterr().err
