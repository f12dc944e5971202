# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Compares identifiers, comments and texts with the terms of the field: see tools/words.yaml."""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import yaml

from trident_tool.workspace import TridentError

TABLE = Path("tools/words.yaml")
BASELINE = Path("tools/words_baseline.yaml")
IDENTIFIERS, PROSE = "identifiers", "prose"

_CPP_TOKEN = re.compile(
    r"""(?P<prose>//[^\n]*(?:\n[ \t]*//[^\n]*)*|/\*.*?\*/)
      | (?P<quoted>R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)" | "(?:\\.|[^"\\\n])*") | '(?:\\.|[^'\\\n])+'
      | \d[\w.']* | (?P<identifiers>[A-Za-z_]\w*)""",
    re.VERBOSE | re.DOTALL,
)
_PYTHON_TOKEN = re.compile(
    r'''(?P<prose>\#[^\n]*(?:\n[ \t]*\#[^\n]*)*|(?:(?<=\n)|\A)[ \t]*r?""".*?""")
      | (?P<quoted>""".*?""" | \'\'\'.*?\'\'\' | "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])*')
      | \d[\w.]* | (?P<identifiers>[A-Za-z_]\w*)''',
    re.VERBOSE | re.DOTALL,
)
_COMMENT_MARK = re.compile(r"^[ \t]*(?://+<?|\*|#)", re.MULTILINE)
_ESCAPE = re.compile(r"\\.", re.DOTALL)
_PART = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")


@dataclass(frozen=True)
class Word:
    """A word of the table.

    Attributes:
        name: what the table calls it.
        term: the standard term, or several that fit in different places.
        forms: matches any of its forms.
        scopes: IDENTIFIERS, PROSE or both.
        upstream: names of other projects that have it, whole.
    """

    name: str
    term: str
    forms: re.Pattern[str]
    scopes: frozenset[str]
    upstream: tuple[str, ...] = ()


@dataclass(frozen=True)
class Place:
    """An occurrence of a word in a file (relative to the clone)."""

    path: Path
    line: int
    word: Word
    text: str


def read_words(path: Path) -> list[Word]:
    """Reads the table.

    Raises:
        TridentError: an entry has another form than name: {forms, term, in, upstream}.
    """
    table = yaml.safe_load(path.read_text(encoding="utf-8"))
    return [_read_word(path, name, entry) for name, entry in table.items()]


def _read_word(path: Path, name: str, entry: Mapping[str, object]) -> Word:
    scopes, forms = entry.get("in", [IDENTIFIERS, PROSE]), entry.get("forms")
    if not isinstance(scopes, list) or not set(scopes) <= {IDENTIFIERS, PROSE}:
        raise TridentError(f"{path}: {name}: 'in' is a list of {IDENTIFIERS} and {PROSE}")
    if not isinstance(forms, list) or not forms or not entry.get("term"):
        raise TridentError(f"{path}: {name}: needs 'forms' (a list) and 'term'")
    alternatives = "|".join(r"\s+".join(map(re.escape, str(form).split())) for form in forms)
    pattern = re.compile(rf"(?<![\w-])(?:{alternatives})(?![\w-])", re.IGNORECASE)
    upstream = entry.get("upstream", [])
    if not isinstance(upstream, list):
        raise TridentError(f"{path}: {name}: 'upstream' is a list of names")
    return Word(
        name, str(entry["term"]), pattern, frozenset(scopes), tuple(str(one) for one in upstream)
    )


def tokens(text: str, python: bool) -> Iterator[tuple[int, str, str]]:
    """Offset, scope and text of the identifiers, comments and quoted texts of a source.

    Identifiers are given in parts: ``kMaxRange`` and ``k_max_range`` as ``k max range``. In
    comments and docstrings the marks at the beginnings of lines are blanked, so that a phrase is
    found across lines; in quoted texts the escapes are. A quoted text without a space is left out.
    """
    for match in (_PYTHON_TOKEN if python else _CPP_TOKEN).finditer(text):
        if match[PROSE]:
            prose = _COMMENT_MARK.sub(lambda mark: " " * len(mark[0]), match[PROSE])
            yield match.start(), PROSE, prose
        elif match["quoted"] and " " in match["quoted"]:
            yield match.start(), PROSE, _ESCAPE.sub("  ", match["quoted"])
        elif match[IDENTIFIERS]:
            yield match.start(), IDENTIFIERS, " ".join(_PART.findall(match[IDENTIFIERS]))


