# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tests for rooms: includes go in one direction."""

from __future__ import annotations

from pathlib import Path

import pytest
from trident_tool.lints.headers import header_units, public_headers
from trident_tool.lints.rooms import TABLE, check_rooms, read_house, violations
from trident_tool.lints.tidy import CompileCommand, IncludeScanner

_MANIFEST = "<package><name>{name}</name>{depends}</package>"


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """Two packages, of which upper depends on lower; upper has the rooms core and rays."""
    for name, depends in (("lower", ""), ("upper", "<depend>lower</depend>")):
        _write(
            tmp_path / "src" / name / "package.xml", _MANIFEST.format(name=name, depends=depends)
        )
    _write(tmp_path / TABLE, "src/upper/src:\n  core: []\n  rays: [core]\n")
    _write(tmp_path / "src/lower/include/lower/base.h", "")
    _write(tmp_path / "src/upper/include/upper/world.h", "")
    _write(tmp_path / "src/upper/src/core/body.h", "")
    _write(tmp_path / "src/upper/src/rays/ray.h", '#include "core/body.h"\n')
    return tmp_path


def _write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def _found(root: Path) -> list[str]:
    sources = [path.relative_to(root) for path in root.glob("src/**/*.[hc]*")]
    return list(violations(root, sources, read_house(root)))


def test_what_the_table_and_the_manifests_allow_is_not_reported(house: Path) -> None:
    _write(house / "src/upper/src/core/body.cpp", '#include "body.h"\n#include "lower/base.h"\n')
    assert _found(house) == []


def test_an_upward_include_is_named_with_line_and_what_is_allowed(house: Path) -> None:
    _write(house / "src/upper/src/core/body.cpp", '#include "body.h"\n#include "rays/ray.h"\n')
    assert _found(house) == [
        "src/upper/src/core/body.cpp:2: includes rays/ray.h: "
        "the room core may include no other room, not rays"
    ]


def test_a_package_that_is_not_depended_on_is_named(house: Path) -> None:
    _write(house / "src/lower/src/a.cpp", '#include "upper/world.h"\n')
    assert _found(house) == [
        "src/lower/src/a.cpp:1: includes upper/world.h: "
        "src/lower/package.xml does not depend on upper"
    ]


def test_a_room_that_the_table_does_not_list_is_named(house: Path) -> None:
    _write(house / "src/upper/src/attic/a.cpp", '#include "core/body.h"\n')
    (problem,) = _found(house)
    assert f"{TABLE} does not list the room attic of src/upper/src" in problem


def test_tests_may_include_any_room(house: Path) -> None:
    _write(house / "src/lower/test/a_test.cpp", '#include "upper/world.h"\n')
    assert _found(house) == []


def test_the_check_fails_if_anything_is_found(
    house: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = _write(house / "src/upper/src/core/body.cpp", '#include "rays/ray.h"\n')
    files = list(house.glob("src/**/*.[hc]*"))
    assert check_rooms(house, files) == 1
    assert str(source.relative_to(house)) in capsys.readouterr().err


def test_a_public_header_gets_the_flags_of_a_source_that_reaches_it(house: Path) -> None:
    source = _write(house / "src/upper/src/core/body.cpp", '#include "lower/base.h"\n')
    include = house / "src/lower/include"
    units = [CompileCommand(source, (f"-I{include}", "-O2"))]
    headers = public_headers(house)
    assert [path.name for path in headers] == ["base.h", "world.h"]
    found = header_units(headers, units, IncludeScanner(house))
    assert {path.name: unit.flags for path, unit in found.items()} == {
        "base.h": (f"-I{include}", "-O2")
    }
