# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Names that a C++ source keeps to itself: two sources with one in common are no one unit."""

from __future__ import annotations

import re

_NOT_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<raw>\w*)\(.*?\)(?P=raw)"'
    r"|\"(?:\\.|[^\"\\\n])*\"|(?<!\w)'(?:\\.|[^'\\\n])+'",
    re.DOTALL,
)
_UNNAMED = re.compile(r"\bnamespace\s*\{")
_TOKEN = re.compile(
    r"[{}();]|\b(?:class|struct|union|enum)\s+(?P<type>[A-Za-z_]\w*)"
    r"|\b(?P<name>[A-Za-z_]\w*)\s*(?P<next>[({=;\[]|:(?!:))?"
)
_MAIN = re.compile(r"^int main\(", re.MULTILINE)
_GTEST = re.compile(r"\b(?:TEST|TEST_F|TEST_P)\s*\(\s*(\w+)\s*,\s*(\w+)\s*\)")
_GTEST_SUITE = re.compile(r"\bINSTANTIATE_TEST_SUITE_P\s*\(\s*(\w+)\s*,\s*(\w+)")
_MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.MULTILINE)


def hidden_names(text: str) -> set[str]:
    """What a source keeps to itself: names of its unnamed namespaces, its macros, tests and main.

    The search is textual and takes too many rather than too few.
    """
    names = {*_MACRO.findall(text), *_MAIN.findall(text)}
    code = _NOT_CODE.sub(" ", text)
    # googletest makes a class of both names.
    code = _GTEST.sub(r"void \1_\2_Test()", code)
    code = _GTEST_SUITE.sub(r"void \1\2_instance(", code)
    for start in _UNNAMED.finditer(code):
        names |= _declared_names(code, start.end())
    return names


def _declared_names(code: str, start: int) -> set[str]:
    """Names declared between ``start`` and the brace that closes what was opened before it."""
    names: set[str] = set()
    depth = 0
    in_initializer = False
    for token in _TOKEN.finditer(code, start):
        mark = token["next"] or token.group()
        if token["type"] and depth == 0:
            names.add(token["type"])
            in_initializer = True  # base classes follow, or nothing
        elif (
            token["name"] and depth == 0 and (mark == "=" or (token["next"] and not in_initializer))
        ):
            names.add(token["name"])  # one of several with initializers, or the first
            in_initializer = mark in "=:"
        if mark in ("{", "("):
            in_initializer = in_initializer and mark == "("
            depth += 1
        elif mark in ("}", ")"):
            depth -= 1
            if depth < 0:
                break
        elif mark == ";" and depth == 0:
            in_initializer = False
    return names
