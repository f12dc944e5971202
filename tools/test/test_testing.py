# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tests for testing: what is built for the tests that are asked for."""

from __future__ import annotations

import pytest
from trident_tool.testing import targets_of_tests

GTEST = "_ctest_trident_slam_gtest_trident_slam_logs_test"


@pytest.mark.parametrize(
    ("names", "targets"),
    [
        ([GTEST], ["trident_slam_logs_test"]),
        ([GTEST, "lint_ruff"], ["trident_slam_logs_test"]),
        (["lint_rooms"], []),
        (["lint_rooms", "lint_reference"], ["plugin_reference"]),
        ([GTEST, "system_launch"], ["all", "tests"]),
        ([], []),
    ],
)
def test_a_gtest_needs_its_program_and_what_starts_nodes_needs_all(
    names: list[str], targets: list[str]
) -> None:
    assert targets_of_tests(names) == targets
