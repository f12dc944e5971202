# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from conftest import REPO
from hypothesis import given, settings
from hypothesis import strategies as st
from trident_fleet.cli import make_formation
from trident_fleet.core.choreography import Choreography, Step, perform
from trident_fleet.core.choreography_file import parse_words, read_choreography
from trident_fleet.core.config import PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource, read_formation
from trident_fleet.core.files.position_file import reading_args, write_positions
from trident_fleet.core.patterns import KINDS, Pattern, places
from trident_fleet.core.plan import plan_formation
from trident_fleet.core.quintic import Array
from trident_fleet.core.separation import min_separation

CONFIGS = sorted((REPO / "config" / "formations").glob("*.yaml"))
GOOD = """\
vehicles: 4
begin: {pattern: line, spacing_m: 2.0}
steps:
  - rotate_deg: 90
  - reconfigure: {pattern: grid}
"""


def shape_of(row: Array) -> Array:
    """Distances of all pairs, which no rigid motion changes."""
    return np.linalg.norm(row[:, None] - row[None], axis=-1)


def longest_step(rows: Array) -> float:
    return float(np.linalg.norm(np.diff(rows, axis=0), axis=-1).max())


def test_a_rigid_step_moves_and_turns_and_keeps_the_shape() -> None:
    step = Step(translate_m=(3.0, 1.0, 0.5), rotate_deg=90.0)
    rows = perform(Choreography(4, Pattern("line", 2.0), (step,))).rows
    for row in rows:
        np.testing.assert_allclose(shape_of(row), shape_of(rows[0]), atol=1e-9)
    np.testing.assert_allclose(rows[-1].mean(axis=0), [3.0, 1.0, 1.7], atol=1e-9)
    # From a line along y to one along -x.
    np.testing.assert_allclose(rows[-1, 0] - rows[-1, 3], [-6.0, 0.0, 0.0], atol=1e-9)
    assert longest_step(rows) <= 0.15


def test_a_rescaled_formation_grows_around_its_center() -> None:
    rows = perform(Choreography(5, Pattern("wedge", 2.0), (Step(rescale=1.5),))).rows
    np.testing.assert_allclose(rows[-1].mean(axis=0), rows[0].mean(axis=0), atol=1e-9)
    np.testing.assert_allclose(shape_of(rows[-1]), 1.5 * shape_of(rows[0]), atol=1e-9)


def test_a_new_pattern_is_where_the_formation_is_and_as_it_heads() -> None:
    steps = (Step(translate_m=(5.0, 0.0, 0.0), rotate_deg=90.0), Step(pattern=Pattern("grid", 2.0)))
    performance = perform(Choreography(6, Pattern("line", 2.0), steps))
    grid = places(Pattern("grid", 2.0), 6)
    turned = np.stack([5.0 - grid[:, 1], grid[:, 0], np.full(6, 1.2)], axis=1)
    transition = performance.steps[1].transition
    assert transition is not None
    np.testing.assert_allclose(performance.rows[-1], turned[list(transition.place)], atol=1e-9)
    first, last = performance.steps[1].rows
    assert performance.steps[0].rows == (0, first)
    assert last == len(performance.rows) - 1
    # The shape that was assigned is the one that is turned next.
    more = perform(Choreography(6, Pattern("line", 2.0), (*steps, Step(rotate_deg=30.0)))).rows
    np.testing.assert_allclose(shape_of(more[-1]), shape_of(more[last]), atol=1e-9)


# An example plans a flight, which takes a second.
@settings(max_examples=20)
@given(
    count=st.integers(1, 16),
    begin=st.sampled_from(KINDS),
    changes=st.lists(
        st.one_of(
            st.sampled_from(KINDS).map(lambda kind: Step(pattern=Pattern(kind, 1.5))),
            st.floats(-200.0, 200.0).map(lambda turn: Step(rotate_deg=turn)),
            st.floats(1.0, 2.0).map(lambda factor: Step(rescale=factor)),
            st.floats(-3.0, 3.0).map(lambda shift: Step(translate_m=(shift, -shift, 0.1))),
        ),
        max_size=4,
    ),
)
def test_every_choreography_keeps_its_separation_in_rows_and_in_flight(
    count: int, begin: str, changes: list[Step]
) -> None:
    choreography = Choreography(count, Pattern(begin, 1.5), tuple(changes), row_spacing_m=0.4)
    rows = perform(choreography).rows
    assert min_separation(rows) >= 1.0 - 1e-6
    assert longest_step(rows) <= 0.4 * 1.01 if len(rows) > 1 else True
    ground = rows[0].copy()
    ground[:, 2] = 0.1
    plan = plan_formation(rows, ground, PlanConfig())
    flown = plan.sample(np.arange(0.0, plan.duration, 0.05)).position
    assert min_separation(flown) >= 1.0 - 0.02


