# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""docs/reference/plugins.md: what plugins ask of their elements, with what the elements mean.

Names, kinds, defaults and ranges are those that the plugins ask for (the program
plugin_reference); what an element means, and its unit, stands in docs/reference/plugins.yaml.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

_UNIT = re.compile(r"\s*\[([^\]]*)\]$")
_HUGE = 1e9
_DERIVED = {"base_link": "the link's name", "case": "the sensor's name", "quad": "the model's name"}


@dataclass(frozen=True)
class Element:
    """What a plugin asks of one element."""

    kind: str
    default: str
    least: float
    largest: float
    is_required: bool

    @property
    def legal(self) -> str:
        """The legal values in words; empty for any text."""
        words = {"flag": "true, false", "vector": "three numbers", "element": "elements"}
        if self.kind == "integer":
            return f"whole, {self._bounds() or 'any'}"
        if self.kind == "number":
            return self._bounds() or "any number"
        return words.get(self.kind, "")

    def _bounds(self) -> str:
        """The range of a number; empty for one without bounds."""
        has_least, has_largest = self.least > -_HUGE, self.largest < _HUGE
        if has_least and has_largest:
            return f"{self.least:g} to {self.largest:g}"
        if has_least:
            return f">= {self.least:g}"
        return f"<= {self.largest:g}" if has_largest else ""

    @property
    def shown_default(self) -> str:
        """The default as the page shows it."""
        if self.is_required:
            return "required"
        if self.kind == "element" or not self.default:
            return ""
        if self.kind == "text" and self.default in _DERIVED:
            return _DERIVED[self.default]
        if self.kind in ("number", "integer") and math.isinf(float(self.default)):
            return "none"
        return f"`{self.default}`"


Listing = dict[str, dict[str, Element]]


def parse_listing(text: str) -> Listing:
    """What the program plugin_reference has printed, by plugin and element."""
    listing: Listing = {}
    for line in text.splitlines():
        plugin, *rest = line.split("\t")
        elements = listing.setdefault(plugin, {})
        if rest:
            name, kind, default, least, largest, required = rest
            elements[name] = Element(kind, default, float(least), float(largest), required == "1")
    return listing


def _row(name: str, element: Element, text: str) -> str:
    unit = _UNIT.search(text)
    meaning = text[: unit.start()] if unit else text
    cells = [f"`{name}`", element.shown_default, unit[1] if unit else "", element.legal, meaning]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _section(entry: dict[str, Any], listing: Listing, common: dict[str, str]) -> list[str]:
    """A plugin under all its names; raises KeyError for an element that has no text."""
    names: list[str] = entry["names"]
    elements: dict[str, Element] = {}
    for name in names:
        for key, element in listing.get(name, {}).items():
            elements.setdefault(key, element)
    meaning = {**common, **entry.get("elements", {})}
    lines = ["### " + ", ".join(f"`lib{name}.so`" for name in names), "", entry["text"].strip(), ""]
    if elements:
        lines += ["| element | default | unit | legal | what |", "|---|---|---|---|---|"]
        lines += [_row(key, element, meaning[key]) for key, element in sorted(elements.items())]
        lines.append("")
    return lines


def _problems(groups: list[dict[str, Any]], listing: Listing, common: dict[str, str]) -> list[str]:
    """Where what is written and what plugins ask for differ."""
    entries = [entry for group in groups for entry in group["plugins"]]
    found = [*_name_problems([name for entry in entries for name in entry["names"]], listing)]
    for entry in entries:
        found += _element_problems(entry, listing, common)
    return found


def _name_problems(written: list[str], listing: Listing) -> Iterator[str]:
    for name in sorted(set(listing) - set(written)):
        yield f"plugin {name} is not in plugins.yaml"
    for name in written:
        if name not in listing:
            yield f"plugins.yaml: there is no plugin {name}"


def _element_problems(
    entry: dict[str, Any], listing: Listing, common: dict[str, str]
) -> Iterator[str]:
    """Where the elements of one plugin (of several names, perhaps) differ."""
    asked = {key for name in entry["names"] for key in listing.get(name, {})}
    own = entry.get("elements", {})
    title = entry["names"][0]
    for key in sorted(asked - set(own) - set(common)):
        yield f"plugins.yaml: {title} has no text for <{key}>"
    for key in own:
        if key not in asked:
            yield f"plugins.yaml: {title} asks for no <{key}>"


def plugins_page(text: str, descriptions: Path, problems: list[str]) -> str:
    """The page without its head.

    Args:
        text: what the program plugin_reference has printed.
        descriptions: plugins.yaml.
        problems: gets a line for each difference between the two.
    """
    listing = parse_listing(text)
    content = yaml.safe_load(descriptions.read_text(encoding="utf-8"))
    groups, common = content["groups"], content["common"]
    found = _problems(groups, listing, common)
    problems += found
    if found:
        common = {key: "" for keys in listing.values() for key in keys} | common
    lines = ["# Plugins", "", content["introduction"].strip(), ""]
    for group in groups:
        lines += [f"## {group['title']}", ""]
        for entry in group["plugins"]:
            lines += _section(entry, listing, common)
    return "\n".join(lines).rstrip() + "\n"
