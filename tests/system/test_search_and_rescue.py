# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A team searches a coast in the simulator; the same run comes out the same, and is judged."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from harness import REPO
from trident.testing import Launch
from trident_eval.__main__ import main as evaluate
from trident_fleet.core.missions.kinds import read_mission
from trident_fleet.core.missions.mission import Mission
from trident_fleet.core.missions.record import Flown, read_flown
from trident_fleet.core.missions.scene import read_scene
from trident_fleet.core.missions.setup import RECORD, Outcome, Setup
from trident_fleet.core.missions.tree_file import read_tree

END_S = 30.0
COAST = {"length": 300.0, "covers": 4, "casualties": 5}
MISSIONS = REPO / "config" / "missions"


def flown(launch: Callable[..., Launch], **args: object) -> tuple[Launch, Flown]:
    """A run to its end, and its record."""
    words = ("trident_bringup", "search_and_rescue.launch")
    run = launch(*words, duration=END_S, seed=2, **COAST, **args)
    assert run.process.wait() == 0, run.log
    assert run.died() == []
    assert run.out_dir is not None
    return run, read_flown(run.out_dir / RECORD)


def in_process(scene_file: Path) -> Outcome:
    """The same mission with models of vehicles."""
    config = read_mission(MISSIONS / "search_and_rescue.yaml")
    config = replace(config, rules=replace(config.rules, until_s=END_S))
    tree = read_tree(MISSIONS / "search_and_rescue_tree.yaml")
    return Mission(read_scene(scene_file), config, tree, Setup(seed=2)).run()


def test_a_team_searches_a_coast_twice_alike_and_nearly_as_models_do(
    launch: Callable[..., Launch],
) -> None:
    run, first = flown(launch)
    results = run.results()
    assert results["repeatable"], results["not_repeatable"]
    assert results["end_reason"] == "finished"
    assert first.outcome.end_s == END_S
    model = in_process(first.scene_file)
    # It has to climb first, and to brake at corners.
    assert 0.6 * model.coverage < first.outcome.coverage <= model.coverage + 0.01
    assert first.outcome.messages > 100, "its robots auction the pieces of the coast"
    assert {work.kind for work in first.record.work} >= {"search"}
    for name, least_m in (("uav1", 90.0), ("ugv1", 20.0), ("usv1", 20.0)):
        assert first.outcome.path_m[name] > least_m, name

    again, second = flown(launch)
    assert again.results()["state_hash"] == results["state_hash"]
    assert second.outcome == first.outcome

    assert run.out_dir is not None
    assert evaluate(["verdict", str(run.out_dir)]) == 0
    verdict = json.loads((run.out_dir / "verdict.json").read_text(encoding="utf-8"))
    assert verdict["mode"] == "search and rescue"
    assert verdict["links"] == "network"
    assert len([text for text in verdict["lost"] if "casualty" in text]) == 5 - verdict["served"]
    for name in ("search_map.png", "search_times.png"):
        assert (run.out_dir / name).stat().st_size > 10_000


def test_a_robot_on_wheels_alone_ends_its_run_itself(launch: Callable[..., Launch]) -> None:
    run, record = flown(launch, mode="ugv", kill="ugv1@20")
    assert run.results()["repeatable"], run.results()["not_repeatable"]
    assert run.results()["sim_s"] >= END_S
    assert record.outcome.lost[0] == "ugv1: killed at 20 s"