def test_waves_leave_the_others_where_they_are() -> None:
    step = Step(pattern=Pattern("circle", 1.2))
    performance = perform(Choreography(12, Pattern("line", 1.2), (step,)))
    transition = performance.steps[0].transition
    assert transition is not None
    assert len(transition.waves) > 1
    late = [vehicle for vehicle in range(12) if vehicle not in transition.waves[0]]
    early = list(transition.waves[0])
    is_early_there = (performance.rows[:, early] == transition.goal[early]).all(axis=(1, 2))
    is_late_there = (performance.rows[:, late] == transition.start[late]).all(axis=(1, 2))
    assert (is_early_there | is_late_there).all(), "one wave after the other"
    np.testing.assert_allclose(performance.rows[-1], transition.goal, atol=1e-12)


@pytest.mark.parametrize(
    ("choreography", "what"),
    [
        (Choreography(0, Pattern("line")), "vehicles: 0; legal: 1 to 500"),
        (Choreography(4, Pattern("line", 0.5)), "begin: vehicles 1 and 2 are 0.500 m apart"),
        (
            Choreography(4, Pattern("line"), (Step(rescale=0.5, where="step 1"),)),
            r"step 1: vehicles 1 and 2 would come within 0.750 m; legal: min_separation_m 1",
        ),
        (
            Choreography(4, Pattern("line"), (Step(pattern=Pattern("grid", 0.8), where="step 1"),)),
            r"step 1: after: places 1 and 2 are 0.800 m apart",
        ),
        (
            Choreography(4, Pattern("line"), (Step(pattern=Pattern("grid"), rescale=2.0),)),
            "rescale: 2.0 together with a new pattern",
        ),
        (Choreography(4, Pattern("line"), (Step(rotate_deg=float("inf")),)), "rotate_deg: inf"),
        (Choreography(4, Pattern("line"), min_separation_m=-1.0), "min_separation_m: -1.0"),
        (Choreography(4, Pattern("line"), row_spacing_m=0.0), "row_spacing_m: 0.0"),
        (Choreography(4, Pattern("line"), position_m=(0.0, float("nan"), 1.0)), "position_m"),
        (Choreography(4, Pattern("line"), heading_deg=float("nan")), "heading_deg: nan"),
    ],
)
def test_what_cannot_be_flown_is_refused(choreography: Choreography, what: str) -> None:
    with pytest.raises(FormationError, match=what):
        perform(choreography)


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("vehicles: 4", "vehicles: four", r"f\.yaml:1: vehicles: 'four'; legal: a whole number"),
        (
            "vehicles: 4",
            "vehicle: 4",
            r"f\.yaml:1: vehicle: unknown key; did you mean 'vehicles'",
        ),
        ("vehicles: 4", "vehicles: 0", r"f\.yaml: vehicles: 0; legal: 1 to 500"),
        ("vehicles: 4", "vehicles: 4\nvehicles: 5", r"f\.yaml:2: vehicles: given twice"),
        ("spacing_m: 2.0", "radius_m: 2.0", r"f\.yaml:2: radius_m: unknown key; legal: .*spacing"),
        ("spacing_m: 2.0", "spacing_m: -2", r"f\.yaml:2: spacing_m: -2.0; legal: over 0"),
        ("spacing_m: 2.0", "spacing_m: .nan", r"f\.yaml:2: spacing_m: nan; legal: a finite"),
        ("pattern: line", "pattern: star", r"f\.yaml:2: pattern: 'star'; legal: line, wedge"),
        ("rotate_deg: 90", "rotate_deg: no", r"f\.yaml:4: rotate_deg: False; legal: a number"),
        ("rotate_deg: 90", "rotate_deg: 9000", r"f\.yaml:4: rotate_deg: 9.*; legal: -3600 to 3600"),
        ("rotate_deg: 90", "translate_m: [1, 2]", r"f\.yaml:4: translate_m: \[1, 2\]; legal: thr"),
        ("rotate_deg: 90", "{}", r"f\.yaml:4: an empty step; legal: reconfigure, translate_m"),
        ("  - rotate_deg: 90", "  - rotate", r"f\.yaml:4: no mapping"),
        ("begin:", "start:", r"f\.yaml:1: no begin"),
        (GOOD, "", r"f\.yaml: empty"),
        ("begin: {", "begin: {{", r"f\.yaml:\d: .*; legal: YAML"),
    ],
)
def test_bad_files_are_refused_with_file_and_line(
    tmp_path: Path, old: str, new: str, what: str
) -> None:
    path = tmp_path / "f.yaml"
    path.write_text(GOOD)
    assert len(read_choreography(path).steps) == 2
    assert old in GOOD
    path.write_text(GOOD.replace(old, new, 1))
    with pytest.raises(FormationError, match=what):
        read_choreography(path)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(FormationError, match=r"none\.yaml: No such file"):
        read_choreography(tmp_path / "none.yaml")


