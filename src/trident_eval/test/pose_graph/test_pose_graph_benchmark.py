# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import os
from pathlib import Path
from typing import Any

import pytest
from trident_eval.pose_graph import bench
from trident_eval.pose_graph.program import optimize


def _row(chi2: float, **gtsam: tuple[float, float]) -> dict[str, Any]:
    entries = {name: {"chi2": c, "cpu_s": s} for name, (c, s) in gtsam.items()}
    return {"best_known": 100.0, "ours": {"chi2": chi2, "cpu_s": 0.1}, "gtsam": entries}


def test_only_rows_that_reach_the_best_chi2_are_compared() -> None:
    told = bench.judgement(_row(100.05, gn=(500.0, 0.01), lm=(100.0, 0.4), chordal=(100.0, 0.3)))
    assert told["is_chi2_best"]
    assert told["gtsam_best"] == "chordal"
    assert told["speed_up"] == pytest.approx(3.0)


def test_chi2_above_the_tolerance_is_not_the_best() -> None:
    assert not bench.judgement(_row(100.2))["is_chi2_best"]
    assert not bench.judgement(_row(100.05, gn=(99.0, 1.0)))["is_chi2_best"]


def test_contestant_that_fails_is_told(tmp_path: Path) -> None:
    assert "error" in bench.run_gtsam("/bin/false", tmp_path / "a.g2o", "gn")
    row = _row(100.0) | {"gtsam": {"gn": {"error": "diverges"}}}
    row |= bench.judgement(row) | {"name": "a", "vertices": 1, "edges": 1}
    assert "| fails | not installed |" in bench.table([row])


@pytest.mark.parametrize("name", ["intel", "M3500", "parking-garage", "sphere2500", "torus3D"])
def test_public_graphs_reach_the_best_known_chi2(name: str) -> None:
    data = os.environ.get("TRIDENT_DATA")
    if not data:
        pytest.skip("TRIDENT_DATA is not set")
    report = optimize(Path(data) / "pose_graph" / f"{name}.g2o.gz", [])
    assert report["converged"]
    assert report["chi2_after"] == pytest.approx(bench.BEST_KNOWN[name], rel=bench.TOLERANCE)
