# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The suites of grid maps and of CPU times, with a map of their own."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import pytest
from trident_benchmarks.nav import movingai, speed
from trident_eval.core.errors import EvalError

WALL = ["....@...", "....@...", "....@...", "........"]  # open at one end


def write_map(folder: Path, length: float) -> None:
    header = f"type octile\nheight {len(WALL)}\nwidth {len(WALL[0])}\nmap\n"
    (folder / "wall.map").write_text(header + "\n".join(WALL) + "\n")
    query = ["0", "wall.map", str(len(WALL[0])), str(len(WALL)), "3", "0", "5", "0", str(length)]
    (folder / "wall.map.scen").write_text("version 1\n" + "\t".join(query) + "\n")


def options(folder: Path) -> argparse.Namespace:
    return argparse.Namespace(worlds=folder, quick=False)


def test_lengths_of_a_map_are_those_of_its_scenarios(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_map(tmp_path, 8.0)  # three down, two along, three up: no corner is cut
    (row,) = movingai.measure(options(tmp_path))
    assert row["map"] == "wall"
    assert row["queries"] == 1
    assert row["failures"] == 0
    assert row["worst_length_error"] < movingai.MAX_LENGTH_ERROR
    assert f"| wall | {row['read_ms']:.2f} ms | 1 |" in capsys.readouterr().out


def test_a_wrong_length_is_reported(tmp_path: Path) -> None:
    write_map(tmp_path, 7.0)
    rows = movingai.measure(options(tmp_path))
    assert "wall: lengths differ" in movingai.summary(rows)


def test_without_maps_the_suite_is_skipped_loudly(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert movingai.measure(options(tmp_path)) == []
    assert "SKIPPED" in "".join(capsys.readouterr())


def test_a_damaged_map_is_named(tmp_path: Path) -> None:
    write_map(tmp_path, 8.0)
    (tmp_path / "wall.map").write_text("type octile\nheight 4\n")
    with pytest.raises(EvalError, match=r"wall\.map"):
        movingai.measure(options(tmp_path))


def test_rows_of_speed_have_their_rivals(monkeypatch: pytest.MonkeyPatch) -> None:
    printed: dict[str, Any] = {"name": "dwa 20x40"}
    printed |= {f"{key}_cpu_ms": 0.5 for key in ("median", "mean", "p99")}
    monkeypatch.setattr(speed, "rows_of", lambda _program, _words: [printed])
    (row,) = speed.cpu_rows("controller", "control_bench")
    assert row["rival"] == "dwa_local_planner"
    assert "8.4 ms (dwa_local_planner)" in speed.table([row])