def test_words_are_the_short_form() -> None:
    words = ["line", "circle", "rotate:-45", "translate:1,2,0.5", "rescale:1.5"]
    choreography = parse_words(words, 8, 2.0)
    assert choreography.begin == Pattern("line", 2.0)
    circle, turn, shift, growth = choreography.steps
    assert circle.pattern == Pattern("circle", 2.0)
    assert (turn.rotate_deg, shift.translate_m, growth.rescale) == (-45.0, (1.0, 2.0, 0.5), 1.5)


@pytest.mark.parametrize(
    "words", [[], ["rotate:90"], ["line", "star"], ["line", "rotate:x"], ["line", "translate:1,2"]]
)
def test_other_words_are_refused(words: list[str]) -> None:
    with pytest.raises(FormationError, match="legal: line, wedge, circle, grid"):
        parse_words(words, 4, 1.5)


@pytest.mark.parametrize("count", [1, 2, 3, 5, 6, 7, 40])
@pytest.mark.parametrize("suffix", ["txt", "mat"])
def test_written_files_are_read_back(tmp_path: Path, count: int, suffix: str) -> None:
    rows = perform(parse_words(["grid", "circle"], count, 1.5)).rows
    path = tmp_path / f"f.{suffix}"
    write_positions(path, rows, ["a comment"])
    args = reading_args(path, rows)
    read = read_formation(
        FormationSource(
            str(path),
            vehicles_in_file=int(args.get("vehicles_in_file", 0)),
            uavs=count,
            layout=args.get("layout", ""),
        )
    )
    np.testing.assert_allclose(read, rows, atol=0.0 if suffix == "mat" else 5e-7)
    again = path.read_bytes()
    write_positions(path, rows, ["a comment"])
    assert path.read_bytes() == again


@pytest.mark.parametrize("config", CONFIGS, ids=lambda path: path.stem)
def test_a_shipped_file_is_what_its_config_makes(tmp_path: Path, config: Path) -> None:
    made = tmp_path / "made.txt"
    assert make_formation.main([str(config), "--out", str(made)]) == 0
    assert made.read_bytes() == config.with_suffix(".txt").read_bytes()


def test_the_command_line_says_what_was_made_and_how_to_fly_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "ring.txt"
    words = ["line", "circle", "--uavs", "12", "--spacing", "1.2"]
    code = make_formation.main([*words, "--out", str(out)])
    text = capsys.readouterr().out
    assert code == 0
    assert "12 vehicles" in text
    assert "waves: all at once they would come too close" in text
    assert f"./trident formation-launch --uavs 12 --formation {out}" in text
    assert "made by: ./trident formation line circle" in out.read_text()


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["line", "rescale:0.1"], "step 2 (rescale:0.1): vehicles 1 and 2 would come within 0.15"),
        (["none.yaml"], "none.yaml: No such file"),
        (["none.yaml", "line"], "'line' after none.yaml"),
        (["line", "--out", "/nowhere/f.txt"], "/nowhere/f.txt: No such file or directory; legal"),
        (["line", "--min-separation", "nan"], "min_separation_m: nan"),
    ],
)
def test_the_command_line_refuses_in_one_line(
    capsys: pytest.CaptureFixture[str], words: list[str], what: str
) -> None:
    assert make_formation.main(words) == 1
    error = capsys.readouterr().err
    assert what in error
    assert error.startswith("formation: ")
    assert error.count("\n") == 1
