# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from trident_eval.core.sweep.jobs import Job, jobs_of
from trident_eval.core.sweep.scenario import Scenario, read_scenario
from trident_fleet.core.errors import FormationError

Write = Callable[[str], Path]
METRICS = "metrics: {score: {better: higher}}\n"


def test_jobs_are_all_points_of_a_seed_before_the_next_seed(scenario: Scenario) -> None:
    jobs = jobs_of(scenario, "code")
    assert len(jobs) == 3 * 2 * 4
    assert [job.seed for job in jobs[:7]] == [1] * 6 + [2]
    assert [job.point for job in jobs[:6]] == list(range(6))
    assert jobs[1].parameters == {"sleep_s": 0.0, "gain": 0.0, "mode": "alone"}
    assert len({job.key for job in jobs}) == len(jobs)


def test_a_key_changes_with_all_that_may_change_a_result(scenario: Scenario) -> None:
    first = jobs_of(scenario, "code")[0]
    assert jobs_of(scenario, "code")[0].key == first.key
    assert jobs_of(scenario, "other code")[0].key != first.key
    assert jobs_of(scenario, "code")[6].key != first.key
    assert Job.from_json(first.to_json()) == first


def test_seeds_are_a_count_or_a_list(scenario_file: Write) -> None:
    head = "function: a:b\n" + METRICS
    assert read_scenario(scenario_file(head + "seeds: 3\n")).seeds == (1, 2, 3)
    assert read_scenario(scenario_file(head + "seeds: [7, 5]\n")).seeds == (7, 5)
    assert read_scenario(scenario_file(head)).seeds == (1,)


def test_a_launch_file_is_a_subject(scenario_file: Write) -> None:
    text = "launch: multi_uav_simulation.launch recorded:=false\n" + METRICS
    scenario = read_scenario(scenario_file(text))
    assert scenario.subject == "launch multi_uav_simulation.launch recorded:=false"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (METRICS, "legal: either .function"),
        ("function: a:b\nlaunch: x.launch\n" + METRICS, "legal: either .function"),
        ("function: ab\n" + METRICS, "function: 'ab'; legal: module:name"),
        ("function: a:b\n", "no metrics"),
        ("function: a:b\nmetrics: {}\n", "metrics: none; legal"),
        ("function: a:b\nmetrics: {x: {better: more}}\n", "better: 'more'; legal: higher, lower"),
        ("function: a:b\nseeds: 0\n" + METRICS, "seeds: 0; legal: 1 to"),
        ("function: a:b\nseeds: [1, 1]\n" + METRICS, "seeds: a seed is given twice"),
        ("function: a:b\nseeds: [-1]\n" + METRICS, "seeds: .-1.; legal"),
        ("function: a:b\nheadline: x\n" + METRICS, "headline: unknown key"),
        ("function: a:b\nname: a/b\n" + METRICS, "name: 'a/b'; legal"),
        ("function: a:b\nlimits: {time_s: 0}\n" + METRICS, "time_s: 0; legal: above 0"),
        ("function: a:b\nlimits: {memory_mb: -1}\n" + METRICS, "memory_mb: -1; legal: 0"),
        ("function: a:b\nparameters: {g: 1}\naxes: {g: {list: [1]}}\n" + METRICS, "g: given twice"),
        ("function: a:b\naxes: {seed: {list: [1]}}\n" + METRICS, "seed is no axis"),
        (
            "function: a:b\naxes: {g: {range: [0, 1, 1000000]}}\nseeds: 9\n" + METRICS,
            "9000000 runs",
        ),
        (
            "function: a:b\nenough: {metric: scor, half_width: 1}\n" + METRICS,
            "did you mean 'score'",
        ),
        ("function: a:b\nenough: {metric: score}\n" + METRICS, "half_width 0; legal: above 0"),
        (
            "function: a:b\nseeds: 4\nenough: {metric: score, half_width: 1, least: 5}\n" + METRICS,
            "least: 5; legal: 2 to",
        ),
        (
            "function: a:b\naxes: {g: {list: [1, 2]}}\ncomparisons:\n"
            "  - {parameter: g, first: 1, second: 3, metric: score}\n" + METRICS,
            "second: 3: no value of g; legal: '1', '2'",
        ),
        (
            "function: a:b\naxes: {g: {list: [1, 2]}}\ncomparisons:\n"
            "  - {parameter: h, first: 1, second: 2, metric: score}\n" + METRICS,
            "parameter: 'h'; legal: g",
        ),
    ],
)
def test_bad_scenarios_are_one_error_with_file_and_line(
    scenario_file: Write, text: str, message: str
) -> None:
    with pytest.raises(FormationError, match=rf"study.yaml:\d+: .*{message}"):
        read_scenario(scenario_file(text))