class _Finder:
    """Finds the words of one scope, all in one pass."""

    def __init__(self, words: Iterable[Word], scope: str) -> None:
        self._words = [word for word in words if scope in word.scopes]
        self._any_form = re.compile("|".join(w.forms.pattern for w in self._words), re.IGNORECASE)

    def find(self, token: str) -> Iterator[tuple[Word, re.Match[str]]]:
        for match in self._any_form.finditer(token):
            yield next(word for word in self._words if word.forms.fullmatch(match[0])), match


def find_places(path: Path, text: str, words: Iterable[Word]) -> Iterator[Place]:
    """Every occurrence of the words in one source, in order."""
    listed = list(words)
    for name in (name for word in listed for name in word.upstream):
        text = text.replace(name, " " * len(name))
    finders = {scope: _Finder(listed, scope) for scope in (IDENTIFIERS, PROSE)}
    for start, scope, token in tokens(text, path.suffix not in (".h", ".cpp")):
        for word, match in finders[scope].find(token):
            offset = start + (match.start() if scope == PROSE else 0)
            line = text.count("\n", 0, offset) + 1
            yield Place(path, line, word, match[0])


def folder_of(path: Path, folders: Iterable[str]) -> str:
    """The longest of the folders that a file is in, or else its own folder."""
    found = [folder for folder in folders if path.is_relative_to(folder)]
    return max(found, key=len, default=path.parent.as_posix())


Baseline = dict[str, dict[str, int]]


def compare(places: Iterable[Place], baseline: Baseline) -> Iterator[str]:
    """One line for each word that a folder has more often than allowed, or no longer has."""
    found: dict[tuple[str, str], list[Place]] = {}
    for place in places:
        folder = folder_of(place.path, baseline)
        found.setdefault((folder, place.word.name), []).append(place)
    for (folder, name), listed in sorted(found.items()):
        allowed = baseline.get(folder, {}).get(name, 0)
        if len(listed) > allowed:
            yield from _excess(folder, allowed, listed)
    for folder, name in _allowed(baseline):
        if (folder, name) not in found:
            yield f"{BASELINE}: {folder} has no {name!r} any more: remove it (--fix does)"


def _allowed(baseline: Baseline) -> Iterator[tuple[str, str]]:
    """Every folder with each of its words that a baseline allows there."""
    return ((folder, name) for folder, allowances in baseline.items() for name in allowances)


def _excess(folder: str, allowed: int, places: list[Place]) -> Iterator[str]:
    if allowed:
        name = places[0].word.name
        yield f"{folder}: {len(places)} times {name!r}, the baseline allows {allowed}"
    for place in places:
        yield f"{place.path}:{place.line}: {place.text!r}: use {place.word.term}"


def lowered(baseline: Baseline, places: Iterable[Place]) -> Baseline:
    """The baseline with what has been converted taken off; nothing in it grows."""
    counts = Counter((folder_of(place.path, baseline), place.word.name) for place in places)
    result: Baseline = {}
    for folder, allowances in baseline.items():
        left = {name: min(most, counts[folder, name]) for name, most in allowances.items()}
        if kept := {name: most for name, most in left.items() if most}:
            result[folder] = kept
    return result


def write_baseline(path: Path, baseline: Baseline) -> None:
    """Writes a baseline; the comment at the head of an existing file is kept."""
    old = path.read_text(encoding="utf-8").splitlines(keepends=True) if path.is_file() else []
    head = "".join(line for line in old if line.startswith("#"))
    path.write_text(head + yaml.safe_dump(baseline, default_flow_style=None), encoding="utf-8")


def check_words(root: Path, sources: Iterable[Path], fix: bool) -> int:
    """Prints the words to replace; returns 0 if there are no more than the baseline allows.

    Args:
        root: the clone.
        sources: its C++ and Python files.
        fix: first lowers the baseline to what is left.
    """
    words = read_words(root / TABLE)
    places = [
        place
        for path in sources
        for place in find_places(path.relative_to(root), path.read_text(encoding="utf-8"), words)
    ]
    baseline: Baseline = yaml.safe_load((root / BASELINE).read_text(encoding="utf-8")) or {}
    if fix:
        baseline = lowered(baseline, places)
        write_baseline(root / BASELINE, baseline)
    found = list(compare(places, baseline))
    for line in found:
        print(line, file=sys.stderr)
    return int(bool(found))
