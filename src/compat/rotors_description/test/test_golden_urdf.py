# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The firefly is the one that the recorded reference flights were flown with."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from urdf_model import PACKAGE, expand, model

DATA = Path(os.environ.get("TRIDENT_DATA", PACKAGE.parents[2].parent / "shared" / "data"))
GOLDEN = DATA.parent / "golden" / "params" / "firefly.urdf"

pytestmark = pytest.mark.skipif(
    not GOLDEN.is_file(), reason=f"reference data is absent: {GOLDEN} (set TRIDENT_DATA)"
)


@pytest.fixture(scope="module")
def reference() -> dict[str, dict[str, Any]]:
    return model(GOLDEN.read_text())


@pytest.fixture(scope="module")
def ours() -> dict[str, dict[str, Any]]:
    return model(
        expand(
            "mav_generic_odometry_sensor.gazebo",
            mav_name="firefly",
            namespace="firefly",
            enable_logging="false",
            enable_ground_truth="true",
            enable_mavlink_interface="false",
            log_file="firefly",
            wait_to_record_bag="false",
        )
    )


@pytest.mark.parametrize("section", ["links", "joints", "plugins", "references"])
def test_expanded_firefly_equals_the_reference(
    section: str, ours: dict[str, dict[str, Any]], reference: dict[str, dict[str, Any]]
) -> None:
    assert len(reference[section]) >= 6
    assert set(ours[section]) == set(reference[section])
    for name, expected in reference[section].items():
        assert ours[section][name] == expected, name
