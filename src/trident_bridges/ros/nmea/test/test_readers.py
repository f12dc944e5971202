# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What nmea_node sends is read by programs of others: pynmea2 and gpsd."""

from __future__ import annotations

import json
import math
import subprocess
from pathlib import Path
from typing import Any

import pytest
from boat import LATITUDE_DEG, LONGITUDE_DEG, Boat, Client, sailing, start_node, start_server
from trident.testing import Ros, eventually
from trident.testing.clients import client_program, clients_python
from trident_base.ports import free_port

# Every sentence of which the boat has the instruments.
KINDS = [
    "GGA",
    "GLL",
    "RMC",
    "VTG",
    "ZDA",
    "GSA",
    "GSV",
    "GST",
    "GBS",
    "DTM",
    "HDT",
    "THS",
    "HDG",
    "HDM",
    "ROT",
    "XDR",
    "VHW",
    "VBW",
    "VLW",
    "DBT",
    "DPT",
    "MWV",
    "MWD",
    "VWR",
    "VWT",
]
RATES = dict.fromkeys(KINDS, 5.0)
BEGIN_S = 1000.0
UNKNOWN_TO_PYNMEA2 = {"THS"}
ALTITUDE_M = 41.0
METERS_PER_DEGREE = 111_320.0


def read_by_pynmea2(python: Path, lines: list[str]) -> list[dict[str, Any]]:
    script = Path(__file__).with_name("read_by_pynmea2.py")
    result = subprocess.run(
        [python, script],
        input="\n".join(lines),
        capture_output=True,
        text=True,
        check=False,
        env={"PATH": "/usr/bin"},
    )
    assert result.returncode == 0, result.stderr
    return [json.loads(line) for line in result.stdout.splitlines()]


def test_pynmea2_reads_all_that_is_sent(ros: Ros, boat: Boat) -> None:
    python = clients_python("pynmea2")
    port = start_server(ros, rates=RATES)
    client = Client(port)
    done = sailing(boat, lambda: all(len(client.lines(kind)) > 1 for kind in KINDS), BEGIN_S)
    eventually(done, "sentences of all kinds")
    lines = client.read().rpartition("\r\n")[0].split("\r\n")
    client.close()
    messages = read_by_pynmea2(python, lines)
    assert len(messages) == len(lines)
    by_type = {message["type"]: message["fields"] for message in messages}
    assert set(by_type) == set(KINDS)
    assert {kind for kind, fields in by_type.items() if fields is None} == UNKNOWN_TO_PYNMEA2
    for kind in ("GGA", "GLL", "RMC"):
        assert by_type[kind]["latitude"] == pytest.approx(LATITUDE_DEG, abs=1e-7)
        assert by_type[kind]["longitude"] == pytest.approx(LONGITUDE_DEG, abs=1e-7)
    assert by_type["GGA"]["gps_qual"] == 4
    assert by_type["RMC"]["datestamp"] == "2026-01-01"
    assert float(by_type["DPT"]["depth"]) == 4.5
    assert float(by_type["HDT"]["heading"]) == 90.0


def check_gpsd(ros: Ros, boat: Boat, source: str) -> None:
    """Has gpsd read a source, and compares what it reports with the truth."""
    port, gpspipe = free_port(), client_program("gpspipe")
    gpsd = ros.launch([client_program("gpsd"), "-N", "-n", "-b", "-D", "2", "-S", port, source])
    pipes = []

    def reports() -> list[dict[str, Any]]:
        whole = pipes[-1].log.rpartition("\n")[0].splitlines()
        lines = [json.loads(line) for line in whole if line.startswith("{")]
        # Where a cycle of sentences was late, gpsd reports what it has of it.
        fixes = [line for line in lines if line["class"] == "TPV"]
        return [line for line in fixes if {"altHAE", "status", "track", "speed"} <= line.keys()]

    def has_enough() -> bool:
        if not pipes or pipes[-1].popen.poll() is not None:  # gpsd was not up yet
            pipes.append(ros.launch([gpspipe, "-w", f"127.0.0.1:{port}"]))
        return len(reports()) >= 5

    eventually(sailing(boat, has_enough, BEGIN_S), "reports of gpsd")
    newest = reports()[-1]
    north_m = (newest["lat"] - LATITUDE_DEG) * METERS_PER_DEGREE
    east_m = (newest["lon"] - LONGITUDE_DEG) * METERS_PER_DEGREE
    east_m *= math.cos(math.radians(LATITUDE_DEG))
    assert math.hypot(north_m, east_m) < 0.1
    assert newest["altHAE"] == pytest.approx(ALTITUDE_M, abs=0.1)
    assert newest["time"].startswith("2026-01-01T00:1")
    assert newest["mode"] == 3
    assert newest["status"] == 3  # RTK fixed
    assert newest["track"] == pytest.approx(90.0)
    assert newest["speed"] == pytest.approx(2.0, abs=1e-3)
    assert "ERROR" not in gpsd.log, gpsd.log


def test_gpsd_reads_the_tcp_stream(ros: Ros, boat: Boat) -> None:
    port = start_server(ros, rates=RATES)
    check_gpsd(ros, boat, f"tcp://127.0.0.1:{port}")


def test_gpsd_reads_the_pseudo_terminal(ros: Ros, boat: Boat, tmp_path: Path) -> None:
    link = tmp_path / "gps"
    start_node(ros, f"pty://{link}:115200", rates=RATES)
    check_gpsd(ros, boat, str(link))
