# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Links and lines of the documentation."""

from __future__ import annotations

from pathlib import Path

import pytest
from trident_tool.lints.markdown import anchors, problems, wrapped

LONG = "word " * 40


@pytest.fixture
def page(tmp_path: Path) -> Path:
    (tmp_path / "other.md").write_text("# Two words, and `code`\n", encoding="utf-8")
    return tmp_path / "page.md"


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("[a](other.md)", ""),
        ("[a](other.md#two-words-and-code)", ""),
        ("[a](https://example.org/absent)", ""),
        ("# Here\n[a](#here)", ""),
        ("[a](absent.md)", "page.md:1: link to 'absent.md': there is no absent.md"),
        ("[a](other.md#three)", "page.md:1: link to 'other.md#three': no heading has this anchor"),
        ("| [a](absent.md) |", "page.md:1: link to 'absent.md': there is no absent.md"),
        (f"x\n{LONG}", "page.md:2: 200 columns, legal: up to 120"),
        (
            "| a | " + "x" * 121 + " |",
            "page.md:1: a table cell of 121 characters, legal: up to 120",
        ),
        ("| " + "x" * 120 + " | [b](other.md) |", ""),
        ("```\n| " + "x" * 121 + " |\n```", ""),
        (f"```\n{LONG}\n```", ""),
    ],
)
def test_pages_are_checked(page: Path, text: str, problem: str) -> None:
    page.write_text(text, encoding="utf-8")
    assert problems(page, page.parent) == ([problem] if problem else [])


def test_anchors_are_those_of_headings_outside_of_code() -> None:
    assert anchors("# A b\n```\n# no heading\n```\n## C-d e") == {"a-b", "c-d-e"}


def test_long_lines_are_broken_and_stay_items_of_their_list() -> None:
    lines = wrapped(f"- {LONG}\n\n| {LONG} |\n").splitlines()
    assert lines[0].startswith("- word")
    assert lines[1].startswith("  word")
    assert all(len(line) <= 120 for line in lines[:2])
    assert lines[-1] == f"| {LONG} |"


def test_a_paragraph_with_a_long_line_is_broken_as_a_whole() -> None:
    assert wrapped(f"{LONG.strip()}\nand so on\n") == (
        " ".join(["word"] * 24) + "\n" + " ".join(["word"] * 16) + " and so on\n"
    )
    short = "one\ntwo\n- three\n  four\n"
    assert wrapped(short) == short


def test_no_line_begins_like_an_item_of_a_list() -> None:
    text = "word " * 23 + "word - " + "word " * 10 + "\n"
    assert not any(line.startswith("-") for line in wrapped(text).splitlines())
