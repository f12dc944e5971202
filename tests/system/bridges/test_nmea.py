# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A USV that talks NMEA 0183 to a client, as its users start it."""

from __future__ import annotations

from trident_base.ports import free_port
from trident_runs import Trident

RTK_FIXED_FROM_S = 30.0
END_S = 36.0
GGA_HZ = 5.0


def test_a_usvs_positions_reach_a_client_within_a_decimeter(trident: Trident) -> None:
    run = trident("run", "nmea.launch", f"port:={free_port()}", f"duration:={END_S}")
    assert run.folder is not None, run.output
    (numbers,) = run.verdict["nmea"]
    assert numbers["satisfied"], run.verdict
    assert numbers["vehicle"] == "usv1"
    assert numbers["positions"] >= GGA_HZ * END_S - 1
    # The newest ones may be later than the last state that was kept.
    assert numbers["rtk_fixed"] >= GGA_HZ * (END_S - RTK_FIXED_FROM_S) - 5
    assert {"GGA", "RMC", "ZDA", "HDT", "APB", "RTE", "WPL", "VDO"} <= set(numbers["types"])
    assert (run.folder / "nmea_usv1.png").exists()
