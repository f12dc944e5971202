# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from trident_eval.core.sweep.scenario import Scenario, read_scenario

SMALL = """
function: model:run
parameters: {sleep_s: 0.0}
axes:
  gain: {range: [0, 1, 3]}
  mode: {list: [joint, alone]}
seeds: 4
limits: {time_s: 20}
metrics:
  score: {unit: m, better: higher}
"""


@pytest.fixture
def scenario_file(tmp_path: Path) -> Callable[[str], Path]:
    """Writes a scenario file."""

    def write(text: str = SMALL) -> Path:
        path = tmp_path / "study.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def scenario(scenario_file: Callable[[str], Path]) -> Scenario:
    """Three gains in two modes, four seeds each."""
    return read_scenario(scenario_file(SMALL))
