# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""From samples to results; what launches are made of."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
from trident_benchmarks.machine import parse_cpu_model
from trident_benchmarks.procfs import Memory
from trident_benchmarks.sim.launches import JobWatch, job_result, startup_launch_text
from trident_benchmarks.sim.lockstep_result import Sample, to_result
from trident_benchmarks.sim.vehicle import MARKER, describe, place
from trident_eval.core.errors import EvalError


def test_a_result_is_the_difference_of_two_samples():
    begin = Sample(100.0, 1.0, 2.0, 0.5, 1000.0)
    end = Sample(101.5, 2.0, 2.6, 0.5, 1003.1)
    result = to_result(begin, end, 90.0)
    assert result["rtf"] == pytest.approx(60.0)
    assert result["cpu_s_per_sim_s"] == pytest.approx(1.6 / 90.0)
    assert result["others_cpu_cores"] == pytest.approx(1.0)
    assert result["cpu_split_s_per_sim_s"]["server"] == pytest.approx(1.0 / 90.0)


def test_ticks_cannot_make_the_others_negative():
    begin = Sample(0.0, 0.0, 0.0, 0.0, 0.0)
    assert to_result(begin, Sample(1.0, 1.0, 0.5, 0.0, 1.4), 60.0)["others_cpu_cores"] == 0.0


@pytest.mark.parametrize(("wall_s", "sim_s"), [(0.0, 60.0), (1.0, 0.0)])
def test_an_empty_window_is_refused(wall_s, sim_s):
    begin = Sample(0.0, 0.0, 0.0, 0.0, 0.0)
    with pytest.raises(EvalError, match="legal: both > 0"):
        to_result(begin, Sample(wall_s, 0.0, 0.0, 0.0, 0.0), sim_s)


def test_a_job_counts_the_cpu_of_its_simulated_time_only():
    watch = JobWatch(Path("none"), cpu=[(8.0, 1.0), (10.0, 3.0), (12.0, 7.0), (14.0, 7.0)])
    watch.memory = Memory(40.0, 67.0)
    summary = {"sim_s": 40.0, "wall_s": 2.0, "rtf": 20.0, "state_hash": "ab"}
    result = job_result(summary, watch, end=12.0)
    assert result["cpu_s_per_sim_s"] == pytest.approx(4.0 / 40.0)
    assert (result["rss_mb"], result["peak_rss_mb"], result["rtf"]) == (40.0, 67.0, 20.0)


def test_the_startup_launch_has_a_namespace_and_a_place_per_vehicle():
    root = ElementTree.fromstring(startup_launch_text(12))
    groups = root.findall("group")
    assert [group.get("ns") for group in groups] == [f"UAV{i}" for i in range(1, 13)]
    places = {
        tuple(arg.get("value") for arg in group.iter("arg") if arg.get("name") in ("x", "y"))
        for group in groups
    }
    assert len(places) == 12


def test_places_are_two_meters_apart_in_rows_of_ten():
    assert place(0) == (0.0, 0.0)
    assert place(9) == (18.0, 0.0)
    assert place(10) == (0.0, 2.0)


def test_a_description_is_the_template_with_the_name():
    assert describe(f"<a ns='{MARKER}'><b l='{MARKER}/base'/></a>", 4) == (
        "<a ns='UAV5'><b l='UAV5/base'/></a>"
    )


def test_the_processor_has_a_name_or_is_unknown():
    assert parse_cpu_model("processor : 0\nmodel name\t: Some  CPU @ 2 GHz\n") == "Some CPU @ 2 GHz"
    assert parse_cpu_model("processor : 0\n") == "unknown"
