# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Checks of the documentation: links lead somewhere, lines are of a length that can be read."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from pathlib import Path

MAX_COLUMNS = 120
MAX_CELL = 120
_CELL_BORDER = re.compile(r"(?<!\\)\|")
_LINK = re.compile(r"\]\(([^)\s]+)\)")
_HEADING = re.compile(r"^#{1,6}\s+(.*)$")
_LIST_ITEM = re.compile(r"^(\s*(?:[-*]|\d+\.)\s+|\s*)")
_STARTS_ITEM = re.compile(r"^\s*(?:[-*]|\d+\.)\s")
_LIKE_MARKER = re.compile(r" ([-+*#>]+|\d+\.) ")
_GLUE = "\u2060"  # joins words, and is no white space
_OUTSIDE = ("http://", "https://", "mailto:")


def prose_lines(text: str) -> Iterator[tuple[int, str]]:
    """Number and text of each line that is neither in a code block nor of a table."""
    is_code = False
    for number, line in enumerate(text.splitlines(), start=1):
        if line.lstrip().startswith("```"):
            is_code = not is_code
        elif not is_code and not line.lstrip().startswith("|"):
            yield number, line


def anchors(text: str) -> set[str]:
    """The anchors of a page's headings, as its viewers make them."""
    found = set()
    for _, line in prose_lines(text):
        heading = _HEADING.match(line)
        if heading:
            words = re.sub(r"[^\w\- ]", "", heading[1].lower())
            found.add(words.replace(" ", "-"))
    return found


def problems(path: Path, root: Path) -> list[str]:
    """What is wrong with a page, a line each: file, line, what.

    Args:
        path: the page.
        root: of the clone, for the names of files.
    """
    text = path.read_text(encoding="utf-8")
    name = path.relative_to(root)
    found = [f"{name}:{number}: {problem}" for number, problem in _bad_links(path, text)]
    for number, line in prose_lines(text):
        if _is_too_long(line):
            found.append(f"{name}:{number}: {len(line)} columns, legal: up to {MAX_COLUMNS}")
    for number, cell in _long_cells(text):
        found.append(f"{name}:{number}: a table cell of {cell} characters, legal: up to {MAX_CELL}")
    return found


def _is_too_long(line: str) -> bool:
    """Whether it could be wrapped; a picture and a single word cannot."""
    if len(line) <= MAX_COLUMNS:
        return False
    return " " in line.strip() and not line.lstrip().startswith("![")


def _long_cells(text: str) -> Iterator[tuple[int, int]]:
    """Line and length of each table cell that is a paragraph; a link counts by what is shown."""
    prose = dict(prose_lines(text))
    is_code = False
    for number, line in enumerate(text.splitlines(), start=1):
        is_code ^= line.lstrip().startswith("```")
        if is_code or number in prose or not line.startswith("|"):
            continue
        for cell in _CELL_BORDER.split(_LINK.sub("]", line)):
            if len(cell.strip()) > MAX_CELL:
                yield number, len(cell.strip())


def _bad_links(page: Path, text: str) -> Iterator[tuple[int, str]]:
    """Line of each link that leads nowhere, and why."""
    for number, line in enumerate(text.splitlines(), start=1):
        for target in _LINK.findall(line):
            if problem := _link_problem(page, target, text):
                yield number, problem


def _link_problem(page: Path, target: str, text: str) -> str:
    """Why a link leads nowhere, or ""."""
    if target.startswith(_OUTSIDE):
        return ""
    file, _, anchor = target.partition("#")
    linked = page.parent / file if file else page
    if not linked.exists():
        return f"link to '{target}': there is no {file}"
    if not anchor or linked.suffix != ".md":
        return ""
    if anchor in anchors(linked.read_text(encoding="utf-8") if file else text):
        return ""
    return f"link to '{target}': no heading has this anchor"


def wrapped(text: str) -> str:
    """The same page, with those paragraphs wrapped again that hold a line that is too long."""
    prose = dict(prose_lines(text))
    lines: list[str] = []
    paragraph: list[str] = []
    for number, line in enumerate(text.splitlines(), start=1):
        is_plain = number in prose and line.strip() and not line.startswith(("#", "!["))
        if paragraph and (not is_plain or _STARTS_ITEM.match(line)):
            lines += _broken(paragraph)
            paragraph = []
        if is_plain:
            paragraph.append(line)
        else:
            lines.append(line)
    return "\n".join(lines + _broken(paragraph)) + "\n"


def _broken(paragraph: list[str]) -> list[str]:
    """The lines of a paragraph, or of an item of a list, of legal length."""
    if all(len(line) <= MAX_COLUMNS for line in paragraph):
        return paragraph
    marker = _LIST_ITEM.match(paragraph[0])
    indent = " " * len(marker[1]) if marker else ""
    joined = " ".join([paragraph[0].rstrip(), *(line.strip() for line in paragraph[1:])])
    head, body = joined[: len(indent)], joined[len(indent) :]
    # A line must not begin with what starts an item of a list or a heading.
    kept = _LIKE_MARKER.sub(lambda found: _GLUE + found[1] + " ", body)
    broken = textwrap.wrap(
        head + kept,
        MAX_COLUMNS,
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [line.replace(_GLUE, " ") for line in broken]


def check_pages(pages: list[Path], root: Path, fix: bool) -> int:
    """Check all pages, after breaking their long lines if `fix`; returns 1 if one has a problem."""
    found: list[str] = []
    for page in pages:
        if fix:
            page.write_text(wrapped(page.read_text(encoding="utf-8")), encoding="utf-8")
        found += problems(page, root)
    for problem in found:
        print(problem)
    print(f"markdown: {len(found)} problems in {len(pages)} pages")
    return int(bool(found))
