# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""YAML in which every key is known and every error has a file, a line and a key."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import yaml
from trident_base.params import nearest

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.bounded_file import LARGEST_YAML_BYTES, read_bounded


class Section:
    """A mapping of a YAML file, read key by key; `finish` refuses what was not read."""

    def __init__(self, node: yaml.Node, file: Path) -> None:
        """Take a node that has to be a mapping.

        Raises:
            FormationError: another kind of node, or a key given twice.
        """
        self._file = file
        self.where = f"{file}:{node.start_mark.line + 1}"
        if not isinstance(node, yaml.MappingNode):
            raise FormationError(f"{self.where}: no mapping; legal: lines of `key: value`")
        self._nodes: dict[str, yaml.Node] = {}
        self._unread: dict[str, str] = {}
        for key, value in node.value:
            name, place = str(key.value), f"{file}:{key.start_mark.line + 1}"
            if name in self._nodes:
                raise FormationError(f"{place}: {name}: given twice")
            self._nodes[name] = value
            self._unread[name] = place
        self._known: list[str] = []

    def __contains__(self, name: str) -> bool:
        return name in self._nodes

    def error(self, name: str, problem: str) -> FormationError:
        """An error about one key of this section."""
        line = self._nodes[name].start_mark.line + 1
        return FormationError(f"{self._file}:{line}: {name}: {problem}")

    def error_here(self, problem: str) -> FormationError:
        """An error about the section as a whole."""
        return FormationError(f"{self.where}: {problem}")

    def names(self) -> list[str]:
        """All keys, in the order of the file."""
        return list(self._nodes)

    def number(self, name: str, default: float) -> float:
        """A finite number."""
        value = self._value(name, default)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self.error(name, f"{value!r}; legal: a number")
        if not math.isfinite(value):
            raise self.error(name, f"{value}; legal: a finite number")
        return float(value)

    def integer(self, name: str, default: int) -> int:
        """A whole number."""
        value = self._value(name, default)
        if isinstance(value, bool) or not isinstance(value, int):
            raise self.error(name, f"{value!r}; legal: a whole number")
        return value

    def text(self, name: str, default: str) -> str:
        """A text."""
        value = self._value(name, default)
        if not isinstance(value, str):
            raise self.error(name, f"{value!r}; legal: a text")
        return value

    def vector(self, name: str, default: tuple[float, float, float]) -> tuple[float, float, float]:
        """Three finite numbers."""
        value = self._value(name, list(default))
        numbers = three_numbers(value)
        if numbers is None:
            raise self.error(name, f"{value!r}; legal: three finite numbers, e.g. [1, 0, 0.5]")
        return numbers

    def choice(self, name: str, legal: Sequence[str]) -> str:
        """A text that has to be there and to be one of these."""
        value = self.value(name)
        if value not in legal:
            near = nearest(value, legal) if isinstance(value, str) else ""
            raise self.error(name, f"{value!r}{near}; legal: {', '.join(legal)}")
        return str(value)

    def value(self, name: str) -> Any:
        """Whatever stands under a key that has to be there."""
        return yaml.SafeLoader("").construct_object(self._node(name), deep=True)

    def items(self, name: str) -> list[Any]:
        """The list under a key that has to be there."""
        if not isinstance(self._node(name), yaml.SequenceNode):
            raise self.error(name, "no list; legal: [VALUE, ...]")
        return list(self.value(name))

    def mapping(self, name: str) -> dict[str, Any]:
        """The mapping under a key, whatever its keys are; empty if it is not there."""
        if name not in self._nodes:
            self._known.append(name)
            return {}
        inner = self.section(name)
        return {key: inner.value(key) for key in inner.names()}

    def is_list(self, name: str) -> bool:
        """Whether a list stands under a key."""
        return isinstance(self._nodes.get(name), yaml.SequenceNode)

    def section(self, name: str) -> Section:
        """The mapping under a key that has to be there."""
        return Section(self._node(name), self._file)

    def sections(self, name: str) -> list[Section]:
        """The list of mappings under a key; none if it is not there."""
        if name not in self._nodes:
            self._known.append(name)
            return []
        node = self._node(name)
        if not isinstance(node, yaml.SequenceNode):
            raise self.error(name, "no list; legal: lines that begin with `- `")
        return [Section(item, self._file) for item in node.value]

    def skip(self, name: str) -> None:
        """A key that is known, and read at another time."""
        self._known.append(name)
        self._unread.pop(name, None)

    def finish(self) -> None:
        """Raise FormationError if there is a key that nobody has read."""
        for name, where in self._unread.items():
            near = nearest(name, self._known)
            raise FormationError(
                f"{where}: {name}: unknown key{near}; legal: {', '.join(sorted(set(self._known)))}"
            )

    def _node(self, name: str) -> yaml.Node:
        self._known.append(name)
        self._unread.pop(name, None)
        if name not in self._nodes:
            raise FormationError(f"{self.where}: no {name}; legal: `{name}: ...`")
        return self._nodes[name]

    def _value(self, name: str, default: Any) -> Any:
        if name not in self._nodes:
            self._known.append(name)
            return default
        return self.value(name)


def load(path: Path) -> Section:
    """The outermost mapping of a file.

    Raises:
        FormationError: unreadable, not YAML, or no mapping.
    """
    node = _compose(path)
    if node is None:
        raise FormationError(f"{path}: empty; legal: lines of `key: value`")
    return Section(node, path)


def _compose(path: Path) -> yaml.Node | None:
    try:
        text = read_bounded(path, LARGEST_YAML_BYTES).decode("utf-8")
        return yaml.compose(text, Loader=yaml.SafeLoader)
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise FormationError(f"{path}: {reason}; legal: a readable YAML file") from error
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        line = f":{mark.line + 1}" if mark else ""
        raise FormationError(f"{path}{line}: {error.problem}; legal: YAML") from error
    except yaml.YAMLError as error:
        raise FormationError(f"{path}: {str(error).splitlines()[0]}; legal: YAML") from error


def three_numbers(value: object) -> tuple[float, float, float] | None:
    """A list of three finite numbers; None for anything else."""
    if not isinstance(value, list) or len(value) != 3:
        return None
    if not all(type(number) in (int, float) and math.isfinite(number) for number in value):
        return None
    return float(value[0]), float(value[1]), float(value[2])
