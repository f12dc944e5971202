# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Three vehicles that speak MAVLink: a client leads them through errands; alone, runs repeat."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import yaml
from trident.testing import Launch
from trident.testing.mavlink_vehicles import KINDS, write_fleet
from trident_runs import Trident

ERRANDS = [
    {"vehicle": "uav1", "system": 1, "kind": "uav", "radius": 2.0, "take_off": 3.0, "end": "land",
     "places": [[6, -8, 5], [0, -12, 4]]},
    {"vehicle": "ugv1", "system": 2, "kind": "ugv", "radius": 2.0, "end": "hold",
     "places": [[6, 0, 0], [12, 0, 0]]},
    {"vehicle": "usv1", "system": 3, "kind": "usv", "radius": 4.0, "end": "hold",
     "places": [[12, 0, 0]]},
]  # fmt: skip


def test_a_client_leads_all_three_through_their_errands(trident: Trident, tmp_path: Path) -> None:
    fleet = write_fleet(tmp_path, uav1="px4")
    errands = tmp_path / "errands.yaml"
    errands.write_text(yaml.safe_dump({"errands": ERRANDS}), encoding="utf-8")
    words = (
        f"vehicles:={fleet.path}",
        f"port:={fleet.router}",
        f"errands:={errands}",
        "demo:=true",
    )
    outcome = trident("run", "mavlink_fleet.launch", *words, "real_time_factor:=0")
    verdict = outcome.passed
    assert verdict["mode"] == "mavlink"
    for name, errand in zip(KINDS, ERRANDS, strict=True):
        row = verdict["commanded"][name]
        assert row["armed"]
        assert row["items_passed"] == row["items_reported"] == len(errand["places"])
        assert row["refusals"] == 0
    assert verdict["commanded"]["uav1"]["end"] == "landed"
    assert not verdict["repeatable"]
    whys = [note["why"] for note in verdict["not_repeatable"]]
    assert all(any(f"commands {name}" in why for why in whys) for name in KINDS), whys
    assert outcome.folder is not None
    assert (outcome.folder / "missions.png").is_file()


def test_runs_that_nobody_commands_are_equal(launch: Callable[..., Launch], tmp_path: Path) -> None:
    hashes = set()
    for _ in range(2):
        fleet = write_fleet(tmp_path, uav1="px4")
        words = ("trident_bringup", "mavlink_fleet.launch")
        # In real time the world does not wait for a connection that breaks and comes back.
        args = {"vehicles": str(fleet.path), "duration": 3.0, "real_time_factor": 0}
        run = launch(*words, env={"TRIDENT_END": "1"}, **args)
        assert run.process.wait() == 0, run.log
        assert run.results()["repeatable"], run.results().get("not_repeatable")
        hashes.add(run.results()["state_hash"])
    assert len(hashes) == 1
