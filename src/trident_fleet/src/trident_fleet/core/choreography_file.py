# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Choreographies from a YAML file, or from the words of a command line."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from trident_fleet.core.choreography import Choreography, Step
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.strict_yaml import Section, load
from trident_fleet.core.patterns import KINDS, Pattern

_STEP_KEYS = ("reconfigure", "translate_m", "rotate_deg", "rescale")


def read_choreography(path: Path) -> Choreography:
    """Read a YAML file.

    Args:
        path: with keys `vehicles`, `begin`, `steps` and the optional others of `Choreography`.

    Raises:
        FormationError: unreadable, an unknown key, a wrong type; names file, line and key.
    """
    root = load(path)
    start = root.section("begin")
    default = Choreography(1, Pattern("line"))
    choreography = Choreography(
        vehicles=root.integer("vehicles", 6),
        begin=_pattern(start, ("position_m", "heading_deg")),
        steps=tuple(_step(section) for section in root.sections("steps")),
        position_m=start.vector("position_m", default.position_m),
        heading_deg=start.number("heading_deg", default.heading_deg),
        min_separation_m=root.number("min_separation_m", default.min_separation_m),
        row_spacing_m=root.number("row_spacing_m", default.row_spacing_m),
    )
    root.finish()
    try:
        choreography.validate()
    except FormationError as error:
        raise FormationError(_placed(str(error), path)) from error
    return choreography


def parse_words(words: list[str], vehicles: int, spacing_m: float) -> Choreography:
    """Read a command line: a pattern to begin with, then patterns and moves.

    Args:
        words: `line`, `wedge`, `circle`, `grid`; `translate:X,Y,Z` [m], `rotate:DEGREES`,
            `rescale:FACTOR`.
        vehicles: how many.
        spacing_m: of all patterns [m].

    Raises:
        FormationError: another word, or a first one that is no pattern.
    """
    if not words or words[0] not in KINDS:
        first = f"'{words[0]}'" if words else "nothing"
        raise FormationError(f"{first} to begin with; legal: {', '.join(KINDS)}")
    steps = [_step_of_word(word, number, spacing_m) for number, word in enumerate(words[1:], 2)]
    return Choreography(vehicles, Pattern(words[0], spacing_m), tuple(steps))


def _with_own_keys(pattern: Pattern, section: Section) -> Pattern:
    """The pattern with what is asked for its kind only."""
    if pattern.kind == "circle":
        return replace(pattern, radius_m=section.number("radius_m", pattern.radius_m))
    if pattern.kind == "wedge":
        return replace(pattern, opening_deg=section.number("opening_deg", pattern.opening_deg))
    if pattern.kind == "grid":
        return replace(pattern, columns=section.integer("columns", pattern.columns))
    return pattern


def _pattern(section: Section, besides: tuple[str, ...] = ()) -> Pattern:
    """A pattern; keys that are named in `besides` are read by the caller."""
    kind = section.text("pattern", "")
    if kind not in KINDS:
        raise FormationError(f"{section.where}: pattern: '{kind}'; legal: {', '.join(KINDS)}")
    pattern = Pattern(kind)
    pattern = replace(pattern, spacing_m=section.number("spacing_m", pattern.spacing_m))
    pattern = _with_own_keys(pattern, section)
    for name in besides:
        section.skip(name)
    section.finish()
    try:
        pattern.validate()
    except FormationError as error:
        raise FormationError(f"{section.where}: {error}") from error
    return pattern


def _step(section: Section) -> Step:
    if not any(key in section for key in _STEP_KEYS):
        raise FormationError(f"{section.where}: an empty step; legal: {', '.join(_STEP_KEYS)}")
    step = Step(
        pattern=_pattern(section.section("reconfigure")) if "reconfigure" in section else None,
        translate_m=section.vector("translate_m", Step.translate_m),
        rotate_deg=section.number("rotate_deg", Step.rotate_deg),
        rescale=section.number("rescale", Step.rescale),
        where=section.where,
    )
    section.skip("reconfigure")
    section.finish()
    return step


def _placed(message: str, path: Path) -> str:
    return message if message.startswith(str(path)) else f"{path}: {message}"


def _step_of_word(word: str, number: int, spacing_m: float) -> Step:
    where = f"step {number} ({word})"
    if word in KINDS:
        return Step(pattern=Pattern(word, spacing_m), where=where)
    name, _, value = word.partition(":")
    match name, _numbers(value):
        case "rotate", [degrees]:
            return Step(rotate_deg=degrees, where=where)
        case "rescale", [factor]:
            return Step(rescale=factor, where=where)
        case "translate", [x, y, z]:
            return Step(translate_m=(x, y, z), where=where)
    raise FormationError(
        f"'{word}'; legal: {', '.join(KINDS)}, translate:X,Y,Z, rotate:DEGREES, rescale:FACTOR"
    )


def _numbers(text: str) -> list[float]:
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        return []
