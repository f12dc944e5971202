# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""MAVSDK, unchanged, flies a simulated iris that speaks as PX4 does."""

from __future__ import annotations

import math
import subprocess
from collections.abc import Callable
from pathlib import Path

from trident.testing import Launch, output_of
from trident.testing.clients import clients_python
from trident.testing.mavlink_vehicles import write_fleet

SCRIPT = Path(__file__).parent / "fly_by_mavsdk.py"
#: MAVSDK lives by the wall's clock: a simulated second is 50 ms of it.
FACTOR = 20


def test_mavsdk_flies_a_mission_and_set_points(
    launch: Callable[..., Launch], tmp_path: Path
) -> None:
    python = clients_python("mavsdk")
    fleet = write_fleet(tmp_path, uav1="px4")
    words = ("trident_bringup", "mavlink_fleet.launch")
    run = launch(*words, vehicles=str(fleet.path), real_time_factor=FACTOR)
    run.ready()
    start = run.position("uav1")
    url = f"udpin://127.0.0.1:{fleet.port('uav1', 'offboard_remote')}"
    client = subprocess.Popen(
        [str(python), str(SCRIPT), url],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    output = output_of(client)
    assert client.returncode == 0, output + run.log[-2000:]
    assert math.dist(start, run.position("uav1")) < 0.5, output
