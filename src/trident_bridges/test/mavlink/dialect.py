# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""pymavlink as the other end: its Python module of our dialect, random messages, comparisons."""

from __future__ import annotations

import contextlib
import importlib.util
import io
import json
import math
import random
import struct
import subprocess
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

PACKAGE = Path(__file__).resolve().parents[2]

_LIMITS = {
    "int8_t": (-(2**7), 2**7 - 1),
    "uint8_t": (0, 2**8 - 1),
    "int16_t": (-(2**15), 2**15 - 1),
    "uint16_t": (0, 2**16 - 1),
    "int32_t": (-(2**31), 2**31 - 1),
    "uint32_t": (0, 2**32 - 1),
    "int64_t": (-(2**63), 2**63 - 1),
    "uint64_t": (0, 2**64 - 1),
}


def _import(name: str, path: Path) -> Any:
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def python_dialect(folder: Path) -> Any:
    """pymavlink's module of the dialect, made in this folder."""
    from pymavlink.generator import mavgen

    generate = _import("trident_generate", PACKAGE / "dialect" / "generate.py")
    definition = generate.copy_definitions(folder / "definitions")
    options = mavgen.Opts(
        str(folder / "trident_dialect.py"),
        wire_protocol="2.0",
        language="Python3",
        validate=False,
        strict_units=False,
    )
    with contextlib.redirect_stdout(io.StringIO()):
        mavgen.mavgen(options, [str(definition)])
    return _import("trident_dialect", folder / "trident_dialect.py")


def decode(stream: bytes, *options: str) -> list[dict[str, Any]]:
    """What mavlink_decode prints of a stream: a dictionary for each message, then the counts."""
    program = PACKAGE.parents[1] / "build/devel/lib/trident_bridges/mavlink_decode"
    done = subprocess.run([program, *options], input=stream, capture_output=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def _random_number(chance: random.Random, kind: str) -> float | int:
    if kind in _LIMITS:
        low, high = _LIMITS[kind]
        return chance.choice((0, low, high, chance.randint(low, high), chance.randint(low, high)))
    if chance.random() < 0.2:
        return chance.choice((0.0, -0.0, math.nan, math.inf, -math.inf))
    if kind == "double":
        return chance.gauss(0.0, 1e9)
    rounded: float = struct.unpack("<f", struct.pack("<f", chance.gauss(0.0, 1e4)))[0]
    return rounded


def random_message(chance: random.Random, message_class: Any) -> Any:
    """A message of pymavlink with random fields; some are all zero."""
    values: list[Any] = []
    order = [message_class.ordered_fieldnames.index(name) for name in message_class.fieldnames]
    is_zero = chance.random() < 0.05
    for index, kind in zip(order, message_class.fieldtypes, strict=True):
        length = message_class.array_lengths[index]
        if kind == "char":
            size = chance.randint(0, max(length, 1)) if not is_zero else 0
            text = bytes(chance.randint(1, 255) for _ in range(size))
            values.append(text if length else (text[:1] or b"\0"))
        elif length:
            values.append([0 if is_zero else _random_number(chance, kind) for _ in range(length)])
        else:
            values.append(0 if is_zero else _random_number(chance, kind))
    return message_class(*values)


def fields_of(message: Any) -> dict[str, Any]:
    """Fields of a message of pymavlink as mavlink_decode prints them."""
    return {name: _field(message, name) for name in message.fieldnames}


def _field(message: Any, name: str) -> Any:
    value = getattr(message, f"_{name}_raw", getattr(message, name))
    length = message.array_lengths[message.ordered_fieldnames.index(name)]
    if isinstance(value, bytes | bytearray):
        return bytes(value).split(b"\0")[0].decode("latin-1") if length else value[0]
    if message.fieldtypes[message.fieldnames.index(name)] == "float":
        return [float(f"{v:.9g}") for v in value] if length else float(f"{value:.9g}")
    return list(value) if length else value


def are_equal(ours: Any, theirs: Any) -> bool:
    """Equality of fields in which NaN equals NaN."""
    if isinstance(ours, dict):
        return ours.keys() == theirs.keys() and all(are_equal(ours[k], theirs[k]) for k in ours)
    if isinstance(ours, list):
        return len(ours) == len(theirs) and all(map(are_equal, ours, theirs))
    if isinstance(ours, float) and math.isnan(ours):
        return isinstance(theirs, float) and math.isnan(theirs)
    return bool(ours == theirs)


def differences(rows: Iterable[dict[str, Any]], messages: Sequence[Any]) -> list[str]:
    """What mavlink_decode printed otherwise than pymavlink has it, in words."""
    found = []
    for row, message in zip(rows, messages, strict=True):
        theirs = fields_of(message)
        if row["name"] != message.get_type() or not are_equal(row["fields"], theirs):
            found.append(f"{message.get_type()}: ours {row}, pymavlink {theirs}")
    return found
