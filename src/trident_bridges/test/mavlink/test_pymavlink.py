# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Our codec against pymavlink. ``TRIDENT_INTEROP_MESSAGES``: how many; default 3,000."""

from __future__ import annotations

import os
import random
import sys
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from dialect import are_equal, decode, differences, fields_of, python_dialect, random_message

MESSAGES = int(os.environ.get("TRIDENT_INTEROP_MESSAGES", "3000"))
KEY = bytes(range(32))
TIME = 10**12


@pytest.fixture(scope="session")
def dialect(tmp_path_factory: pytest.TempPathFactory) -> Any:
    return python_dialect(tmp_path_factory.mktemp("dialect"))


@pytest.fixture
def key_file(tmp_path: Path) -> Path:
    path = tmp_path / "key"
    path.write_text(KEY.hex() + "\n")
    path.chmod(0o600)
    return path


def _messages(dialect: Any, seed: int) -> list[Any]:
    chance = random.Random(seed)
    classes = list(dialect.mavlink_map.values())
    return [random_message(chance, classes[i % len(classes)]) for i in range(MESSAGES)]


def _link(dialect: Any, *, signs: bool = False) -> Any:
    link = dialect.MAVLink(None, srcSystem=9, srcComponent=3)
    if signs:
        link.signing.secret_key = KEY
        link.signing.link_id = 5
        link.signing.timestamp = TIME
        link.signing.sign_outgoing = True
    return link


def _repacked(dialect: Any, rows: list[dict[str, Any]], *, signs: bool) -> list[Any]:
    link = _link(dialect, signs=signs)
    return [link.decode(bytearray.fromhex(row["packet"])) for row in rows]


def test_the_dialect_has_all_messages_of_ardupilotmega_and_ours(dialect: Any) -> None:
    from pymavlink.dialects.v20 import ardupilotmega

    ours = {290, 291, 300, 334, 397, 400, 410, 435, 436}
    assert set(dialect.mavlink_map) == set(ardupilotmega.mavlink_map) | ours


def test_each_message_of_a_flight_log_is_the_same_for_both(dialect: Any) -> None:
    data = os.environ.get("TRIDENT_DATA")
    if not data:
        pytest.skip("TRIDENT_DATA is not set")
    log = (Path(data) / "mavlink" / "vtol.tlog").read_bytes()
    rows = decode(log, "--tlog")
    counts = rows.pop()
    parser = dialect.MAVLink(None)
    theirs, times, at = [], [], 0
    while at < len(log):
        times.append(int.from_bytes(log[at : at + 8], "big"))
        size = log[at + 9] + (12 if log[at + 8] == 0xFD else 8)
        theirs.append(parser.decode(bytearray(log[at + 8 : at + 8 + size])))
        at += 8 + size
    assert (counts["packets"], counts["skipped_bytes"]) == (23894, 0)
    assert len({row["name"] for row in rows}) == 41
    assert differences(rows, theirs) == []
    assert [row["time_us"] for row in rows] == times
    sources = [(row["system"], row["component"], row["sequence"]) for row in rows]
    assert sources == [(m.get_srcSystem(), m.get_srcComponent(), m.get_seq()) for m in theirs]


def test_random_messages_pass_in_both_directions(dialect: Any) -> None:
    messages = _messages(dialect, seed=1)
    link = _link(dialect)
    rows = decode(b"".join(message.pack(link) for message in messages), "--repack")
    counts = rows.pop()
    assert (counts["packets"], counts["skipped_bytes"]) == (MESSAGES, 0)
    assert differences(rows, messages) == []
    back = _repacked(dialect, rows, signs=False)
    for row, message in zip(rows, back, strict=True):
        assert are_equal(row["fields"], fields_of(message)), row["name"]
        assert (message.get_srcSystem(), message.get_srcComponent()) == (9, 3)


def test_random_messages_pass_signed_in_both_directions(dialect: Any, key_file: Path) -> None:
    messages = _messages(dialect, seed=2)
    link = _link(dialect, signs=True)
    stream = b"".join(message.pack(link) for message in messages)
    options = ("--key", str(key_file), "--link", "7", "--signing-time", str(TIME))
    rows = decode(stream, "--repack", *options)
    assert rows.pop()["packets"] == MESSAGES
    assert differences(rows, messages) == []
    for row, message in zip(rows, _repacked(dialect, rows, signs=True), strict=True):
        assert are_equal(row["fields"], fields_of(message)), row["name"]
        assert message.get_signed()
        assert message.get_link_id() == 7


def test_mavlink_1_is_read_where_it_is_accepted(dialect: Any) -> None:
    link = _link(dialect)
    old = [m for m in _messages(dialect, seed=3)[:600] if m.get_msgId() < 256]
    stream = b"".join(message.pack(link, force_mavlink1=True) for message in old)
    rows = decode(stream, "--mavlink1")
    assert rows.pop()["packets"] == len(old)
    assert differences(rows, old) == []
    assert decode(stream)[-1]["mavlink1"] == len(old)


@pytest.mark.parametrize(
    ("tampering", "reason"),
    [
        ("none", "replayed"),
        ("unsigned", "unsigned"),
        ("other key", "wrong signature"),
        ("other content", None),
        ("other link", "wrong signature"),
        ("two minutes ago", "older than a minute"),
    ],
)
def test_what_is_not_signed_well_is_refused(
    dialect: Any, key_file: Path, tampering: str, reason: str | None
) -> None:
    link = _link(dialect, signs=True)
    heartbeat = dialect.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3)
    good = bytes(heartbeat.pack(link))
    bad = bytearray(good)
    if tampering == "unsigned":
        bad = bytearray(heartbeat.pack(_link(dialect)))
    elif tampering == "other key":
        link.signing.secret_key = bytes(32)
        bad = bytearray(heartbeat.pack(link))
    elif tampering == "other content":
        bad[10] ^= 1
    elif tampering == "other link":
        bad[-13] ^= 1
    elif tampering == "two minutes ago":
        link.signing.timestamp = TIME - 12_000_000
        bad = bytearray(heartbeat.pack(link))
    options = ("--key", str(key_file), "--signing-time", str(TIME))
    rows = decode(good + bytes(bad), *options)
    assert rows[0]["name"] == "HEARTBEAT"
    assert [row["refused"] for row in rows[1:-1]] == ([reason] if reason else [])
    if reason is None:
        assert rows[-1]["bad_checksum"] > 0
