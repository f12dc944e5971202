# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Every shipped rviz configuration names what the installed rviz has."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import yaml

CONFIGURATIONS = sorted((Path(__file__).parents[2] / "config" / "rviz").glob("*.rviz"))
PLUGINS = Path("/usr/share/rviz/plugin_description.xml")
# Built into rviz: they are no plugins.
PANELS = {"Displays", "Help", "Selection", "Time", "Tool Properties", "Views"}
_TOPIC = re.compile(r"/?[A-Za-z]\w*(/\w+)*")


def _plugins(base: str) -> set[str]:
    found = ElementTree.parse(PLUGINS).iter("class")
    return {str(one.get("name")) for one in found if one.get("base_class_type") == base}


def _topics(display: dict[str, Any]) -> Iterator[str]:
    for key, value in display.items():
        if key == "Topic" or key.endswith(" Topic"):
            yield value["Value"] if isinstance(value, dict) else value


@pytest.mark.parametrize("path", CONFIGURATIONS, ids=lambda path: path.stem)
def test_it_names_what_rviz_has(path: Path) -> None:
    document = yaml.safe_load(path.read_text(encoding="utf-8"))
    manager = document["Visualization Manager"]
    displays, view = manager["Displays"], manager["Views"]["Current"]
    assert {panel["Class"] for panel in document["Panels"]} <= {f"rviz/{one}" for one in PANELS}
    assert {one["Class"] for one in displays} <= _plugins("rviz::Display")
    assert {one["Class"] for one in manager["Tools"]} <= _plugins("rviz::Tool")
    assert view["Class"] in _plugins("rviz::ViewController")
    assert manager["Global Options"]["Fixed Frame"]
    names = [one["Name"] for one in displays]
    assert len(set(names)) == len(names)
    topics = [topic for one in displays for topic in _topics(one)]
    assert topics
    assert all(_TOPIC.fullmatch(topic) for topic in topics), topics
