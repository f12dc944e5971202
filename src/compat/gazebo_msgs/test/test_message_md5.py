# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The generated message and service types carry the MD5 sums that existing programs expect."""

from __future__ import annotations

from pathlib import Path

import pytest
import roslib.message

TABLE = Path(__file__).with_name("md5sums.txt")
COMPAT = Path(__file__).resolve().parents[2]


def read_table() -> list[tuple[str, str, str]]:
    """Rows (kind, type, md5) of the committed table."""
    lines = [line.split("#")[0].split() for line in TABLE.read_text().splitlines()]
    return [(kind, name, md5) for kind, name, md5 in (line for line in lines if line)]


@pytest.mark.parametrize(("kind", "name", "md5"), read_table())
def test_generated_type_has_the_expected_md5(kind: str, name: str, md5: str) -> None:
    lookup = {"msg": roslib.message.get_message_class, "srv": roslib.message.get_service_class}
    generated = lookup[kind](name)
    assert generated is not None, f"{name} is not built"
    assert generated._md5sum == md5


def test_every_definition_is_in_the_table() -> None:
    packages = sorted({name.split("/")[0] for _, name, _ in read_table()})
    defined = {
        (kind, f"{package}/{path.stem}")
        for package in packages
        for kind in ("msg", "srv")
        for path in (COMPAT / package / kind).glob(f"*.{kind}")
    }
    assert defined == {(kind, name) for kind, name, _ in read_table()}
