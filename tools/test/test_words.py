# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tests for words: identifiers and comments use the standard terms."""

from __future__ import annotations

from pathlib import Path

import pytest
from trident_tool.lints import words
from trident_tool.workspace import TridentError

_TABLE = """
report: {forms: [told, tells], term: report}
return: {forms: [gives back], term: return}
max: {forms: [k most], term: kMax..., in: [identifiers]}
gone: {forms: [is none], term: does not exist, in: [prose]}
"""


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """A clone with a table of four words and an empty baseline."""
    _write(tmp_path / words.TABLE, _TABLE)
    _write(tmp_path / words.BASELINE, "# What is left.\n{}\n")
    return tmp_path


def _write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def _found(clone: Path, name: str, text: str) -> list[tuple[int, str]]:
    table = words.read_words(clone / words.TABLE)
    return [(place.line, place.text) for place in words.find_places(Path(name), text, table)]


@pytest.mark.parametrize("identifier", ["told_once", "toldOnce", "kTold", "is_told_", "TOLD_ONCE"])
def test_an_identifier_is_compared_in_its_parts(clone: Path, identifier: str) -> None:
    for name in ("a.cpp", "a.py"):
        assert [text.lower() for _, text in _found(clone, name, f"{identifier}")] == ["told"]


def test_a_word_of_several_parts_is_found_in_camel_case_only_where_they_follow(clone: Path) -> None:
    assert _found(clone, "a.h", "int kMostCells, most, kUtmost;") == [(1, "k Most")]


def test_a_phrase_is_found_across_the_lines_of_a_comment(clone: Path) -> None:
    assert _found(clone, "a.h", "int x;\n/// It gives\n/// back a pose.\n") == [
        (2, "gives\n    back")
    ]
    assert _found(clone, "a.py", "# It gives\n# back.\n") == [(1, "gives\n  back")]


def test_docstrings_are_prose_and_other_strings_are_not_compared(clone: Path) -> None:
    text = 'def f():\n    """Is told."""\n    return "is told", \'told\', f"told"\n'
    assert _found(clone, "a.py", text) == [(2, "told")]


def test_strings_and_digits_of_cpp_are_not_compared(clone: Path) -> None:
    text = 'auto a = "told // told"; auto b = R"x(told " told)x"; int c = 1\'000; char d = \'"\';\n'
    assert _found(clone, "a.cpp", text + "// told\n") == [(2, "told")]


def test_a_word_counts_only_in_its_scope(clone: Path) -> None:
    assert _found(clone, "a.h", "int is_none;  // there is none\n") == [(1, "is none")]
    assert _found(clone, "a.h", "// k most\n") == []


def test_a_part_of_a_word_is_no_match(clone: Path) -> None:
    assert _found(clone, "a.h", "// retold, told-off, untold\nint retold;\n") == []


def _check(clone: Path, fix: bool = False) -> int:
    return words.check_words(clone, sorted(clone.glob("src/**/*.*")), fix)


def test_a_word_that_the_baseline_does_not_allow_fails_with_its_place_and_term(
    clone: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _write(clone / "src/a/a.h", "\nint told;\n")
    assert _check(clone) == 1
    assert capsys.readouterr().err == "src/a/a.h:2: 'told': use report\n"


def test_the_baseline_allows_its_counts_and_no_more(clone: Path) -> None:
    _write(clone / words.BASELINE, "src/a: {report: 2}\n")
    _write(clone / "src/a/a.h", "// told\n")
    _write(clone / "src/a/test/a.h", "// told\n")
    assert _check(clone) == 0
    _write(clone / "src/a/b.py", "told = 1\n")
    assert _check(clone) == 1


def test_the_longest_folder_of_the_baseline_counts(clone: Path) -> None:
    _write(clone / words.BASELINE, "src/a: {report: 1}\nsrc/a/test: {report: 1}\n")
    _write(clone / "src/a/test/a.h", "// told, told\n")
    assert _check(clone) == 1


def test_an_entry_of_the_baseline_without_the_word_fails_until_it_is_removed(
    clone: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _write(clone / words.BASELINE, "# What is left.\nsrc/a: {report: 2}\n")
    _write(clone / "src/a/a.h", "int a;\n")
    assert _check(clone) == 1
    assert "src/a has no 'report' any more" in capsys.readouterr().err
    assert _check(clone, fix=True) == 0
    assert (clone / words.BASELINE).read_text(encoding="utf-8") == "# What is left.\n{}\n"


def test_fix_lowers_the_counts_and_raises_none(clone: Path) -> None:
    _write(clone / words.BASELINE, "src/a: {report: 3, return: 1}\n")
    _write(clone / "src/a/a.h", "// told, gives back, gives back\n")
    assert _check(clone, fix=True) == 1
    assert "src/a: {report: 1, return: 1}" in (clone / words.BASELINE).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "entry", ["{forms: [told]}", "{term: report}", "{forms: [told], term: report, in: [strings]}"]
)
def test_an_incomplete_entry_of_the_table_is_an_error_that_names_it(
    clone: Path, entry: str
) -> None:
    path = _write(clone / words.TABLE, f"tell: {entry}\n")
    with pytest.raises(TridentError, match="tell"):
        words.read_words(path)
