# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import pytest
from trident_benchmarks.__main__ import main
from trident_benchmarks.bridges.all_rows import ROWS
from trident_benchmarks.bridges.measure import chosen_rows, line, measure_row
from trident_benchmarks.bridges.rows import BridgeRow, Node
from trident_benchmarks.processes import Processes
from trident_benchmarks.results import UNUSABLE
from trident_eval.core.errors import EvalError


def test_bytes_cross_two_bridges_and_none_is_lost() -> None:
    (row,) = chosen_rows("bytes over UDP")
    with Processes() as processes:
        _, master = processes.start_master()
        result = measure_row(row, processes, master, share=0.005)
    assert result["lost"] == 0
    assert 0.0 < result["median_ms"] <= result["p99_ms"] <= result["max_ms"]
    assert result["mbit_s"] == pytest.approx(8e-6 * 280 * result["messages_s"])
    assert line(result).startswith("bytes over UDP: ")
    assert "; 0 lost;" in line(result)


def test_a_bridge_that_passes_nothing_on_is_an_error() -> None:
    row = BridgeRow("deaf", "udp", "bytes", 8, lambda: [Node("deaf", ["sleep", "60"])])
    with Processes() as processes:
        _, master = processes.start_master()
        with pytest.raises(EvalError, match="source has ended with exit code 1"):
            measure_row(row, processes, master, share=0.001)


def test_names_of_rows_are_unique_and_an_unknown_one_is_refused() -> None:
    assert len({row.name for row in ROWS}) == len(ROWS)
    with pytest.raises(EvalError, match="did you mean 'roscpp relays'"):
        chosen_rows("roscpp relay")


def test_a_missing_folder_is_refused_before_anything_is_measured(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bridges", "--out", str(tmp_path / "no" / "rows.json")]) == UNUSABLE
    assert "its folder does not exist" in capsys.readouterr().err
