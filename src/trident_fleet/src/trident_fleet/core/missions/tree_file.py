# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Behavior trees in YAML: selectors, sequences, subtrees and the nodes of the registry."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any, Protocol

import py_trees
from py_trees.common import Status
from py_trees.composites import Selector, Sequence

from trident_fleet.core.files.strict_yaml import Section, load
from trident_fleet.core.missions.nodes import NODES
from trident_fleet.core.missions.nodes.base import Node
from trident_fleet.core.missions.robot import MissionRobot

_COMPOSITES: dict[str, type[Any]] = {"selector": Selector, "sequence": Sequence}


class Tree(Protocol):
    """What has grown."""

    def tick_once(self) -> None:
        """Let it act once."""
        ...


class Leaf(py_trees.behaviour.Behaviour):
    """A node of the registry in a tree of py_trees."""

    def __init__(self, name: str, node: Node, robot: MissionRobot) -> None:
        """Of a robot."""
        super().__init__(name)
        self._node, self._robot = node, robot

    def update(self) -> Status:
        """Tick the node."""
        return self._node.tick(self._robot)


@dataclasses.dataclass(frozen=True)
class TreePlan:
    """A tree that has been read: `kind` is selector, sequence, or a node's name."""

    kind: str
    children: tuple[TreePlan, ...] = ()
    node: Node | None = None

    def grow(self, robot: MissionRobot) -> Tree:
        """The tree of a robot."""
        if self.node is not None:
            return Leaf(self.kind, self.node, robot)
        children = [child.grow(robot) for child in self.children]
        grown: Tree = _COMPOSITES[self.kind](self.kind, memory=False, children=children)
        return grown


def read_tree(path: Path) -> TreePlan:
    """A file with `tree:` and, if it likes, `subtrees:` by name.

    Raises:
        FormationError: what is wrong, with file, line, key, value and legal range: unknown nodes
            or parameters, a subtree that is not there, or one that contains itself.
    """
    file = load(path)
    subtrees: dict[str, Section] = {}
    if "subtrees" in file:
        part = file.section("subtrees")
        subtrees = {name: part.section(name) for name in part.names()}
        part.finish()
    else:
        file.skip("subtrees")
    plan = _read(file.section("tree"), subtrees, ())
    file.finish()
    return plan


def _kind(section: Section) -> str:
    names = section.names()
    if len(names) != 1:
        raise section.error_here(f"{len(names)} keys; legal: one, the kind of the node")
    return names[0]


def _children(section: Section, kind: str) -> list[Section]:
    parts = section.sections(kind)
    if not parts:
        raise section.error(kind, "no children; legal: one or more")
    return parts


def _read(section: Section, subtrees: dict[str, Section], within: tuple[str, ...]) -> TreePlan:
    kind = _kind(section)
    if kind in _COMPOSITES:
        children = _children(section, kind)
        return TreePlan(kind, tuple(_read(part, subtrees, within) for part in children))
    if kind == "subtree":
        name = section.choice(kind, sorted(subtrees))
        if name in within:
            raise section.error(kind, f"{name}: contains itself; legal: a tree without cycles")
        return _read(subtrees[name], subtrees, (*within, name))
    if kind not in NODES:
        legal = ", ".join((*_COMPOSITES, "subtree", *NODES))
        raise section.error(kind, f"unknown node; legal: {legal}")
    return TreePlan(kind, node=_node(section, kind))


def _node(section: Section, kind: str) -> Node:
    part = section.section(kind)
    values: dict[str, Any] = {}
    for field in dataclasses.fields(NODES[kind]):
        default: Any = field.default
        values[field.name] = part.number(field.name, default)
        if values[field.name] < 0.0:
            raise part.error(field.name, f"{values[field.name]:g}; legal: 0 or more")
    part.finish()
    return NODES[kind](**values)
