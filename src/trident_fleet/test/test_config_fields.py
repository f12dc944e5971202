# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Every field of every configuration can be set through its reader, and has one default."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from trident_base.params import Recorded
from trident_fleet.core.choreography import Choreography, Step
from trident_fleet.core.choreography_file import read_choreography
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.follow import follow_settings
from trident_fleet.core.follow.follow_config import FollowConfig
from trident_fleet.core.follow.follow_settings import read_follow_settings
from trident_fleet.core.patterns import Pattern
from trident_fleet.core.settings import FleetSettings, read_settings

# One of them differs from any default, and is legal, for each field.
CANDIDATES = (0.2, 0.4, 0.05, 0.7, 3, 90.0, True, False, "gate", "world", "3xNxT", "line")


def _leaves(config: Any, path: str = "") -> dict[str, Any]:
    """All values of a dataclass and those in it, by their path of fields."""
    found: dict[str, Any] = {}
    for item in dataclasses.fields(config):
        value, here = getattr(config, item.name), f"{path}{item.name}"
        if dataclasses.is_dataclass(value):
            found |= _leaves(value, here + ".")
        else:
            found[here] = value.tolist() if isinstance(value, np.ndarray) else value
    return found


def _settable(read: Callable[[Any], Any], given: dict[str, Any]) -> set[str]:
    """Paths of the fields that some parameter changes."""
    base, known = Recorded(given.get), _leaves(read(given.get))
    read(base)
    changed: set[str] = set()
    for name in base.asked:
        for value in CANDIDATES:
            try:
                leaves = _leaves(read((given | {name: value}).get))
            except FormationError:
                continue
            changed |= {path for path in known if leaves[path] != known[path]}
    return changed


def test_a_formation_node_has_the_defaults_of_its_dataclass() -> None:
    settings = read_settings({}.get, "own.txt")
    assert settings == FleetSettings(FormationSource("own.txt"))


def test_every_field_of_a_formation_node_can_be_set() -> None:
    settable = _settable(lambda get: read_settings(get, "own.txt"), {})
    assert set(_leaves(FleetSettings(FormationSource("own.txt")))) == settable


def test_a_leader_follower_node_has_the_defaults_of_its_dataclasses() -> None:
    settings = read_follow_settings({"followers": "a b"}.get)
    default = FollowConfig(settings.config.offsets)
    assert _leaves(settings.config) == _leaves(default)
    fleet = FleetSettings(FormationSource(), plan=default.plan, feed=default.feed)
    assert settings.fleet == fleet


def test_every_field_of_a_leader_follower_node_can_be_set_but_for_those_it_has_no_use_for() -> None:
    given = {"followers": "a b"}
    settings = read_follow_settings(given.get)
    unused = {path for path in follow_settings._LEFT if path != "offsets"}
    fields = {f"config.{path}" for path in set(_leaves(settings.config)) - unused}
    fields |= {"fleet.lookahead", "fleet.guard", "fleet.enroll_wait_s", "fleet.connect_wait_s"}
    assert fields | {"leader_timeout_s"} <= _settable(read_follow_settings, given)


def _choreography(folder: Path, text: str) -> Choreography:
    file = folder / "steps.yaml"
    file.write_text(text, encoding="utf-8")
    return read_choreography(file)


@pytest.mark.parametrize("kind", ["line", "wedge", "circle", "grid"])
def test_a_choreography_has_the_defaults_of_its_dataclasses(tmp_path: Path, kind: str) -> None:
    steps = "steps:\n  - {reconfigure: {pattern: line}}\n  - {rotate_deg: 0}\n"
    read = _choreography(tmp_path, f"begin: {{pattern: {kind}}}\n{steps}")
    places = [step.where for step in read.steps]
    expected = (Step(Pattern("line"), where=places[0]), Step(where=places[1]))
    assert read == Choreography(6, Pattern(kind), expected)


def test_every_field_of_a_choreography_can_be_set(tmp_path: Path) -> None:
    steps = "[{translate_m: [1, 2, 3], rotate_deg: 4, rescale: 0.5}]"
    read = _choreography(
        tmp_path,
        "vehicles: 3\nmin_separation_m: 0.5\nrow_spacing_m: 0.2\n"
        "begin: {pattern: wedge, spacing_m: 2,"
        f" opening_deg: 60, position_m: [1, 1, 2], heading_deg: 9}}\nsteps: {steps}\n",
    )
    default = Choreography(6, Pattern("line"))
    for name, value in _leaves(read).items():
        assert name in ("begin.radius_m", "begin.columns") or value != _leaves(default)[name], name
    step, base = read.steps[0], Step()
    assert all(getattr(step, name) != getattr(base, name) for name in ("translate_m", "rotate_deg"))
    assert step.rescale == 0.5
    circle = (
        "begin: {pattern: circle, radius_m: 3}\nsteps: [{reconfigure: {pattern: grid, columns: 2}}]"
    )
    shaped = _choreography(tmp_path, circle)
    assert shaped.begin.radius_m == 3.0
    assert shaped.steps[0].pattern == Pattern("grid", columns=2)


def test_an_unknown_key_is_reported_with_file_line_and_the_nearest_one(tmp_path: Path) -> None:
    text = "begin:\n  pattern: line\n  spacing: 2\nsteps: []\n"
    with pytest.raises(FormationError, match=r"steps.yaml:3: spacing: unknown key; did you mean"):
        _choreography(tmp_path, text)
