# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The program fusion_benchmark, which prints a line of JSON for each run of a filter."""

from __future__ import annotations

from typing import Any

from trident_benchmarks.programs import rows_of


def runs(suite: str, seeds: int) -> list[dict[str, Any]]:
    """What it prints about the first seeds; see `rows_of`."""
    return rows_of("trident_estimation", "fusion_benchmark", (suite, "0", str(seeds)))
