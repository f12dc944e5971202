# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the benchmark sweeps: runs that cost a known time."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def wait(parameters: Mapping[str, Any], seed: int, _folder: Path) -> dict[str, float]:
    """Last for `sleep_s`, and give a number that parameters and seed make."""
    time.sleep(parameters["sleep_s"])
    return {"score": parameters["gain"] + 0.01 * seed}
