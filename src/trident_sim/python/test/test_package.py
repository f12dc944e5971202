# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the package promises beside physics: no ROS, types and documentation that fit."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import WORLD

import trident_sim
from trident_sim import _core

PACKAGE = Path(trident_sim.__file__).resolve().parent


@pytest.mark.parametrize("python", ["/usr/bin/python3", sys.executable])
def test_no_ros_is_imported(python: str) -> None:
    code = f"""
import sys, trident_sim
world = trident_sim.World({WORLD!r})
world.step(10)
ros = [name for name in sys.modules if name.partition(".")[0] in
       ("rospy", "roslib", "rosgraph", "rospkg", "genpy", "roslaunch", "xacro")]
print(world.step_count, ros)
"""
    result = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout == "10 []\n"


def stub_classes() -> dict[str, set[str]]:
    tree = ast.parse((PACKAGE / "_core.pyi").read_text(encoding="utf-8"))
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    members: dict[str, set[str]] = {}
    for name, node in classes.items():
        bases = [base.id for base in node.bases if isinstance(base, ast.Name)]
        inherited = set().union(*(members.get(base, set()) for base in bases))
        own = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        members[name] = own | inherited
    return members


def test_stub_and_module_have_the_same_members() -> None:
    stubs = {name: members for name, members in stub_classes().items() if name[0] != "_"}
    compiled = {name: cls for name, cls in vars(_core).items() if isinstance(cls, type)}
    assert set(stubs) == set(compiled)
    for name, cls in compiled.items():
        if issubclass(cls, Exception):
            continue
        public = {member for member in vars(cls) if not member.startswith("_")}
        assert {member for member in stubs[name] if not member.startswith("_")} == public, name
    functions = {name for name, item in vars(_core).items() if callable(item)} - set(compiled)
    assert functions == {"find_resource", "restore_snapshot", "save_snapshot"}


def test_public_names_are_documented_and_say_where_they_belong() -> None:
    for name in trident_sim.__all__:
        item = getattr(trident_sim, name)
        assert item.__doc__, name
        assert item.__module__.partition(".")[0] == "trident_sim", name


def test_typed() -> None:
    assert (PACKAGE / "py.typed").is_file()
