# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The reference pages that are made from the code."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest
import yaml
from trident_tool.lints.plugin_reference import parse_listing, plugins_page
from trident_tool.lints.reference import arguments_without_doc, check_reference, launch_page

LISTING = """\
push
push\tforce\tnumber\t1\t0\t100\t0
push\tlinkName\ttext\t\t-inf\tinf\t1
push\tframe\ttext\tbase_link\t-inf\tinf\t0
push\tcount\tinteger\t3\t-inf\t9\t0
"""


@pytest.fixture
def descriptions(tmp_path: Path) -> Path:
    elements = {"force": "that pushes [N]", "frame": "of it", "count": "of | them"}
    plugin = {"names": ["push"], "text": "Pushes.", "elements": elements}
    content = {
        "introduction": "All.",
        "common": {"linkName": "link"},
        "groups": [{"title": "Forces", "plugins": [plugin]}],
    }
    file = tmp_path / "plugins.yaml"
    file.write_text(yaml.safe_dump(content), encoding="utf-8")
    return file


def test_each_element_has_default_unit_range_and_meaning(descriptions: Path) -> None:
    problems: list[str] = []
    page = plugins_page(LISTING, descriptions, problems)
    assert problems == []
    assert "### `libpush.so`" in page
    assert "| `force` | `1` | N | 0 to 100 | that pushes |" in page
    assert "| `linkName` | required |  |  | link |" in page
    assert "| `frame` | the link's name |  |  | of it |" in page
    assert "| `count` | `3` |  | whole, <= 9 | of \\| them |" in page


@pytest.mark.parametrize(
    ("listing", "problem"),
    [
        (LISTING + "push\tmass\tnumber\t1\t0\t1\t0\n", "push has no text for <mass>"),
        (LISTING + "pull\n", "plugin pull is not in plugins.yaml"),
        (LISTING.replace("push\tforce", "push\tlinkName"), "push asks for no <force>"),
        ("pull\n", "there is no plugin push"),
    ],
)
def test_what_is_written_and_what_is_asked_for_must_agree(
    descriptions: Path, listing: str, problem: str
) -> None:
    problems: list[str] = []
    plugins_page(listing, descriptions, problems)
    assert any(problem in line for line in problems), problems


def test_a_listing_keeps_plugins_without_elements() -> None:
    assert parse_listing("quiet\n") == {"quiet": {}}


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    (tmp_path / "launch").mkdir()
    (tmp_path / "docs" / "reference").mkdir(parents=True)
    (tmp_path / "launch" / "a.launch").write_text(
        "<!-- SPDX-License-Identifier: X -->\n<!-- Flies\n a kite. -->\n<launch>"
        "<arg name='wind' default='3' doc='of the day [m/s]'/>"
        "<arg name='line' value='1'/></launch>",
        encoding="utf-8",
    )
    return tmp_path


def test_launch_arguments_are_those_of_the_files(clone: Path) -> None:
    page = launch_page(clone)
    assert "## trident_bringup a.launch\n\nFlies a kite.\n\n" in page
    assert "- `wind` (default `3`): of the day [m/s]" in page
    assert "line" not in page.split("Flies a kite")[1]


def test_a_page_that_differs_is_a_problem_until_it_is_written(
    clone: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    parser = argparse.ArgumentParser()
    assert check_reference(clone, parser, fix=False) == 1
    assert "launch_arguments.md: differs from the code" in capsys.readouterr().out
    assert check_reference(clone, parser, fix=True) == 0
    assert check_reference(clone, parser, fix=False) == 0


def test_an_argument_without_doc_is_a_problem(clone: Path) -> None:
    file = clone / "launch" / "a.launch"
    file.write_text("<launch><arg name='wind' default='3'/></launch>", encoding="utf-8")
    assert arguments_without_doc(clone) == ['launch/a.launch: <arg name="wind"> has no doc']
