# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import settings
from runs import Run

settings.register_profile("trident", deadline=None, derandomize=True)
settings.load_profile("trident")


@pytest.fixture
def planned_run(tmp_path: Path) -> Run:
    """Three vehicles that follow a planned formation exactly, 4 cm too high."""
    return Run.planned(tmp_path / "planned")


@pytest.fixture
def gated_run(tmp_path: Path) -> Run:
    """Three vehicles that fly row by row with a lag, 4 cm too high."""
    return Run.gated(tmp_path / "gated")
