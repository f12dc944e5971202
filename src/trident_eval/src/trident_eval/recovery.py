# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Makes readable what a recorder that was killed has left open.

A rosbag (format 2.0) is a row of records: length and fields of a header, length and bytes of data.
Messages lie in chunks. Until a chunk is full, 768 KiB by default, its header says that it holds
nothing, and rosbag's own reindexing drops it; short recordings are no longer than that.
"""

from __future__ import annotations

import bz2
import io
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

from trident_eval.core.errors import EvalError

_ACTIVE = ".active"
_MAGIC = b"#ROSBAG V2.0\n"
_LENGTH = struct.Struct("<I")
_STAMP = struct.Struct("<II")  # seconds, nanoseconds
_LONGEST_HEADER = 1 << 20  # of what is no bag any number may be the length
_OP_MESSAGE, _OP_CHUNK, _OP_CONNECTION = b"\x02", b"\x05", b"\x07"

Fields = dict[bytes, bytes]


def recover_bags(folder: Path) -> list[str]:
    """Keep what is in every bag below a folder that was left open, under the name it had got.

    Only for a run that has ended: a process that still writes one would lose it.

    Args:
        folder: of the run.

    Returns:
        A sentence about each of them.
    """
    return [_recovered(path) for path in sorted(folder.rglob(f"*.bag{_ACTIVE}"))]


def _recovered(path: Path) -> str:
    target = path.with_name(path.name.removesuffix(_ACTIVE))
    if target.exists():
        return f"{path} was left open, and {target.name} is there already"
    try:
        count, end_s = copy_whole_messages(path, target)
    except EvalError as error:
        return str(error)
    path.unlink()
    return (
        f"{target} was not closed: its {count} messages up to {end_s:.2f} s are kept, what came "
        "later is lost"
    )


def copy_whole_messages(source: Path, target: Path) -> tuple[int, float]:
    """Write the messages of a bag that was left open into a new one.

    Args:
        source: the bag; what is torn at its end is left out.
        target: the new one.

    Returns:
        Number of messages, and time of the last one [s].

    Raises:
        EvalError: there is not one, or the new bag cannot be written.
    """
    import rosbag
    from genpy import Time

    count, last_s = 0, 0.0
    try:
        with source.open("rb") as stream, rosbag.Bag(str(target), "w") as bag:
            for header, stamp, data in _messages(stream):
                raw = (header["type"], data, header["md5sum"], None)
                bag.write(header["topic"], raw, Time(*stamp), raw=True, connection_header=header)
                count, last_s = count + 1, max(last_s, stamp[0] + 1e-9 * stamp[1])
    except (OSError, rosbag.ROSBagException) as error:
        target.unlink(missing_ok=True)
        raise EvalError(
            f"{source} was left open, and {target} cannot be written: {error}"
        ) from error
    if not count:
        target.unlink(missing_ok=True)
        raise EvalError(f"{source}: there is no whole message in it")
    return count, last_s


def _messages(stream: BinaryIO) -> Iterator[tuple[dict[str, Any], tuple[int, int], bytes]]:
    """Header of its connection, stamp [s, ns] and bytes of each whole message, in their order."""
    if stream.read(len(_MAGIC)) != _MAGIC:
        return
    connections: dict[bytes, dict[str, Any]] = {}
    while (record := _read_header(stream)) is not None:
        fields, length = record
        if fields.get(b"op") != _OP_CHUNK:
            stream.seek(length, 1)
            continue
        # A chunk that was being written ends with the file.
        chunk = _unpacked(fields, stream.read(length or -1))
        yield from _messages_of_chunk(chunk, connections)


def _messages_of_chunk(
    chunk: BinaryIO, connections: dict[bytes, dict[str, Any]]
) -> Iterator[tuple[dict[str, Any], tuple[int, int], bytes]]:
    """The same of one chunk, whose connections are added to those that are known."""
    while (record := _read_header(chunk)) is not None:
        fields, length = record
        data = chunk.read(length)
        if len(data) < length:
            break
        if fields.get(b"op") == _OP_CONNECTION:
            connections[fields[b"conn"]] = _connection(fields, data)
        elif fields.get(b"op") == _OP_MESSAGE and fields[b"conn"] in connections:
            seconds, nanoseconds = _STAMP.unpack(fields[b"time"])
            yield connections[fields[b"conn"]], (seconds, nanoseconds), data


def _unpacked(fields: Fields, data: bytes) -> io.BytesIO:
    """The records of a chunk; none where a compressor had not given them away."""
    try:
        if fields.get(b"compression") == b"bz2":
            data = bz2.decompress(data)
        elif fields.get(b"compression") == b"lz4":
            import roslz4  # type: ignore[import-untyped]

            data = roslz4.decompress(data)
    except (OSError, ValueError, RuntimeError, ImportError):
        data = b""
    return io.BytesIO(data)


def _connection(fields: Fields, data: bytes) -> dict[str, Any]:
    header = {name.decode(): value.decode() for name, value in _fields(data).items()}
    return {**header, "topic": fields[b"topic"].decode()}


def _read_header(stream: BinaryIO) -> tuple[Fields, int] | None:
    """Fields of the next record, and the length of its data; None where it is torn."""
    head = stream.read(4)
    if len(head) < 4 or (size := _LENGTH.unpack(head)[0]) > _LONGEST_HEADER:
        return None
    header = stream.read(size)
    tail = stream.read(4)
    if len(header) < size or len(tail) < 4:
        return None
    return _fields(header), _LENGTH.unpack(tail)[0]


def _fields(header: bytes) -> Fields:
    fields: Fields = {}
    while len(header) >= 4:
        (length,) = _LENGTH.unpack(header[:4])
        name, _, value = header[4 : 4 + length].partition(b"=")
        fields[name] = value
        header = header[4 + length :]
    return fields
