# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which sources are compiled as one: a compiler spends most of its time on what they include.

cmake writes the sources of each target to LIST, and includes GROUPS, where each line puts a source
into a group, or says that it is the only one of its group and is compiled as it is. Sources that
hide something under the same name are never in one group. A source stays where it was as long as
that holds, so that a change compiles no more than its group.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from trident_tool.hidden_names import hidden_names

LIST = "unity_sources.txt"
GROUPS = "unity_groups.cmake"
_LARGEST = 5  # sources: more save little time, and leave less for other processors
_CALL = "trident_unity_group"
_CALL_ALONE = "trident_unity_alone"


@dataclass(frozen=True)
class Source:
    """A source file of a target."""

    target: str
    path: str


@dataclass
class _Group:
    size: int = 0
    names: set[str] = field(default_factory=set)

    def takes(self, names: set[str]) -> bool:
        return self.size < _LARGEST and self.names.isdisjoint(names)

    def add(self, names: set[str]) -> None:
        self.size += 1
        self.names |= names


def grouped(
    paths: Sequence[str], previous: Mapping[str, int], names_of: Callable[[str], set[str]]
) -> dict[str, int]:
    """The group of each source of a target.

    Args:
        paths: the sources; those that stand together come together.
        previous: their groups so far; none or -1 for a new one.
        names_of: what a source hides.

    Returns:
        The number of its group for each source.
    """
    groups: dict[int, _Group] = {}
    found: dict[str, int] = {}

    def put(path: str, number: int) -> None:
        groups.setdefault(number, _Group()).add(names_of(path))
        found[path] = number

    for path in paths:
        number = previous.get(path, -1)
        if number >= 0 and groups.get(number, _Group()).takes(names_of(path)):
            put(path, number)
    for path in paths:
        if path not in found:
            fits = (number for number in sorted(groups) if groups[number].takes(names_of(path)))
            put(path, next(fits, max(groups, default=-1) + 1))
    return {path: found[path] for path in paths}


def parse_list(text: str) -> list[Source]:
    """Sources of a LIST: target and path, with a tab between, in each line."""
    return [Source(*line.split("\t")) for line in text.splitlines() if line]


def parse_groups(text: str) -> dict[Source, int]:
    """What ``groups_text`` has written."""
    found = {}
    for line in text.splitlines():
        call, _, words = line.partition("(")
        if call in (_CALL, _CALL_ALONE):
            target, number, path = words[:-1].split(" ", 2)
            found[Source(target, path.strip('"'))] = int(number)
    return found


def groups_text(groups: Mapping[Source, int]) -> str:
    """A cmake script that puts each source into its group."""
    sizes = Counter((source.target, number) for source, number in groups.items())
    lines = []
    for source, number in groups.items():
        call = _CALL if sizes[source.target, number] > 1 else _CALL_ALONE
        lines.append(f'{call}({source.target} {number} "{source.path}")\n')
    return "".join(lines)


def group_sources(
    sources: Iterable[Source], previous: Mapping[Source, int], read: Callable[[str], str]
) -> dict[Source, int]:
    """The groups of all targets, see `grouped`."""
    names: dict[str, set[str]] = {}

    def names_of(path: str) -> set[str]:
        if path not in names:
            names[path] = hidden_names(read(path))
        return names[path]

    of_target: dict[str, list[str]] = {}
    for source in sources:
        of_target.setdefault(source.target, []).append(source.path)
    result: dict[Source, int] = {}
    for target, paths in of_target.items():
        before = {path: previous.get(Source(target, path), -1) for path in paths}
        for path, number in grouped(paths, before, names_of).items():
            result[Source(target, path)] = number
    return result


def _read(path: str) -> str:
    return Path(path).read_text(encoding="utf-8", errors="replace") if Path(path).is_file() else ""


def update(build: Path) -> bool:
    """Brings GROUPS in a build folder up to date with what the sources hide now.

    Returns:
        Whether it has changed; ninja then runs cmake.
    """
    if not (build / LIST).is_file():
        return False
    sources = parse_list((build / LIST).read_text(encoding="utf-8"))
    file = build / GROUPS
    before = file.read_text(encoding="utf-8") if file.is_file() else None
    text = groups_text(group_sources(sources, parse_groups(before or ""), _read))
    if text == before:
        return False
    file.write_text(text, encoding="utf-8")
    return True


def main(args: Sequence[str] | None = None) -> int:
    """Called by cmake when it configures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path, help="the build folder, where LIST is")
    update(parser.parse_args(args).build)
    return 0


if __name__ == "__main__":
    sys.exit(main())
