# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The stub of the compiled module says what the module says: names, arguments, docstrings."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

import trident_sim
from trident_sim import _core

STUB = ast.parse((Path(trident_sim.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
STUB_CLASSES = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
COMPILED = {name: item for name, item in vars(_core).items() if isinstance(item, type)}
PHYSICAL = re.compile(r"position|orientation|velocit|accelerat|force|torque|mass|time|stamp|effort")
UNIT_OR_SHAPE = re.compile(r"\[[^]]+\]|quaternion|until|shape")

Function = ast.FunctionDef


def functions(name: str) -> dict[str, Function]:
    """Members of a class in the stub, inherited ones too; getters stand for properties."""
    node = STUB_CLASSES[name]
    found: dict[str, Function] = {}
    for base in node.bases:
        if isinstance(base, ast.Name) and base.id in STUB_CLASSES:
            found |= functions(base.id)
    for item in node.body:
        if isinstance(item, Function):
            is_setter = any(isinstance(mark, ast.Attribute) for mark in item.decorator_list)
            found |= {} if is_setter else {item.name: item}
    return found


def public(names: object) -> set[str]:
    return {name for name in names if not name.startswith("_")}  # type: ignore[attr-defined]


def compiled_functions(cls: type) -> dict[str, object]:
    """Methods and properties of a compiled class that are documented in the stub."""
    kept = {name: item for name, item in vars(cls).items() if not name.startswith("_")}
    return kept | {name: item for name, item in vars(cls).items() if name == "__init__"}


def text_of(item: object) -> str:
    """Docstring without the line of the signature that pybind11 puts before it."""
    text = (item.__doc__ or "").strip()
    if not isinstance(item, property):
        text = text.partition("\n\n")[2]
    return "\n".join(line.strip() for line in text.strip().splitlines())


def arguments_of(item: object) -> list[str] | None:
    """Names of the arguments in pybind11's signature; None where it does not know them."""
    line = (item.__doc__ or "").strip().partition("\n")[0]
    names = re.findall(r"[(,] ?(\w+): ", line)
    return None if not names or any(re.fullmatch(r"arg\d+", name) for name in names) else names


def test_classes_and_functions_have_the_same_names() -> None:
    assert public(STUB_CLASSES) == set(COMPILED)
    compiled = {name for name, item in vars(_core).items() if callable(item)} - set(COMPILED)
    assert {node.name for node in STUB.body if isinstance(node, Function)} == compiled


@pytest.mark.parametrize("name", sorted(COMPILED))
def test_members_have_the_same_names(name: str) -> None:
    if not issubclass(COMPILED[name], Exception):
        assert public(functions(name)) == public(vars(COMPILED[name]))


@pytest.mark.parametrize("name", sorted(set(COMPILED) - {"Error"}))
def test_arguments_have_the_same_names(name: str) -> None:
    stub = functions(name)
    for member, item in compiled_functions(COMPILED[name]).items():
        wanted = None if isinstance(item, property) else arguments_of(item)
        if wanted is not None and member in stub:
            assert [one.arg for one in stub[member].args.args] == wanted, member


@pytest.mark.parametrize("name", sorted(set(COMPILED) - {"Session"}))
def test_docstrings_are_the_same_and_there_is_one_for_everything(name: str) -> None:
    assert ast.get_docstring(STUB_CLASSES[name]) == (COMPILED[name].__doc__ or "").strip()
    if name == "Error":
        return
    stub = functions(name)
    for member, item in compiled_functions(COMPILED[name]).items():
        text = text_of(item)
        if member != "__init__":
            assert text, f"{name}.{member} is not documented"
        if text:
            assert ast.get_docstring(stub[member]) == text, f"{name}.{member}"


@pytest.mark.parametrize("name", sorted(set(COMPILED) - {"Session", "Error", "Message"}))
def test_quantities_have_a_unit_or_a_shape(name: str) -> None:
    for member, item in vars(COMPILED[name]).items():
        if isinstance(item, property) and PHYSICAL.search(member):
            assert UNIT_OR_SHAPE.search(item.__doc__ or ""), f"{name}.{member}: {item.__doc__}"
