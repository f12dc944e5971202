# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings
from trident_fleet.core.quintic import Array

REPO = Path(__file__).resolve().parents[3]

# Wall time depends on the machine; examples must not, so that a failure can be had again.
settings.register_profile("trident", deadline=None, derandomize=True)
settings.load_profile("trident")


@pytest.fixture(scope="session")
def formation_data() -> Path:
    folder = Path(os.environ.get("TRIDENT_DATA", REPO.parent / "shared" / "data")) / "formation"
    if not folder.is_dir():
        pytest.skip(f"no recorded formation files in {folder}; set TRIDENT_DATA")
    return folder


@pytest.fixture(scope="session")
def own_formation() -> Path:
    return REPO / "config" / "formations" / "hexagon_translate_rotate.txt"


@pytest.fixture
def line_spawn() -> Array:
    """Six vehicles on the ground, 1.6 m apart along y."""
    return np.array([[0.0, 4.0 - 1.6 * index, 0.1] for index in range(6)])
