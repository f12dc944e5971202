# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from trident_tool.workspace import Workspace


@pytest.fixture
def clone(tmp_path: Path) -> Workspace:
    """An empty clone with the folders that the tools look at."""
    for folder in ("src", "launch", "tools", "build", "config/rviz"):
        (tmp_path / folder).mkdir(parents=True)
    return Workspace(tmp_path)
