# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Launch files: finding them, and checking arguments before anything is started."""

from __future__ import annotations

import difflib
import subprocess
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from trident_tool.workspace import TridentError, Workspace


@dataclass(frozen=True)
class LaunchRequest:
    """What the user asked for: a launch file, perhaps its package, and roslaunch arguments."""

    file: str
    package: str | None
    args: dict[str, str]


@dataclass(frozen=True)
class DeclaredArgs:
    """Arguments that a launch file declares at its top level."""

    optional: frozenset[str]
    required: frozenset[str]
    fixed: frozenset[str]

    @property
    def settable(self) -> list[str]:
        """Those a user may give, sorted."""
        return sorted(self.optional | self.required)


def parse_request(words: Sequence[str]) -> LaunchRequest:
    """Splits ``[PACKAGE] FILE.launch [name:=value …]``.

    Raises:
        TridentError: no file, more than a package and a file, an empty name, or a name given twice.
    """
    names = [word for word in words if ":=" not in word]
    if not 1 <= len(names) <= 2:
        found = " ".join(names) if names else "nothing"
        raise TridentError(f"run needs [PACKAGE] FILE.launch [name:=value …], found {found}")
    args = _assigned(words)
    return LaunchRequest(names[-1], names[0] if len(names) == 2 else None, args)


def _assigned(words: Sequence[str]) -> dict[str, str]:
    """Values of those words that are ``name:=value``, by name."""
    args: dict[str, str] = {}
    for word in words:
        name, separator, value = word.partition(":=")
        if not separator:
            continue
        if not name or name in args:
            raise TridentError(
                f"argument {word!r}: its name is {'given twice' if name else 'empty'}"
            )
        args[name] = value
    return args


def _closest(name: str, candidates: Sequence[str]) -> str:
    close = difflib.get_close_matches(name, candidates, n=1)
    return f"; did you mean {close[0]!r}?" if close else ""


def _package_folder(package: str, env: Mapping[str, str]) -> Path:
    result = subprocess.run(
        ["rospack", "find", package], env=dict(env), capture_output=True, text=True, check=False
    )
    if result.returncode != 0:
        raise TridentError(f"there is no package {package!r} on ROS_PACKAGE_PATH")
    return Path(result.stdout.strip())


def find_launch_file(workspace: Workspace, request: LaunchRequest, env: Mapping[str, str]) -> Path:
    """The launch file of ``request``: in its package, or a path, or below the workspace's launch/.

    Raises:
        TridentError: no such file, or more than one.
    """
    if request.package is not None:
        top = _package_folder(request.package, env)
        return _find_below(top, request.file, f"package {request.package} ({top})")
    if Path(request.file).is_file():
        return Path(request.file).resolve()
    return _find_below(workspace.launch, request.file, str(workspace.launch))


def _find_below(top: Path, file: str, where: str) -> Path:
    """The launch file at ``top``, in its launch/, or else the only one of its name below."""
    found = _launch_files(top, file)
    if len(found) == 1:
        return found[0]
    if found:
        raise TridentError(f"{file} is ambiguous: {', '.join(map(str, found))}")
    hint = _closest(file, sorted(path.name for path in top.rglob("*.launch")))
    raise TridentError(f"there is no launch file {file!r} in {where}{hint}")


def _launch_files(top: Path, file: str) -> list[Path]:
    for direct in (top / file, top / "launch" / file):
        if direct.is_file():
            return [direct]
    return sorted(path for path in top.rglob(Path(file).name) if path.is_file())


def _own_elements(element: ElementTree.Element) -> Iterator[ElementTree.Element]:
    """Elements outside of <include>, whose <arg>s belong to another file."""
    for child in element:
        yield child
        if child.tag != "include":
            yield from _own_elements(child)


def _root_of(launch_file: Path) -> ElementTree.Element:
    try:
        return ElementTree.parse(launch_file).getroot()
    except ElementTree.ParseError as error:
        line, column = error.position
        raise TridentError(
            f"{launch_file}:{line}:{column}: not well-formed XML ({error.msg})"
        ) from None


def declared_args(launch_file: Path) -> DeclaredArgs:
    """Arguments of a launch file.

    Raises:
        TridentError: the file is not well-formed; names file, line and column.
    """
    root = _root_of(launch_file)
    groups: dict[str, set[str]] = {"default": set(), "value": set(), "none": set()}
    for element in _own_elements(root):
        if element.tag == "arg" and "name" in element.attrib:
            kind = next((kind for kind in ("value", "default") if kind in element.attrib), "none")
            groups[kind].add(element.attrib["name"])
    optional = groups["default"] - groups["value"]
    return DeclaredArgs(
        frozenset(optional),
        frozenset(groups["none"] - optional - groups["value"]),
        frozenset(groups["value"]),
    )


def check_args(launch_file: Path, declared: DeclaredArgs, given: Mapping[str, str]) -> None:
    """Refuses what roslaunch would only reject after a master was started.

    Raises:
        TridentError: an argument is unknown, cannot be set, or is missing.
    """
    for name in given:
        if name in declared.settable:
            continue
        if name in declared.fixed:
            raise TridentError(f"{launch_file.name} sets {name!r} itself, it cannot be given")
        known = ", ".join(declared.settable) or "none"
        hint = _closest(name, declared.settable)
        raise TridentError(f"{launch_file.name} has no argument {name!r}{hint} (it has: {known})")
    missing = sorted(declared.required - set(given))
    if missing:
        raise TridentError(
            f"{launch_file.name} needs {', '.join(f'{name}:=…' for name in missing)}"
        )
