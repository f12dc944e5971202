# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suites people and pains: their rows, one crossing, a few scenes."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import pytest
from trident_eval.core.errors import EvalError

pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

from trident_benchmarks.nav import people
from trident_benchmarks.nav.pains_suite.drives import silence
from trident_benchmarks.nav.pains_suite.instructions import wide_functions
from trident_benchmarks.nav.pains_suite.rows import pain, table
from trident_benchmarks.nav.pains_suite.stack import commands
from trident_benchmarks.nav.pains_suite.steady_rate import missed_periods, unnamed
from trident_benchmarks.nav.pictures.people import draw_crossing
from trident_benchmarks.nav.programs import rows_of
from trident_benchmarks.nav.scene_runs import run_documents, shares
from trident_benchmarks.nav.trials import JACKAL, default_parameters
from trident_eval.ros_paths import program


def crossing(**changes: Any) -> dict[str, Any]:
    """A crossing as the program prints it."""
    run = {"seed": 1, "has_arrived": True, "time_s": 10.0, "text": "Goal reached.", "touches": []}
    return run | {"wall": "", "recoveries": 0, "navigation_cpu_s": 1.0} | changes


def test_seeds_are_dealt_out_and_nobody_gets_none() -> None:
    assert shares([1, 2, 3, 4, 5], 2) == [[1, 3, 5], [2, 4]]
    assert shares([1], 4) == [[1]]


def test_a_robot_that_pushes_or_does_not_arrive_fails_the_row() -> None:
    touch = {"time_s": 3.0, "walker": 2, "own_speed_m_s": 0.3, "last_s": 3.1}
    touch |= {"is_pushed": False}
    still = touch | {"own_speed_m_s": -0.4}
    row = people.row_of("x", [crossing(), crossing(seed=2, touches=[still])])
    assert row["passed"]
    assert (row["touches"], row["fastest_own_m_s"], row["arrived"]) == (1, -0.4, 1.0)
    pushed = people.row_of("x", [crossing(), crossing(seed=2, touches=[touch, still])])
    assert not pushed["passed"]
    assert pushed["touches_beyond_limit"] == 1
    others = people.row_of("x", [crossing(touches=[touch | {"is_pushed": True}])])
    assert others["passed"]
    assert (others["touches"], others["touches_while_pushed"]) == (1, 1)
    lost = people.row_of("x", [crossing(), crossing(seed=2, has_arrived=False, text="no path")])
    assert not lost["passed"]
    assert lost["failures"] == ["seed 2: no path"]
    assert "| x | 0.500 | 0 |" in people.table([lost])


def test_a_crossing_arrives_repeats_and_is_drawn(tmp_path: Path) -> None:
    first, second = (
        people.crossings(tmp_path, [1], default_parameters(JACKAL), 1, frames=True)[0]
        for _ in range(2)
    )
    assert first["has_arrived"], first["text"]
    assert not first["wall"]
    assert first["frames"] == second["frames"]
    assert max(len(frame["tracks"]) for frame in first["frames"]) >= 3
    for name in ("crossing.png", "crossing.gif"):
        draw_crossing(tmp_path / name, first | {"frames": first["frames"][:12]})
        assert (tmp_path / name).stat().st_size > 5000


def test_a_silent_lidar_stops_the_robot_within_its_limit() -> None:
    rows = silence([], 1)
    assert [row["passed"] for row in rows] == [True, True, True], rows
    assert rows[0]["measured"] > 0.3


@pytest.mark.parametrize("scene", ["obstacles", "reasons"])
def test_scenes_without_a_simulator_pass(scene: str) -> None:
    rows = rows_of("nav_pain_scenes", ["--quick", scene])
    assert rows
    assert [row for row in rows if not row["passed"]] == []


def test_an_unknown_scene_and_a_bad_file_are_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(EvalError, match=r"legal: --quick, bands, obstacles"):
        rows_of("nav_pain_scenes", ["moon"])
    with pytest.raises(EvalError, match="trial"):
        run_documents("trident_benchmarks", "nav_people", [{"trials": 1}], 1)
    bad = subprocess.run(
        [program("trident_benchmarks", "nav_drive_pains"), "moon"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert bad.returncode == 2
    assert "silence|near_goals" in bad.stderr


def test_avx_is_found_where_nothing_chose_it() -> None:
    listing = """
0000000000001000 <plain>:
    1000:	addps  %xmm1,%xmm0
    1003:	verr   %ax
0000000000002000 <_ZN3foo8run_avx2Ev>:
    2000:	vaddps %ymm1,%ymm0,%ymm0
0000000000003000 <careless>:
    3000:	vaddss %xmm1,%xmm0,%xmm0
    3004:	vaddss %xmm1,%xmm0,%xmm0
"""
    assert list(wide_functions(listing.splitlines())) == ["careless"]


def test_missed_periods_are_counted_and_a_line_without_a_step_is_none() -> None:
    named = (
        "[ WARN] [1.0]: The control loop missed 3 of its periods of 0.050 s; the longest was"
        " 0.071 s. The search for a command took longest in it, 0.060 s."
    )
    count, lines = missed_periods(f"noise\n{named}\nnoise\n{named}\n")
    assert count == 6
    assert unnamed(lines) == 0
    assert unnamed(["The control loop missed 1 of its periods of 0.050 s"]) == 1


def test_rows_say_whether_they_pass_and_the_table_is_in_the_order_of_scenes() -> None:
    rows = [
        pain("P12", "a#1", "functions", 0.0, 0.0, "functions"),
        pain("P2", "b#2", "share", 0.9, 0.95, "1", is_least=True),
    ]
    assert [row["passed"] for row in rows] == [True, False]
    lines = table(rows).splitlines()
    assert lines[2] == "| P2 | b#2 | share | 0.9 | >= 0.95 | NO |"
    assert lines[3].endswith("| 0 functions | <= 0 functions | yes |")


def test_each_part_of_the_stack_is_started_on_its_own(tmp_path: Path) -> None:
    parts = commands(tmp_path, tmp_path / "m.yaml", "room", (1.0, 2.0, 0.0), ("1,0,0",), 2.0)
    assert set(parts) == {"world", "robot", "localization", "move_base", "client"}
    text = (tmp_path / "move_base.launch").read_text()
    assert text.count("rosparam") >= 3
    for word in text.split('file="')[1:]:
        assert Path(word.split('"')[0]).is_file()
