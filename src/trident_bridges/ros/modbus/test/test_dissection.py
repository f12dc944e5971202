# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""tshark, which knows Modbus by itself, reads what our nodes and other clients say over TCP."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from capture import Conversation, recorded, write_capture
from peers import Libmodbus
from plc import Line, make_line, start_node, write_map
from std_msgs.msg import Float32, UInt16MultiArray
from trident.testing import Ros, eventually, recorder
from trident.testing.clients import client_program

FIELDS = (
    "tcp.len", "_ws.col.Info", "mbtcp.trans_id", "modbus.func_code",
    "modbus.request_frame", "modbus.exception_code", "_ws.malformed", "_ws.expert.severity",
)  # fmt: skip
EXPERT_WARNING = 0x600000  # and what is graver; TCP's own remarks are below
READS = {1, 2, 3, 4}
READABLE = (("coil", 0, 10), ("discrete", 0, 2), ("input", 0, 9), ("holding", 1, 2))
PIPELINE = 4  # queries of our client open at once
Publish = Callable[[str, Any], None]


@dataclass
class Frame:
    """A frame with bytes of Modbus, as tshark reads it.

    Attributes:
        kind: "Query" or "Response".
        pairs: transaction id and function code of each message in it.
        asked_in: numbers of the frames with the queries that its responses answer.
        exceptions: codes in it.
    """

    kind: str
    pairs: list[tuple[int, int]]
    asked_in: list[int]
    exceptions: list[int]


def numbers(text: str) -> list[int]:
    """Those of a field that occurs several times."""
    return [int(number, 0) for number in text.split(",") if number]


def dissect(path: Path, conversation: Conversation) -> list[Frame]:
    """Each frame of the conversation that carries bytes; fails where tshark objects to one."""
    write_capture(path, conversation)
    columns = [word for one in FIELDS for word in ("-e", one)]
    checks = ["-o", "ip.check_checksum:TRUE", "-o", "tcp.check_checksum:TRUE"]
    command = [str(client_program("tshark")), "-r", str(path), *checks, "-T", "fields", *columns]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    frames = []
    for line in done.stdout.splitlines():
        length, info, ids, functions, asked_in, codes, malformed, experts = line.split("\t")
        assert not malformed, line
        assert all(severity < EXPERT_WARNING for severity in numbers(experts)), line
        if length == "0":
            continue
        kind = info.split(":")[0].strip()
        assert kind in ("Query", "Response"), line
        pairs = list(zip(numbers(ids), numbers(functions), strict=True))
        frames.append(Frame(kind, pairs, numbers(asked_in), numbers(codes)))
    return frames


def check_pairs(frames: list[Frame], unanswered: int = 0) -> list[int]:
    """Function codes that were asked; each query has its answer, of its id and function.

    Args:
        unanswered: how many of the last queries may have none, as when the client is ended.
    """
    queries, answers = (
        [pair for frame in frames if frame.kind == kind for pair in frame.pairs]
        for kind in ("Query", "Response")
    )
    assert answers == queries[: len(answers)]
    assert len(queries) - len(answers) <= unanswered
    for frame in frames:
        # tshark itself pairs all but exceptions.
        expected = len(frame.pairs) - len(frame.exceptions) if frame.kind == "Response" else 0
        assert len(frame.asked_in) == expected, frame
    return [function for _, function in queries]


def start_device(ros: Ros, folder: Path) -> Line:
    """A device in /v."""
    client_program("tshark")  # before anything is started for it
    line = make_line("tcp", ros, folder)
    start_node(ros, "server", write_map(folder, "s.yaml", line, is_device=True), "v")
    return line


def test_tshark_reads_what_our_client_and_our_device_say(
    ros: Ros, tmp_path: Path, publish: Publish
) -> None:
    line = start_device(ros, tmp_path)
    with recorded(line.port) as conversation:
        proxied = write_map(
            tmp_path,
            "c.yaml",
            Line(port=conversation.port),
            is_device=False,
            head=f"pipeline: {PIPELINE}\n",
        )
        client = start_node(ros, "client", proxied, "c")
        eventually(lambda: "unit 7 answers" in client.log, "the first answer")
        with recorder("/c/setpoint/state", Float32) as states:
            publish("/c/setpoint", Float32(2.5))
            publish("/c/row", UInt16MultiArray(data=list(range(100, 120))))
            eventually(lambda: any(m.data == 2.5 for m in states.messages), "the state")
        client.stop()
    functions = check_pairs(dissect(tmp_path / "ours.pcap", conversation), PIPELINE)
    assert READS | {16} <= set(functions)


def test_tshark_reads_every_function_that_libmodbus_asks_our_device(
    ros: Ros, tmp_path: Path
) -> None:
    line = start_device(ros, tmp_path)
    with recorded(line.port) as conversation:
        peer = Libmodbus(Line(port=conversation.port))
        for table, first, count in READABLE:
            assert len(peer.read(table, first, count)) == count
        assert peer.write("coil", 0, [1])
        assert peer.write("coil", 1, [1, 0, 1, 0, 0, 0, 0, 0, 1])
        assert peer.write("holding", 0, [5000])
        assert peer.write("holding", 10, list(range(20)))
        assert peer.mask(10, 0xF2, 0x25)
        assert peer.write_and_read(10, [7, 8], 3) == [7, 8, 2]
        assert not peer.write("holding", 0, [20000]), "out of range"
        peer.close()
    frames = dissect(tmp_path / "libmodbus.pcap", conversation)
    assert check_pairs(frames) == [1, 2, 4, 3, 5, 15, 6, 16, 22, 23, 6]
    assert [code for frame in frames for code in frame.exceptions] == [3]


def test_tshark_objects_to_bytes_that_are_no_modbus(tmp_path: Path) -> None:
    client_program("tshark")
    query = bytes.fromhex("0001 0000 0006 07 03 0000 0002")
    answer = bytes.fromhex("0001 0000 0007 07 03 04 0001 0002")
    whole = Conversation(0, [(0, query), (1, answer)])
    assert check_pairs(dissect(tmp_path / "whole.pcap", whole)) == [3]
    cut = Conversation(0, [(0, query), (1, bytes([*answer[:5], 2, *answer[6:8]]))])
    with pytest.raises(AssertionError, match="Response"):
        dissect(tmp_path / "cut.pcap", cut)
    other = Conversation(0, [(0, query), (1, b"\0\2" + answer[2:])])
    with pytest.raises(AssertionError):
        check_pairs(dissect(tmp_path / "other.pcap", other))
