# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The program sim_benchmark and the description that it is given, in a built workspace."""

from __future__ import annotations

import json
import subprocess

import pytest
from trident_benchmarks.sim.vehicle import MARKER, describe, expand_description, prepare, program
from trident_eval.core.errors import EvalError


@pytest.fixture(scope="module")
def benchmark():
    try:
        return program("trident_sim", "sim_benchmark")
    except (EvalError, FileNotFoundError) as error:
        pytest.skip(f"needs a built and sourced workspace: {error}")


@pytest.fixture(scope="module")
def setup(benchmark):
    return prepare(None)


@pytest.fixture
def words(benchmark, setup, tmp_path):
    urdf = tmp_path / "vehicle.urdf"
    urdf.write_text(setup.template)
    return {
        "--world": str(setup.world),
        "--urdf": str(urdf),
        "--marker": MARKER,
        "--parameters": " ".join(map(str, setup.parameter_files)),
        "--n": "2",
        "--window": "1",
        "--min-wall": "0",
    }


def _run(benchmark, words, *more):
    command = [benchmark, *(word for pair in words.items() for word in pair), *more]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_the_marker_stands_for_nothing_but_the_name(setup):
    assert describe(setup.template, 0) == expand_description("UAV1")


def test_two_vehicles_hover_and_two_flights_are_equal(benchmark, words):
    first, second = (json.loads(_run(benchmark, words).stdout) for _ in range(2))
    assert first["n"] == 2
    assert first["sim_s"] == 1.0
    assert first["rtf"] == pytest.approx(first["sim_s"] / first["wall_s"], rel=1e-3)
    assert first["lowest_z_m"] > 0.5
    assert 0.0 < first["rss_mb"] <= first["peak_rss_mb"]
    assert first["state_hash"] == second["state_hash"]


def test_windows_are_added_until_the_wall_time_is_reached(benchmark, words):
    result = json.loads(_run(benchmark, words | {"--min-wall": "0.05"}).stdout)
    assert result["wall_s"] >= 0.05
    assert result["sim_s"] % 1.0 == 0.0


def test_the_profile_has_every_stage(benchmark, words):
    profile = json.loads(_run(benchmark, words, "--profile").stdout)["profile_us_per_step"]
    assert list(profile) == ["sense", "control", "actuate", "physics", "post"]
    assert all(value > 0.0 for value in profile.values())


@pytest.mark.parametrize(
    ("bad", "error_text"),
    [
        ({"--n": "0"}, "option --n is '0', must be a whole number in [1, 1000]"),
        ({"--n": "2.5"}, "must be a whole number"),
        ({"--window": "soon"}, "option --window is 'soon'"),
        ({"--gpu": "1"}, "option --gpu is unknown"),
        ({"--world": "/no/such.world"}, "/no/such.world"),
        ({"--urdf": "/no/such.urdf"}, "file '/no/such.urdf' does not exist"),
        ({"--marker": "NOT_THERE"}, "does not contain the marker 'NOT_THERE'"),
        ({"--marker": ""}, "option --marker is missing"),
    ],
)
def test_bad_options_are_one_clear_error(benchmark, words, bad, error_text):
    result = _run(benchmark, words | bad)
    assert result.returncode == 1
    assert error_text in result.stderr
    assert result.stdout == ""
