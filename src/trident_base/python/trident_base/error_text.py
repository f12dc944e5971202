# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Texts of errors about bad input."""

from __future__ import annotations

import re

_SHOWN = 200
_LONG_WORD = re.compile(r"\S{201,}")
_LONGEST_PATH = 4096


def with_short_words(text: str) -> str:
    """A message with words of more than 200 characters cut, but for paths."""
    return _LONG_WORD.sub(_cut, text)


def _cut(word: re.Match[str]) -> str:
    is_path = "/" in word[0] and len(word[0]) <= _LONGEST_PATH
    return word[0] if is_path else word[0][:_SHOWN] + "..."
