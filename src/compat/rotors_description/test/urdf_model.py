# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Expands the package's xacro files and reads a URDF into comparable numbers."""

from __future__ import annotations

import subprocess
import xml.etree.ElementTree as ET
from functools import cache
from pathlib import Path
from typing import Any

PACKAGE = Path(__file__).resolve().parents[1]
XACRO = PACKAGE.parent / "xacro" / "xacro"

# A value is a number where the text is one, so that 1e-06 equals 0.000001.
Value = float | str


@cache
def expand(file_name: str, **arguments: str) -> str:
    """The URDF text of urdf/<file_name> with xacro arguments."""
    command = [str(XACRO), str(PACKAGE / "urdf" / file_name)]
    command += [f"{key}:={value}" for key, value in arguments.items()]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert not result.stderr, f"xacro warns: {result.stderr}"
    return result.stdout


def values(text: str | None) -> tuple[Value, ...]:
    """Words of a text, as numbers where they are numbers (rounded to 12 digits)."""
    out: list[Value] = []
    for word in (text or "").split():
        try:
            out.append(float(f"{float(word):.12g}"))
        except ValueError:
            out.append(word)
    return tuple(out)


def _origin(element: ET.Element | None) -> tuple[tuple[Value, ...], tuple[Value, ...]]:
    origin = element.find("origin") if element is not None else None
    found: dict[str, str] = dict(origin.attrib) if origin is not None else {}
    return values(found.get("xyz", "0 0 0")), values(found.get("rpy", "0 0 0"))


def _attributes(element: ET.Element) -> dict[str, tuple[Value, ...]]:
    return {key: values(text) for key, text in element.attrib.items()}


def _shapes(link: ET.Element, tag: str) -> list[Any]:
    shapes = []
    for element in link.findall(tag):
        geometry = element.find("geometry")
        assert geometry is not None
        (shape,) = geometry
        shapes.append((_origin(element), shape.tag, _attributes(shape)))
    return shapes


def _inertial(link: ET.Element) -> Any:
    inertial = link.find("inertial")
    if inertial is None:
        return None
    mass, inertia = inertial.find("mass"), inertial.find("inertia")
    assert mass is not None
    assert inertia is not None
    return values(mass.get("value")), _origin(inertial), _attributes(inertia)


def _joint(joint: ET.Element) -> dict[str, Any]:
    out: dict[str, Any] = {"type": joint.get("type"), "origin": _origin(joint)}
    for tag in ("parent", "child", "axis", "limit"):
        element = joint.find(tag)
        out[tag] = _attributes(element) if element is not None else None
    return out


def model(urdf: str) -> dict[str, dict[str, Any]]:
    """Links, joints, plugin parameters and per-link simulator settings, by name."""
    root = ET.fromstring(urdf)
    extensions = root.findall("gazebo")
    plugins = [p for e in extensions for p in e.findall("plugin")]
    return {
        "links": {
            str(link.get("name")): {
                "inertial": _inertial(link),
                "visual": _shapes(link, "visual"),
                "collision": _shapes(link, "collision"),
            }
            for link in root.findall("link")
        },
        "joints": {str(joint.get("name")): _joint(joint) for joint in root.findall("joint")},
        "plugins": {
            str(plugin.get("name")): {
                "filename": plugin.get("filename"),
                **{child.tag: values(child.text) for child in plugin},
            }
            for plugin in plugins
        },
        "references": {
            str(e.get("reference")): {child.tag: values(child.text) for child in e}
            for e in extensions
            if e.get("reference")
        },
    }
