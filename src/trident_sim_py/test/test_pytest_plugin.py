# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The fixtures that users get, as pytest processes of their own see them."""

from __future__ import annotations

from pathlib import Path

from conftest import BALL, WORLD
from documents import run_unsourced


def pytest_of(folder: Path, test: str) -> str:
    """Output of pytest on a file with this test."""
    text = f"import pytest\nimport trident_sim\nWORLD = '''{WORLD}'''\nBALL = '''{BALL}'''\n{test}"
    (folder / "test_mine.py").write_text(text, encoding="utf-8")
    options = (
        "-q",
        "--strict-markers",
        "-p",
        "trident_sim.pytest_plugin",
        "-p",
        "no:cacheprovider",
    )
    return run_unsourced("-m", "pytest", *options, "test_mine.py", cwd=folder).stdout


def test_each_test_has_a_new_world_and_a_marker_says_which(tmp_path: Path) -> None:
    output = pytest_of(
        tmp_path,
        """
def test_default(world):
    assert "ground_plane" in world.models
    world.step(3)

def test_again(world):
    assert world.step_count == 0

@pytest.mark.world(WORLD, seed=5, timing="direct")
def test_marked(world):
    assert (world.name, world.seed) == ("tiny", 5)

def test_several(make_world):
    first, second = make_world(WORLD, seed=1), make_world(WORLD, seed=1)
    assert first is not second
    assert first.state_hash() == second.state_hash()
""",
    )
    assert "4 passed" in output, output


def test_a_failure_shows_where_everything_was(tmp_path: Path) -> None:
    output = pytest_of(
        tmp_path,
        """
@pytest.mark.world(WORLD)
def test_falls(world):
    world.spawn("ball", sdf=BALL, pose=(1.0, 2.0, 3.0))
    world.step(100)
    assert False
""",
    )
    assert "1 failed" in output, output
    assert "world 'tiny'" in output
    assert "1 s, 100 steps, seed 0" in output
    assert "ball: at (1.0000, 2.0000, -1.9490) m, (0.0000, 0.0000, -9.8000) m/s" in output
    assert "state hash " in output


def test_a_bad_world_is_an_error_of_the_fixture(tmp_path: Path) -> None:
    output = pytest_of(
        tmp_path,
        """
@pytest.mark.world("no_such.world")
def test_nothing(world):
    pass
""",
    )
    assert "1 error" in output, output
    assert "no_such.world" in output
