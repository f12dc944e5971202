# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Damaged xacro files: each is expanded or refused with a message, and never with a traceback.

TRIDENT_MUTATIONS says how many there are (default 300).
"""

from __future__ import annotations

import os
import random
import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

xacro: Any = pytest.importorskip("xacro", reason="PyPI's xacro is in the workspace's .venv")

COUNT = int(os.environ.get("TRIDENT_MUTATIONS", "300"))
LIMIT_S = 20
SEED_FILE = """<?xml version="1.0"?>
<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:arg name="size" default="1"/>
  <xacro:property name="mass" value="${2 * 0.5 + $(arg size)}"/>
  <xacro:property name="arms" value="${[0.1, 0.2, 0.3]}"/>
  <xacro:macro name="rotor" params="name parent:=base *origin angle:=^|0 side:=${-1}">
    <link name="${name}"><inertial><mass value="${mass / 10}"/>
      <inertia ixx="${0.1*mass}" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="${name}_joint" type="continuous"><xacro:insert_block name="origin"/>
      <parent link="${parent}"/><child link="${name}"/><axis xyz="0 0 ${side}"/></joint>
  </xacro:macro>
  <link name="base"/>
  <xacro:rotor name="a"><origin xyz="${arms[0]} 0 0"/></xacro:rotor>
  <xacro:rotor name="b" side="1"><origin xyz="${cos(pi/3)} 0 0"/></xacro:rotor>
  <xacro:if value="${mass > 1}"><link name="$(eval 1 + 2)"/></xacro:if>
  <xacro:unless value="0"><link name="x"/></xacro:unless>
</robot>
"""
VALUES = [
    "",
    "nan",
    "${",
    "}",
    "${1/0}",
    "${undefined}",
    "$(arg none)",
    "$(find no_such)",
    "${'a'*9}",
    "^",
    "**block",
    "params",
    "\x00",
    "&",
    "<",
    "xacro:rotor",
    "-1",
    "1e999",
    "${mass}",
]


def mutate(text: str, generator: random.Random) -> str:
    """One to three changes: of a character, a tag, a value or an expression."""
    for _ in range(generator.randint(1, 3)):
        spans = [m.span() for m in re.finditer(r'<[^>]*>|"[^"]*"|\$\{[^}]*\}', text)]
        begin, end = generator.choice(spans) if spans else (0, len(text))
        kind = generator.randrange(5)
        if kind == 0:
            at = generator.randrange(len(text) + 1)
            text = text[:at] + generator.choice(VALUES) + text[at:]
        elif kind == 1:
            text = text[:begin] + text[end:]
        elif kind == 2:
            text = text[:end] + text[begin:end] + text[end:]
        elif kind == 3:
            text = text[: begin + 1] + generator.choice(VALUES) + text[end - 1 :]
        else:
            text = text[: generator.randrange(len(text) // 2, len(text) + 1)]
    return text


@contextmanager
def time_limit(text: str) -> Iterator[None]:
    def give_up(_number: int, _frame: FrameType | None) -> None:
        raise TimeoutError(f"not done after {LIMIT_S} s:\n{text}")

    signal.signal(signal.SIGALRM, give_up)
    signal.alarm(LIMIT_S)
    try:
        yield
    finally:
        signal.alarm(0)


def test_mutations_are_expanded_or_refused_with_a_message(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "mutated.xacro"
    outcomes = {True: 0, False: 0}
    for number in range(COUNT + 1):
        text = mutate(SEED_FILE, random.Random(number)) if number else SEED_FILE
        path.write_text(text, encoding="utf-8")
        monkeypatch.setattr("sys.argv", ["xacro", str(path), "size:=1"])
        try:
            with time_limit(text):
                xacro.main()
            expanded = True
        except SystemExit as end:
            expanded = not end.code
        output = capsys.readouterr()
        outcomes[expanded] += 1
        assert expanded or output.err.strip(), f"refused without a word:\n{text}"
        assert "Traceback" not in output.err, f"{text}\n{output.err}"
        assert expanded or number, output.err
    assert min(outcomes.values()) > COUNT / 20, outcomes
