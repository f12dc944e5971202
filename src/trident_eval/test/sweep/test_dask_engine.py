# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sweeps on Dask: the same table, whatever carries the runs out."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_sweep_command import sweep, table, write_scenario
from trident_eval.core.errors import EvalError
from trident_eval.sweep import dask_engine
from trident_eval.sweep.code_version import unlike


def test_dask_gives_the_same_table_as_this_machine_alone(tmp_path: Path) -> None:
    tables = []
    for engine in ("local", "dask"):
        folder = tmp_path / engine
        folder.mkdir()
        scenario = write_scenario(folder)
        sweep(scenario, "--engine", engine)
        tables.append(table(folder / "study_sweep"))
    assert tables[0] == tables[1]
    assert len(tables[0]) == 24


def test_no_scheduler_is_one_message(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dask_engine, "_CONNECT_S", 1)
    with pytest.raises(EvalError, match=r"tcp://127\.0\.0\.1:9: .*legal: a running scheduler"):
        dask_engine.DaskEngine(tmp_path, "subjects:score", 1, "tcp://127.0.0.1:9")


def test_unlike_workers_are_named_by_what_differs() -> None:
    ours = {"code": "a", "numpy": "1.24.2"}
    assert unlike(ours, dict(ours)) == ""
    assert unlike(ours, {"code": "b", "numpy": "1.24.2"}) == "code: b instead of a"
    assert unlike(ours, {"code": "a"}) == "numpy: none instead of 1.24.2"


def test_a_cluster_that_is_slow_to_end_does_not_fail_a_sweep() -> None:
    waited = []

    class Slow:
        def close(self, timeout: float) -> None:
            waited.append(timeout)
            raise TimeoutError(f"timed out after {timeout} s.")

    dask_engine.end_in_time(Slow())
    assert len(waited) == 1
