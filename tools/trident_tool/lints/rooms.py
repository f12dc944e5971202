# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which C++ file may include which: packages by package.xml, rooms by tools/rooms.yaml."""

from __future__ import annotations

import re
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import yaml

TABLE = Path("tools/rooms.yaml")
_INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
_TESTS = {"test", "test_support", "benchmark"}


@dataclass
class House:
    """What may include what.

    Attributes:
        packages: catkin packages by folder, relative to the clone, with the names they depend on.
        rooms: folders that are divided, with the rooms that each room may include.
    """

    packages: dict[Path, tuple[str, set[str]]] = field(default_factory=dict)
    rooms: dict[Path, dict[str, list[str]]] = field(default_factory=dict)

    def package_of(self, path: Path) -> Path | None:
        """Folder of the package that a file belongs to."""
        return next((folder for folder in path.parents if folder in self.packages), None)

    def room_of(self, path: Path) -> tuple[Path, str] | None:
        """The divided folder that a file is in, and its room there; the name may be unlisted."""
        for folder in self.rooms:
            if path.is_relative_to(folder) and len(path.relative_to(folder).parts) > 1:
                return folder, path.relative_to(folder).parts[0]
        return None


def read_house(root: Path) -> House:
    """The packages of a clone and its table of rooms."""
    house = House()
    for manifest in sorted(root.glob("src/**/package.xml")):
        house.packages[manifest.parent.relative_to(root)] = _read_manifest(manifest)
    table: Mapping[str, Mapping[str, list[str]]] = yaml.safe_load(
        (root / TABLE).read_text(encoding="utf-8")
    )
    house.rooms = {Path(folder): dict(rooms) for folder, rooms in table.items()}
    return house


def _read_manifest(manifest: Path) -> tuple[str, set[str]]:
    """A package's name, and those of the packages it depends on."""
    tree = ET.parse(manifest).getroot()
    depends = {(item.text or "").strip() for item in tree if "depend" in item.tag}
    return (tree.findtext("name") or "").strip(), depends


def _candidates(source: Path, include: str, files: Mapping[str, list[Path]]) -> list[Path]:
    """Files of the clone that an include may mean, the nearest first."""
    sibling = Path(*_normalized((source.parent / include).parts))
    found = files.get(Path(include).name, [])
    if sibling in found:
        return [sibling]
    return [path for path in found if path.as_posix().endswith("/" + include.removeprefix("../"))]


def _normalized(parts: Iterable[str]) -> list[str]:
    result: list[str] = []
    for part in parts:
        if part == "..":
            result.pop()
        else:
            result.append(part)
    return result


def violations(root: Path, sources: Iterable[Path], house: House) -> Iterator[str]:
    """One line for each include that goes against the house, with file, line and what is allowed.

    Args:
        root: the clone.
        sources: C++ files, relative to it.
        house: see `read_house`.
    """
    listed = sorted(sources)
    files: dict[str, list[Path]] = {}
    for path in listed:
        files.setdefault(path.name, []).append(path)
    for source in listed:
        text = (root / source).read_text(encoding="utf-8")
        for match in _INCLUDE.finditer(text):
            target = _target(house, source, _candidates(source, match.group(1), files))
            problem = target and _problem(house, source, target)
            if problem:
                line = text.count("\n", 0, match.start()) + 1
                yield f"{source}:{line}: includes {match.group(1)}: {problem}"


def _target(house: House, source: Path, found: list[Path]) -> Path | None:
    """That of the files an include may mean which it means: one of its own package, if any."""
    package = house.package_of(source)
    same = [path for path in found if house.package_of(path) == package]
    return next(iter(same or found), None)


def _problem(house: House, source: Path, target: Path) -> str:
    if _TESTS & set(source.parts):
        return ""
    package, other = house.package_of(source), house.package_of(target)
    if package is None or other is None:
        return ""
    if package == other:
        return _room_problem(house, source, target)
    name, depends = house.packages[other][0], house.packages[package][1]
    return "" if name in depends else f"{package}/package.xml does not depend on {name}"


def _room_problem(house: House, source: Path, target: Path) -> str:
    """What is wrong with an include inside a package, or ""."""
    room, target_room = house.room_of(source), house.room_of(target)
    if room is None or target_room is None or room == target_room or room[0] != target_room[0]:
        return ""
    allowed = house.rooms[room[0]].get(room[1])
    if allowed is None:
        return f"{TABLE} does not list the room {room[1]} of {room[0]}"
    if target_room[1] in allowed:
        return ""
    names = ", ".join(allowed) or "no other room"
    return f"the room {room[1]} may include {names}, not {target_room[1]}"


def check_rooms(root: Path, sources: Iterable[Path]) -> int:
    """Prints what goes against the house; returns 0 if nothing does."""
    found = list(violations(root, (path.relative_to(root) for path in sources), read_house(root)))
    for line in found:
        print(line, file=sys.stderr)
    return int(bool(found))
