# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tests for words: identifiers, comments and texts use the standard terms."""

from __future__ import annotations

from pathlib import Path

import pytest
from trident_tool.lints import words
from trident_tool.workspace import TridentError

_TABLE = """
report: {forms: [spoken, speaks], term: report}
return: {forms: [hands back], term: return}
max: {forms: [k most], term: kMax..., in: [identifiers]}
gone: {forms: [is nought], term: does not exist, in: [prose]}
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


@pytest.mark.parametrize(
    "identifier", ["spoken_once", "spokenOnce", "kSpoken", "is_spoken_", "SPOKEN_ONCE"]
)
def test_an_identifier_is_compared_in_its_parts(clone: Path, identifier: str) -> None:
    for name in ("a.cpp", "a.py"):
        assert [text.lower() for _, text in _found(clone, name, f"{identifier}")] == ["spoken"]


def test_a_word_of_several_parts_is_found_in_camel_case_only_where_they_follow(clone: Path) -> None:
    assert _found(clone, "a.h", "int kMostCells, most, kUtmost;") == [(1, "k Most")]


def test_a_phrase_is_found_across_the_lines_of_a_comment(clone: Path) -> None:
    assert _found(clone, "a.h", "int x;\n/// It hands\n/// back a pose.\n") == [
        (2, "hands\n    back")
    ]
    assert _found(clone, "a.py", "# It hands\n# back.\n") == [(1, "hands\n  back")]


def test_docstrings_and_texts_are_prose_and_a_string_without_a_space_is_not(clone: Path) -> None:
    text = 'def f():\n    """Is spoken."""\n    return "it\\nspeaks.", \'spoken\', f"{a} spoken"\n'
    assert _found(clone, "a.py", text) == [(2, "spoken"), (3, "spoken")]
    assert _found(clone, "a.py", 'a = """a text\nthat is\\tspoken"""\n') == [(2, "spoken")]


def test_texts_of_cpp_are_prose_and_digits_are_not_their_beginning(clone: Path) -> None:
    text = 'auto a = "is spoken // b"; auto b = "spoken"; int c = 1\'000; char d = \'"\';\n'
    assert _found(clone, "a.cpp", text + "// spoken\n") == [(1, "spoken"), (2, "spoken")]
    assert _found(clone, "a.cpp", 'auto a = R"x(hands\nback "it")x"; // b\n') == [
        (1, "hands\nback")
    ]


def test_a_word_counts_only_in_its_scope(clone: Path) -> None:
    assert _found(clone, "a.h", "int is_nought;  // there is nought\n") == [(1, "is nought")]
    assert _found(clone, "a.h", "// k most\n") == []


def test_a_name_of_another_project_is_its_own(clone: Path) -> None:
    table = _TABLE.replace("term: report}", "term: report, upstream: [lips.Spoken]}")
    _write(clone / words.TABLE, table)
    assert _found(clone, "a.py", "a: lips.Spoken\nspoken = 1\n") == [(2, "spoken")]


def test_a_part_of_a_word_is_no_match(clone: Path) -> None:
    assert _found(clone, "a.h", "// respoken, spoken-off, unspoken\nint respoken;\n") == []


def _check(clone: Path, fix: bool = False) -> int:
    return words.check_words(clone, sorted(clone.glob("src/**/*.*")), fix)


def test_a_word_that_the_baseline_does_not_allow_fails_with_its_place_and_term(
    clone: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _write(clone / "src/a/a.h", "\nint spoken;\n")
    assert _check(clone) == 1
    assert capsys.readouterr().err == "src/a/a.h:2: 'spoken': use report\n"


def test_the_baseline_allows_its_counts_and_no_more(clone: Path) -> None:
    _write(clone / words.BASELINE, "src/a: {report: 2}\n")
    _write(clone / "src/a/a.h", "// spoken\n")
    _write(clone / "src/a/test/a.h", "// spoken\n")
    assert _check(clone) == 0
    _write(clone / "src/a/b.py", "spoken = 1\n")
    assert _check(clone) == 1


def test_the_longest_folder_of_the_baseline_counts(clone: Path) -> None:
    _write(clone / words.BASELINE, "src/a: {report: 1}\nsrc/a/test: {report: 1}\n")
    _write(clone / "src/a/test/a.h", "// spoken, spoken\n")
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
    _write(clone / "src/a/a.h", "// spoken, hands back, hands back\n")
    assert _check(clone, fix=True) == 1
    assert "src/a: {report: 1, return: 1}" in (clone / words.BASELINE).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "entry",
    ["{forms: [spoken]}", "{term: report}", "{forms: [spoken], term: report, in: [strings]}"],
)
def test_an_incomplete_entry_of_the_table_is_an_error_that_names_it(
    clone: Path, entry: str
) -> None:
    path = _write(clone / words.TABLE, f"speak: {entry}\n")
    with pytest.raises(TridentError, match="speak"):
        words.read_words(path)
